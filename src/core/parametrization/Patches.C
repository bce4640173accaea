// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/parametrization/Patches.H"

#include "core/base/Rows.H"
#include "core/parametrization/SurfaceShape.H"
#include "DynamicList.H"

namespace Foam::stability
{

namespace
{

// Edges across which the materials change.
List<bool> materialEdges(const InterfaceMesh& mesh, const SurfaceTopology& topology)
{
    const List<SurfaceEdge>& edges = topology.edges();
    List<bool> cut(edges.size(), false);
    forAll(edges, edgei)
    {
        const label* t = edges[edgei].triangles;
        cut[edgei] =
            t[0] >= 0 && t[1] >= 0 && mesh.materials[t[0]] != mesh.materials[t[1]];
    }
    return cut;
}

// Numbers of pieces per triangle, in the order of their lowest triangle.
labelList numberPieces(
    const InterfaceMesh& mesh, const SurfaceTopology& topology, const List<bool>& cut,
    label& nPieces
)
{
    nPieces = 0;
    labelList pieces(mesh.triangles.size(), -1);
    DynamicList<label> front;
    forAll(pieces, start)
    {
        if (pieces[start] >= 0)
        {
            continue;
        }
        pieces[start] = nPieces;
        front.append(start);
        while (!front.empty())
        {
            const label trianglei = front.remove();
            for (label k = 0; k < 3; ++k)
            {
                const label other =
                    coherentNeighbour(topology, mesh.triangles, trianglei, k);
                if (other >= 0 && pieces[other] < 0
                    && !cut[topology.triangleEdges()[trianglei][k]])
                {
                    pieces[other] = nPieces;
                    front.append(other);
                }
            }
        }
        ++nPieces;
    }
    return pieces;
}

// `numbers` (all -1 on entry and on return) holds the points of the patch.
Patch extract(
    const InterfaceMesh& mesh, const Fans& fans, const labelUList& triangles,
    labelList& numbers
)
{
    Patch patch;
    patch.surface.triangles.setSize(triangles.size());
    DynamicList<label> vertices;
    forAll(triangles, i)
    {
        for (label k = 0; k < 3; ++k)
        {
            const label vertex = fans.corners[triangles[i]][k];
            if (numbers[vertex] < 0)
            {
                numbers[vertex] = vertices.size();
                vertices.append(vertex);
            }
            patch.surface.triangles[i][k] = numbers[vertex];
        }
    }
    for (const label vertex : vertices)
    {
        numbers[vertex] = -1;
    }
    patch.points = labelList(fans.points, vertices);
    patch.surface.points = pointField(mesh.points, patch.points);
    patch.materials = mesh.materials[triangles[0]];
    patch.lowestTriangle = triangles[0];
    return patch;
}

} // namespace

List<Patch> patchesOf(const InterfaceMesh& mesh)
{
    const SurfaceTopology topology(mesh.points.size(), mesh.triangles);
    const List<bool> cut = materialEdges(mesh, topology);
    const Fans fans = splitFans(topology, mesh.triangles, cut);
    label nPieces = 0;
    const labelList pieces = numberPieces(mesh, topology, cut, nPieces);
    const Rows pieceTriangles(
        nPieces,
        [&](auto add)
        {
            forAll(pieces, trianglei)
            {
                add(pieces[trianglei], trianglei);
            }
        }
    );
    labelList numbers(fans.points.size(), -1);
    List<Patch> patches(nPieces);
    forAll(patches, i)
    {
        patches[i] = extract(mesh, fans, pieceTriangles[i], numbers);
    }
    return patches;
}

} // namespace Foam::stability
