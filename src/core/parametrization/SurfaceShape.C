// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/parametrization/SurfaceShape.H"

#include "core/base/DisjointSets.H"
#include "DynamicList.H"

namespace Foam::stability
{

namespace
{

// Finds the next point along the boundary for each point, -1 inside. Returns false if a
// point has several.
bool boundarySuccessors(
    const SurfaceTopology& topology, const UList<triFace>& triangles, labelList& next
)
{
    bool single = true;
    forAll(triangles, trianglei)
    {
        for (label k = 0; k < 3; ++k)
        {
            if (coherentNeighbour(topology, triangles, trianglei, k) < 0)
            {
                label& successor = next[triangles[trianglei][k]];
                single = single && successor < 0;
                successor = triangles[trianglei][(k + 1) % 3];
            }
        }
    }
    return single;
}

} // namespace

label coherentNeighbour(
    const SurfaceTopology& topology, const UList<triFace>& triangles, label trianglei,
    label k
)
{
    const label other = topology.neighbour(trianglei, k);
    if (other < 0)
    {
        return -1;
    }
    const triFace& t = triangles[trianglei];
    const label a = t[k];
    const label b = t[(k + 1) % 3];
    const triFace& o = triangles[other];
    return o[(cornerOf(o, b) + 1) % 3] == a ? other : -1;
}

Fans splitFans(
    const SurfaceTopology& topology, const UList<triFace>& triangles,
    const UList<bool>& cutEdges
)
{
    DisjointSets sets(3 * triangles.size());
    forAll(triangles, trianglei)
    {
        for (label k = 0; k < 3; ++k)
        {
            const label other = coherentNeighbour(topology, triangles, trianglei, k);
            if (other < trianglei || cutEdges[topology.triangleEdges()[trianglei][k]])
            {
                continue;
            }
            for (const label corner : {k, (k + 1) % 3})
            {
                const label pointi = triangles[trianglei][corner];
                sets.unite(
                    3 * trianglei + corner,
                    3 * other + cornerOf(triangles[other], pointi)
                );
            }
        }
    }
    Fans fans;
    fans.corners.setSize(triangles.size());
    DynamicList<label> points;
    labelList vertices(3 * triangles.size(), -1);
    forAll(triangles, trianglei)
    {
        for (label k = 0; k < 3; ++k)
        {
            label& vertex = vertices[sets.root(3 * trianglei + k)];
            if (vertex < 0)
            {
                vertex = points.size();
                points.append(triangles[trianglei][k]);
            }
            fans.corners[trianglei][k] = vertex;
        }
    }
    fans.points = labelList(std::move(points));
    return fans;
}

List<labelList> boundaryLoops(label nPoints, const UList<triFace>& triangles)
{
    const SurfaceTopology topology(nPoints, triangles);
    labelList next(nPoints, -1);
    boundarySuccessors(topology, triangles, next);

    DynamicList<labelList> loops;
    List<bool> seen(nPoints, false);
    for (label start = 0; start < nPoints; ++start)
    {
        DynamicList<label> loop;
        for (label i = start; i >= 0 && next[i] >= 0 && !seen[i]; i = next[i])
        {
            seen[i] = true;
            loop.append(i);
        }
        if (!loop.empty())
        {
            loops.append(labelList(std::move(loop)));
        }
    }
    return List<labelList>(std::move(loops));
}

SurfaceShape shapeOf(label nPoints, const UList<triFace>& triangles)
{
    SurfaceShape shape;
    const SurfaceTopology topology(nPoints, triangles);
    List<bool> used(nPoints, false);
    for (const triFace& t : triangles)
    {
        used[t[0]] = used[t[1]] = used[t[2]] = true;
    }
    label nUsed = 0;
    for (const bool u : used)
    {
        nUsed += u;
    }
    shape.euler = nUsed - topology.edges().size() + triangles.size();
    shape.nLoops = boundaryLoops(nPoints, triangles).size();

    labelList next(nPoints, -1);
    shape.manifold = topology.nNonManifoldEdges() == 0
                     && boundarySuccessors(topology, triangles, next);
    return shape;
}

} // namespace Foam::stability
