// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/reconstruction/InterfaceSmoothing.H"
#include "core/cells/CellPlacement.H"
#include "core/reconstruction/IsoAlpha.H"
#include "shapes/ExactAlpha.H"
#include "shapes/PolyMeshes.H"

#include <gtest/gtest.h>

using namespace Foam;
using namespace Foam::stability;

// Thin tetrahedra at the walls: points could leave the domain in one move.
TEST(InterfaceSmoothing, pointsStayInTheDomainAndKnowTheirCells)
{
    shapes::BoxOptions options;
    options.n = Vector<label>(8, 8, 8);
    const auto complex = shapes::complexOf(shapes::tetrahedralBox(options));
    const shapes::Shape shape = shapes::sphere(point(0.93, 0.9, 0.95), 0.6);
    const auto raw =
        IsoAlpha(ReconstructionOptions()).extract(shapes::snapshotOf(complex, shape));
    InterfaceMesh mesh = raw.mesh;
    EXPECT_NE(smoothInterface(mesh, *complex, 8), 0);

    EXPECT_EQ(mesh.triangles, raw.mesh.triangles);
    EXPECT_EQ(mesh.boundaryFaces, raw.mesh.boundaryFaces);
    label nMoved = 0;
    label nElsewhere = 0;
    forAll(mesh.points, pointi)
    {
        const point& x = mesh.points[pointi];
        EXPECT_GE(cmptMin(x), 0);
        EXPECT_LE(cmptMax(x), 1);
        EXPECT_TRUE(liesWithin(*complex, mesh.cells[pointi], x));
        const scalar move = mag(x - raw.mesh.points[pointi]);
        EXPECT_LE(move, 0.3 * raw.mesh.cellSizes[pointi] * (1 + 1e-9));
        nMoved += move > 0;
        nElsewhere += mesh.cells[pointi] != raw.mesh.cells[pointi];
    }
    EXPECT_GT(nMoved, mesh.points.size() / 2);
    EXPECT_GT(nElsewhere, 10);
}
