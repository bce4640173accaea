// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/entries/Controls.H"

#include "foam/entries/EntryChoices.H"
#include "foam/entries/EntryReaders.H"
#include "foam/entries/ReconstructionControls.H"
#include "foam/errors/IncludeLimit.H"
#include "foam/ranks/RankMessages.H"
#include "IOdictionary.H"
#include "OSspecific.H"

#include <omp.h>

namespace Foam::stability
{

namespace
{

const word dictName("interfaceStabilityDict");

// The entries that OpenFOAM itself, in one release or another, reads from the
// dictionary of any function object.
const wordList functionObjectEntries{
    "type",
    "libs",
    "functionObjectLibs",
    "enabled",
    "log",
    "errors",
    "timeStart",
    "timeEnd",
    "triggerStart",
    "triggerEnd",
    "controlMode",
    "deltaTCoeff",
    "nStepsToStartTimeChange",
    "executeControl",
    "executeInterval",
    "writeControl",
    "writeInterval",
    "outputControl",
    "outputInterval",
    "subRegion",
    "useNamePrefix",
    "useUserTime",
    "updateHeader"};

// OpenMP's own number follows OMP_NUM_THREADS, else it is that of the cores, of which
// every rank has one.
label defaultThreads()
{
    const bool alone = UPstream::parRun() && getEnv("OMP_NUM_THREADS").empty();
    return alone ? 1 : omp_get_max_threads();
}

TrackerOptions readTrackerOptions(const dictionary& dict, Caller caller)
{
    TrackerOptions options;
    options.reconstruction = readReconstruction(dict, caller);
    options.parametrization.flattening = readChoice(dict, "flattening");
    readComparison(
        dict, options.reconstruction.method, options.matching, options.transfer
    );
    options.wallVelocity = readEnum(dict, "wallVelocity", wallVelocityNames());
    options.integration.tolerance = readNumber<scalar>(dict, "tolerance");
    options.maxParticles = readNumber<label>(dict, "maxParticles");
    options.nThreads = readNumber<label>(dict, "nThreads", defaultThreads());
    return options;
}

} // namespace

Controls readControls(const dictionary& dict, Caller caller)
{
    const bool inSolver = caller == Caller::functionObject;
    checkKeys(
        dict, inSolver ? inFunctionObject : inUtility,
        inSolver ? functionObjectEntries : wordList()
    );
    Controls controls;
    controls.fields.alpha = readName(dict, "alpha", word::null);
    controls.fields.U = readName(dict, "U");
    controls.fields.phi = readName(dict, "phi");
    if (dict.found("velocity", keyType::LITERAL))
    {
        controls.fields.velocity = readEnum(dict, "velocity", velocityNames());
    }
    else if (controls.fields.phi != entryRow("phi", EntryType::name).standard)
    {
        controls.fields.velocity = VelocityKind::flux; // no other name is meant in vain
    }
    controls.tracker = readTrackerOptions(dict, caller);
    controls.fields.files = {
        {-VGREAT, readFiles(dict, controls.tracker.reconstruction.method)}};
    readLater(dict, caller, controls);
    controls.writePrecision = readNumber<label>(dict, "writePrecision");
    controls.surfaceInterval = readNumber<label>(dict, "surfaceInterval");
    controls.particleInterval = readNumber<label>(dict, "particleInterval");
    controls.surfaceParts = readEnum(dict, "surfaceParts", surfacePartsNames());
    controls.parameterSpace = readSwitch(dict, "parameterSpace");
    controls.writeToFile = readSwitch(dict, "writeToFile");
    controls.classify = readClassify(dict);
    controls.onError = readEnum(dict, "onError", onErrorNames());
    return controls;
}

dictionary
findControlsDict(const Time& runTime, const fileName& option, const word& region)
{
    const auto at = [&](const fileName& local)
    {
        return IOobject(
            dictName, runTime.caseSystem(), local, runTime, IOobject::MUST_READ,
            IOobject::NO_WRITE, false
        );
    };
    // What the master finds holds for all ranks.
    const auto isThere = [](const IOobject& io)
    {
        const RankMessages messages;
        Packet found;
        found.put(label(messages.isMaster() && isFile(io.objectPath())));
        return messages.fromMaster(found).get<label>() != 0;
    };
    IOobject io(at(region));
    if (!option.empty())
    {
        io = IOobject::selectIO(at(fileName::null), option);
    }
    else if (!region.empty() && !isThere(io))
    {
        io = at(fileName::null);
    }
    if (option.empty() && !isThere(io))
    {
        Info << "No " << runTime.system() / io.local() / dictName
             << ": every entry has its default." << nl << endl;
        return dictionary();
    }
    const IncludeLimit limit;
    return IOdictionary(io);
}

} // namespace Foam::stability
