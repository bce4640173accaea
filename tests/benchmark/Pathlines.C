// SPDX-License-Identifier: GPL-3.0-or-later

// What pathlines cost: one evaluation of the velocity, and one interval of LeVeque's
// field, on n^3 cells.

#include "core/cells/CellWalk.H"
#include "core/flow/PathlineIntegrator.H"
#include "shapes/AnalyticFlows.H"
#include "shapes/BoxMesh.H"
#include "shapes/OneRank.H"

#include <benchmark/benchmark.h>
#include <random>

using namespace Foam;
using namespace Foam::stability;

namespace
{

VelocityInterval intervalOn(label n, scalar duration)
{
    const auto complex = shapes::unitCube(n);
    const auto flow = shapes::leveque();
    return VelocityInterval(
        shapes::sampledVelocity(complex, flow, 0),
        shapes::sampledVelocity(complex, flow, duration)
    );
}

// Positions a hop of so many cells from each other, as the stages of a step are.
List<point> hops(label n, scalar cells)
{
    std::mt19937 engine(1);
    std::uniform_real_distribution<scalar> random(-1, 1);
    List<point> points(10000);
    point x(0.5, 0.5, 0.5);
    for (point& next : points)
    {
        vector hop(random(engine), random(engine), random(engine));
        x += cells / n / mag(hop) * hop;
        x = max(point::uniform(0.1), min(x, point::uniform(0.9)));
        next = x;
    }
    return points;
}

void sampleAlong(benchmark::State& state)
{
    const label n = state.range(0);
    const VelocityInterval velocity = intervalOn(n, 0.1);
    const List<point> points = hops(n, 0.01 * state.range(1));
    CellHint hint, unused;
    label i = 0;
    for (auto _ : state)
    {
        benchmark::DoNotOptimize(velocity.sample(points[i], 0.03, hint, unused));
        i = (i + 1) % points.size();
    }
}

void sampleWithoutHint(benchmark::State& state)
{
    const label n = state.range(0);
    const VelocityInterval velocity = intervalOn(n, 0.1);
    const List<point> points = hops(n, 3);
    label i = 0;
    for (auto _ : state)
    {
        CellHint hint, unused;
        benchmark::DoNotOptimize(velocity.sample(points[i], 0.03, hint, unused));
        i = (i + 1) % points.size();
    }
}

// One interval in which the fastest particle crosses about two cells.
void advanceSphere(benchmark::State& state)
{
    const label n = state.range(0);
    const VelocityInterval velocity = intervalOn(n, 2.0 / n);
    std::mt19937 engine(1);
    std::uniform_real_distribution<scalar> random(-1, 1);
    List<Pathline> start(10000);
    for (Pathline& line : start)
    {
        const vector arm(random(engine), random(engine), random(engine));
        line.x = point(0.35, 0.35, 0.35) + 0.15 / mag(arm) * arm;
    }
    IntegrationCounts counts;
    IntegrationOptions options;
    options.nThreads = state.range(1);
    for (auto _ : state)
    {
        List<Pathline> lines(start);
        counts = advance(lines, velocity, options);
    }
    // Six evaluations a step, and the first of the interval.
    state.counters["evaluations"] = benchmark::Counter(
        6.0 * (counts.nSteps + counts.nRejected) + start.size(),
        benchmark::Counter::kIsIterationInvariantRate
    );
    state.counters["steps/line"] = scalar(counts.nSteps) / start.size();
}

} // namespace

BENCHMARK(sampleAlong)->ArgNames({"n", "hop%"})->ArgsProduct({{32, 64}, {5, 20, 100}});
BENCHMARK(sampleWithoutHint)->ArgName("n")->Arg(32)->Arg(64);
BENCHMARK(advanceSphere)
    ->ArgNames({"n", "threads"})
    ->ArgsProduct({{32, 64}, {1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

BENCHMARK_MAIN();
