// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/entries/EntryTable.H"

#include "core/base/Errors.H"
#include "core/parametrization/FlatteningMethods.H"
#include "foam/entries/EntryChoices.H"
#include "polyMesh.H"

#include <cstdlib>
#include <sstream>

namespace Foam::stability
{

namespace
{

using EntryRows = std::vector<EntryRow>;

// An entry of both dictionaries, which methods may give, too.
constexpr unsigned general = inUtility | inFunctionObject | inMethods;

EntryValue text(EntryType type, const std::string& form)
{
    EntryValue value;
    value.type = type;
    value.form = form;
    return value;
}

EntryValue name()
{
    return text(EntryType::name, "one name");
}

EntryValue number(scalar low, scalar high, const std::string& unit)
{
    EntryValue value{EntryType::number, "", {}, low, high, false, unit};
    return value;
}

EntryValue numberAbove(scalar low, scalar high, const std::string& unit)
{
    EntryValue value(number(low, high, unit));
    value.openLow = true;
    return value;
}

EntryValue wholeNumber(label low, scalar high, const std::string& unit = "")
{
    EntryValue value(number(low, high, unit));
    value.type = EntryType::wholeNumber;
    return value;
}

EntryValue choice(const std::vector<std::string>& names)
{
    EntryValue value(text(EntryType::choice, ""));
    value.choices = names;
    return value;
}

template<class EnumType>
EntryValue choice(const Enum<EnumType>& names)
{
    return choice(std::vector<std::string>(names.names().begin(), names.names().end()));
}

EntryValue yesNo()
{
    EntryValue value(choice({"yes", "no", "true", "false", "on", "off"}));
    value.type = EntryType::yesNo;
    return value;
}

EntryRows fieldRows()
{
    return {
        {"alpha", "found in the case", name(), general,
         "volume fraction of the first material"},
        {"U", "U", name(), general, "velocity"},
        {"phi", "phi", name(), general, "volume fluxes through the faces [m3/s]"},
        {"velocity", "flux where there is phi at all times, else U",
         choice(velocityNames()), general,
         "what carries the interface: the fluxes or the velocity"},
        {"region", polyMesh::defaultRegion, name(), inUtility | inFunctionObject,
         "mesh region"},
    };
}

// The order is that in which an unknown entry of reconstructions is told them.
EntryRows surfaceRows()
{
    constexpr unsigned also = general | inReconstructions;
    return {
        {"from", "", number(-GREAT, GREAT, "(user's time)"), inReconstructions,
         "the time from which on it is used, which must be given"},
        {"reconstruction", reconstructionNames().front(), choice(reconstructionNames()),
         also, "the method; fromFiles of the utility only"},
        {"reconstructions", "",
         text(EntryType::list, "a list, as ( name { from 0.5; ... } ... )"), general,
         "other reconstructions from later times on"},
        {"sharpening", "auto with isoAlpha, else none", choice(sharpeningNames()), also,
         "points are moved onto fitted paraboloids"},
        {"smooth", "0", wholeNumber(0, 1000, "pairs"), also,
         "Taubin smoothing steps of the interface"},
        {"files", "", text(EntryType::string, SurfaceFiles::allowed()), also,
         "the surfaces of fromFiles, one per time"},
        {"epsilon", "0.5, with bonnell 1", numberAbove(0, 10, "cells"), also,
         "band in which the interface is stable"},
        {"epsilonAbsolute", "", numberAbove(0, GREAT, "m"), also,
         "the same in metres, instead of epsilon"},
        {"merge", "nearest", choice(mergeNames()), general,
         "parameters where several sheets of T are near"},
        {"normalGate", "yes", yesNo(), general,
         "surfaces must face the same way to match"},
        {"seamTreatment", "yes, with plic no", yesNo(), also,
         "triangles that cross a seam of the parameters are cut"},
        {"volumeFit", "none", choice(volumeFitNames()), also,
         "closed components get the volume of their fractions"},
    };
}

EntryRows flowRows()
{
    return {
        {"flattening", "abf", choice(Flattening::names()), general,
         "how the first interface is flattened"},
        {"wallVelocity", "slip", choice(wallVelocityNames()), general,
         "how the surface feels walls"},
        {"tolerance", "1e-3", number(1e-10, 0.1, "cells"), general,
         "error of one integration step"},
        {"maxParticles", "1000000", wholeNumber(0, 1e9), general,
         "cap on the instability particles"},
        {"nThreads", "all cores, in parallel 1", wholeNumber(1, 1024, "threads"),
         general, "OpenMP threads of each process"},
        {"methods", "",
         text(EntryType::list, "a list of at least two, as ( name { entries } ... )"),
         inUtility, "combinations of entries, compared on the same flow"},
    };
}

EntryRows outputRows()
{
    return {
        {"writePrecision", "15", wholeNumber(3, 17, "digits"), general,
         "digits of the tables"},
        {"surfaceInterval", "1", wholeNumber(0, 1e9), general,
         "surfaces at every n-th classified time; 0: never"},
        {"particleInterval", "1", wholeNumber(0, 1e9), general,
         "the same for the particles"},
        {"surfaceParts", "whole", choice(surfacePartsNames()), general,
         "one file of a surface, or one from each process"},
        {"parameterSpace", "no", yesNo(), general,
         "the interface is written laid out by its parameters, too"},
    };
}

EntryRows solverRows()
{
    return {
        {"classifyControl", "asWritten", choice(classifyControlNames()),
         inFunctionObject, "when the interface is classified"},
        {"classifyInterval", "1", wholeNumber(1, 1e9), inFunctionObject,
         "with timeStep and writeTime: at every n-th"},
        {"classifyInterval", "", numberAbove(0, GREAT, "(user's time)"),
         inFunctionObject, "with runTime and adjustableRunTime, which need it"},
        {"classifyDisplacement", "", numberAbove(0, 100, "cells"), inFunctionObject,
         "classify, too, after such a displacement (rms)"},
        {"writeToFile", "yes", yesNo(), inFunctionObject,
         "whether anything is written but the log"},
        {"onError", "stop", choice(onErrorNames()), inFunctionObject,
         "what follows when the analysis fails"},
    };
}

} // namespace

const std::vector<EntryRow>& entryTable()
{
    static const EntryRows table = []
    {
        EntryRows all;
        for (const EntryRows& part :
             {fieldRows(), surfaceRows(), flowRows(), outputRows(), solverRows()})
        {
            all.insert(all.end(), part.begin(), part.end());
        }
        return all;
    }();
    return table;
}

const EntryRow& entryRow(const word& name, EntryType type)
{
    for (const EntryRow& row : entryTable())
    {
        if (row.name == name && row.value.type == type)
        {
            return row;
        }
    }
    FatalErrorInFunction << "The table of entries has no '" << name << "' of this type."
                         << exit(FatalError);
    std::abort(); // not reached: exit() ends the program or throws
}

wordList entryNames(EntryPlace place)
{
    DynamicList<word> names;
    for (const EntryRow& row : entryTable())
    {
        if ((row.places & place) && !names.found(row.name))
        {
            names.append(row.name);
        }
    }
    return wordList(std::move(names));
}

std::string allowedText(const EntryValue& value)
{
    if (!value.choices.empty())
    {
        return "one of " + listed(value.choices);
    }
    if (!value.form.empty())
    {
        return value.form;
    }
    std::ostringstream os;
    os << (value.type == EntryType::wholeNumber ? "a whole number" : "a number");
    if (value.low != -GREAT || value.high != GREAT)
    {
        os << ", " << (value.openLow ? "above " : "") << value.low << " to "
           << value.high;
    }
    os << (value.unit.empty() ? "" : " ") << value.unit;
    return os.str();
}

} // namespace Foam::stability
