// SPDX-License-Identifier: GPL-3.0-or-later

#include "shapes/BoxMesh.H"
#include "shapes/DeformedSphere.H"
#include "shapes/ExactAlpha.H"

#include <gtest/gtest.h>

using namespace Foam;
using namespace Foam::stability;
using namespace Foam::stability::shapes;

namespace
{

const Ball start{{0.35, 0.35, 0.35}, 0.15};
const DeformedSphere body(start, 3);

// The cells of the unit cube divided n times along each side.
struct Cube
{
    explicit Cube(label n) : points((n + 1) * (n + 1) * (n + 1)), cells(n * n * n)
    {
        const auto id = [n](label i, label j, label k)
        { return i + (n + 1) * (j + (n + 1) * k); };
        for (label k = 0; k <= n; ++k)
        {
            for (label j = 0; j <= n; ++j)
            {
                for (label i = 0; i <= n; ++i)
                {
                    points[id(i, j, k)] = vector(i, j, k) / scalar(n);
                    if (i < n && j < n && k < n)
                    {
                        cells[i + n * (j + n * k)] = labelList(
                            {id(i, j, k), id(i + 1, j + 1, k + 1), id(i + 1, j, k),
                             id(i, j + 1, k), id(i, j, k + 1), id(i + 1, j + 1, k),
                             id(i + 1, j, k + 1), id(i, j + 1, k + 1)}
                        );
                    }
                }
            }
        }
    }

    pointField points;
    labelListList cells;
};

} // namespace

TEST(DeformedSphere, isTheBallAtTheStart)
{
    const label n = 24;
    const Cube cube(n);
    const scalarField fractions = body.fractions(cube.points, cube.cells, 0);
    const scalarField exact =
        exactAlpha(*unitCube(n), sphere(start.centre, start.radius), 3);
    EXPECT_LT(max(mag(fractions - exact)), 2e-3);
    EXPECT_LT(mag(average(fractions) / start.volume() - 1), 2e-4);
}

TEST(DeformedSphere, keepsItsVolume)
{
    const Cube cube(24);
    for (const scalar time : {0.4, 0.7})
    {
        const scalarField fractions = body.fractions(cube.points, cube.cells, time);
        EXPECT_LT(mag(average(fractions) / start.volume() - 1), 8e-4) << time;
        // It is no ball any more.
        EXPECT_GT(
            max(mag(fractions - body.fractions(cube.points, cube.cells, 0))), 0.9
        );
    }
}

TEST(DeformedSphere, tracesBackWhatTheFlowCarried)
{
    // Along with the flow by small steps to the midpoint.
    const point from = start.centre + start.radius * vector(-0.48, 0.6, 0.64);
    point x = from;
    const label n = 100000;
    const scalar step = 1.2 / n;
    for (label i = 0; i < n; ++i)
    {
        const vector half = 0.5 * step * deformation(x, i * step, 3);
        x += step * deformation(x + half, (i + 0.5) * step, 3);
    }
    EXPECT_GT(mag(x - from), 0.1);
    EXPECT_LT(mag(body.origin(x, 1.2) - from), 2e-5);
    EXPECT_LT(mag(body.level(x, 1.2)), 2e-5);
}
