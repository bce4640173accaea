// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/surface/SurfaceTopology.H"

#include "core/base/DisjointSets.H"

#include <algorithm>
#include <vector>

namespace Foam::stability
{

namespace
{

// One side of a triangle, to be sorted by its points.
struct Side
{
    label a, b, trianglei, k;

    bool operator<(const Side& s) const
    {
        return a != s.a   ? a < s.a
               : b != s.b ? b < s.b
                          : 3 * trianglei + k < 3 * s.trianglei + s.k;
    }
};

} // namespace

Rows trianglesAtPoints(label nPoints, const UList<triFace>& triangles)
{
    return Rows(
        nPoints,
        [&](auto&& add)
        {
            forAll(triangles, trianglei)
            {
                for (const label pointi : triangles[trianglei])
                {
                    add(pointi, trianglei);
                }
            }
        }
    );
}

SurfaceTopology::SurfaceTopology(label nPoints, const UList<triFace>& triangles)
    : triangleEdges_(triangles.size()), components_(triangles.size(), -1)
{
    std::vector<Side> sides;
    sides.reserve(3 * std::size_t(triangles.size()));
    forAll(triangles, trianglei)
    {
        for (label k = 0; k < 3; ++k)
        {
            const label p = triangles[trianglei][k];
            const label q = triangles[trianglei][(k + 1) % 3];
            sides.push_back({std::min(p, q), std::max(p, q), trianglei, k});
        }
    }
    std::sort(sides.begin(), sides.end());

    DisjointSets sets(triangles.size());
    DynamicList<SurfaceEdge> edges(2 * triangles.size());
    for (const Side& side : sides)
    {
        if (edges.empty() || edges.last().a != side.a || edges.last().b != side.b)
        {
            edges.append(SurfaceEdge{side.a, side.b, {-1, -1}, 0});
        }
        SurfaceEdge& edge = edges.last();
        if (edge.nTriangles < 2)
        {
            edge.triangles[edge.nTriangles] = side.trianglei;
        }
        ++edge.nTriangles;
        triangleEdges_[side.trianglei][side.k] = edges.size() - 1;

        sets.unite(edge.triangles[0], side.trianglei);
    }
    edges_ = std::move(edges);
    numberComponents(nPoints, triangles, sets);
}

void SurfaceTopology::numberComponents(
    label nPoints, const UList<triFace>& triangles, DisjointSets& sets
)
{
    labelList lowestPoint(triangles.size(), nPoints);
    std::vector<label> roots;
    forAll(triangles, trianglei)
    {
        const label root = sets.root(trianglei);
        if (root == trianglei)
        {
            roots.push_back(root);
        }
        for (const label pointi : triangles[trianglei])
        {
            lowestPoint[root] = std::min(lowestPoint[root], pointi);
        }
    }
    std::stable_sort(
        roots.begin(), roots.end(),
        [&](label r, label s) { return lowestPoint[r] < lowestPoint[s]; }
    );
    nComponents_ = roots.size();
    for (label i = 0; i < nComponents_; ++i)
    {
        components_[roots[i]] = i;
    }
    forAll(triangles, trianglei)
    {
        components_[trianglei] = components_[sets.root(trianglei)];
    }
}

label SurfaceTopology::neighbour(label trianglei, label k) const
{
    const SurfaceEdge& edge = edges_[triangleEdges_[trianglei][k]];
    if (edge.nTriangles != 2 || edge.triangles[0] == edge.triangles[1])
    {
        return -1;
    }
    return edge.triangles[0] == trianglei ? edge.triangles[1] : edge.triangles[0];
}

label SurfaceTopology::nNonManifoldEdges() const
{
    return std::count_if(
        edges_.begin(), edges_.end(),
        [](const SurfaceEdge& edge) { return edge.nTriangles > 2; }
    );
}

} // namespace Foam::stability
