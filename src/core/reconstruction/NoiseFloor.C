// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/reconstruction/NoiseFloor.H"

#include "core/ranks/Quantiles.H"
#include "core/surface/SurfaceLocator.H"

namespace Foam::stability
{

namespace
{

ReconstructionOptions otherThan(const ReconstructionOptions& options)
{
    ReconstructionOptions other;
    other.method = reconstructionMethod(options.method).reference;
    other.nThreads = options.nThreads;
    return other;
}

} // namespace

scalar noiseQuantile(
    const scalarField& values, const UList<bool>& isPrimary, const Exchange& exchange
)
{
    // Round-off must not raise 0.999 n above the whole number that it is.
    constexpr scalar share = 0.999 * (1 - 1e-12);
    scalarField weights(values.size());
    forAll(weights, i)
    {
        weights[i] = isPrimary[i] ? 1 : 0;
    }
    return weightedQuantiles(values, weights, {share}, exchange)[0];
}

scalar spreadFloor(
    const scalarField& spread, const UList<bool>& isPrimary, const Exchange& exchange
)
{
    constexpr scalar ofPointsThatStay = 0.2; // [extents]
    scalarField noise(spread);
    for (scalar& value : noise)
    {
        value = value < 0 ? -ofPointsThatStay * value : value;
    }
    return noiseQuantile(noise, isPrimary, exchange);
}

scalarField
distancesFrom(const InterfaceMesh& other, const InterfaceMesh& mesh, label nThreads)
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
    return distances;
}

scalar noiseFloor(
    const InterfaceMesh& mesh, const scalarField& spread, const UList<bool>& isPrimary,
    const ReconstructionOptions& options,
    const std::function<InterfaceMesh(const ReconstructionOptions&)>& extract,
    const Run& run
)
{
    if (options.sharpening != Sharpening::none)
    {
        return spreadFloor(spread, isPrimary, run.ranks);
    }
    scalarField distances;
    runOnAllRanks(
        run.ranks, [&]
        { distances = distancesFrom(extract(otherThan(options)), mesh, run.nThreads); }
    );
    return noiseQuantile(distances, isPrimary, run.ranks);
}

} // namespace Foam::stability
