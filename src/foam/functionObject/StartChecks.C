// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/functionObject/StartChecks.H"

#include "core/base/Errors.H"
#include "foam/case/CaseFields.H"
#include "foam/entries/EntryReaders.H"
#include "foam/errors/Failures.H"
#include "foam/ranks/RankMessages.H"
#include "fvMesh.H"

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
    const wordList meshes(runTime.sortedNames<fvMesh>());
    const bool other = !meshes.empty() && !meshes.found(region);
    return runTime.lookupObject<fvMesh>(other ? meshes.first() : region);
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

namespace
{

// The sentence on what is wrong with the fields on this rank.
std::string complaint(const fvMesh& mesh, const CaseOptions& options)
{
    try
    {
        return CaseFields(mesh, options.alpha, options.U, FieldSource::solver)
            .missing();
    }
    catch (const BadInput& mistake)
    {
        return mistake.what();
    }
}

// Throws BadInput on all ranks for a mistake, another exception for any other failure.
void requireFields(const fvMesh& mesh, const CaseOptions& options)
{
    const RankMessages messages;
    std::string mistake;
    runOnAllRanks(messages, [&] { mistake = complaint(mesh, options); });
    messages.throwIfAny<BadInput>(mistake);
    FaceFlux flux(mesh, options.phi, options.velocity, FieldSource::solver, messages);
    flux.choose(instantList());
}

} // namespace

void checkFields(const fvMesh& mesh, const CaseOptions& options, const dictionary& dict)
{
    // Without any field the solver has not made them yet.
    if (mesh.names<volVectorField>().empty())
    {
        return;
    }
    std::string mistake;
    // Other failures, as a lack of memory, are told when the analysis starts.
    failureOf(
        [&]
        {
            try
            {
                requireFields(mesh, options);
            }
            catch (const BadInput& bad)
            {
                mistake = bad.what();
            }
        }
    );
    if (!mistake.empty())
    {
        failOn(dict, mistake);
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
