// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/entries/ReconstructionControls.H"

#include "foam/entries/EntryChoices.H"
#include "foam/entries/EntryReaders.H"
#include "foam/errors/Failures.H"

#include <algorithm>

namespace Foam::stability
{

namespace
{

Epsilon readEpsilon(const dictionary& dict, const word& reconstruction)
{
    if (dict.found("epsilon") && dict.found("epsilonAbsolute"))
    {
        failOn(
            dict, "Entries 'epsilon' (in cells) and 'epsilonAbsolute' (in metres) are "
                  "both given; allowed is one of them."
        );
    }
    Epsilon epsilon;
    epsilon.relative = !dict.found("epsilonAbsolute");
    if (epsilon.relative)
    {
        epsilon.value = readNumber<scalar>(
            dict, "epsilon", reconstructionMethod(reconstruction).epsilon
        );
    }
    else
    {
        epsilon.value = readNumber<scalar>(dict, "epsilonAbsolute");
    }
    return epsilon;
}

Sharpening readSharpening(const dictionary& dict, const ReconstructionOptions& options)
{
    const bool possible = reconstructionMethod(options.method).canSharpen;
    const std::vector<std::string>& names = sharpeningNames();
    const word name = readChoice(dict, "sharpening", word(possible ? "auto" : "none"));
    if (!possible && name != "none")
    {
        refuse(dict, "sharpening", "none with the reconstruction " + options.method);
    }
    return Sharpening(std::find(names.begin(), names.end(), name) - names.begin());
}

VolumeFit readVolumeFit(const dictionary& dict, const ReconstructionOptions& options)
{
    const std::vector<std::string>& names = volumeFitNames();
    const word name = readChoice(dict, "volumeFit");
    if (!reconstructionMethod(options.method).canFitVolumes && name != "none")
    {
        refuse(dict, "volumeFit", "none with the reconstruction " + options.method);
    }
    return VolumeFit(std::find(names.begin(), names.end(), name) - names.begin());
}

} // namespace

ReconstructionOptions readReconstruction(const dictionary& dict, Caller caller)
{
    ReconstructionOptions options;
    // While a solver runs nobody has made surfaces of its times.
    wordList barred;
    for (const ReconstructionMethod& method : reconstructionMethods())
    {
        if (method.readsFiles && caller == Caller::functionObject)
        {
            barred.append(method.name);
        }
    }
    options.method = readChoice(dict, "reconstruction", std::nullopt, barred);
    options.smooth = readNumber<label>(dict, "smooth");
    if (options.smooth > 0 && !reconstructionMethod(options.method).canSmooth)
    {
        refuse(dict, "smooth", "0 with the reconstruction " + options.method);
    }
    options.sharpening = readSharpening(dict, options);
    options.volumeFit = readVolumeFit(dict, options);
    return options;
}

std::string readFiles(const dictionary& dict, const std::string& method)
{
    const bool found = dict.found("files", keyType::LITERAL);
    if (found != reconstructionMethod(method).readsFiles)
    {
        failOn(
            dict,
            "Entries 'files' and 'reconstruction fromFiles' belong together; found is "
                + (found ? "'files' with the reconstruction " + method : "no 'files'")
                + "."
        );
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
        refuse(dict, "files", allowedText(entryRow("files", EntryType::string).value));
    }
    return pattern;
}

void readComparison(
    const dictionary& dict, const std::string& method, MatchingOptions& matching,
    TransferOptions& transfer
)
{
    matching.epsilon = readEpsilon(dict, method);
    matching.normalGate = readSwitch(dict, "normalGate");
    transfer.merge = readEnum(dict, "merge", mergeNames());
    // Polygons that do not meet have no edges that a seam could cross.
    transfer.seamTreatment =
        readSwitch(dict, "seamTreatment", reconstructionMethod(method).sharesPoints);
}

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

void readLater(const dictionary& dict, Caller caller, Controls& controls)
{
    scalar before = -VGREAT;
    for (const NamedEntries& one : readList(dict, "reconstructions"))
    {
        const dictionary& later = one.entries;
        checkKeys(later, inReconstructions);
        if (!later.found("from", keyType::LITERAL))
        {
            failOn(later, "Entry 'from' is missing in '" + one.name + "'.");
        }
        ReconstructionFrom change;
        change.from = readNumber<scalar>(later, "from");
        if (!(change.from > before))
        {
            refuse(later, "from", "a later time than that of the entry before");
        }
        before = change.from;
        change.reconstruction = readReconstruction(later, caller);
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

} // namespace Foam::stability
