// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/case/FieldReader.H"

#include "core/base/Errors.H"
#include "foam/errors/Failures.H"
#include "OSspecific.H"
#include "Time.H"
#include "fvMesh.H"
#include "sigFpe.H"

namespace Foam::stability
{

namespace
{

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
bool FieldReader<FieldType>::onDisk(const word& timeName) const
{
    return isFile(at(timeName).objectPath());
}

template<class FieldType>
std::string FieldReader<FieldType>::complaint(const word& timeName) const
{
    const regIOobject* registered =
        source_ == FieldSource::solver ? mesh_.findObject<regIOobject>(name_) : nullptr;
    if (registered)
    {
        return isA<FieldType>(*registered)
                   ? ""
                   : "Field " + name_ + " is a " + registered->type() + "; needed is a "
                         + FieldType::typeName + ".";
    }

    IOobject io(at(timeName));
    const std::string file = mesh_.time().relativePath(io.objectPath());
    if (!isFile(io.objectPath()))
    {
        return "There is no field " + name_ + " at time " + timeName + " (no file "
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

template<class FieldType>
tmp<FieldType> FieldReader<FieldType>::get() const
{
    return inMemory() ? tmp<FieldType>(mesh_.lookupObject<FieldType>(name_))
                      : read(mesh_.time().timeName());
}

template<class FieldType>
tmp<FieldType> FieldReader<FieldType>::read(const word& timeName) const
{
    const ThrowingErrors throwing;
    // Patch fields may compute on values that are not finite; that is told later.
    const sigFpe::ignore untrapped;
    try
    {
        return tmp<FieldType>(new FieldType(at(timeName), mesh_));
    }
    catch (const std::exception& failure)
    {
        throw BadInput(
            "Field " + name_ + " of time " + timeName
            + " cannot be read: " + describe(failure)
        );
    }
}

template class FieldReader<volScalarField>;
template class FieldReader<volVectorField>;
template class FieldReader<surfaceScalarField>;

} // namespace Foam::stability
