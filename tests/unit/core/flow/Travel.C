// SPDX-License-Identifier: GPL-3.0-or-later

// Pathlines that leave through a cyclic patch go on behind the other half of it, and
// remember where they would be without it.

#include "core/flow/Travel.H"

#include "core/flow/PathlineIntegrator.H"
#include "shapes/PathlineRuns.H"
#include "shapes/PeriodicBox.H"
#include "shapes/OneRank.H"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace Foam::stability
{

namespace
{

struct Trip
{
    List<Pathline> lines;
    label nTravels = 0; // calls of advance but the first of each interval
    label nWithin = 0;  // stops within a step
};

// Through snapshots of the flow, one per interval.
Trip carry(
    const std::shared_ptr<const CellComplex>& complex, const shapes::Flow& flow,
    const List<point>& starts, scalar end, label nIntervals
)
{
    const SerialExchange exchange;
    DynamicList<Pathline> lines;
    forAll(starts, i)
    {
        Pathline line;
        line.id = i;
        line.x = line.start = starts[i];
        line.hint.cell = complex->findCell(line.x);
        lines.append(line);
    }
    const auto velocityAt = [&](scalar time)
    {
        return std::make_shared<const PointVelocity>(
            shapes::periodicSnapshot(
                complex, flow, time, [](const point&) { return 1; }
            ),
            WallVelocity::slip
        );
    };
    Trip trip;
    for (label n = 0; n < nIntervals; ++n)
    {
        const VelocityInterval velocity(
            velocityAt(end * n / nIntervals), velocityAt(end * (n + 1) / nIntervals)
        );
        --trip.nTravels;
        travel(
            lines, *complex, exchange,
            [&](UList<Pathline>& here)
            {
                ++trip.nTravels;
                advance(here, velocity, shapes::tolerance(1e-6));
                for (const Pathline& line : here)
                {
                    trip.nWithin += line.stage > 0;
                }
            }
        );
    }
    trip.lines = lines;
    std::sort(
        trip.lines.begin(), trip.lines.end(),
        [](const Pathline& a, const Pathline& b) { return a.id < b.id; }
    );
    return trip;
}

// All are at home, where they say they are.
void expectAtHome(const Trip& trip, const CellComplex& complex)
{
    for (const Pathline& line : trip.lines)
    {
        EXPECT_EQ(line.state, PathlineState::moving);
        ASSERT_GE(line.hint.cell, 0);
        EXPECT_TRUE(complex.own(line.hint.cell));
        const vector arm = line.x - complex.cellCentres()[line.hint.cell];
        EXPECT_LT(mag(arm), complex.cellSizes()[line.hint.cell]);
    }
}

List<point> randomPoints(const point& low, const point& high, label n)
{
    std::mt19937 engine(7);
    std::uniform_real_distribution<scalar> random(0, 1);
    List<point> points(n);
    for (point& x : points)
    {
        for (direction d = 0; d < 3; ++d)
        {
            x[d] = low[d] + random(engine) * (high[d] - low[d]);
        }
    }
    return points;
}

} // namespace

TEST(Travel, aTranslationGoesRoundAndRound)
{
    shapes::BoxOptions options;
    options.n = Vector<label>(7, 6, 5);
    options.kinds = FixedList<BoundaryKind, 6>(BoundaryKind::open);
    shapes::CyclicPair inY{2, 3, {}};
    inY.motion.shift.y() = -1;
    const auto piece = shapes::periodicPiece(
        shapes::boxInput(options), {shapes::periodicInX(options), inY}
    );
    const vector U(1.3, -0.7, 0.04);
    const List<point> starts(randomPoints(point(0, 0, 0.1), point(1, 1, 0.8), 50));
    for (const label nRings : {1, 2, 4})
    {
        const auto complex = shapes::withRings(piece, nRings);
        const Trip trip(carry(complex, shapes::uniformFlow(U), starts, 2.5, 3));
        expectAtHome(trip, *complex);
        EXPECT_GT(trip.nTravels, 2);
        EXPECT_GT(trip.nWithin, 0);
        label nFar = 0;
        for (const Pathline& line : trip.lines)
        {
            const point exact(line.start + 2.5 * U);
            EXPECT_LT(mag(line.unwrapped() - exact), 1e-12);
            EXPECT_EQ(line.start, starts[line.id]);
            const point wrapped(
                exact - vector(std::floor(exact.x()), std::floor(exact.y()), 0)
            );
            EXPECT_LT(mag(line.x - wrapped), 1e-12);
            nFar += mag(line.unwrapTransform.shift) > 3;
        }
        EXPECT_GT(nFar, 10);
    }
}

// Around an axis off the directions of the grid, faster and faster.
TEST(Travel, aRotationTurnsItsVelocities)
{
    const scalar c = std::cos(0.7), s = std::sin(0.7);
    const tensor tilt(
        tensor(c, -s, 0, s, c, 0, 0, 0, 1) & tensor(1, 0, 0, 0, s, -c, 0, c, s)
    );
    const point through(0.31, -0.17, 0.23);
    shapes::BoxOptions options;
    options.n = Vector<label>(8, 8, 3);
    options.max = point(1, 1, 0.5);
    options.map = [&](const point& x) { return through + (tilt & x); };
    shapes::CyclicPair pair{2, 0, {}};
    pair.motion.rotation = tilt & tensor(0, 1, 0, -1, 0, 0, 0, 0, 1) & tilt.T();
    pair.motion.shift = through - (pair.motion.rotation & through);
    const auto complex =
        shapes::withRings(shapes::periodicPiece(shapes::boxInput(options), {pair}), 2);
    const vector axis(tilt & vector(0, 0, 1));
    const auto flow = [&](const point& x, scalar time)
    { return (1 + time) * (axis ^ (x - through)); };
    const scalar end = 4, angle = end + 0.5 * sqr(end); // [s], [rad]

    List<point> starts(randomPoints(point(0.02, 0.02, 0.05), point(0.6, 0.6, 0.45), 50)
    );
    for (point& x : starts)
    {
        x = options.map(x);
    }
    const Trip trip(carry(complex, flow, starts, end, 4));
    expectAtHome(trip, *complex);
    EXPECT_GT(trip.nTravels, 4);
    EXPECT_GT(trip.nWithin, 0);
    for (const Pathline& line : trip.lines)
    {
        const vector arm(line.start - through);
        const vector along((arm & axis) * axis), across(arm - along);
        const point exact(
            through + along + std::cos(angle) * across
            + std::sin(angle) * (axis ^ across)
        );
        EXPECT_LT(mag(line.unwrapped() - exact), 1e-5);
        const vector home(tilt.T() & (line.x - through));
        EXPECT_GE(home.x(), -1e-12);
        EXPECT_GE(home.y(), -1e-12);
    }
}

} // namespace Foam::stability
