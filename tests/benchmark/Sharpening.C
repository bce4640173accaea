// SPDX-License-Identifier: GPL-3.0-or-later

// What sharpening costs beside the extraction of alpha = 1/2: a sphere of exact
// fractions on hexahedra, on tetrahedra and on their duals, R/h = 9.6. The second
// argument is the sharpening, as in Sharpening.H; the ratio to none is the cost.

#include "core/reconstruction/Reconstruction.H"
#include "shapes/DualMesh.H"
#include "shapes/ExactAlpha.H"
#include "shapes/PolyMeshes.H"

#include <benchmark/benchmark.h>

using namespace Foam;
using namespace Foam::stability;

namespace
{

const char* const meshes[] = {"hexahedra", "tetrahedra", "duals of tetrahedra"};

FlowSnapshot sphereIn(label mesh)
{
    shapes::BoxOptions box;
    box.max = point(24, 24, 24);
    box.n = Vector<label>(24, 24, 24);
    const auto complex = mesh == 0   ? shapes::box(box)
                         : mesh == 1 ? shapes::complexOf(shapes::tetrahedralBox(box))
                                     : shapes::complexOf(shapes::dualBox(box));
    const shapes::Shape ball = shapes::sphere(point(12.137, 11.732, 12.281), 9.6);
    return shapes::snapshotOf(complex, ball);
}

void sharpening(benchmark::State& state)
{
    static const FlowSnapshot snapshots[] = {sphereIn(0), sphereIn(1), sphereIn(2)};
    const FlowSnapshot& snapshot = snapshots[state.range(0)];
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
        std::string(meshes[state.range(0)]) + ' ' + sharpeningNames()[state.range(1)]
    );
}

} // namespace

BENCHMARK(sharpening)
    ->ArgsProduct({{0, 1, 2}, {0, 1, 2, 3}})
    ->Unit(benchmark::kMillisecond);
