// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

#include "foam/CaseFields.H"

#include "core/Errors.H"
#include "foam/Failures.H"
#include "IOdictionary.H"
#include "IOobjectList.H"
#include "OSspecific.H"
#include "Time.H"
#include "fvMesh.H"
#include "sigFpe.H"

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

IOobject fieldAt(const fvMesh& mesh, const word& name, const word& timeName)
{
    return IOobject(
        name, timeName, mesh, IOobject::MUST_READ, IOobject::NO_WRITE, false
    );
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

// The scalar fields alpha.* in memory or else on disk, without averages, old times
// and set-up copies of them.
wordList presentAlphas(const fvMesh& mesh)
{
    wordList candidates(mesh.sortedNames<volScalarField>());
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

word findAlpha(const fvMesh& mesh, std::string& source)
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

    const wordList alphas(presentAlphas(mesh));
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

template<class FieldType>
tmp<FieldType> getField(const fvMesh& mesh, const word& name)
{
    const auto* registered = mesh.findObject<FieldType>(name);
    if (registered)
    {
        return tmp<FieldType>(*registered);
    }

    const IOobject io(fieldAt(mesh, name, mesh.time().timeName()));
    const ThrowingErrors throwing;
    // Patch fields may compute on values that are not finite; that is told later.
    const sigFpe::ignore untrapped;
    try
    {
        return tmp<FieldType>(new FieldType(io, mesh));
    }
    catch (const std::exception& failure)
    {
        throw BadInput(
            "Field " + name + " of time " + mesh.time().timeName()
            + " cannot be read: " + describe(failure)
        );
    }
}

// While it lives, OpenFOAM prints neither progress nor warnings.
class Silence
{
public:
    Silence() : level_(messageStream::level) { messageStream::level = 0; }
    ~Silence() { messageStream::level = level_; }
    Silence(const Silence&) = delete;
    Silence& operator=(const Silence&) = delete;

private:
    int level_;
};

// What is wrong with a field at a time, by its header; empty if nothing is.
template<class FieldType>
std::string complaint(const fvMesh& mesh, const word& name, const word& timeName)
{
    const regIOobject* registered = mesh.findObject<regIOobject>(name);
    if (registered)
    {
        return isA<FieldType>(*registered)
                   ? ""
                   : "Field " + name + " is a " + registered->type() + "; needed is a "
                         + FieldType::typeName + ".";
    }

    IOobject io(fieldAt(mesh, name, timeName));
    const std::string file = mesh.time().relativePath(io.objectPath());
    if (!isFile(io.objectPath()))
    {
        return "There is no field " + name + " at time " + timeName + " (no file "
               + file + ").";
    }
    bool legible = false;
    {
        const Silence silence;
        legible = io.typeHeaderOk<FieldType>(false, true, false);
    }
    if (!legible)
    {
        return "File " + file + " has no legible header.";
    }
    return io.headerClassName() == FieldType::typeName
               ? ""
               : "File " + file + " holds a " + io.headerClassName() + "; needed is a "
                     + FieldType::typeName + ".";
}

} // namespace

CaseFields::CaseFields(const fvMesh& mesh, const word& alphaName, const word& UName)
    : mesh_(mesh), alphaName_(alphaName), UName_(UName), source_("the dictionary")
{
    if (alphaName_.empty())
    {
        alphaName_ = findAlpha(mesh, source_);
    }
}

std::string CaseFields::missingAt(const word& timeName) const
{
    const std::string first = complaint<volScalarField>(mesh_, alphaName_, timeName);
    return first.empty() ? complaint<volVectorField>(mesh_, UName_, timeName) : first;
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

tmp<volScalarField> CaseFields::alpha() const
{
    return getField<volScalarField>(mesh_, alphaName_);
}

tmp<volVectorField> CaseFields::U() const
{
    return getField<volVectorField>(mesh_, UName_);
}

scalar CaseFields::time() const
{
    const Time& runTime = mesh_.time();
    if (mesh_.foundObject<volVectorField>(UName_))
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
