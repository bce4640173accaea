// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

#include "foam/entries/Controls.H"

#include "core/parametrization/Flattening.H"
#include "foam/entries/EntryChoices.H"
#include "foam/entries/EntryReaders.H"
#include "foam/entries/ReconstructionControls.H"
#include "IOdictionary.H"
#include "OSspecific.H"

#include <omp.h>

namespace Foam::stability
{

namespace
{

const word dictName("interfaceStabilityDict");

const wordList ownEntries{
    "alpha",
    "U",
    "phi",
    "velocity",
    "region",
    "reconstruction",
    "reconstructions",
    "files",
    "sharpening",
    "smooth",
    "epsilon",
    "epsilonAbsolute",
    "merge",
    "normalGate",
    "seamTreatment",
    "wallVelocity",
    "tolerance",
    "maxParticles",
    "flattening",
    "nThreads",
    "volumeFit",
    "writePrecision",
    "surfaceInterval",
    "particleInterval",
    "surfaceParts"};

const wordList solverEntries{
    "classifyControl", "classifyInterval", "classifyDisplacement", "writeToFile",
    "onError"};

// What OpenFOAM itself reads from the dictionary of any function object.
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
    "outputInterval"};

void checkEntries(const dictionary& dict, Caller caller)
{
    wordList allowed(ownEntries);
    const bool inSolver = caller == Caller::functionObject;
    allowed.append(inSolver ? solverEntries : wordList{"methods"});
    checkKeys(dict, allowed, inSolver ? functionObjectEntries : wordList());
}

// OpenMP's own number follows OMP_NUM_THREADS, else it is that of the cores, of which
// every rank has one.
label defaultThreads()
{
    const bool alone = UPstream::parRun() && !env("OMP_NUM_THREADS");
    return alone ? 1 : omp_get_max_threads();
}

TrackerOptions readTrackerOptions(const dictionary& dict, Caller caller)
{
    TrackerOptions options;
    options.reconstruction = readReconstruction(dict, caller);
    options.parametrization.flattening = readWord(
        dict, "flattening", options.parametrization.flattening, Flattening::names()
    );
    readComparison(
        dict, options.reconstruction.method, options.matching, options.transfer
    );
    options.wallVelocity =
        readEnum(dict, "wallVelocity", WallVelocity::slip, wallVelocityNames());
    options.integration.tolerance =
        readNumber<scalar>(dict, "tolerance", 1e-3, Range{1e-10, 0.1, " cells"});
    options.maxParticles =
        readNumber<label>(dict, "maxParticles", 1000000, Range{0, 1e9, ""});
    options.nThreads = readNumber<label>(
        dict, "nThreads", defaultThreads(), Range{1, 1024, " threads"}
    );
    return options;
}

} // namespace

Controls readControls(const dictionary& dict, Caller caller)
{
    checkEntries(dict, caller);
    Controls controls;
    controls.fields.alpha = readName(dict, "alpha", word::null);
    controls.fields.U = readName(dict, "U", controls.fields.U);
    controls.fields.phi = readName(dict, "phi", controls.fields.phi);
    if (dict.found("velocity", keyType::LITERAL))
    {
        controls.fields.velocity =
            readEnum(dict, "velocity", VelocityKind::flux, velocityNames());
    }
    controls.tracker = readTrackerOptions(dict, caller);
    controls.fields.files = {
        {-VGREAT, readFiles(dict, controls.tracker.reconstruction.method)}};
    readLater(dict, caller, controls);
    controls.writePrecision =
        readNumber<label>(dict, "writePrecision", 15, Range{3, 17, " digits"});
    controls.surfaceInterval =
        readNumber<label>(dict, "surfaceInterval", 1, Range{0, 1e9, ""});
    controls.particleInterval =
        readNumber<label>(dict, "particleInterval", 1, Range{0, 1e9, ""});
    controls.surfaceParts =
        readEnum(dict, "surfaceParts", SurfaceParts::whole, surfacePartsNames());
    controls.writeToFile = readSwitch(dict, "writeToFile", true);
    controls.classify = readClassify(dict);
    controls.onError = readEnum(dict, "onError", OnError::stop, onErrorNames());
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
    IOobject io(at(region));
    if (!option.empty())
    {
        io = IOobject::selectIO(at(fileName::null), option);
    }
    else if (!region.empty() && !isFile(io.objectPath()))
    {
        io = at(fileName::null);
    }
    if (option.empty() && !isFile(io.objectPath()))
    {
        Info << "No " << runTime.system() / io.local() / dictName
             << ": every entry has its default." << nl << endl;
        return dictionary();
    }
    return IOdictionary(io);
}

} // namespace Foam::stability
