// SPDX-License-Identifier: GPL-3.0-or-later

// What pathlines do at walls and openings.

#include "core/flow/PathlineIntegrator.H"

#include "shapes/PathlineRuns.H"
#include "shapes/CutOut.H"
#include "shapes/PolyMeshes.H"
#include "shapes/OneRank.H"
#include "mathematicalConstants.H"

#include <cmath>
#include <gtest/gtest.h>

using namespace Foam;
using namespace Foam::stability;

namespace
{

using constant::mathematical::pi;

} // namespace

TEST(PathlineBoundaries, LeavesWhereAndWhenItCrossesTheOutlet)
{
    const auto complex = shapes::box(shapes::channel(6, BoundaryKind::open));
    const vector U(0.8, 0.1, -0.05);
    const List<point> start{
        point(1.3, 0.5, 0.5), point(1.9, 0.2, 0.8), point(0.2, 0.3, 0.4),
        point(1.999, 0.95, 0.5)};
    List<Pathline> lines = shapes::linesAt(start);
    const IntegrationCounts counts = shapes::throughSnapshots(
        lines, complex, shapes::uniformFlow(U), 0, 1.2, 3, IntegrationOptions()
    );
    EXPECT_EQ(counts.nLeft, 3);
    for (const label i : {0, 1, 3})
    {
        const scalar time = (2 - start[i].x()) / U.x();
        EXPECT_EQ(lines[i].state, PathlineState::left);
        EXPECT_NEAR(lines[i].time, time, 1e-10);
        EXPECT_LT(mag(lines[i].x - (start[i] + time * U)), 1e-10);
        EXPECT_EQ(complex->patchNames()[lines[i].patch], "xMax");
    }
    EXPECT_EQ(lines[2].state, PathlineState::moving);
    EXPECT_LT(mag(lines[2].x - (start[2] + 1.2 * U)), 1e-10);
}

TEST(PathlineBoundaries, UniformFlowIsExactOnAnyMesh)
{
    const auto options = shapes::channel(6, BoundaryKind::open);
    const auto refine = [](const point& x)
    { return mag(x - point(0.8, 0.4, 0.5)) < 0.35; };
    const vector U(0.8, 0.1, -0.05);
    for (const auto& complex :
         {shapes::complexOf(shapes::perturbedBox(options)),
          shapes::complexOf(shapes::tetrahedralBox(options)),
          shapes::complexOf(shapes::refinedBox(options, refine))})
    {
        const List<point> start = shapes::inSphere(200);
        List<Pathline> lines = shapes::linesAt(start);
        shapes::throughSnapshots(
            lines, complex, shapes::uniformFlow(U), 0, 2.5, 5, IntegrationOptions()
        );
        forAll(lines, i)
        {
            const scalar time = min((2 - start[i].x()) / U.x(), scalar(2.5));
            EXPECT_EQ(lines[i].state == PathlineState::left, time < 2.5);
            EXPECT_NEAR(lines[i].time, time, 1e-9);
            EXPECT_LT(mag(lines[i].x - (start[i] + time * U)), 1e-9);
        }
    }
}

TEST(PathlineBoundaries, LeavesACurvedWayWithinTheTolerance)
{
    // Around the middle of the face x = 0: exact on hexes, but the chord is not.
    const auto complex = shapes::box(shapes::channel(10, BoundaryKind::open));
    const point middle(0, 0.5, 0.5);
    const shapes::Flow flow = shapes::rotation(middle, vector(0, 0, 1));
    List<Pathline> lines = shapes::linesAt({point(0.2, 0.45, 0.52)});
    shapes::throughSnapshots(lines, complex, flow, 0, 3, 1, shapes::tolerance(1e-3));
    const scalar radius = mag(point(0.2, 0.45, 0.5) - middle);
    const scalar angle = 0.5 * pi - std::atan2(-0.05, 0.2);
    EXPECT_EQ(lines[0].state, PathlineState::left);
    EXPECT_LT(mag(lines[0].x - (middle + vector(0, radius, 0.02))), 5e-4);
    EXPECT_NEAR(lines[0].time, angle, 3e-3);
    EXPECT_EQ(complex->patchNames()[lines[0].patch], "xMin");
}

TEST(PathlineBoundaries, StartOnAnOpeningByRoundOffGoesOn)
{
    const auto complex = shapes::box(shapes::channel(4, BoundaryKind::open));
    List<Pathline> lines =
        shapes::linesAt({point(-1e-7, 0.5, 0.5), point(-0.1, 0.5, 0.5)});
    shapes::throughSnapshots(
        lines, complex, shapes::uniformFlow(vector(0.5, 0, 0)), 0, 1, 1,
        IntegrationOptions()
    );
    EXPECT_EQ(lines[0].state, PathlineState::moving);
    EXPECT_NEAR(lines[0].x.x(), 0.5, 1e-6);
    EXPECT_EQ(lines[1].state, PathlineState::left);
    EXPECT_EQ(complex->patchNames()[lines[1].patch], "xMin");
    EXPECT_NEAR(lines[1].x.x(), 0, 1e-12);
}

