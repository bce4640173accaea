// SPDX-License-Identifier: GPL-3.0-or-later

// Matching and transfer with its seam treatment, by number of points.

#include "core/transfer/Transfer.H"

#include "shapes/ChartedSurfaces.H"
#include "shapes/OneRank.H"

#include <benchmark/benchmark.h>

using namespace Foam;
using namespace Foam::stability;
using namespace Foam::stability::shapes;

namespace
{

struct Pair
{
    InterfaceMesh target, mesh;
};

Pair cylinders(label nPhi)
{
    Revolution from, to;
    from.nPhi = nPhi;
    from.nZ = nPhi / 3;
    from.phase = 0.3;
    from.cellSize = 4 * M_PI / nPhi;
    to = from;
    to.nPhi = nPhi - 3;
    to.phase = 1.1;
    to.jitter = 0.2;
    Pair pair{from(onCylinder), to(onCylinder)};
    from.addChart(pair.target, cylinderChart);
    return pair;
}

void matching(benchmark::State& state)
{
    const Pair pair = cylinders(state.range(0));
    const MatchingOptions options;
    for (auto _ : state)
    {
        const MatchTarget target(pair.target, options);
        benchmark::DoNotOptimize(matchPoints(pair.mesh, target, options));
    }
    state.SetItemsProcessed(state.iterations() * pair.mesh.points.size());
}

void transferring(benchmark::State& state)
{
    const Pair pair = cylinders(state.range(0));
    const MatchingOptions options;
    const MatchTarget target(pair.target, options);
    const List<Match> matches = matchPoints(pair.mesh, target, options);
    for (auto _ : state)
    {
        InterfaceMesh mesh(pair.mesh);
        List<Match> carried(matches);
        benchmark::DoNotOptimize(transfer(mesh, carried, target, TransferOptions()));
    }
    state.SetItemsProcessed(state.iterations() * pair.mesh.points.size());
}

} // namespace

BENCHMARK(matching)->Arg(60)->Arg(120)->Arg(240)->Unit(benchmark::kMillisecond);
BENCHMARK(transferring)->Arg(60)->Arg(120)->Arg(240)->Unit(benchmark::kMillisecond);
