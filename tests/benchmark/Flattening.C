// SPDX-License-Identifier: GPL-3.0-or-later

// What the methods of flattening cost and how they distort, on disks of even triangles
// as they come from remeshing. Counters: points, mean and largest difference of angles
// [degrees], L2 stretch, ratio of areas, whether the chart is one-to-one.

#include "core/parametrization/ChartDistortion.H"
#include "core/base/Errors.H"
#include "core/parametrization/seams/DiskCut.H"
#include "core/parametrization/Remeshing.H"
#include "shapes/RaggedSurface.H"
#include "shapes/Surfaces.H"

#include <benchmark/benchmark.h>

using namespace Foam;
using namespace Foam::stability;
using namespace Foam::stability::shapes;

namespace
{

PlainSurface opened(const PlainSurface& surface)
{
    return DiskCut(surface).disk();
}

PlainSurface remeshedBall(scalar radius, const boundBox& box, label n, scalar edge)
{
    const PlainSurface ball = marchingTetrahedra(
        [&](const point& p) { return mag(p - point(.013, .021, .007)) - radius; }, box,
        n
    );
    return opened(remesh(ball, edge).surface);
}

PlainSurface ellipsoid()
{
    PlainSurface surface = sphere(point(0, 0, 0), 1, 5);
    for (point& p : surface.points)
    {
        p = point(1.7 * p.x(), 0.8 * p.y(), p.z());
    }
    return surface;
}

PlainSurface waves(label n)
{
    return grid(
        [](scalar u, scalar v)
        {
            const scalar x = 2 * u - 1, y = 2 * v - 1;
            return point(x, y, 0.3 * std::sin(4 * x + 1) * std::cos(3 * y + x));
        },
        n, n
    );
}

struct Disk
{
    std::string name;
    PlainSurface surface;
};

const std::vector<Disk>& disks()
{
    const boundBox whole(point(-1, -1, -1), point(1, 1, 1));
    const boundBox cap(point(-1, -1, -.5), point(1, 1, 1));
    static const std::vector<Disk> all{
        {"hemisphere", ringedHemisphere(point(0, 0, 0), 1, 58)},
        {"torus", opened(torus(1, 0.4, 144, 64))},
        {"ellipsoid", opened(ellipsoid())},
        {"waves", waves(100)},
        {"remeshed deep cap", remeshedBall(.8, cap, 40, .03)},
        {"remeshed ball", remeshedBall(.8, whole, 40, .03)},
        {"remeshed deep cap, 50k", remeshedBall(.8, cap, 60, .0112)},
        {"waves, 50k", waves(230)},
    };
    return all;
}

void flattening(benchmark::State& state)
{
    const Disk& disk = disks()[state.range(0)];
    const std::string name = Flattening::names()[state.range(1)];
    state.SetLabel(disk.name + ' ' + name);
    const auto method = Flattening::New(name);
    FlatteningResult flat;
    try
    {
        for (auto _ : state)
        {
            flat = method->flatten(disk.surface);
        }
    }
    catch (const NumericalFailure& failure)
    {
        state.SkipWithError(failure.what());
        return;
    }
    List<CornerIndices> corners(disk.surface.triangles.size());
    forAll(corners, i)
    {
        const triFace& t = disk.surface.triangles[i];
        corners[i] = CornerIndices{t[0], t[1], t[2]};
    }
    const ChartDistortion d = distortionOf(disk.surface, corners, flat.parameters);
    state.counters["points"] = disk.surface.points.size();
    state.counters["iterations"] = flat.iterations;
    state.counters["residual"] = flat.residual;
    state.counters["angleMean"] = d.meanAngle;
    state.counters["angleMax"] = d.largestAngle;
    state.counters["stretchL2"] = d.stretchL2;
    state.counters["areaRatio"] = areaRatioOf(disk.surface, corners, flat.parameters);
    state.counters["oneToOne"] = isOneToOne(disk.surface, flat.parameters);
}

} // namespace

// Of six methods only abf, linAbf, lscm and arap.
BENCHMARK(flattening)
    ->ArgsProduct({{0, 1, 2, 3, 4, 5, 6, 7}, {0, 1, 2, 3}})
    ->Unit(benchmark::kMillisecond);
