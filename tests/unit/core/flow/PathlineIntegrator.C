// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/flow/PathlineIntegrator.H"

#include "shapes/PathlineRuns.H"
#include "shapes/OneRank.H"
#include "mathematicalConstants.H"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

using namespace Foam;
using namespace Foam::stability;

namespace
{

using constant::mathematical::pi;

// Where LeVeque's field carries the points from 0 to `end`.
List<point> exactLeveque(const List<point>& points, scalar end)
{
    List<Pathline> lines = shapes::linesAt(points);
    const shapes::AnalyticVelocity velocity(shapes::leveque(), 0, end);
    advance(lines, velocity, shapes::tolerance(1e-12));
    return shapes::positions(lines);
}

void expectBitwise(const List<Pathline>& one, const List<Pathline>& two)
{
    ASSERT_EQ(one.size(), two.size());
    forAll(one, i)
    {
        ASSERT_EQ(one[i].x, two[i].x) << i;
        ASSERT_EQ(one[i].time, two[i].time) << i;
        ASSERT_EQ(one[i].step, two[i].step) << i;
        ASSERT_EQ(one[i].state, two[i].state) << i;
        ASSERT_EQ(one[i].nSteps, two[i].nSteps) << i;
        ASSERT_EQ(one[i].hint.cell, two[i].hint.cell) << i;
        ASSERT_EQ(one[i].patch, two[i].patch) << i;
    }
}

// Answers `elsewhere` to every n-th question of each thread of questions, as if a
// processor face lay there.
class Interrupted : public Velocity
{
public:
    Interrupted(const Velocity& velocity, label every)
        : velocity_(velocity), every_(every)
    {
    }

    scalar startTime() const override { return velocity_.startTime(); }
    scalar endTime() const override { return velocity_.endTime(); }
    VelocitySample sample(
        const point& x, scalar time, CellHint& hint, CellHint& earlierHint
    ) const override
    {
        if (++nAsked_ % every_ == 0)
        {
            VelocitySample sample;
            sample.where = VelocitySample::Where::elsewhere;
            return sample;
        }
        ++nAnswered_;
        return velocity_.sample(x, time, hint, earlierHint);
    }
    label nAnswered() const { return nAnswered_; }
    point exitPoint(
        const point& inside, const point& outside, const CellHint& hint, label& patch
    ) const override
    {
        return velocity_.exitPoint(inside, outside, hint, patch);
    }

private:
    const Velocity& velocity_;
    label every_;
    mutable label nAsked_ = 0;
    mutable label nAnswered_ = 0;
};

} // namespace

TEST(PathlineIntegrator, FixedStepsConvergeWithOrderFive)
{
    // A spiral with a swirl that changes in time: nothing vanishes by symmetry.
    const shapes::Flow flow = [](const point& x, scalar t)
    {
        return vector(
            -x.y() * (1 + 0.5 * std::sin(2 * t)) + 0.3 * std::sin(x.z()),
            x.x() * (1 + 0.3 * t), 0.5 * std::cos(x.x()) - 0.2 * x.z()
        );
    };
    const auto end = [&](label nSteps)
    {
        Pathline line;
        line.x = point(0.7, -0.2, 0.4);
        IntegrationCounts counts;
        for (label i = 0; i < nSteps; ++i)
        {
            // One step per interval: any error is allowed in so large a cell.
            line.step = GREAT;
            const shapes::AnalyticVelocity velocity(
                flow, 2.0 * i / nSteps, 2.0 * (i + 1) / nSteps, 1e6
            );
            EXPECT_TRUE(advance(line, velocity, shapes::tolerance(1), counts));
        }
        EXPECT_EQ(counts.nSteps, nSteps);
        return line.x;
    };
    const point exact = end(4096);
    scalar last = 0;
    for (const label nSteps : {8, 16, 32, 64})
    {
        const scalar error = mag(end(nSteps) - exact);
        if (last > 0)
        {
            EXPECT_NEAR(std::log2(last / error), 5.0, 0.3) << nSteps << " steps";
        }
        last = error;
    }
    EXPECT_LT(last, 1e-8);
}

