// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/parametrization/seams/TreeCotree.H"

#include "core/base/DisjointSets.H"
#include "core/parametrization/seams/EdgePaths.H"

#include <algorithm>
#include <numeric>

namespace Foam::stability
{

namespace
{

// The edges, those that close the heaviest loops with the paths first.
labelList heaviestFirst(
    const SurfaceTopology& topology, const EdgePaths& paths, const scalarField& weights
)
{
    scalarField loops(weights.size());
    forAll(loops, edgei)
    {
        const SurfaceEdge& e = topology.edges()[edgei];
        loops[edgei] = paths.distances()[e.a] + weights[edgei] + paths.distances()[e.b];
    }
    labelList order(weights.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(
        order.begin(), order.end(),
        [&](label i, label j) { return loops[i] > loops[j]; }
    );
    return order;
}

// The last edges of the paths, as far as they make a tree where each boundary loop
// counts as one point: paths of equal weight may reach a loop at several of its points.
List<bool> spanningPaths(
    label nPoints, const SurfaceTopology& topology, const List<bool>& onBoundary,
    const EdgePaths& paths
)
{
    const List<SurfaceEdge>& edges = topology.edges();
    DisjointSets joined(nPoints);
    forAll(edges, edgei)
    {
        if (onBoundary[edgei])
        {
            joined.unite(edges[edgei].a, edges[edgei].b);
        }
    }
    labelList order(nPoints);
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(
        order.begin(), order.end(),
        [&](label i, label j) { return paths.distances()[i] < paths.distances()[j]; }
    );
    List<bool> inTree(edges.size(), false);
    for (const label pointi : order)
    {
        const label edgei = paths.arrival(pointi);
        if (edgei >= 0 && joined.root(edges[edgei].a) != joined.root(edges[edgei].b))
        {
            joined.unite(edges[edgei].a, edges[edgei].b);
            inTree[edgei] = true;
        }
    }
    return inTree;
}

// Removes the dangling ends of a graph.
void prune(label nPoints, const List<SurfaceEdge>& edges, List<bool>& graph)
{
    const Rows pointEdges(
        nPoints,
        [&](auto add)
        {
            forAll(edges, edgei)
            {
                add(edges[edgei].a, edgei);
                add(edges[edgei].b, edgei);
            }
        }
    );
    labelList degrees(nPoints, 0);
    forAll(edges, edgei)
    {
        degrees[edges[edgei].a] += graph[edgei];
        degrees[edges[edgei].b] += graph[edgei];
    }
    forAll(degrees, start)
    {
        for (label pointi = start; degrees[pointi] == 1;)
        {
            label last = -1;
            for (const label edgei : pointEdges[pointi])
            {
                last = graph[edgei] ? edgei : last;
            }
            graph[last] = false;
            --degrees[pointi];
            pointi = edges[last].a == pointi ? edges[last].b : edges[last].a;
            --degrees[pointi];
        }
    }
}

} // namespace

List<bool> openingLoops(
    const PlainSurface& surface, const SurfaceTopology& topology,
    const List<bool>& onBoundary, const scalarField& weights, label root
)
{
    const label nPoints = surface.points.size();
    const EdgePaths paths(nPoints, topology, weights, labelList(1, root));
    const List<bool> inPaths(spanningPaths(nPoints, topology, onBoundary, paths));
    DisjointSets joined(surface.triangles.size());
    List<bool> graph(weights.size(), true);
    for (const label edgei : heaviestFirst(topology, paths, weights))
    {
        const label* t = topology.edges()[edgei].triangles;
        if (!onBoundary[edgei] && !inPaths[edgei]
            && joined.root(t[0]) != joined.root(t[1]))
        {
            joined.unite(t[0], t[1]);
            graph[edgei] = false;
        }
    }
    prune(nPoints, topology.edges(), graph);
    return graph;
}

} // namespace Foam::stability
