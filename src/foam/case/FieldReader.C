// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/case/FieldReader.H"

#include "core/base/Errors.H"
#include "foam/errors/Failures.H"
#include "Time.H"
#include "fileOperation.H"
#include "fvMesh.H"
#include "localIOdictionary.H"

namespace Foam::stability
{

namespace
{

template<class FieldType>
constexpr bool isOnFaces = std::is_same_v<FieldType, surfaceScalarField>;

// The dictionary of a patch without the condition: constraints stay, others have their
// values, if there are any, or take those of the cells.
template<class FieldType>
dictionary valuesOf(const dictionary& condition, const fvPatch& patch)
{
    dictionary values;
    const bool given = condition.found("value");
    values.add(
        "type", patch.constraintType(patch.type()) ? patch.type()
                : given || isOnFaces<FieldType>    ? word("calculated")
                                                   : word("zeroGradient")
    );
    if (given)
    {
        values.add("value", condition.lookup("value"));
    }
    return values;
}

template<class FieldType>
tmp<FieldType> readValues(const IOobject& io, const fvMesh& mesh)
{
    localIOdictionary file(io, FieldType::typeName);
    const dictionary conditions(file.subDict("boundaryField"));
    dictionary& boundary = file.subDict("boundaryField");
    boundary.clear();
    for (const fvPatch& patch : mesh.boundary())
    {
        boundary.add(
            patch.name(),
            valuesOf<FieldType>(conditions.subOrEmptyDict(patch.name()), patch)
        );
    }
    const IOobject unread(
        io.name(), io.instance(), io.db(), IOobject::NO_READ, IOobject::NO_WRITE, false
    );
    return tmp<FieldType>::New(unread, mesh, file);
}

} // namespace

template<class FieldType>
IOobject FieldReader<FieldType>::at(const word& timeName) const
{
    return IOobject(
        name_, timeName, mesh_, IOobject::MUST_READ, IOobject::NO_WRITE, false
    );
}

template<class FieldType>
bool FieldReader<FieldType>::inMemory() const
{
    return source_ == FieldSource::solver && mesh_.foundObject<FieldType>(name_);
}

template<class FieldType>
bool FieldReader<FieldType>::inSolver() const
{
    return source_ == FieldSource::solver && mesh_.foundObject<regIOobject>(name_);
}

template<class FieldType>
bool FieldReader<FieldType>::onDisk(const word& timeName) const
{
    const Silence silence;
    return !fileHandler()
                .filePath(false, at(timeName), FieldType::typeName, true)
                .empty();
}

template<class FieldType>
bool FieldReader<FieldType>::absentAt(const word& timeName) const
{
    return !inSolver() && !onDisk(timeName);
}

template<class FieldType>
std::string FieldReader<FieldType>::complaint(const word& timeName) const
{
    if (inSolver())
    {
        const regIOobject& registered = mesh_.lookupObject<regIOobject>(name_);
        return isA<FieldType>(registered)
                   ? ""
                   : "Field " + name_ + " is a " + registered.type() + "; needed is a "
                         + FieldType::typeName + ".";
    }

    IOobject io(at(timeName));
    const std::string file = mesh_.time().relativePath(io.objectPath());
    if (!onDisk(timeName))
    {
        return "There is no field " + name_ + " at time " + timeName + " (no file "
               + file + ").";
    }
    bool legible = false;
    const std::string failure = failureOf(
        [&]
        {
            const Silence silence;
            legible = io.typeHeaderOk<FieldType>(false, true, false);
        }
    );
    if (failure.find("'version'") != failure.npos)
    {
        return "File " + file
               + " has no 'version' in its header, as files of the OpenFOAM "
                 "Foundation: add 'version 2.0;' to the headers of a copy of the case, "
                 "for instance by etc/addVersions of interfaceStability.";
    }
    if (!legible || !failure.empty())
    {
        return "File " + file + " has no legible header.";
    }
    return io.headerClassName() == FieldType::typeName
               ? ""
               : "File " + file + " holds a " + io.headerClassName() + "; needed is a "
                     + FieldType::typeName + ".";
}

template<class FieldType>
tmp<FieldType> FieldReader<FieldType>::get(const Exchange& exchange) const
{
    return inMemory() ? tmp<FieldType>(mesh_.lookupObject<FieldType>(name_))
                      : read(mesh_.time().timeName(), exchange);
}

template<class FieldType>
tmp<FieldType>
FieldReader<FieldType>::read(const word& timeName, const Exchange& exchange) const
{
    tmp<FieldType> field;
    const std::string here =
        failureOf([&] { field = tmp<FieldType>(new FieldType(at(timeName), mesh_)); });
    // Reading again may be collective, so that all ranks do it or none.
    exchange.meet();
    const std::string failure = exchange.firstNonEmpty(here);
    if (failure.empty())
    {
        return field;
    }
    if (!failureOf([&] { field = readValues<FieldType>(at(timeName), mesh_); }).empty())
    {
        throw BadInput(
            "Field " + name_ + " of time " + timeName + " cannot be read: " + failure
        );
    }
    if (toldConditions_)
    {
        return field;
    }
    toldConditions_ = true;
    Info << "interfaceStability: a boundary condition of field " << name_ << " of time "
         << timeName << " cannot be made (" << failure.c_str()
         << "): the values of the patches are taken, or those of the cells. Told once."
         << nl << endl;
    return field;
}

template class FieldReader<volScalarField>;
template class FieldReader<volVectorField>;
template class FieldReader<surfaceScalarField>;

} // namespace Foam::stability