TEST(PathlineIntegrator, ErrorFollowsToleranceInLevequesField)
{
    // tolerance, error at T/2, error after the return: measured elsewhere with an
    // independent program on 4000 points.
    const scalar table[3][3] = {
        {1e-5, 2.1e-4, 1.1e-4}, {1e-6, 1.2e-5, 6.7e-6}, {1e-8, 7.6e-8, 7.2e-8}};
    const List<point> start = shapes::inSphere(1000);
    const List<point> half = exactLeveque(start, 1.5);
    for (const auto& row : table)
    {
        List<Pathline> lines = shapes::linesAt(start);
        const shapes::AnalyticVelocity there(shapes::leveque(), 0, 1.5);
        advance(lines, there, shapes::tolerance(row[0]));
        const scalar errorAtHalf = shapes::rmsDistance(lines, half);
        EXPECT_LT(errorAtHalf, 3 * row[1]);
        EXPECT_GT(errorAtHalf, row[1] / 3);

        const shapes::AnalyticVelocity back(shapes::leveque(), 1.5, 3);
        advance(lines, back, shapes::tolerance(row[0]));
        const scalar returned = shapes::rmsDistance(lines, start);
        EXPECT_LT(returned, 3 * row[2]);
        EXPECT_GT(returned, row[2] / 3);
    }
}

TEST(PathlineIntegrator, SampledLevequeConvergesWithOrderTwoAndReturns)
{
    const List<point> start = shapes::inSphere(400);
    const List<point> half = exactLeveque(start, 1.5);
    scalar last = 0;
    for (const label n : {16, 32, 64})
    {
        const auto still = shapes::sampled(shapes::unitCube(n), shapes::leveque(), 0);
        const auto at = [&](scalar time)
        {
            auto snapshot = std::make_shared<FlowSnapshot>(*still);
            snapshot->time = time;
            snapshot->U *= std::cos(pi * time / 3);
            return std::make_shared<const PointVelocity>(snapshot, WallVelocity::slip);
        };
        List<Pathline> lines = shapes::linesAt(start);
        shapes::throughSnapshots(lines, at, 0, 1.5, 48, shapes::tolerance(1e-5));
        const scalar error = shapes::rmsDistance(lines, half);
        if (last > 0)
        {
            EXPECT_GT(std::log2(last / error), 1.9) << n;
            EXPECT_LT(std::log2(last / error), 2.1) << n;
        }
        RecordProperty("rms" + std::to_string(n), std::to_string(error));
        last = error;
        if (n == 32)
        {
            // Says nothing of the interpolation, all of the search and the steps.
            shapes::throughSnapshots(lines, at, 1.5, 3, 48, shapes::tolerance(1e-5));
            EXPECT_LT(shapes::rmsDistance(lines, start), 2e-4);
        }
    }
    EXPECT_LT(last, 4.5e-3);
}

TEST(PathlineIntegrator, StillWaterTakesOneStep)
{
    const auto complex = shapes::unitCube(4);
    List<Pathline> lines = shapes::linesAt({point(0.3, 0.4, 0.7), point(0, 0, 1e-3)});
    const IntegrationCounts counts = shapes::throughSnapshots(
        lines, complex, shapes::uniformFlow(vector::zero), 0, 2, 1, IntegrationOptions()
    );
    EXPECT_EQ(counts.nSteps, 2);
    EXPECT_EQ(lines[0].x, point(0.3, 0.4, 0.7));
    EXPECT_EQ(lines[0].time, 2);
    EXPECT_EQ(lines[1].state, PathlineState::moving);
}

TEST(PathlineIntegrator, ScaleDoesNotMatter)
{
    // The same flow in a cube of a hundredth of a millimetre and of a kilometre.
    const List<point> start = shapes::inSphere(50);
    const auto endIn = [&](scalar scale)
    {
        shapes::BoxOptions options;
        options.n = Vector<label>(10, 10, 10);
        options.max = point(scale, scale, scale);
        const shapes::Flow unit = shapes::leveque();
        const shapes::Flow flow = [unit, scale](const point& x, scalar t)
        { return scale * unit(x / scale, t); };
        List<Pathline> lines = shapes::linesAt(start);
        for (Pathline& line : lines)
        {
            line.x *= scale;
        }
        shapes::throughSnapshots(
            lines, shapes::box(options), flow, 0, 1.5, 10, IntegrationOptions()
        );
        for (Pathline& line : lines)
        {
            line.x /= scale;
        }
        return lines;
    };
    const List<point> one = shapes::positions(endIn(1));
    EXPECT_GT(shapes::rmsDistance(shapes::linesAt(start), one), 0.1);
    EXPECT_LT(shapes::rmsDistance(endIn(1e-5), one), 1e-9);
    EXPECT_LT(shapes::rmsDistance(endIn(1e3), one), 1e-9);
}