TEST(PathlineBoundaries, SlidesAlongWallsEdgesAndIntoCorners)
{
    const vector U(0.6, -0.5, -0.4);
    for (const BoundaryKind kind : {BoundaryKind::wall, BoundaryKind::symmetry})
    {
        const auto complex = shapes::box(shapes::channel(8, kind));
        // To the floor, to an edge, on the floor itself, and beyond it.
        List<Pathline> lines = shapes::linesAt(
            {point(0.1, 0.97, 0.06), point(0.1, 0.05, 0.06), point(0.1, 0.97, 0),
             point(0.1, 0.6, -0.01)}
        );
        auto snapshot = std::make_shared<FlowSnapshot>(
            *shapes::sampled(complex, shapes::uniformFlow(U), 0)
        );
        forAll(snapshot->boundaryU, i)
        {
            if (complex->kinds()[i] != BoundaryKind::open)
            {
                snapshot->boundaryU[i] = vector::zero;
            }
        }
        auto next = std::make_shared<FlowSnapshot>(*snapshot);
        next->time = 2;
        const VelocityInterval velocity(
            std::make_shared<PointVelocity>(snapshot, WallVelocity::slip),
            std::make_shared<PointVelocity>(next, WallVelocity::slip)
        );
        advance(lines, velocity, IntegrationOptions());
        for (const Pathline& line : lines)
        {
            EXPECT_EQ(line.state, PathlineState::moving);
            EXPECT_NEAR(line.x.x(), 1.3, 1e-6);
            EXPECT_GE(line.x.y(), 0);
            EXPECT_GE(line.x.z(), 0);
            EXPECT_LT(line.x.z(), 0.01);
            EXPECT_LT(line.nSteps, 200);
        }
        EXPECT_LT(lines[1].x.y(), 0.01);
        EXPECT_LT(lines[2].x.z(), 2e-7);
    }

    // No way out of a corner: it comes to rest there.
    List<Pathline> lines =
        shapes::linesAt({point(0.1, 0.08, 0.06), point(1e-12, 0, -1e-9)});
    const IntegrationCounts counts = shapes::throughSnapshots(
        lines, shapes::unitCube(8), shapes::uniformFlow(vector(-0.6, -0.5, -0.4)), 0, 2,
        2, IntegrationOptions(), WallVelocity::noSlip
    );
    EXPECT_EQ(counts.nStuck + counts.nLost + counts.nLeft, 0);
    for (const Pathline& line : lines)
    {
        for (direction d = 0; d < 3; ++d)
        {
            EXPECT_GT(line.x[d], 0);
            EXPECT_LT(line.x[d], 0.01);
        }
    }
}

TEST(PathlineBoundaries, NoSlipSticksWhereSlipGoesOn)
{
    const auto complex = shapes::box(shapes::channel(8, BoundaryKind::wall));
    const shapes::Flow flow = shapes::uniformFlow(vector(0.6, 0, 0));
    const auto wayOf = [&](WallVelocity wall)
    {
        auto first = std::make_shared<FlowSnapshot>(*shapes::sampled(complex, flow, 0));
        first->boundaryU = vector::zero;
        auto second = std::make_shared<FlowSnapshot>(*first);
        second->time = 1;
        List<Pathline> lines =
            shapes::linesAt({point(0.5, 0.5, 0), point(0.5, 0.5, 0.02)});
        advance(
            lines,
            VelocityInterval(
                std::make_shared<PointVelocity>(first, wall),
                std::make_shared<PointVelocity>(second, wall)
            ),
            IntegrationOptions()
        );
        return Vector2D<scalar>(lines[0].x.x() - 0.5, lines[1].x.x() - 0.5);
    };
    const auto slip = wayOf(WallVelocity::slip);
    EXPECT_NEAR(slip.x(), 0.6, 1e-9);
    EXPECT_NEAR(slip.y(), 0.6, 1e-9);
    const auto noSlip = wayOf(WallVelocity::noSlip);
    EXPECT_LT(noSlip.x(), 1e-5);
    // On this plane, between cells, linear from the wall to the first points, at 1/8.
    EXPECT_NEAR(noSlip.y(), 0.6 * 0.02 * 8, 1e-9);
}

