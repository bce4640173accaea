// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/comparison/ImpulsiveStart.H"

#include "core/ranks/ExactSum.H"

#include <cmath>

namespace Foam::stability
{

namespace
{

scalar largestSpeed(const FlowSnapshot& snapshot, const Exchange& exchange)
{
    scalar squared = 0;
    for (const vector& U : snapshot.U)
    {
        squared = max(squared, magSqr(U));
    }
    return std::sqrt(largest(squared, exchange));
}

// Mean over the area of T of its distance from the interface [cells].
scalar meanDistance(
    const SurfacePiece& interface, TimeSurface& timeSurface,
    const Comparison::Setting& setting
)
{
    const Exchange& exchange = setting.run.ranks;
    timeSurface.collectPoints(setting.flow->time, setting.complex(), exchange);
    Comparison comparison(setting, interface, timeSurface);
    comparison.match();
    const ClassifiedSurface surface(comparison.describeTimeSurface());
    List<ExactSum> sums(2);
    forAll(surface.areas, pointi)
    {
        if (surface.isPrimary[pointi])
        {
            const scalar h = max(surface.mesh.cellSizes[pointi], VSMALL);
            sums[0].add(surface.areas[pointi] * surface.distance[pointi] / h);
            sums[1].add(surface.areas[pointi]);
        }
    }
    sum(sums, exchange);
    return sums[1].value() > 0 ? sums[0].value() / sums[1].value() : 0;
}

} // namespace

void ImpulsiveStart::consider(
    const TimeSurface& timeSurface, const PointVelocity& first,
    const PointVelocity& second, WallVelocity wallVelocity, const Exchange& exchange
)
{
    constexpr scalar atRest = 1e-3; // of the speed that follows
    const scalar later = largestSpeed(second.snapshot(), exchange);
    if (later > 0 && largestSpeed(first.snapshot(), exchange) <= atRest * later)
    {
        auto snapshot = std::make_shared<FlowSnapshot>(second.snapshot());
        snapshot->complex = first.snapshot().complex;
        snapshot->time = first.snapshot().time;
        first_ = std::make_shared<const PointVelocity>(snapshot, wallVelocity);
        surface_ = timeSurface;
    }
}

void ImpulsiveStart::advance(
    const std::shared_ptr<const PointVelocity>& earlier,
    const std::shared_ptr<const PointVelocity>& later,
    const IntegrationOptions& options, const CellComplex& complex,
    const Exchange& exchange
)
{
    const bool begins = earlier->snapshot().time <= first_->snapshot().time;
    const VelocityInterval interval(begins ? first_ : earlier, later);
    surface_->advance(interval, options, complex, exchange);
}

bool ImpulsiveStart::decide(
    const SurfacePiece& interface, TimeSurface& timeSurface, VelocityHistory& history,
    const Comparison::Setting& setting
)
{
    constexpr scalar nearer = 0.5;
    const bool impulsive = meanDistance(interface, *surface_, setting)
                           < nearer * meanDistance(interface, timeSurface, setting);
    if (impulsive)
    {
        timeSurface = std::move(*surface_);
        history.replaceFirst(first_);
    }
    surface_.reset();
    return impulsive;
}

} // namespace Foam::stability
