// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

#include "foam/MeshSnapshots.H"

#include "core/Errors.H"
#include "core/flow/FluxVelocity.H"
#include "emptyPolyPatch.H"
#include "fvMesh.H"
#include "symmetryPlanePolyPatch.H"
#include "symmetryPolyPatch.H"
#include "wallPolyPatch.H"
#include "wedgePolyPatch.H"

namespace Foam::stability
{

namespace
{

BoundaryKind kindOf(const polyPatch& patch)
{
    if (patch.coupled() || isA<emptyPolyPatch>(patch) || isA<wedgePolyPatch>(patch))
    {
        throw BadInput(
            "Patch " + patch.name() + " is of type " + patch.type()
            + ", which interfaceStability does not support yet; allowed are walls, "
              "symmetries and open patches of a three-dimensional mesh."
        );
    }
    if (isA<wallPolyPatch>(patch))
    {
        return BoundaryKind::wall;
    }
    if (isA<symmetryPolyPatch>(patch) || isA<symmetryPlanePolyPatch>(patch))
    {
        return BoundaryKind::symmetry;
    }
    return BoundaryKind::open;
}

CellComplexInput complexInput(const fvMesh& mesh)
{
    const label nBoundaryFaces = mesh.nFaces() - mesh.nInternalFaces();
    CellComplexInput input;
    input.points = mesh.points();
    input.faces = mesh.faces();
    input.owner = mesh.faceOwner();
    input.neighbour = SubList<label>(mesh.faceNeighbour(), mesh.nInternalFaces());
    input.kinds.setSize(nBoundaryFaces, BoundaryKind::open);
    input.patches.setSize(nBoundaryFaces, -1);
    input.patchNames = mesh.boundaryMesh().names();
    for (const polyPatch& patch : mesh.boundaryMesh())
    {
        if (patch.empty())
        {
            continue; // without faces it does no harm, whatever its type
        }
        const label start = patch.start() - mesh.nInternalFaces();
        const BoundaryKind kind = kindOf(patch);
        for (label i = 0; i < patch.size(); ++i)
        {
            input.kinds[start + i] = kind;
            input.patches[start + i] = patch.index();
        }
    }
    return input;
}

// The patch values, in the order of the boundary faces.
template<class Type, template<class> class PatchField, class GeoMesh>
Field<Type> boundaryValues(const GeometricField<Type, PatchField, GeoMesh>& field)
{
    const fvMesh& mesh = field.mesh();
    Field<Type> values(mesh.nFaces() - mesh.nInternalFaces(), Zero);
    for (const PatchField<Type>& patchField : field.boundaryField())
    {
        const label start = patchField.patch().start() - mesh.nInternalFaces();
        forAll(patchField, i)
        {
            values[start + i] = patchField[i];
        }
    }
    return values;
}

// At walls and symmetries the volume fraction is that of the cell. A patch of a contact
// angle extrapolates, beyond [0, 1] if it is told to, and at the first time it does so
// in the memory of a solver but not on disk.
scalarField boundaryAlpha(const volScalarField& alpha, const CellComplex& complex)
{
    scalarField values(boundaryValues(alpha));
    forAll(values, i)
    {
        if (complex.kinds()[i] != BoundaryKind::open)
        {
            values[i] = alpha[complex.owner()[complex.nInternalFaces() + i]];
        }
    }
    return values;
}

// At symmetries the velocity is that of the cell without its normal part: OpenFOAM's
// patches round it differently when they are read and when they are evaluated.
vectorField boundaryVelocity(const volVectorField& U, const CellComplex& complex)
{
    vectorField values(boundaryValues(U));
    forAll(values, i)
    {
        if (complex.kinds()[i] == BoundaryKind::symmetry)
        {
            const label facei = complex.nInternalFaces() + i;
            const vector& inCell = U[complex.owner()[facei]];
            const vector& area = complex.faceAreas()[facei];
            values[i] = inCell - (inCell & area) / max(magSqr(area), VSMALL) * area;
        }
    }
    return values;
}

// Of all faces, in the order of the mesh.
scalarField faceValues(const surfaceScalarField& field)
{
    scalarField values(field.primitiveField());
    values.append(boundaryValues(field));
    return values;
}

} // namespace

MeshSnapshots::MeshSnapshots(const fvMesh& mesh)
    : complex_(std::make_shared<const CellComplex>(complexInput(mesh)))
{
}

std::shared_ptr<FlowSnapshot> MeshSnapshots::take(
    const volScalarField& alpha, const volVectorField& U, scalar time,
    const surfaceScalarField* phi
) const
{
    auto snapshot = std::make_shared<FlowSnapshot>();
    snapshot->complex = complex_;
    snapshot->time = time;
    snapshot->alphas = List<scalarField>(1, alpha.primitiveField());
    snapshot->boundaryAlphas = List<scalarField>(1, boundaryAlpha(alpha, *complex_));
    snapshot->boundaryU = boundaryVelocity(U, *complex_);
    try
    {
        snapshot->U =
            phi ? fluxVelocity(*complex_, faceValues(*phi)) : U.primitiveField();
        snapshot->check();
    }
    catch (const BadInput& bad)
    {
        throw BadInput(
            "Fields " + alpha.name() + (phi ? ", " + phi->name() : "") + " and "
            + U.name() + " at time " + alpha.time().timeName() + ": " + bad.what()
        );
    }
    return snapshot;
}

} // namespace Foam::stability
