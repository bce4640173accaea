// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/matching/ClassifiedSurface.H"

#include <gtest/gtest.h>

using namespace Foam;
using namespace Foam::stability;

namespace
{

// A triangle whose normal is +z: the first fluid lies below.
InterfaceMesh oneTriangle()
{
    InterfaceMesh mesh;
    mesh.points = List<point>{point(0, 0, 0.5), point(1, 0, 0.5), point(0, 1, 0.5)};
    mesh.triangles = List<triFace>{triFace(0, 1, 2)};
    mesh.clearParametrization();
    mesh.cells = labelList(3, 0);
    mesh.cellSizes = scalarField(3, 0.1);
    return mesh;
}

// The other surface is 0.02 m above the first point, 0.06 m below the second and not
// near the third.
List<Match> matches(const InterfaceMesh& mesh)
{
    List<Match> result(3);
    const scalar heights[2] = {0.02, -0.06};
    for (label i = 0; i < 2; ++i)
    {
        result[i].nearest.triangle = 4;
        result[i].nearest.position = mesh.points[i] + vector(0, 0, heights[i]);
        result[i].nearest.distance = mag(heights[i]);
    }
    result[2].nearest.distance = 0.3; // the cap
    return result;
}

scalarField speeds(Stability unmatched, scalar interval)
{
    const InterfaceMesh mesh(oneTriangle());
    return describe(mesh, matches(mesh), unmatched, List<bool>(3, false), interval)
        .driftSpeed;
}

} // namespace

// Where the interface lies above the time surface it moved out of the first fluid.
TEST(ClassifiedSurface, driftIntoTheFirstFluidIsPositiveOnBothSurfaces)
{
    const scalarField onT(speeds(Stability::detached, 0.25));
    EXPECT_NEAR(onT[0], -0.08, 1e-15);
    EXPECT_NEAR(onT[1], 0.24, 1e-15);
    const scalarField onM(speeds(Stability::attached, 0.25));
    EXPECT_NEAR(onM[0], 0.08, 1e-15);
    EXPECT_NEAR(onM[1], -0.24, 1e-15);
}

TEST(ClassifiedSurface, driftIsCappedAsTheDistanceIs)
{
    EXPECT_NEAR(speeds(Stability::detached, 0.25)[2], 1.2, 1e-15);
    EXPECT_NEAR(speeds(Stability::attached, 0.25)[2], 1.2, 1e-15);
}

// Cells of 0.1 m and an epsilon of half a cell: 0.3, 0.1 and 2.5 cells from the edge.
TEST(ClassifiedSurface, confidenceIsTheWayToEpsilonInFloors)
{
    const InterfaceMesh mesh(oneTriangle());
    const ClassifiedSurface surface(
        describe(mesh, matches(mesh), Stability::detached, List<bool>(3, false), 0.25)
    );
    const scalarField relative(confidences(surface, Epsilon{0.5, true}, 0.04));
    EXPECT_NEAR(relative[0], 7.5, 1e-12);
    EXPECT_NEAR(relative[1], 2.5, 1e-12);
    EXPECT_NEAR(relative[2], 62.5, 1e-12);
    const scalarField absolute(confidences(surface, Epsilon{0.03, false}, 0.04));
    EXPECT_NEAR(absolute[0], 2.5, 1e-12);
    EXPECT_NEAR(absolute[1], 7.5, 1e-12);
}

TEST(ClassifiedSurface, confidenceEndsAtAThousand)
{
    const InterfaceMesh mesh(oneTriangle());
    const ClassifiedSurface surface(
        describe(mesh, matches(mesh), Stability::detached, List<bool>(3, false), 0.25)
    );
    const scalarField fine(confidences(surface, Epsilon{0.5, true}, 2e-4));
    EXPECT_EQ(fine[0], 1000);
    EXPECT_NEAR(fine[1], 500, 1e-9);
    EXPECT_EQ(confidences(surface, Epsilon{0.2, true}, 0), scalarField(3, 1000));
}

TEST(ClassifiedSurface, nothingDriftsAtTheStart)
{
    EXPECT_EQ(speeds(Stability::attached, 0), scalarField(3, 0));
}
