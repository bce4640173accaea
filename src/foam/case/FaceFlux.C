// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/case/FaceFlux.H"

#include "core/base/Errors.H"
#include "StringStream.H"
#include "Time.H"
#include "fvMesh.H"

namespace Foam::stability
{

namespace
{

std::string text(const dimensionSet& dimensions)
{
    OStringStream os;
    os << dimensions;
    return os.str();
}

// Mass fluxes do not tell a velocity without the density at the faces.
std::string wrongDimensions(const surfaceScalarField& phi, const word& timeName)
{
    const dimensionSet volumetric(dimVolume / dimTime);
    return phi.dimensions() == volumetric
               ? ""
               : "Field " + phi.name() + " of time " + timeName + " has the dimensions "
                     + text(phi.dimensions()) + "; allowed is a volume flux, "
                     + text(volumetric) + ".";
}

} // namespace

FaceFlux::FaceFlux(
    const fvMesh& mesh, const word& phiName, std::optional<VelocityKind> asked,
    FieldSource fields
)
    : mesh_(mesh), phi_(mesh, phiName, fields), asked_(asked)
{
}

// Why there are no fluxes to take the flow from; empty where there are.
std::string FaceFlux::shortcoming(const instantList& times) const
{
    const word present = mesh_.time().timeName();
    if (times.empty())
    {
        return phi_.inMemory() ? wrongDimensions(phi_.get()(), present)
                               : "The solver has no surfaceScalarField " + name() + ".";
    }
    word last;
    for (const instant& time : times)
    {
        if (time.name() == firstTime_ && !phi_.onDisk(firstTime_))
        {
            continue;
        }
        std::string complaint = phi_.complaint(time.name());
        if (!complaint.empty())
        {
            return complaint;
        }
        last = time.name();
    }
    return last.empty() ? phi_.complaint(firstTime_)
                        : wrongDimensions(phi_.read(last)(), last);
}

void FaceFlux::choose(const instantList& times)
{
    firstTime_ = times.empty() ? mesh_.time().timeName() : times.first().name();
    kind_ = VelocityKind::U;
    reason_ = "as the dictionary says";
    if (asked_ == VelocityKind::U)
    {
        return;
    }
    const std::string shortcoming = this->shortcoming(times);
    if (shortcoming.empty())
    {
        kind_ = VelocityKind::flux;
        if (!asked_)
        {
            reason_ = "by default, as there is " + name();
        }
        if (!solverHasStepped() && !phi_.onDisk(firstTime_))
        {
            reason_ += "; U at time " + firstTime_ + ", which has none yet";
        }
    }
    else if (asked_)
    {
        throw BadInput(shortcoming + " The dictionary says 'velocity flux'.");
    }
    else
    {
        reason_ = shortcoming;
    }
}

// Not so at its start, when the fluxes in its memory are made of U and those on disk,
// if any, are the ones that moved the volume fraction.
bool FaceFlux::solverHasStepped() const
{
    const Time& time = mesh_.time();
    return phi_.inMemory() && time.timeIndex() > time.startTimeIndex();
}

bool FaceFlux::applies() const
{
    if (kind_ != VelocityKind::flux)
    {
        return false;
    }
    const word present = mesh_.time().timeName();
    return solverHasStepped() || present != firstTime_ || phi_.onDisk(present);
}

tmp<surfaceScalarField> FaceFlux::get() const
{
    const word present = mesh_.time().timeName();
    tmp<surfaceScalarField> phi(solverHasStepped() ? phi_.get() : phi_.read(present));
    const std::string failure = wrongDimensions(phi(), present);
    if (!failure.empty())
    {
        throw BadInput(failure);
    }
    return phi;
}

} // namespace Foam::stability
