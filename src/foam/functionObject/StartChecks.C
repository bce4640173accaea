// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/functionObject/StartChecks.H"

#include "core/base/Errors.H"
#include "foam/case/CaseFields.H"
#include "foam/entries/EntryReaders.H"
#include "foam/errors/Failures.H"
#include "foam/ranks/RankMessages.H"
#include "fvMesh.H"

#include <stdexcept>

namespace Foam::stability
{

bool hasStepped(const Time& time)
{
    return time.timeIndex() > time.startTimeIndex();
}

const fvMesh& meshOf(const Time& runTime, const dictionary& dict)
{
    word region(polyMesh::defaultRegion);
    failureOf([&] { region = readName(dict, "region"); });
    const auto* mesh = runTime.findObject<fvMesh>(region);
    return mesh ? *mesh
                : runTime.lookupObject<fvMesh>(runTime.sortedNames<fvMesh>()[0]);
}

void checkRegion(const fvMesh& mesh, const dictionary& dict)
{
    if (mesh.name() == readName(dict, "region"))
    {
        return;
    }
    refuse(
        dict, "region",
        "a mesh of this run: " + listed(mesh.time().sortedNames<fvMesh>())
    );
}

void checkFields(const fvMesh& mesh, const CaseOptions& options, const dictionary& dict)
{
    // Without any field the solver has not made them yet.
    if (mesh.names<volVectorField>().empty())
    {
        return;
    }
    const std::string failure = failureOf(
        [&]
        {
            const CaseFields fields(
                mesh, options.alpha, options.U, FieldSource::solver
            );
            const std::string missing = fields.missing();
            if (!missing.empty())
            {
                throw std::runtime_error(missing);
            }
            const RankMessages messages;
            FaceFlux flux(
                mesh, options.phi, options.velocity, FieldSource::solver, messages
            );
            flux.choose(instantList());
        }
    );
    if (!failure.empty())
    {
        failOn(dict, failure);
    }
}

// As functionObjects::timeControl, which calls execute() while it is so.
bool beginsNow(const Time& time, const dictionary& dict)
{
    scalar timeStart = -VGREAT;
    if (dict.readIfPresent("timeStart", timeStart))
    {
        timeStart = time.userTimeToTime(timeStart);
    }
    const bool inTime = time.value() >= timeStart - 0.5 * time.deltaTValue();
    label triggerStart = labelMax;
    if (!dict.readIfPresent("triggerStart", triggerStart))
    {
        return inTime;
    }
    const bool inTrigger = time.functionObjects().triggerIndex() >= triggerStart;
    const word mode(dict.get<word>("controlMode"));
    return mode == "trigger"          ? inTrigger
           : mode == "timeOrTrigger"  ? inTime || inTrigger
           : mode == "timeAndTrigger" ? inTime && inTrigger
                                      : inTime;
}

} // namespace Foam::stability
