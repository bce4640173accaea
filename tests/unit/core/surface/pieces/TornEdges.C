// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/surface/pieces/TornEdges.H"

#include "shapes/Surfaces.H"
#include "shapes/ThreadRanks.H"

#include <gtest/gtest.h>

namespace Foam::stability
{

namespace
{

// A sphere with a hole of one triangle, and a sheet whose rim is on the boundary.
SurfacePiece tornScene(bool torn)
{
    const scalar h = 0.1;
    InterfaceMesh mesh(
        shapes::asInterface(shapes::sphere(point(0.03, 0.02, 0.01), 1, 3), h)
    );
    if (torn)
    {
        mesh.triangles.setSize(mesh.triangles.size() - 1);
    }
    const InterfaceMesh sheet(shapes::asInterface(
        shapes::grid(
            [](scalar u, scalar v) { return point(2 * u - 1, 2 * v - 1, -1.4); }, 9, 9
        ),
        h
    ));
    const label first = mesh.points.size();
    mesh.points.append(sheet.points);
    for (const triFace& t : sheet.triangles)
    {
        mesh.triangles.append(triFace(t[0] + first, t[1] + first, t[2] + first));
    }
    mesh.cells = labelList(mesh.points.size(), 0);
    mesh.cellSizes = scalarField(mesh.points.size(), h);
    mesh.boundaryFaces = labelList(mesh.points.size(), 5);
    for (label i = 0; i < first; ++i)
    {
        mesh.boundaryFaces[i] = -1;
    }
    mesh.clearParametrization();
    return wholeSurface(mesh);
}

label tornOn(label nRanks, const SurfacePiece& whole)
{
    label found = -1;
    shapes::onRanks(
        nRanks,
        [&](const Exchange& exchange)
        {
            DynamicList<label> mine;
            forAll(whole.mesh.triangles, i)
            {
                const scalar x = whole.mesh.centre(i).x() + 5;
                if (label(x / 0.37) % nRanks == exchange.rank())
                {
                    mine.append(i);
                }
            }
            const SurfacePiece piece(partOf(whole, mine));
            VoxelMask around(0.3);
            for (const point& x : piece.mesh.points)
            {
                around.add(x, 0.3);
            }
            const label n =
                tornEdges(SurfaceHalo(piece, around, exchange), std::nullopt, exchange);
            if (exchange.isMaster())
            {
                found = n;
            }
        }
    );
    return found;
}

} // namespace

TEST(TornEdges, areThoseOfAHoleWithinTheDomain)
{
    for (const label nRanks : {1, 2, 3})
    {
        EXPECT_EQ(tornOn(nRanks, tornScene(false)), 0);
        EXPECT_EQ(tornOn(nRanks, tornScene(true)), 3);
    }
}

// Where points are not welded, ranks tear the surface: this is what is looked for.
TEST(TornEdges, areWherePiecesAreNotWelded)
{
    SurfacePiece whole(tornScene(false));
    whole.sharesPoints = false;
    EXPECT_EQ(tornOn(1, whole), 0);
    EXPECT_GT(tornOn(2, whole), 20);
}

} // namespace Foam::stability
