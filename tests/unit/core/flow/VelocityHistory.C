// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/flow/VelocityHistory.H"

#include "core/flow/PathlineIntegrator.H"
#include "shapes/PathlineRuns.H"

#include <gtest/gtest.h>

using namespace Foam;
using namespace Foam::stability;

namespace
{

// Turns and speeds up linearly in time.
const shapes::Flow unsteady = [](const point& x, scalar time)
{ return vector(0.4, 0.1, 0.2) + (time - 3) * vector(0.4, -0.3 * x.x(), 0.1); };

} // namespace

// As many as are added there and back again, thinned from the sixth on; the flow is
// linear in time, so that thinning changes little.
TEST(VelocityHistory, theWayBackLeadsToTheStart)
{
    const auto complex = shapes::box(shapes::channel(6, BoundaryKind::open));
    for (const label n : {1, 2, 4, 5, 6, 7, 8, 9, 16, 23})
    {
        const auto at = [&](label i)
        { return shapes::sampledVelocity(complex, unsteady, 3 + scalar(i) / n); };
        VelocityHistory history;
        EXPECT_TRUE(history.empty());
        history.begin(at(0));
        EXPECT_TRUE(history.empty());
        List<Pathline> lines(shapes::linesAt({point(0.41, 0.52, 0.13)}, 3));
        const point start = lines[0].x;
        for (label i = 1; i <= n; ++i)
        {
            history.add(at(i));
            IntegrationCounts counts;
            advance(lines[0], VelocityInterval(at(i - 1), at(i)), {}, counts);
        }
        EXPECT_GT(mag(lines[0].x - start), 0.5);

        const auto intervals(history.reversed());
        EXPECT_LT(intervals.size(), VelocityHistory::maxKept);
        EXPECT_EQ(intervals.front()->startTime(), -4);
        EXPECT_EQ(intervals.back()->endTime(), -3);
        List<Pathline> back(shapes::linesAt({lines[0].x}, -4));
        for (const auto& interval : intervals)
        {
            IntegrationCounts counts;
            EXPECT_TRUE(advance(back[0], *interval, {}, counts));
        }
        EXPECT_EQ(back[0].state, PathlineState::moving);
        EXPECT_LT(mag(back[0].x - start), 1e-4) << n;
    }
}

TEST(VelocityHistory, beginsAnew)
{
    const auto complex = shapes::box(shapes::channel(3, BoundaryKind::open));
    VelocityHistory history;
    history.begin(shapes::sampledVelocity(complex, unsteady, 0));
    history.add(shapes::sampledVelocity(complex, unsteady, 1));
    history.begin(shapes::sampledVelocity(complex, unsteady, 1));
    EXPECT_TRUE(history.empty());
    history.add(shapes::sampledVelocity(complex, unsteady, 1.5));
    EXPECT_EQ(history.reversed().back()->endTime(), -1);
}
