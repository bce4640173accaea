// SPDX-License-Identifier: GPL-3.0-or-later

#include "shapes/AnalyticFlows.H"

#include "shapes/DeformedSphere.H"
#include "mathematicalConstants.H"

#include <cmath>

namespace Foam::stability::shapes
{

namespace
{

using constant::mathematical::pi;

} // namespace

Flow uniformFlow(const vector& U)
{
    return [U](const point&, scalar) { return U; };
}

Flow rotation(const point& origin, const vector& omega)
{
    return [origin, omega](const point& x, scalar) { return omega ^ (x - origin); };
}

Flow linearFlow(const vector& U0, const tensor& gradient)
{
    return [U0, gradient](const point& x, scalar) { return U0 + (gradient & x); };
}

Flow leveque(scalar period)
{
    return [period](const point& x, scalar time)
    { return deformation(x, time, period); };
}

Flow riderKothe(scalar period)
{
    return [period](const point& x, scalar time)
    {
        // The stream function is sin^2(pi x) sin^2(pi y) cos(pi t/T)/pi.
        const scalar g = std::cos(pi * time / period);
        return g
               * vector(
                   sqr(std::sin(pi * x.x())) * std::sin(2 * pi * x.y()),
                   -std::sin(2 * pi * x.x()) * sqr(std::sin(pi * x.y())), 0
               );
    };
}

std::shared_ptr<const FlowSnapshot>
sampled(std::shared_ptr<const CellComplex> complex, const Flow& flow, scalar time)
{
    auto snapshot = std::make_shared<FlowSnapshot>();
    snapshot->time = time;
    snapshot->U.setSize(complex->nCells());
    forAll(snapshot->U, celli)
    {
        snapshot->U[celli] = flow(complex->cellCentres()[celli], time);
    }
    snapshot->boundaryU.setSize(complex->nBoundaryFaces());
    forAll(snapshot->boundaryU, i)
    {
        const label facei = complex->nInternalFaces() + i;
        snapshot->boundaryU[i] = flow(complex->faceCentres()[facei], time);
    }
    snapshot->alphas.setSize(1, scalarField(complex->nCells(), 1));
    snapshot->boundaryAlphas.setSize(1, scalarField(complex->nBoundaryFaces(), 1));
    snapshot->complex = std::move(complex);
    return snapshot;
}

std::shared_ptr<const PointVelocity> sampledVelocity(
    std::shared_ptr<const CellComplex> complex, const Flow& flow, scalar time,
    WallVelocity wallVelocity
)
{
    return std::make_shared<const PointVelocity>(
        sampled(std::move(complex), flow, time), wallVelocity
    );
}

VelocitySample
AnalyticVelocity::sample(const point& x, scalar time, CellHint&, CellHint&) const
{
    VelocitySample sample;
    sample.where = VelocitySample::Where::inside;
    sample.U = flow_(x, time);
    sample.cellSize = cellSize_;
    sample.position = x;
    return sample;
}

point AnalyticVelocity::exitPoint(
    const point&, const point& outside, const CellHint&, label& patch
) const
{
    patch = -1;
    return outside;
}

} // namespace Foam::stability::shapes
