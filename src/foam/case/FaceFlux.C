// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/case/FaceFlux.H"

#include "core/base/Errors.H"
#include "StringStream.H"
#include "Time.H"
#include "fvMesh.H"
#include "processorPolyPatch.H"
#include "syncTools.H"

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
    FieldSource fields, const Exchange& exchange
)
    : mesh_(mesh), phi_(mesh, phiName, fields), asked_(asked), exchange_(exchange)
{
}

// Why this rank has no fluxes to take the flow from; empty where it has. `last` is the
// last time that has them on disk.
std::string FaceFlux::shortcomingHere(const instantList& times, word& last) const
{
    if (times.empty())
    {
        return phi_.inMemory() ? ""
                               : "The solver has no surfaceScalarField " + name() + ".";
    }
    for (const instant& time : times)
    {
        if (time.name() == firstTime_ && !firstOnDisk_)
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
    return last.empty() ? phi_.complaint(firstTime_) : "";
}

// Sets, too, whether the first time has fluxes.
std::string FaceFlux::shortcoming(const instantList& times)
{
    bool absent = false;
    runOnAllRanks(exchange_, [&] { absent = !phi_.onDisk(firstTime_); });
    firstOnDisk_ = exchange_.total(absent) == 0;
    std::string here;
    word last;
    runOnAllRanks(exchange_, [&] { here = shortcomingHere(times, last); });
    const std::string first = exchange_.firstNonEmpty(here);
    if (!first.empty())
    {
        return first;
    }
    runOnAllRanks(
        exchange_,
        [&]
        {
            here = times.empty()
                       ? wrongDimensions(phi_.get(exchange_)(), mesh_.time().timeName())
                       : wrongDimensions(phi_.read(last, exchange_)(), last);
        }
    );
    return exchange_.firstNonEmpty(here);
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
        if (!solverHasStepped() && !firstOnDisk_)
        {
            reason_ += "; U at time " + firstTime_ + ", which has none yet";
        }
    }
    else if (asked_)
    {
        throw BadInput(shortcoming + " The dictionary asks for the fluxes.");
    }
    else
    {
        reason_ = shortcoming;
    }
}

// At its start a solver has fluxes made of U; those on disk, if any, moved the volume
// fraction.
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
    return solverHasStepped() || mesh_.time().timeName() != firstTime_ || firstOnDisk_;
}

tmp<surfaceScalarField> FaceFlux::read() const
{
    const word present = mesh_.time().timeName();
    tmp<surfaceScalarField> phi(
        solverHasStepped() ? phi_.get(exchange_) : phi_.read(present, exchange_)
    );
    const std::string failure = wrongDimensions(phi(), present);
    if (!failure.empty())
    {
        throw BadInput(failure);
    }
    return phi;
}

FaceFluxes FaceFlux::get()
{
    FaceFluxes fluxes{name(), scalarField(mesh_.nFaces(), Zero)};
    runOnAllRanks(
        exchange_,
        [&]
        {
            const tmp<surfaceScalarField> phi(read());
            const UList<scalar>& internal = phi().primitiveField();
            SubList<scalar>(fluxes.values, internal.size()) = internal;
            for (const fvsPatchScalarField& values : phi().boundaryField())
            {
                SubList<scalar>(fluxes.values, values.size(), values.patch().start()) =
                    values;
            }
        }
    );
    if (exchange_.nRanks() > 1)
    {
        turnSides(fluxes.values);
    }
    return fluxes;
}

// The two sides of a face between ranks have opposite signs. decomposePar gives them
// the same one where the file does not say `oriented`, as those of other releases.
void FaceFlux::turnSides(scalarField& values)
{
    const label nInternal = mesh_.nInternalFaces();
    scalarField others(SubList<scalar>(values, mesh_.nFaces() - nInternal, nInternal));
    exchange_.meet();
    syncTools::swapBoundaryFaceList(mesh_, others);
    scalar sum = 0, ofSums = 0, ofDifferences = 0;
    DynamicList<label> turned; // faces of which this rank has the neighbour's side
    for (const polyPatch& patch : mesh_.boundaryMesh())
    {
        const auto* between = isA<processorPolyPatch>(patch);
        for (label i = 0; between && i < patch.size(); ++i)
        {
            const label facei = patch.start() + i;
            const scalar mine = values[facei], other = others[facei - nInternal];
            sum += mag(mine) + mag(other);
            ofSums += mag(mine + other);
            ofDifferences += mag(mine - other);
            if (!between->owner())
            {
                turned.append(facei);
            }
        }
    }
    constexpr scalar digits = 1e-4; // files of few digits round both sides alike
    if (exchange_.total(ofSums > digits * sum) == 0)
    {
        return;
    }
    if (exchange_.total(ofDifferences > digits * sum) > 0)
    {
        throw BadInput(
            "Field " + name() + " of time " + mesh_.time().timeName()
            + " differs on the two sides of faces between ranks: decompose it again."
        );
    }
    for (const label facei : turned)
    {
        values[facei] *= -1;
    }
    if (!toldTurned_)
    {
        toldTurned_ = true;
        Info << "interfaceStability: field " << name()
             << " was decomposed without 'oriented': its signs are turned on one side "
             << "of the faces between ranks" << nl << endl;
    }
}

} // namespace Foam::stability
