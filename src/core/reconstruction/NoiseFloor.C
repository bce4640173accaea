// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

#include "core/reconstruction/NoiseFloor.H"

#include "core/mesh/SurfaceLocator.H"

#include <algorithm>
#include <cmath>

namespace Foam::stability
{

namespace
{

ReconstructionOptions otherThan(const ReconstructionOptions& options)
{
    ReconstructionOptions other;
    other.method = options.method == "bonnell" ? "isoAlpha" : "bonnell";
    other.nThreads = options.nThreads;
    return other;
}

} // namespace

scalar noiseQuantile(scalarField values)
{
    constexpr scalar share = 0.999;
    const label n = values.size();
    if (n == 0)
    {
        return 0;
    }
    // Round-off must not raise 0.999 n above the whole number that it is.
    const label rank = label(std::ceil(share * n * (1 - 1e-12)));
    const auto at = values.begin() + std::max(rank, label(1)) - 1;
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

scalar spreadFloor(const scalarField& spread)
{
    constexpr scalar ofPointsThatStay = 0.2; // [cells]
    scalarField noise(spread);
    for (scalar& value : noise)
    {
        value = value < 0 ? ofPointsThatStay : value;
    }
    return noiseQuantile(std::move(noise));
}

scalar
differenceFloor(const InterfaceMesh& mesh, const InterfaceMesh& other, label nThreads)
{
    constexpr scalar farthest = 3; // [cells]
    scalarField distances(mesh.points.size(), farthest);
    if (!other.empty())
    {
        const SurfaceLocator locator(
            other.points, other.triangles, other.meanCellSize()
        );
#pragma omp parallel for schedule(dynamic, 64) num_threads(nThreads)
        for (label pointi = 0; pointi < mesh.points.size(); ++pointi)
        {
            const scalar h = mesh.cellSizes[pointi];
            const SurfacePoint nearest =
                locator.closest(mesh.points[pointi], farthest * h);
            if (nearest.triangle >= 0)
            {
                distances[pointi] = nearest.distance / h;
            }
        }
    }
    return noiseQuantile(std::move(distances));
}

scalar noiseFloor(
    const ReconstructionResult& result, const ReconstructionOptions& options,
    const std::function<InterfaceMesh(const ReconstructionOptions&)>& extract
)
{
    // Not by what the result holds: ranks without the whole must take the same way.
    if (options.sharpening != Sharpening::none)
    {
        return result.sharpening ? spreadFloor(result.sharpening->spread) : 0;
    }
    const InterfaceMesh other(extract(otherThan(options)));
    return differenceFloor(result.mesh, other, options.nThreads);
}

} // namespace Foam::stability
