// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/reconstruction/BonnellDual.H"
#include "shapes/ExactAlpha.H"
#include "shapes/PolyMeshes.H"
#include "shapes/ReconstructionErrors.H"
#include "shapes/SurfaceChecks.H"

#include <gtest/gtest.h>

using namespace Foam;
using namespace Foam::stability;

namespace
{

ReconstructionOptions smoothedBonnell(label pairs)
{
    ReconstructionOptions options;
    options.method = "bonnell";
    options.smooth = pairs;
    return options;
}

shapes::BoxOptions meshBox()
{
    shapes::BoxOptions options;
    options.n = Vector<label>(9, 8, 10);
    return options;
}

// The largest distance [h] of the surface from where a linear function is 1/2, for
// points whose dual cell does not touch the boundary.
scalar linearError(const std::shared_ptr<const CellComplex>& complex)
{
    const point origin(0.47, 0.52, 0.49);
    const vector gradient(0.31, -0.43, 0.22);
    const scalarField alpha(0.5 + (gradient & (complex->cellCentres() - origin)));
    const auto result =
        BonnellDual(smoothedBonnell(0)).extract(shapes::snapshotOf(complex, alpha));
    scalar largest = 0;
    label nInside = 0;
    forAll(result.mesh.points, pointi)
    {
        const point& x = result.mesh.points[pointi];
        const vector fromMiddle = x - point(0.5, 0.5, 0.5);
        if (cmptMax(cmptMag(fromMiddle)) < 0.3)
        {
            const scalar distance = (gradient & (x - origin)) / mag(gradient);
            largest = max(largest, mag(distance) / result.mesh.cellSizes[pointi]);
            ++nInside;
        }
    }
    EXPECT_GT(nInside, 50);
    return largest;
}

} // namespace

// Its vertices have exact values: linear functions are met exactly, but for cuts
// that are kept off the ends of edges.
TEST(BonnellDual, linearFractionsGiveAPlaneOnEveryMesh)
{
    const auto left = [](const point& x) { return x.x() + x.y() < 0.8; };
    EXPECT_LT(linearError(shapes::complexOf(shapes::boxInput(meshBox()))), 1e-3);
    EXPECT_LT(linearError(shapes::complexOf(shapes::perturbedBox(meshBox()))), 2e-3);
    EXPECT_LT(linearError(shapes::complexOf(shapes::tetrahedralBox(meshBox()))), 2e-3);
    EXPECT_LT(
        linearError(shapes::complexOf(shapes::refinedBox(meshBox(), left))), 2e-3
    );
}

// B4.
TEST(BonnellDual, ballOfExactFractions)
{
    const shapes::BallErrors errors =
        shapes::ballErrors(BonnellDual(smoothedBonnell(0)), 6);
    EXPECT_GT(errors.meanVolume, -0.009);
    EXPECT_LT(errors.meanVolume, -0.007);
    EXPECT_LT(errors.largestDistance, 0.45);
    EXPECT_GT(errors.largestDistance, 0.3);
    EXPECT_NEAR(errors.rmsDistance, 0.105, 0.01);
    EXPECT_NEAR(errors.meanArea, 0.053, 0.01);
}

TEST(BonnellDual, smoothingFlattensTheStaircase)
{
    const shapes::BallErrors five =
        shapes::ballErrors(BonnellDual(smoothedBonnell(5)), 6);
    const shapes::BallErrors ten =
        shapes::ballErrors(BonnellDual(smoothedBonnell(10)), 6);
    EXPECT_LT(five.meanArea, 0.016);
    EXPECT_LT(ten.meanArea, 0.008);
    EXPECT_LT(five.largestDistance, 0.25);
    EXPECT_NEAR(ten.meanVolume, -0.0065, 0.002);
}

// B17.
TEST(BonnellDual, movingPlane)
{
    const scalar largest = shapes::planeError(BonnellDual(smoothedBonnell(0)));
    EXPECT_LT(largest, 0.45);
    EXPECT_GT(largest, 0.2);
}

// Kuhn's division of a Cartesian mesh: one cell inside is cut out by the edges to its
// 14 neighbours along axes, positive face diagonals and the long diagonal.
TEST(BonnellDual, oneCellOfACartesianMeshIsCutOutAsByKuhn)
{
    const auto complex = shapes::unitCube(5);
    scalarField alpha(125, 0.0);
    const label middle = 2 + 5 * (2 + 5 * 2);
    alpha[middle] = 1;
    const auto result =
        BonnellDual(smoothedBonnell(0)).extract(shapes::snapshotOf(complex, alpha));
    EXPECT_EQ(result.mesh.points.size(), 14);
    EXPECT_EQ(result.mesh.triangles.size(), 24);
    for (const point& x : result.mesh.points)
    {
        const vector step = (x - complex->cellCentres()[middle]) / 0.1; // to -1, 0, 1
        for (direction d = 0; d < 3; ++d)
        {
            EXPECT_NEAR(step[d], std::round(step[d]), 1e-9);
        }
        EXPECT_TRUE(cmptMin(step) > -0.5 || cmptMax(step) < 0.5);
    }
}

// An aligned plane between two layers is exact up to the walls and edges of the box.
TEST(BonnellDual, alignedPlaneIsExactUpToTheWalls)
{
    const auto complex = shapes::unitCube(7);
    scalarField alpha(343);
    forAll(alpha, celli)
    {
        alpha[celli] = complex->cellCentres()[celli].z() < 3.0 / 7 ? 0.9 : 0.3;
    }
    const auto result =
        BonnellDual(smoothedBonnell(0)).extract(shapes::snapshotOf(complex, alpha));
    // From 0.9 at z = 2.5/7 to 0.3 at 3.5/7: 1/2 lies two thirds of the way.
    EXPECT_NEAR(result.volume, (2.5 + 2.0 / 3) / 7, 1e-12);
    EXPECT_NEAR(result.mesh.area(), 1, 1e-12);
}