TEST(PathlineBoundaries, FollowsABentWall)
{
    // Half a turn in a pipe of 18 flats: a particle near the outer wall keeps up.
    shapes::BoxOptions options;
    options.n = Vector<label>(8, 18, 3);
    options.map = [](const point& x)
    {
        const scalar r = 1 + x.x();
        const scalar phi = pi * x.y();
        return point(r * std::cos(phi), r * std::sin(phi), x.z());
    };
    const auto complex = shapes::box(options);
    List<Pathline> lines =
        shapes::linesAt({point(0, 1.97, 0.5), point(0, 1.03, 0.5), point(0, 1.999, 0.5)}
        );
    shapes::throughSnapshots(
        lines, complex, shapes::rotation(point::zero, vector(0, 0, 1)), 0, 1, 2,
        IntegrationOptions()
    );
    for (const Pathline& line : lines)
    {
        EXPECT_EQ(line.state, PathlineState::moving);
        EXPECT_NEAR(std::atan2(line.x.y(), line.x.x()), 0.5 * pi + 1, 0.05);
        // Between the flats of the two walls.
        EXPECT_GT(mag(point(line.x.x(), line.x.y(), 0)), 0.99);
        EXPECT_LT(mag(point(line.x.x(), line.x.y(), 0)), 2.0);
    }
}

// As of the same point on several ranks: all move, one is in the numbers.
TEST(PathlineBoundaries, CountsWhatIsToBeCounted)
{
    const auto complex = shapes::box(shapes::channel(6, BoundaryKind::open));
    List<Pathline> lines = shapes::linesAt(List<point>(3, point(1.9, 0.5, 0.5)));
    lines[0].isPrimary = lines[2].isPrimary = false;
    const IntegrationCounts counts = shapes::throughSnapshots(
        lines, complex, shapes::uniformFlow(vector(1, 0, 0)), 0, 1, 1,
        IntegrationOptions()
    );
    EXPECT_EQ(counts.nLeft, 1);
    EXPECT_EQ(counts.nSteps, lines[1].nSteps);
    for (const Pathline& line : lines)
    {
        EXPECT_EQ(line.state, PathlineState::left);
    }
}

TEST(PathlineBoundaries, FlowsAroundAnObstacle)
{
    const auto inObstacle = [](const point& x, scalar gap)
    {
        return x.x() > 0.75 + gap && x.x() < 1.25 - gap && x.y() > 0.25 + gap
               && x.y() < 0.75 - gap && x.z() < 0.5 - gap;
    };
    const auto complex = std::make_shared<const CellComplex>(shapes::cutOut(
        shapes::boxInput(shapes::channel(8, BoundaryKind::wall)),
        [&](const point& x) { return inObstacle(x, 0); }
    ));
    List<point> start;
    for (label j = 0; j < 19; ++j)
    {
        for (label k = 0; k < 19; ++k)
        {
            start.append(point(0.5, 0.05 * (j + 0.5), 0.05 * (k + 0.5)));
        }
    }
    List<Pathline> lines = shapes::linesAt(start);
    const IntegrationCounts counts = shapes::throughSnapshots(
        lines, complex, shapes::uniformFlow(vector(1, 0.07, -0.11)), 0, 1.2, 12,
        IntegrationOptions()
    );
    EXPECT_EQ(counts.nStuck + counts.nLost + counts.nLeft, 0);
    label nPassed = 0;
    for (const Pathline& line : lines)
    {
        EXPECT_FALSE(inObstacle(line.x, 1e-9));
        nPassed += line.x.x() > 1.25;
    }
    EXPECT_GT(nPassed, 200);
}

// Edges of obstacles are convex: a particle that slides up a face passes the edge.
TEST(PathlineBoundaries, NothingStaysAtAConvexEdge)
{
    const auto inObstacle = [](const point& x)
    { return mag(x.x() - 1) < 0.25 && mag(x.y() - 0.5) < 0.25 && x.z() < 0.5; };
    const auto complex = std::make_shared<const CellComplex>(shapes::cutOut(
        shapes::boxInput(shapes::channel(8, BoundaryKind::wall)), inObstacle
    ));
    auto first = std::make_shared<FlowSnapshot>(
        *shapes::sampled(complex, shapes::uniformFlow(vector(1, 0.07, 0.3)), 0)
    );
    forAll(first->boundaryU, i)
    {
        if (complex->kinds()[i] == BoundaryKind::wall)
        {
            first->boundaryU[i] = vector::zero;
        }
    }
    auto second = std::make_shared<FlowSnapshot>(*first);
    second->time = 5;
    List<point> start;
    for (label j = 0; j < 11; ++j)
    {
        for (label k = 1; k < 11; ++k)
        {
            start.append(point(0.6, 0.25 + 0.05 * j, 0.05 * k));
        }
    }
    List<Pathline> lines = shapes::linesAt(start);
    const IntegrationCounts counts = advance(
        lines,
        VelocityInterval(
            std::make_shared<PointVelocity>(first, WallVelocity::slip),
            std::make_shared<PointVelocity>(second, WallVelocity::slip)
        ),
        IntegrationOptions()
    );
    EXPECT_EQ(counts.nLeft, lines.size());
    for (const Pathline& line : lines)
    {
        EXPECT_EQ(line.state, PathlineState::left)
            << line.x.x() << " " << line.x.y() << " " << line.x.z();
    }
}
