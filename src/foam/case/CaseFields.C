// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/case/CaseFields.H"

#include "core/base/Errors.H"
#include "IOdictionary.H"
#include "IOobjectList.H"
#include "Time.H"
#include "fvMesh.H"

namespace Foam::stability
{

namespace
{

std::string listed(const wordList& names)
{
    std::string text;
    for (const word& name : names)
    {
        text += (text.empty() ? "" : ", ") + name;
    }
    return text;
}

// The names in `phases (water air);` or `phases (water {...} air {...});`.
wordList phaseNames(const ITstream& tokens)
{
    DynamicList<word> names;
    label depth = 0;
    for (const token& t : tokens)
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
    for (const char* name : {"transportProperties", "thermophysicalProperties"})
    {
        const IOdictionary properties(IOobject(
            name, mesh.time().constant(), mesh, IOobject::READ_IF_PRESENT,
            IOobject::NO_WRITE, false
        ));
        const entry* phases = properties.findEntry("phases", keyType::LITERAL);
        if (phases && phases->isStream())
        {
            file = name;
            return phaseNames(phases->stream());
        }
    }
    return wordList();
}

bool endsWith(const std::string& text, const std::string& end)
{
    return text.size() >= end.size()
           && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

// The scalar fields alpha.* in a solver's memory or else on disk, without averages, old
// times and set-up copies of them.
wordList presentAlphas(const fvMesh& mesh, FieldSource fields)
{
    wordList candidates;
    if (fields == FieldSource::solver)
    {
        candidates = mesh.sortedNames<volScalarField>();
    }
    if (candidates.empty())
    {
        const IOobjectList objects(mesh, mesh.time().timeName());
        candidates = objects.sortedNames(volScalarField::typeName);
    }
    DynamicList<word> alphas;
    for (const word& name : candidates)
    {
        const bool derived =
            endsWith(name, "_0") || endsWith(name, "Mean") || endsWith(name, ".orig");
        if (name.compare(0, 6, "alpha.") == 0 && !derived)
        {
            alphas.append(name);
        }
    }
    return wordList(std::move(alphas));
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
        source = "the first of the phases in " + file;
        return IOobject::groupName("alpha", phases.first());
    }

    const wordList alphas(presentAlphas(mesh, fields));
    const std::string time = "time " + mesh.time().timeName();
    if (alphas.empty())
    {
        throw BadInput(
            "No volume fraction: there is no scalar field alpha.* at " + time
            + ", no 'phases' in transportProperties, and no entry 'alpha'."
        );
    }
    if (alphas.size() > 1)
    {
        throw BadInput(
            "Several volume fractions at " + time + " (" + listed(alphas)
            + "): say which to analyse, for instance 'alpha " + alphas.first() + ";'."
        );
    }
    source = "the only alpha.* at " + time;
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
