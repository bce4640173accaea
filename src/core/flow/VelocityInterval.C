// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/flow/VelocityInterval.H"

#include "core/base/Errors.H"
#include "core/cells/CellWalk.H"

#include <string>

namespace Foam::stability
{

namespace
{

const CellComplex& complexOf(const PointVelocity& velocity)
{
    return *velocity.snapshot().complex;
}

// Linear in the tetrahedron.
vector interpolate(const PointVelocity& velocity, const Location& location)
{
    vector U = location.weights[0] * velocity.atCentre(location.cell);
    for (direction i = 0; i < 3; ++i)
    {
        U += location.weights[i + 1] * velocity.atPoint(location.points[i]);
    }
    return U;
}

VelocitySample sampleAt(const CellComplex& complex, const Location& location)
{
    VelocitySample sample;
    sample.position = location.position;
    if (location.where == Location::Where::nowhere
        || location.where == Location::Where::elsewhere)
    {
        return sample;
    }
    sample.where = location.where == Location::Where::outside
                       ? VelocitySample::Where::outside
                       : VelocitySample::Where::inside;
    sample.cellSize = complex.cellSizes()[location.cell];
    sample.boundaryFace = location.boundaryFace;
    if (sample.boundaryFace >= 0)
    {
        const label facei = complex.nInternalFaces() + sample.boundaryFace;
        const vector& area = complex.faceAreas()[facei];
        sample.outward = area / max(mag(area), VSMALL);
    }
    return sample;
}

} // namespace

VelocityInterval::VelocityInterval(
    std::shared_ptr<const PointVelocity> earlier,
    std::shared_ptr<const PointVelocity> later
)
    : earlier_(std::move(earlier)), later_(std::move(later))
{
    if (!(earlier_->snapshot().time < later_->snapshot().time))
    {
        throw BadInput(
            "The snapshots of an interval must follow each other, but the first is of "
            + std::to_string(earlier_->snapshot().time) + " s and the second of "
            + std::to_string(later_->snapshot().time) + " s."
        );
    }
}

scalar VelocityInterval::startTime() const
{
    return earlier_->snapshot().time;
}

scalar VelocityInterval::endTime() const
{
    return later_->snapshot().time;
}

bool VelocityInterval::sharesComplex() const
{
    return &complexOf(*earlier_) == &complexOf(*later_);
}

VelocitySample VelocityInterval::sample(
    const point& x, scalar time, CellHint& hint, CellHint& earlierHint
) const
{
    const scalar elapsed = (time - startTime()) / (endTime() - startTime());
    const scalar f = max(scalar(0), min(elapsed, scalar(1)));

    const Location later = locate(complexOf(*later_), x, hint);
    const Location earlier =
        sharesComplex() ? later : locate(complexOf(*earlier_), x, earlierHint);

    // The snapshot that is nearer in time says where x is.
    VelocitySample sample = f < 0.5 ? sampleAt(complexOf(*earlier_), earlier)
                                    : sampleAt(complexOf(*later_), later);
    if (later.where == Location::Where::elsewhere
        || earlier.where == Location::Where::elsewhere)
    {
        sample.where = VelocitySample::Where::elsewhere;
        return sample;
    }
    if (later.where == Location::Where::nowhere
        || earlier.where == Location::Where::nowhere)
    {
        sample.where = VelocitySample::Where::nowhere;
        return sample;
    }
    sample.U =
        (1 - f) * interpolate(*earlier_, earlier) + f * interpolate(*later_, later);
    return sample;
}

point VelocityInterval::exitPoint(
    const point& inside, const point& outside, const CellHint& hint, label& patch
) const
{
    const CellComplex* complex = &complexOf(*later_);
    CellHint current = hint;
    Location exit = locate(*complex, outside, current);
    if (exit.where != Location::Where::outside && !sharesComplex())
    {
        complex = &complexOf(*earlier_);
        current = CellHint();
        exit = locate(*complex, outside, current);
    }
    patch = exit.boundaryFace < 0 ? -1 : complex->patches()[exit.boundaryFace];
    if (exit.where != Location::Where::outside)
    {
        return exit.position;
    }

    // Bisection: right on any mesh, and a pathline leaves only once.
    scalar low = 0;
    scalar high = 1;
    for (label n = 0; n < 60 && high - low > 1e-15; ++n)
    {
        const scalar middle = 0.5 * (low + high);
        const point x = inside + middle * (outside - inside);
        const Location location = locate(*complex, x, current);
        if (location.where == Location::Where::outside)
        {
            high = middle;
            exit = location;
        }
        else
        {
            low = middle;
            // A position in a cell of another rank is inside.
            current = location.where == Location::Where::elsewhere ? hint : current;
        }
    }
    patch = complex->patches()[exit.boundaryFace];
    return exit.position;
}

} // namespace Foam::stability
