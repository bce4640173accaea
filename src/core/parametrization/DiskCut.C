// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/parametrization/DiskCut.H"

#include "core/base/Errors.H"
#include "core/parametrization/EdgePaths.H"
#include "DynamicList.H"

#include <functional>
#include <queue>
#include <utility>
#include <vector>

namespace Foam::stability
{

DiskCut::DiskCut(const PlainSurface& surface, label nBranches)
    : surface_(surface), topology_(surface.points.size(), surface.triangles),
      cut_(topology_.edges().size(), false), border_(topology_.edges().size(), false)
{
    bool closed = true;
    forAll(surface_.triangles, trianglei)
    {
        for (label k = 0; k < 3; ++k)
        {
            if (coherentNeighbour(topology_, surface_.triangles, trianglei, k) < 0)
            {
                border_[topology_.triangleEdges()[trianglei][k]] = true;
                closed = false;
            }
        }
    }
    cut_ = border_;
    if (!closed || !openClosedSphere(nBranches))
    {
        cutComplement(growTree());
    }
    fans_ = splitFans(topology_, surface_.triangles, cut_);

    if (!shapeOf(fans_.points.size(), disk().triangles).isDisk())
    {
        throw NumericalFailure("it could not be cut to a disk");
    }
}

// A closed component of genus 0 has no loop to cut along: it is opened between two
// points far apart. False for any other genus.
bool DiskCut::openClosedSphere(label nBranches)
{
    const SurfaceShape shape = shapeOf(surface_.points.size(), surface_.triangles);
    if (shape.euler != 2)
    {
        return false;
    }
    // Twice farthest finds the ends of the surface's length.
    const label start = surface_.triangles[0][0];
    const label one =
        EdgePaths(surface_.points, topology_, labelList(1, start)).farthest();
    const EdgePaths paths(surface_.points, topology_, labelList(1, one));
    labelList path = paths.edgesTo(paths.farthest());
    if (path.size() == 1)
    {
        // A single edge opens nothing: take the other two of its triangle.
        const FixedList<label, 3>& around =
            topology_.triangleEdges()[topology_.edges()[path[0]].triangles[0]];
        const label only = path[0];
        path.clear();
        for (const label edgei : around)
        {
            if (edgei != only)
            {
                path.append(edgei);
            }
        }
    }
    for (const label edgei : path)
    {
        cut_[edgei] = true;
    }
    // Branches to what is then farthest from the cut: along a single slit the chart of
    // a sphere varies by 35 times in area, with two branches by 5, and p drifts less.
    for (label i = 0; i < nBranches; ++i)
    {
        addBranch();
    }
    return true;
}

// A path from the cut to the point farthest from it: the cut stays a tree.
void DiskCut::addBranch()
{
    DynamicList<label> onCut;
    forAll(cut_, edgei)
    {
        if (cut_[edgei])
        {
            onCut.append(topology_.edges()[edgei].a);
            onCut.append(topology_.edges()[edgei].b);
        }
    }
    const EdgePaths paths(surface_.points, topology_, onCut);
    // No branch where all points are on the cut, as on a tetrahedron.
    for (const label edgei : paths.edgesTo(paths.farthest()))
    {
        cut_[edgei] = true;
    }
}

// The edges that a disk crosses as it grows from the first triangle to its nearest
// neighbours (by the length of the paths over centres) until it covers all.
labelList DiskCut::growTree() const
{
    const List<triFace>& triangles = surface_.triangles;
    const auto centre = [&](label t) { return triangles[t].centre(surface_.points); };

    using Entry = std::pair<scalar, label>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
    scalarField distances(triangles.size(), GREAT);
    labelList entries(triangles.size(), -1);
    distances[0] = 0;
    queue.emplace(0, 0);
    while (!queue.empty())
    {
        const auto [distance, trianglei] = queue.top();
        queue.pop();
        if (distance > distances[trianglei])
        {
            continue;
        }
        for (label k = 0; k < 3; ++k)
        {
            const label edgei = topology_.triangleEdges()[trianglei][k];
            const label other = topology_.neighbour(trianglei, k);
            if (cut_[edgei] || other < 0)
            {
                continue;
            }
            const scalar further = distance + mag(centre(other) - centre(trianglei));
            if (further < distances[other])
            {
                distances[other] = further;
                entries[other] = edgei;
                queue.emplace(further, other);
            }
        }
    }
    return entries;
}

// All edges that the tree does not cross, less their dangling ends. The boundary is
// a part of that graph and stays, so that its loops end up joined.
void DiskCut::cutComplement(const labelList& treeEdges)
{
    const List<SurfaceEdge>& edges = topology_.edges();
    List<bool> graph(edges.size(), true);
    for (const label edgei : treeEdges)
    {
        if (edgei >= 0)
        {
            graph[edgei] = false;
        }
    }
    const Rows pointEdges(
        surface_.points.size(),
        [&](auto add)
        {
            forAll(edges, edgei)
            {
                add(edges[edgei].a, edgei);
                add(edges[edgei].b, edgei);
            }
        }
    );
    labelList degrees(surface_.points.size(), 0);
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
    forAll(edges, edgei)
    {
        cut_[edgei] = cut_[edgei] || graph[edgei];
    }
}

bool DiskCut::extendTo(label pointi)
{
    List<bool> onBoundary(surface_.points.size(), false);
    forAll(cut_, edgei)
    {
        if (cut_[edgei])
        {
            onBoundary[topology_.edges()[edgei].a] = true;
            onBoundary[topology_.edges()[edgei].b] = true;
        }
    }
    if (onBoundary[pointi])
    {
        return false;
    }
    DynamicList<label> sources;
    forAll(onBoundary, i)
    {
        if (onBoundary[i])
        {
            sources.append(i);
        }
    }
    for (const label edgei :
         EdgePaths(surface_.points, topology_, sources).edgesTo(pointi))
    {
        cut_[edgei] = true;
    }
    fans_ = splitFans(topology_, surface_.triangles, cut_);
    return true;
}

List<labelPair> DiskCut::seams() const
{
    DynamicList<labelPair> seams;
    forAll(cut_, edgei)
    {
        if (cut_[edgei] && !border_[edgei])
        {
            seams.append(
                labelPair(topology_.edges()[edgei].a, topology_.edges()[edgei].b)
            );
        }
    }
    return List<labelPair>(std::move(seams));
}

PlainSurface DiskCut::disk() const
{
    PlainSurface result{
        pointField(surface_.points, fans_.points), List<triFace>(fans_.corners.size())};
    forAll(fans_.corners, trianglei)
    {
        const CornerIndices& c = fans_.corners[trianglei];
        result.triangles[trianglei] = triFace(c[0], c[1], c[2]);
    }
    return result;
}

} // namespace Foam::stability
