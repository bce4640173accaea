// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/parametrization/seams/EdgePaths.H"

#include <functional>
#include <queue>
#include <utility>
#include <vector>

namespace Foam::stability
{

namespace
{

Rows edgesOfPoints(label nPoints, const List<SurfaceEdge>& edges)
{
    return Rows(
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
}

} // namespace

scalarField edgeLengths(const pointField& points, const SurfaceTopology& topology)
{
    const List<SurfaceEdge>& edges = topology.edges();
    scalarField lengths(edges.size());
    forAll(edges, edgei)
    {
        lengths[edgei] = mag(points[edges[edgei].b] - points[edges[edgei].a]);
    }
    return lengths;
}

EdgePaths::EdgePaths(
    const pointField& points, const SurfaceTopology& topology, const labelUList& sources
)
    : EdgePaths(points.size(), topology, edgeLengths(points, topology), sources)
{
}

EdgePaths::EdgePaths(
    label nPoints, const SurfaceTopology& topology, const scalarField& weights,
    const labelUList& sources
)
    : topology_(topology), distances_(nPoints, GREAT), origins_(nPoints, -1),
      arrivals_(nPoints, -1)
{
    const List<SurfaceEdge>& edges = topology.edges();
    const Rows pointEdges = edgesOfPoints(nPoints, edges);

    using Entry = std::pair<scalar, label>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
    for (const label source : sources)
    {
        distances_[source] = 0;
        origins_[source] = source;
        queue.emplace(0, source);
    }
    while (!queue.empty())
    {
        const auto [distance, pointi] = queue.top();
        queue.pop();
        if (distance > distances_[pointi])
        {
            continue;
        }
        for (const label edgei : pointEdges[pointi])
        {
            const SurfaceEdge& e = edges[edgei];
            const label other = e.a == pointi ? e.b : e.a;
            const scalar further = distance + weights[edgei];
            if (further < distances_[other])
            {
                distances_[other] = further;
                origins_[other] = origins_[pointi];
                arrivals_[other] = edgei;
                queue.emplace(further, other);
            }
        }
    }
}

labelList EdgePaths::edgesTo(label pointi) const
{
    DynamicList<label> path;
    while (pointi >= 0 && arrivals_[pointi] >= 0)
    {
        const SurfaceEdge& e = topology_.edges()[arrivals_[pointi]];
        path.append(arrivals_[pointi]);
        pointi = e.a == pointi ? e.b : e.a;
    }
    return labelList(std::move(path));
}

label EdgePaths::farthest() const
{
    label best = -1;
    forAll(distances_, pointi)
    {
        const scalar d = distances_[pointi];
        if (d > 0 && d < GREAT && (best < 0 || d > distances_[best]))
        {
            best = pointi;
        }
    }
    return best;
}

} // namespace Foam::stability
