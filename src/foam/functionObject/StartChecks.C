// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/functionObject/StartChecks.H"

#include "foam/case/CaseFields.H"
#include "foam/errors/Failures.H"
#include "fvMesh.H"

#include <stdexcept>

namespace Foam::stability
{

const fvMesh& meshOf(const Time& runTime, const dictionary& dict)
{
    const word region(dict.getOrDefault<word>("region", polyMesh::defaultRegion));
    const auto* mesh = runTime.findObject<fvMesh>(region);
    if (!mesh)
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'region' is '" << region << "'; allowed is a mesh of this run: "
            << flatOutput(runTime.sortedNames<fvMesh>()) << '.' << exit(FatalIOError);
    }
    return *mesh;
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
            FaceFlux flux(mesh, options.phi, options.velocity, FieldSource::solver);
            flux.choose(instantList());
        }
    );
    if (!failure.empty())
    {
        FatalIOErrorInFunction(dict) << failure.c_str() << exit(FatalIOError);
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
