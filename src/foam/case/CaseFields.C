// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/case/CaseFields.H"

#include "core/base/Errors.H"
#include "foam/case/CaseChecks.H"
#include "IOdictionary.H"
#include "IOobjectList.H"
#include "Time.H"
#include "fvMesh.H"

#include <cctype>

namespace Foam::stability
{

namespace
{

// The names in `phases (water air);`, `phases (water {...} air {...});` or
// `phases {water {...} air {...}}`.
wordList phaseNames(const entry& phases)
{
    if (phases.isDict())
    {
        return phases.dict().toc();
    }
    DynamicList<word> names;
    label depth = 0;
    for (const token& t : phases.stream())
    {
        if (t.isPunctuation())
        {
            depth += t.pToken() == token::BEGIN_BLOCK;
            depth -= t.pToken() == token::END_BLOCK;
        }
        else if (depth == 0 && t.isWord())
        {
            names.append(t.wordToken());
        }
    }
    return wordList(std::move(names));
}

// The phases that the case declares, and the file that does.
wordList declaredPhases(const fvMesh& mesh, word& file)
{
    for (const char* name :
         {"transportProperties", "phaseProperties", "thermophysicalProperties"})
    {
        const IOdictionary properties(IOobject(
            name, mesh.time().constant(), mesh, IOobject::READ_IF_PRESENT,
            IOobject::NO_WRITE, false
        ));
        const entry* phases = properties.findEntry("phases", keyType::LITERAL);
        if (phases)
        {
            file = name;
            return phaseNames(*phases);
        }
    }
    return wordList();
}

bool endsWith(const std::string& text, const std::string& end)
{
    return text.size() >= end.size()
           && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

// The scalar fields in a solver's memory or else on disk at a time.
wordList scalarFields(const fvMesh& mesh, FieldSource fields, const word& timeName)
{
    wordList names;
    if (fields == FieldSource::solver)
    {
        names = mesh.sortedNames<volScalarField>();
    }
    return !names.empty()
               ? names
               : IOobjectList(mesh, timeName).sortedNames(volScalarField::typeName);
}

// The fields alpha.* among them, without averages, old times and the copies that users
// and editors leave beside a field (.orig, .bak, ~, :Zone.Identifier).
wordList alphasOf(const wordList& names)
{
    DynamicList<word> alphas;
    for (const word& name : names)
    {
        const bool derived = endsWith(name, "_0") || endsWith(name, "Mean");
        if (name.compare(0, 6, "alpha.") == 0 && !derived
            && name.find_first_of(".~:#", 6) == name.npos)
        {
            alphas.append(name);
        }
    }
    return wordList(std::move(alphas));
}

// Releases before 2.3 called them alpha1 and alphawater. alphat is a diffusivity, and
// alphas the sum over several phases.
wordList oldAlphasOf(const wordList& names)
{
    DynamicList<word> alphas;
    for (const word& name : names)
    {
        if (name.size() > 5 && name.compare(0, 5, "alpha") == 0
            && std::isalnum(static_cast<unsigned char>(name[5])) && name != "alphat"
            && name != "alphas" && !endsWith(name, "_0") && !endsWith(name, "Mean"))
        {
            alphas.append(name);
        }
    }
    return wordList(std::move(alphas));
}

[[noreturn]] void refuseWithoutAlpha(const wordList& names, const Time& runTime)
{
    const wordList old(oldAlphasOf(names));
    const std::string decomposed = decomposedWayOut(runTime);
    throw BadInput(
        "No volume fraction: there is no scalar field alpha.* at time "
        + runTime.timeName()
        + ", no 'phases' in transportProperties, phaseProperties or "
          "thermophysicalProperties, and no entry 'alpha'."
        + (!old.empty() ? " There is " + listed(old) + ": say 'alpha " + old.first()
                              + ";' in the dictionary."
           : !decomposed.empty() ? " Perhaps " + decomposed
                                 : "")
    );
}

// The times from the present one on.
instantList laterTimes(const Time& runTime)
{
    DynamicList<instant> times;
    times.append(instant(runTime.value(), runTime.timeName()));
    for (const instant& time : runTime.times())
    {
        if (time.name() != runTime.constant() && time.value() > runTime.value())
        {
            times.append(time);
        }
    }
    return instantList(std::move(times));
}

// True where one of the times from the present one on has the field.
bool hasField(const fvMesh& mesh, FieldSource fields, const word& name)
{
    const FieldReader<volScalarField> field(mesh, name, fields);
    for (const instant& time : laterTimes(mesh.time()))
    {
        if (!field.absentAt(time.name()))
        {
            return true;
        }
    }
    return false;
}

// The volume fraction of the first of the declared phases; of the second where only
// that has a field.
word declaredAlpha(
    const fvMesh& mesh, FieldSource fields, const wordList& phases, const word& file,
    std::string& source
)
{
    const word first(IOobject::groupName("alpha", phases.first()));
    const word last(IOobject::groupName("alpha", phases.last()));
    const bool takeLast =
        !hasField(mesh, fields, first) && hasField(mesh, fields, last);
    source = takeLast
                 ? "the second of the phases in " + file + ", as there is no " + first
                 : "the first of the phases in " + file;
    return takeLast ? last : first;
}

word findAlpha(const fvMesh& mesh, FieldSource fields, std::string& source)
{
    word file;
    const wordList phases(declaredPhases(mesh, file));
    if (phases.size() > 2)
    {
        throw BadInput(
            file + " has the phases " + listed(phases)
            + ": say which volume fraction to analyse, for instance 'alpha alpha."
            + phases.first() + ";'."
        );
    }
    if (!phases.empty())
    {
        return declaredAlpha(mesh, fields, phases, file, source);
    }

    const Time& runTime = mesh.time();
    const wordList names(scalarFields(mesh, fields, runTime.timeName()));
    word found(runTime.timeName());
    wordList alphas(alphasOf(names));
    // The first times of a case may have no fields yet.
    for (const instant& later : laterTimes(runTime))
    {
        if (alphas.empty())
        {
            alphas = alphasOf(scalarFields(mesh, fields, later.name()));
            found = later.name();
        }
    }
    if (alphas.empty())
    {
        refuseWithoutAlpha(names, runTime);
    }
    if (alphas.size() > 1)
    {
        throw BadInput(
            "Several volume fractions at time " + found + " (" + listed(alphas)
            + "): say which to analyse, for instance 'alpha " + alphas.first() + ";'."
        );
    }
    source = "the only alpha.* at time " + found;
    return alphas.first();
}

} // namespace

CaseFields::CaseFields(
    const fvMesh& mesh, const word& alphaName, const word& UName, FieldSource fields
)
    : mesh_(mesh), source_("the dictionary"),
      alpha_(
          mesh, alphaName.empty() ? findAlpha(mesh, fields, source_) : alphaName, fields
      ),
      U_(mesh, UName, fields)
{
}

std::string CaseFields::missingAt(const word& timeName) const
{
    const std::string first = alpha_.complaint(timeName);
    return first.empty() ? U_.complaint(timeName) : first;
}

bool CaseFields::absentAt(const word& timeName) const
{
    const bool noAlpha = alpha_.absentAt(timeName);
    return U_.absentAt(timeName) || noAlpha;
}

void CaseFields::require(const instantList& times) const
{
    for (const instant& time : times)
    {
        const std::string failure = missingAt(time.name());
        if (!failure.empty())
        {
            throw BadInput(failure);
        }
    }
}

scalar CaseFields::time() const
{
    const Time& runTime = mesh_.time();
    if (inMemory())
    {
        return runTime.value();
    }
    const IOdictionary kept(IOobject(
        "time", runTime.timeName(), "uniform", runTime, IOobject::READ_IF_PRESENT,
        IOobject::NO_WRITE, false
    ));
    const scalar value = kept.getOrDefault<scalar>("value", runTime.value());
    return Time::timeName(value) == runTime.timeName() ? value : runTime.value();
}

} // namespace Foam::stability
