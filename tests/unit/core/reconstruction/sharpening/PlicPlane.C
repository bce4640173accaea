// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/reconstruction/sharpening/PlicPlane.H"
#include "shapes/ExactAlpha.H"
#include "shapes/PolyMeshes.H"

#include <gtest/gtest.h>

#include <random>

using namespace Foam;
using namespace Foam::stability;

namespace
{

vector unit(const vector& v)
{
    return v / mag(v);
}

shapes::BoxOptions smallBox()
{
    shapes::BoxOptions options;
    options.n = Vector<label>(4, 4, 4);
    return options;
}

} // namespace

TEST(PlicPlane, cubeHasItsCornersAndItsMiddle)
{
    const auto complex = shapes::unitCube(1);
    const CellShape cube(*complex, 0);
    EXPECT_NEAR(cube.volume(), 1, 1e-14);
    const vector n = unit(vector(1, 1, 1));

    const PlicPlane half = cube.planeOf(n, 0.5);
    EXPECT_TRUE(half.converged);
    EXPECT_NEAR(mag(half.centre - point(0.5, 0.5, 0.5)), 0, 1e-10);
    EXPECT_NEAR(half.area, 0.75 * std::sqrt(3.0), 1e-10); // a regular hexagon
    EXPECT_EQ(cube.polygonOf(half).size(), 6u);

    // A corner with edges a holds a^3 / 6.
    const scalar a = 1e-2;
    const PlicPlane corner = cube.planeOf(n, a * a * a / 6);
    EXPECT_TRUE(corner.converged);
    EXPECT_NEAR(mag(corner.centre - point(1, 1, 1)) * std::sqrt(3.0), a, 1e-6 * a);
    EXPECT_NEAR(corner.area, std::sqrt(3.0) / 2 * a * a, 1e-6 * a * a);
    EXPECT_EQ(cube.polygonOf(corner).size(), 3u);
}

TEST(PlicPlane, secondMomentOfASquare)
{
    const CellShape cube(*shapes::unitCube(1), 0);
    const PlicPlane plane = cube.planeOf(vector(0, 0, 1), 0.3);
    EXPECT_NEAR(plane.centre.z(), 0.7, 1e-12);
    EXPECT_NEAR(plane.secondMoment.xx(), 1.0 / 12, 1e-12);
    EXPECT_NEAR(plane.secondMoment.yy(), 1.0 / 12, 1e-12);
    EXPECT_NEAR(plane.secondMoment.xy(), 0, 1e-12);
    EXPECT_NEAR(plane.secondMoment.zz(), 0, 1e-12);
}

// The fractions of a plane, made by another program, give the plane back.
TEST(PlicPlane, findsPlanesInAllKindsOfCells)
{
    const auto refine = [](const point& x) { return x.x() > 0.5; };
    std::mt19937 random(5);
    std::uniform_real_distribution<scalar> uniform(-1, 1);
    for (const CellComplexInput& input :
         {shapes::boxInput(smallBox()), shapes::perturbedBox(smallBox()),
          shapes::tetrahedralBox(smallBox()), shapes::refinedBox(smallBox(), refine)})
    {
        const auto complex = shapes::complexOf(input);
        const vector n =
            unit(vector(uniform(random), uniform(random), uniform(random)));
        const point origin(0.5 + 0.1 * uniform(random), 0.5, 0.5);
        const scalarField alpha =
            shapes::exactAlpha(*complex, shapes::halfSpace(origin, -n));
        label nTested = 0, nWhole = 0;
        forAll(alpha, celli)
        {
            if (alpha[celli] > 1e-3 && alpha[celli] < 1 - 1e-3)
            {
                const CellShape shape(*complex, celli);
                const PlicPlane plane = shape.planeOf(n, alpha[celli]);
                const scalar h = complex->cellSizes()[celli];
                EXPECT_TRUE(plane.converged);
                EXPECT_LT(plane.nIterations, 20);
                EXPECT_NEAR(((plane.centre - origin) & n) / h, 0, 1e-6);
                EXPECT_NEAR(shape.volume() / complex->cellVolumes()[celli], 1, 1e-9);
                scalar area = 0;
                const std::vector<point> polygon = shape.polygonOf(plane);
                for (std::size_t i = 0; i < polygon.size(); ++i)
                {
                    const point &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
                    area += 0.5 * (((a - plane.centre) ^ (b - plane.centre)) & n);
                }
                // A cell with warped faces may be cut into two loops.
                EXPECT_LT(area / plane.area, 1 + 1e-9);
                nWhole += area / plane.area > 1 - 1e-9;
                ++nTested;
            }
        }
        EXPECT_GT(nTested, 10);
        EXPECT_GT(nWhole, 0.95 * nTested);
    }
}

TEST(PlicPlane, nearlyEmptyAndNearlyFullCellsConverge)
{
    const auto complex = shapes::complexOf(shapes::perturbedBox(smallBox()));
    for (label celli = 0; celli < complex->nCells(); ++celli)
    {
        const CellShape shape(*complex, celli);
        for (const scalar alpha : {1e-6, 1e-4, 1 - 1e-4, 1 - 1e-6})
        {
            const PlicPlane plane = shape.planeOf(unit(vector(1, 2, -3)), alpha);
            EXPECT_TRUE(plane.converged) << celli << ' ' << alpha;
        }
    }
}
