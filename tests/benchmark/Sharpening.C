// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

// What sharpening costs beside the extraction of alpha = 1/2: a sphere of exact
// fractions on hexahedra and on tetrahedra, R/h = 9.6. The second argument is the
// sharpening, as in Sharpening.H; the ratio to none is the cost.

#include "core/reconstruction/Reconstruction.H"
#include "shapes/ExactAlpha.H"
#include "shapes/PolyMeshes.H"

#include <benchmark/benchmark.h>

using namespace Foam;
using namespace Foam::stability;

namespace
{

const FlowSnapshot& sphereIn(bool tetrahedra)
{
    static const auto made = [](bool tets)
    {
        shapes::BoxOptions box;
        box.max = point(24, 24, 24);
        box.n = Vector<label>(24, 24, 24);
        const auto complex =
            tets ? shapes::complexOf(shapes::tetrahedralBox(box)) : shapes::box(box);
        return shapes::snapshotOf(
            complex, shapes::sphere(point(12.137, 11.732, 12.281), 9.6)
        );
    };
    static const FlowSnapshot hexahedral = made(false), tetrahedral = made(true);
    return tetrahedra ? tetrahedral : hexahedral;
}

void sharpening(benchmark::State& state)
{
    const FlowSnapshot& snapshot = sphereIn(state.range(0) > 0);
    ReconstructionOptions options;
    options.sharpening = Sharpening(state.range(1));
    const auto reconstruction = Reconstruction::New(options);
    label nPoints = 0;
    for (auto _ : state)
    {
        nPoints = reconstruction->extract(snapshot).mesh.points.size();
    }
    state.SetItemsProcessed(state.iterations() * nPoints);
    state.SetLabel(
        std::string(state.range(0) ? "tetrahedra " : "hexahedra ")
        + sharpeningNames()[state.range(1)]
    );
}

} // namespace

BENCHMARK(sharpening)
    ->ArgsProduct({{0, 1}, {0, 1, 2, 3}})
    ->Unit(benchmark::kMillisecond);