TEST(PathlineIntegrator, GoesOnWhereItStoppedWithTheSameBits)
{
    const auto complex = shapes::box(shapes::channel(6, BoundaryKind::wall));
    const shapes::Flow flow = [](const point& x, scalar)
    { return vector(1.5, 0, 0) + (vector(0.3, 0.2, 1) ^ (x - point(0.9, 0.4, 0.5))); };
    const VelocityInterval velocity(
        shapes::sampledVelocity(complex, flow, 0),
        shapes::sampledVelocity(complex, flow, 1)
    );
    std::mt19937 engine(3);
    std::uniform_real_distribution<scalar> random(0, 1);
    List<point> start(60);
    for (point& x : start)
    {
        x = point(2 * random(engine), random(engine), random(engine));
    }
    List<Pathline> straight = shapes::linesAt(start);
    IntegrationCounts counts;
    const Interrupted never(velocity, labelMax);
    for (Pathline& line : straight)
    {
        EXPECT_TRUE(advance(line, never, IntegrationOptions(), counts));
    }
    EXPECT_GT(counts.nLeft, 5);
    EXPECT_GT(counts.nRejected, 5);

    for (const label every : {2, 3, 7, 10})
    {
        const Interrupted interrupted(velocity, every);
        List<Pathline> stopped = shapes::linesAt(start);
        IntegrationCounts stoppedCounts;
        label nStops = 0;
        for (Pathline& line : stopped)
        {
            while (!advance(line, interrupted, IntegrationOptions(), stoppedCounts))
            {
                ++nStops;
                // As if it were sent: nothing but the pathline survives.
                const Pathline copy(line);
                line = Pathline();
                line = copy;
            }
        }
        EXPECT_GT(nStops, 100);
        EXPECT_EQ(nStops, stoppedCounts.nElsewhere);
        EXPECT_EQ(counts.nSteps, stoppedCounts.nSteps);
        EXPECT_EQ(counts.nRejected, stoppedCounts.nRejected);
        // No stage is evaluated twice.
        EXPECT_EQ(interrupted.nAnswered(), never.nAnswered());
        expectBitwise(straight, stopped);
    }
}

TEST(PathlineIntegrator, SameBitsOnFourThreads)
{
    const List<point> start = shapes::inSphere(500);
    const auto complex = shapes::unitCube(12);
    const auto run = [&](label nThreads)
    {
        List<Pathline> lines = shapes::linesAt(start);
        IntegrationOptions options;
        options.nThreads = nThreads;
        shapes::throughSnapshots(lines, complex, shapes::leveque(), 0, 1, 4, options);
        return lines;
    };
    expectBitwise(run(1), run(4));
}

TEST(PathlineIntegrator, MeshMayChangeBetweenSnapshots)
{
    // A linear field is exact on both; every hint of the last mesh is wrong.
    auto options = shapes::channel(7, BoundaryKind::open);
    const auto fine = shapes::box(options);
    options.n = Vector<label>(9, 5, 4);
    const auto coarse = shapes::box(options);
    const tensor gradient(0.2, -0.9, 0.1, 0.8, -0.3, 0.2, -0.1, 0.3, 0.1);
    const point middle(1, 0.5, 0.5);
    const shapes::Flow flow = [&](const point& x, scalar)
    { return gradient & (x - middle); };

    const List<point> start{point(0.8, 0.4, 0.45), point(1.2, 0.6, 0.5)};
    List<Pathline> exact = shapes::linesAt(start);
    advance(exact, shapes::AnalyticVelocity(flow, 0, 1), shapes::tolerance(1e-10));

    List<Pathline> lines = shapes::linesAt(start);
    const std::shared_ptr<const CellComplex> meshes[] = {
        fine, coarse, coarse, fine, fine};
    for (label i = 0; i < 4; ++i)
    {
        const VelocityInterval velocity(
            shapes::sampledVelocity(meshes[i], flow, 0.25 * i),
            shapes::sampledVelocity(meshes[i + 1], flow, 0.25 * (i + 1))
        );
        EXPECT_EQ(velocity.sharesComplex(), i % 2 == 1);
        advance(lines, velocity, shapes::tolerance(1e-8));
    }
    EXPECT_GT(shapes::rmsDistance(exact, start), 0.1);
    EXPECT_LT(shapes::rmsDistance(lines, shapes::positions(exact)), 1e-7);
}

