// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

#include "foam/entries/Controls.H"

#include "core/parametrization/Flattening.H"
#include "foam/entries/EntryReaders.H"
#include "IOdictionary.H"
#include "OSspecific.H"

#include <algorithm>
#include <vector>

#include <omp.h>

namespace Foam::stability
{

namespace
{

const word dictName("interfaceStabilityDict");

const Enum<Merge> mergeNames({
    {Merge::nearest, "nearest"},
    {Merge::untracked, "untracked"},
});

const Enum<VelocityKind> velocityNames({
    {VelocityKind::U, "U"},
    {VelocityKind::flux, "flux"},
});

const Enum<WallVelocity> wallVelocityNames({
    {WallVelocity::slip, "slip"},
    {WallVelocity::noSlip, "noSlip"},
});

const Enum<OnError> onErrorNames({
    {OnError::stop, "stop"},
    {OnError::resume, "resume"},
});

const Enum<SurfaceParts> surfacePartsNames({
    {SurfaceParts::whole, "whole"},
    {SurfaceParts::pieces, "pieces"},
});

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

void checkEntries(const dictionary& dict, Shell shell)
{
    wordList allowed(ownEntries);
    const bool inSolver = shell == Shell::functionObject;
    allowed.append(inSolver ? solverEntries : wordList{"methods"});
    checkKeys(dict, allowed, inSolver ? functionObjectEntries : wordList());
}

Epsilon readEpsilon(const dictionary& dict, const word& reconstruction)
{
    if (dict.found("epsilon") && dict.found("epsilonAbsolute"))
    {
        FatalIOErrorInFunction(dict)
            << "Entries 'epsilon' (in cells) and 'epsilonAbsolute' (in metres) are "
            << "both given; allowed is one of them." << exit(FatalIOError);
    }
    Epsilon epsilon;
    epsilon.relative = !dict.found("epsilonAbsolute");
    if (epsilon.relative)
    {
        // The dual mesh of bonnell is noisier than cell-point tetrahedra.
        const scalar standard = reconstruction == "bonnell" ? 1 : 0.5;
        epsilon.value =
            readNumber(dict, "epsilon", standard, Range{0, 10, " cells", true});
    }
    else
    {
        epsilon.value =
            readNumber<scalar>(dict, "epsilonAbsolute", 1, Range{0, GREAT, " m", true});
    }
    return epsilon;
}

Sharpening readSharpening(const dictionary& dict, const ReconstructionOptions& options)
{
    const bool possible = options.method == "isoAlpha";
    const std::vector<std::string>& names = sharpeningNames();
    const word name = readWord(dict, "sharpening", possible ? "auto" : "none", names);
    if (!possible && name != "none")
    {
        refuse(dict, "sharpening", "none with the reconstruction " + options.method);
    }
    return Sharpening(std::find(names.begin(), names.end(), name) - names.begin());
}

VolumeFit readVolumeFit(const dictionary& dict, const ReconstructionOptions& options)
{
    const std::vector<std::string>& names = volumeFitNames();
    const word name = readWord(dict, "volumeFit", "none", names);
    if (options.method != "isoAlpha" && name != "none")
    {
        refuse(dict, "volumeFit", "none with the reconstruction " + options.method);
    }
    return VolumeFit(std::find(names.begin(), names.end(), name) - names.begin());
}

ReconstructionOptions readReconstruction(const dictionary& dict, Shell shell)
{
    ReconstructionOptions options;
    std::vector<std::string> names = Reconstruction::names();
    if (shell == Shell::functionObject)
    {
        // While a solver runs nobody has made surfaces of its times.
        names.erase(std::find(names.begin(), names.end(), "fromFiles"));
    }
    options.method = readWord(dict, "reconstruction", options.method, names);
    options.smooth = readNumber<label>(dict, "smooth", 0, Range{0, 1000, " pairs"});
    if (options.smooth > 0 && !Reconstruction::canSmooth(options.method))
    {
        refuse(dict, "smooth", "0 with the reconstruction " + options.method);
    }
    options.sharpening = readSharpening(dict, options);
    options.volumeFit = readVolumeFit(dict, options);
    return options;
}

// The pattern of the names of files, needed by fromFiles alone.
std::string readFiles(const dictionary& dict, const std::string& method)
{
    const bool found = dict.found("files", keyType::LITERAL);
    if (found != (method == "fromFiles"))
    {
        FatalIOErrorInFunction(dict
        ) << "Entries 'files' and 'reconstruction fromFiles' belong together; found is "
          << (found ? "'files' with the reconstruction " : "no 'files'")
          << (found ? method.c_str() : "") << '.' << exit(FatalIOError);
    }
    if (!found)
    {
        return "";
    }
    const entry* e = dict.findEntry("files", keyType::LITERAL);
    const bool one = e->isStream() && e->stream().size() == 1;
    const token& t = one ? e->stream()[0] : token::undefinedToken;
    std::string pattern = t.isString() ? std::string(t.stringToken())
                          : t.isWord() ? std::string(t.wordToken())
                                       : "";
    if (!SurfaceFiles::isPattern(pattern))
    {
        refuse(dict, "files", SurfaceFiles::allowed());
    }
    return pattern;
}

// How surfaces are compared, and p handed on, with this method of reconstruction.
void readComparison(
    const dictionary& dict, const std::string& method, MatchingOptions& matching,
    TransferOptions& transfer
)
{
    matching.epsilon = readEpsilon(dict, method);
    matching.normalGate = readSwitch(dict, "normalGate", true);
    transfer.merge = readEnum(dict, "merge", Merge::nearest, mergeNames);
    // Polygons that do not meet have no edges that a seam could cross.
    transfer.seamTreatment = readSwitch(dict, "seamTreatment", method != "plic");
}

// The entries of `outer` with those of `inner` in their place; of the two for epsilon
// only one may be given, so one takes the place of either.
dictionary overlaid(const dictionary& outer, const dictionary& inner)
{
    dictionary merged(outer);
    if (inner.found("epsilon") || inner.found("epsilonAbsolute"))
    {
        merged.remove("epsilon");
        merged.remove("epsilonAbsolute");
    }
    merged.merge(inner);
    return merged;
}

// Other reconstructions from later times on, each with all that belongs to it.
void readLater(const dictionary& dict, Shell shell, Controls& controls)
{
    if (!dict.found("reconstructions", keyType::LITERAL))
    {
        return;
    }
    const wordList allowed{
        "from",    "reconstruction",  "sharpening",    "smooth",   "files",
        "epsilon", "epsilonAbsolute", "seamTreatment", "volumeFit"};
    scalar before = -VGREAT;
    for (const entry& e : PtrList<entry>(dict.lookup("reconstructions")))
    {
        const dictionary& later = e.dict();
        checkKeys(later, allowed);
        ReconstructionFrom change;
        change.from = later.get<scalar>("from");
        if (!(change.from > before))
        {
            refuse(later, "from", "a later time than that of the entry before");
        }
        before = change.from;
        change.reconstruction = readReconstruction(later, shell);
        readComparison(
            overlaid(dict, later), change.reconstruction.method, change.matching,
            change.transfer
        );
        controls.fields.files.push_back(
            {change.from, readFiles(later, change.reconstruction.method)}
        );
        controls.tracker.later.push_back(change);
    }
}

// OpenMP's own number follows OMP_NUM_THREADS, else it is that of the cores, of which
// every rank has one.
label defaultThreads()
{
    const bool alone = UPstream::parRun() && !env("OMP_NUM_THREADS");
    return alone ? 1 : omp_get_max_threads();
}

TrackerOptions readTrackerOptions(const dictionary& dict, Shell shell)
{
    TrackerOptions options;
    options.reconstruction = readReconstruction(dict, shell);
    options.parametrization.flattening = readWord(
        dict, "flattening", options.parametrization.flattening, Flattening::names()
    );
    readComparison(
        dict, options.reconstruction.method, options.matching, options.transfer
    );
    options.wallVelocity =
        readEnum(dict, "wallVelocity", WallVelocity::slip, wallVelocityNames);
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

Controls readControls(const dictionary& dict, Shell shell)
{
    checkEntries(dict, shell);
    Controls controls;
    controls.fields.alpha = readName(dict, "alpha", word::null);
    controls.fields.U = readName(dict, "U", controls.fields.U);
    controls.fields.phi = readName(dict, "phi", controls.fields.phi);
    if (dict.found("velocity", keyType::LITERAL))
    {
        controls.fields.velocity =
            readEnum(dict, "velocity", VelocityKind::flux, velocityNames);
    }
    controls.tracker = readTrackerOptions(dict, shell);
    controls.fields.files = {
        {-VGREAT, readFiles(dict, controls.tracker.reconstruction.method)}};
    readLater(dict, shell, controls);
    controls.writePrecision =
        readNumber<label>(dict, "writePrecision", 15, Range{3, 17, " digits"});
    controls.surfaceInterval =
        readNumber<label>(dict, "surfaceInterval", 1, Range{0, 1e9, ""});
    controls.particleInterval =
        readNumber<label>(dict, "particleInterval", 1, Range{0, 1e9, ""});
    controls.surfaceParts =
        readEnum(dict, "surfaceParts", SurfaceParts::whole, surfacePartsNames);
    controls.writeToFile = readSwitch(dict, "writeToFile", true);
    controls.classify = readClassify(dict);
    controls.onError = readEnum(dict, "onError", OnError::stop, onErrorNames);
    return controls;
}

std::vector<Method> readMethods(const dictionary& dict)
{
    if (!dict.found("methods"))
    {
        return {{word::null, readControls(dict, Shell::utility)}};
    }
    std::vector<Method> methods;
    for (const entry& e : PtrList<entry>(dict.lookup("methods")))
    {
        const word name(e.keyword());
        for (const Method& other : methods)
        {
            if (other.name == name)
            {
                refuse(
                    dict, "methods",
                    "a list in which each name is new; " + name + " is twice"
                );
            }
        }
        // What belongs together is given together.
        dictionary outer(dict);
        outer.remove("methods");
        if (e.dict().found("reconstruction"))
        {
            outer.remove("sharpening");
            outer.remove("volumeFit");
        }
        const dictionary merged(overlaid(outer, e.dict()));
        methods.push_back({name, readControls(merged, Shell::utility)});
    }
    if (methods.size() < 2)
    {
        refuse(dict, "methods", "a list of at least two, as ( name { entries } ... )");
    }
    return methods;
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
