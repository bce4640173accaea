// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/parametrization/seams/SteinerTree.H"

#include "core/base/DisjointSets.H"
#include "core/parametrization/seams/EdgePaths.H"

#include <algorithm>
#include <vector>

namespace Foam::stability
{

labelList steinerTree(
    label nPoints, const SurfaceTopology& topology, const scalarField& weights,
    const List<labelList>& groups
)
{
    labelList groupOf(nPoints, -1);
    DynamicList<label> sources;
    forAll(groups, i)
    {
        for (const label pointi : groups[i])
        {
            groupOf[pointi] = i;
            sources.append(pointi);
        }
    }
    const EdgePaths paths(nPoints, topology, weights, sources);
    struct Bridge
    {
        scalar weight;
        label edge, from, to; // groups
    };
    std::vector<Bridge> bridges;
    forAll(weights, edgei)
    {
        const SurfaceEdge& e = topology.edges()[edgei];
        const label a = paths.origins()[e.a], b = paths.origins()[e.b];
        if (a >= 0 && b >= 0 && groupOf[a] != groupOf[b])
        {
            bridges.push_back(
                {paths.distances()[e.a] + weights[edgei] + paths.distances()[e.b],
                 edgei, groupOf[a], groupOf[b]}
            );
        }
    }
    std::sort(
        bridges.begin(), bridges.end(),
        [](const Bridge& a, const Bridge& b)
        { return a.weight != b.weight ? a.weight < b.weight : a.edge < b.edge; }
    );
    DisjointSets joined(groups.size());
    List<bool> inTree(weights.size(), false);
    for (const Bridge& bridge : bridges)
    {
        if (joined.root(bridge.from) != joined.root(bridge.to))
        {
            joined.unite(bridge.from, bridge.to);
            const SurfaceEdge& e = topology.edges()[bridge.edge];
            inTree[bridge.edge] = true;
            for (const label end : {e.a, e.b})
            {
                for (const label edgei : paths.edgesTo(end))
                {
                    inTree[edgei] = true;
                }
            }
        }
    }
    DynamicList<label> tree;
    forAll(inTree, edgei)
    {
        if (inTree[edgei])
        {
            tree.append(edgei);
        }
    }
    return labelList(std::move(tree));
}

} // namespace Foam::stability