TEST(PathlineIntegrator, PositionMayBeChangedBetweenIntervals)
{
    const shapes::AnalyticVelocity first(shapes::leveque(), 0, 0.2);
    const shapes::AnalyticVelocity second(shapes::leveque(), 0.2, 0.4);
    List<Pathline> moved = shapes::linesAt({point(0.3, 0.35, 0.4)});
    advance(moved, first, IntegrationOptions());
    moved[0].x = point(0.6, 0.2, 0.3);
    moved[0].firstSameAsLast = false;
    List<Pathline> fresh = shapes::linesAt({moved[0].x}, 0.2);
    fresh[0].step = moved[0].step;
    advance(moved, second, IntegrationOptions());
    advance(fresh, second, IntegrationOptions());
    expectBitwise(moved, fresh);
}

TEST(PathlineIntegrator, LastStageOfAnIntervalIsTheFirstOfTheNext)
{
    const List<point> start = shapes::inSphere(50);
    List<Pathline> lines = shapes::linesAt(start);
    for (label n = 0; n < 3; ++n)
    {
        const shapes::AnalyticVelocity flow(shapes::leveque(), 0.2 * n, 0.2 * (n + 1));
        const Interrupted isPrimary(flow, labelMax);
        IntegrationCounts counts;
        for (Pathline& line : lines)
        {
            advance(line, isPrimary, shapes::tolerance(1e-8), counts);
        }
        EXPECT_EQ(
            isPrimary.nAnswered(),
            6 * (counts.nSteps + counts.nRejected) + (n == 0 ? start.size() : 0)
        );
    }
    List<Pathline> exact = shapes::linesAt(start);
    advance(
        exact, shapes::AnalyticVelocity(shapes::leveque(), 0, 0.6),
        shapes::tolerance(1e-10)
    );
    EXPECT_LT(shapes::rmsDistance(lines, shapes::positions(exact)), 1e-7);
}

TEST(PathlineIntegrator, StepsEndTogetherWithTheInterval)
{
    List<Pathline> lines = shapes::linesAt({point(0.3, 0.35, 0.4)});
    const shapes::AnalyticVelocity velocity(shapes::leveque(), 0, 0.7, 0.01);
    const IntegrationCounts counts = advance(lines, velocity, IntegrationOptions());
    EXPECT_EQ(lines[0].time, 0.7);
    EXPECT_EQ(counts.nSteps, lines[0].nSteps);
    EXPECT_GT(counts.nSteps, 3);
    // Two cells a step at most: the first ones are as long as that allows.
    EXPECT_GT(counts.nSteps, mag(lines[0].x - point(0.3, 0.35, 0.4)) / 0.02);
}

TEST(PathlineIntegrator, GivesUpWithAReason)
{
    IntegrationOptions few;
    few.maxSteps = 3;
    List<Pathline> lines = shapes::linesAt({point(0.3, 0.35, 0.4)});
    const shapes::AnalyticVelocity velocity(shapes::leveque(), 0, 1, 0.01);
    const IntegrationCounts counts = advance(lines, velocity, few);
    EXPECT_EQ(lines[0].state, PathlineState::stuck);
    EXPECT_EQ(counts.nStuck, 1);
    EXPECT_EQ(lines[0].nSteps, 3);
    EXPECT_LT(lines[0].time, 1);
    // It stays so.
    EXPECT_EQ(advance(lines, velocity, few).nStuck, 0);

    // Noise: no step is short enough, and none of the many that are left to go helps.
    const shapes::Flow noise = [](const point& x, scalar t)
    { return vector(std::sin(1e9 * (x.x() + t)), 0, 0); };
    List<Pathline> caught = shapes::linesAt({point(0.42, 0, 0)});
    const auto stuck = advance(
        caught, shapes::AnalyticVelocity(noise, 0, 1, 0.1), shapes::tolerance(1e-9)
    );
    EXPECT_EQ(caught[0].state, PathlineState::stuck);
    EXPECT_EQ(stuck.nStuck, 1);
    EXPECT_EQ(caught[0].nSteps, 101);

    const auto complex = shapes::unitCube(4);
    List<Pathline> astray = shapes::linesAt({point(9, 9, 9), point(0.5, 0.5, 0.5)});
    const auto lost = shapes::throughSnapshots(
        astray, complex, shapes::uniformFlow(vector(0.1, 0, 0)), 0, 1, 1,
        IntegrationOptions()
    );
    EXPECT_EQ(lost.nLost, 1);
    EXPECT_EQ(astray[0].state, PathlineState::lost);
    EXPECT_EQ(astray[0].x, point(9, 9, 9));
    EXPECT_EQ(astray[1].state, PathlineState::moving);
}
