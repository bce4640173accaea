// SPDX-License-Identifier: GPL-3.0-or-later

// What a pathline gains where every step of a solver is integrated, rather than the
// stored times alone: velocities are interpolated linearly between snapshots. Prints
// the table of doc/method.md.

#include "shapes/PathlineRuns.H"
#include "mathematicalConstants.H"

#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>

using namespace Foam;
using namespace Foam::stability;

namespace
{

using constant::mathematical::pi;
constexpr scalar period = 0.5;    // [s]
constexpr scalar end = 1.15625;   // [s], 2.3125 periods
constexpr scalar fastest = 5;     // [rad/s]
constexpr label nSteps = 592;     // of the solver: 256 to a period
constexpr scalar cell = 1.0 / 64; // [m], only a measure: the flow is linear in space
const point centre(0.47, 0.52, 0.51);
const vector axis = vector(1, 2, 3) / std::sqrt(14.0);

// Sloshing: a rigid rotation to and fro. The mesh does not blur it.
vector sloshing(const point& x, scalar time)
{
    return fastest * std::cos(2 * pi * time / period) * (axis ^ (x - centre));
}

point exactEnd(const point& start)
{
    const scalar angle = fastest * period / (2 * pi) * std::sin(2 * pi * end / period);
    const vector arm = start - centre, along = (arm & axis) * axis;
    return centre + along + std::cos(angle) * (arm - along)
           + std::sin(angle) * (axis ^ arm);
}

// [cells], rms, where every so many steps are known.
scalar errorOf(label stepsPerInterval)
{
    List<point> start;
    List<point> wanted;
    for (label i = 0; i < 60; ++i)
    {
        const scalar turn = 2.4 * i, height = -0.2 + 0.4 * (i + 0.5) / 60;
        const point x =
            centre + vector(0.2 * std::cos(turn), 0.2 * std::sin(turn), height);
        start.append(x);
        wanted.append(exactEnd(x));
    }
    List<Pathline> lines = shapes::linesAt(start);
    shapes::throughSnapshots(
        lines, shapes::unitCube(6), sloshing, 0, end, nSteps / stepsPerInterval,
        shapes::tolerance(1e-8)
    );
    return shapes::rmsDistance(lines, wanted) / cell;
}

} // namespace

TEST(EveryStep, theErrorGrowsWithTheSquareOfTheInterval)
{
    std::printf("  steps per interval  intervals per period  error [cells]\n");
    scalar last = 0, first = 0;
    for (const label steps : {1, 2, 4, 8, 16})
    {
        const scalar error = errorOf(steps);
        std::printf("  %18d  %20d  %13.2e\n", int(steps), int(256 / steps), error);
        if (last > 0)
        {
            EXPECT_NEAR(std::log2(error / last), 2, 0.15) << steps;
        }
        first = first > 0 ? first : error;
        last = error;
    }
    EXPECT_GT(last, 200 * first);
    EXPECT_LT(first, 1e-3);
}
