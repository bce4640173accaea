// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/case/MeshSnapshots.H"

#include "core/base/Errors.H"
#include "foam/errors/Failures.H"
#include "fvMesh.H"

namespace Foam::stability
{

namespace
{

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

// The distances of places in a mesh from the axis of the wedge that it is [m].
scalarField radii(const PlaneSection& section, const UList<point>& places)
{
    scalarField result(places.size());
    forAll(result, i)
    {
        result[i] = section.radius(places[i]);
    }
    return result;
}

// Those of the complex over those of the mesh.
scalarField
stretches(const PlaneSection& section, const UList<point>& places, scalarField radii)
{
    forAll(radii, i)
    {
        radii[i] = radii[i] > VSMALL ? section.radius(places[i]) / radii[i] : 1;
    }
    return radii;
}

// The velocity in the section: without what flows across; and from the axis it is that
// at the place in the complex, to which it is stretched, as it vanishes on the axis.
void moveToSection(
    vectorField& U, const CellComplex& complex, const scalarField& stretches
)
{
    const std::optional<PlaneSection>& section = complex.whole().section;
    const vector outward(section ? section->axis ^ section->normal : vector::zero);
    forAll(U, i)
    {
        U[i] = complex.whole().inPlane(U[i]);
        if (!stretches.empty())
        {
            U[i] += (stretches[i] - 1) * (U[i] & outward) * outward;
        }
    }
}

// At walls and symmetries the volume fraction is that of the cell. A patch of a contact
// angle extrapolates, beyond [0, 1] if it is told to, and at the first time it does so
// in the memory of a solver but not on disk. All in the order of the complex.
void correctAlpha(
    scalarField& boundary, const scalarField& cells, const CellComplex& complex
)
{
    forAll(boundary, i)
    {
        if (complex.kinds()[i] != BoundaryKind::open)
        {
            boundary[i] = cells[complex.owner()[complex.nInternalFaces() + i]];
        }
    }
}

// At symmetries the velocity is that of the cell without its normal part: OpenFOAM's
// patches round it differently when they are read and when they are evaluated.
void correctVelocity(
    vectorField& boundary, const vectorField& cells, const CellComplex& complex
)
{
    forAll(boundary, i)
    {
        if (complex.kinds()[i] == BoundaryKind::symmetry)
        {
            const label facei = complex.nInternalFaces() + i;
            const vector& inCell = cells[complex.owner()[facei]];
            const vector& area = complex.faceAreas()[facei];
            boundary[i] = inCell - (inCell & area) / max(magSqr(area), VSMALL) * area;
        }
    }
}

// The values are those of all internal faces, then of all boundary faces, in the order
// of the mesh.
scalarField faceValues(const surfaceScalarField& field)
{
    scalarField values(field.primitiveField());
    values.append(boundaryValues(field));
    return values;
}

} // namespace

MeshSnapshots::MeshSnapshots(
    const fvMesh& mesh, const RankMessages& messages, const FetchReach& reach,
    const wordHashSet& walls
)
    : messages_(messages), cells_(mesh, messages, reach, walls)
{
    if (!section() || !section()->wedge)
    {
        return;
    }
    const CellComplex& complex = *cells_.complex();
    const label nBoundary = complex.nBoundaryFaces(), first = complex.nInternalFaces();
    const SubList<point> boundary(complex.faceCentres(), nBoundary, first);
    const SubList<point> meshBoundary(
        mesh.faceCentres(), mesh.nFaces() - mesh.nInternalFaces(), mesh.nInternalFaces()
    );
    cellStretches_ = stretches(
        *section(), complex.cellCentres(),
        cells_.cellValues(radii(*section(), mesh.cellCentres()))
    );
    boundaryStretches_ = stretches(
        *section(), boundary, cells_.boundaryValues(radii(*section(), meshBoundary))
    );
}

std::shared_ptr<FlowSnapshot> MeshSnapshots::take(
    const volScalarField& alpha, const volVectorField& U, scalar time,
    const surfaceScalarField* phi
)
{
    const CellComplex& complex = *cells_.complex();
    auto snapshot = std::make_shared<FlowSnapshot>();
    snapshot->complex = cells_.complex();
    snapshot->time = time;
    snapshot->alphas.setSize(1, cells_.cellValues(alpha.primitiveField()));
    snapshot->boundaryAlphas.setSize(1, cells_.boundaryValues(boundaryValues(alpha)));
    correctAlpha(snapshot->boundaryAlphas[0], snapshot->alphas[0], complex);
    snapshot->U = cells_.cellValues(U.primitiveField());
    snapshot->boundaryU = cells_.boundaryValues(boundaryValues(U));
    moveToSection(snapshot->U, complex, cellStretches_);
    moveToSection(snapshot->boundaryU, complex, boundaryStretches_);
    correctVelocity(snapshot->boundaryU, snapshot->U, complex);
    std::string failure;
    try
    {
        if (phi)
        {
            if (!fluxVelocity_)
            {
                fluxVelocity_ = std::make_unique<const FluxVelocity>(complex);
            }
            snapshot->U = (*fluxVelocity_)(cells_.fluxes(faceValues(*phi)));
        }
        snapshot->check();
    }
    catch (const std::exception& bad)
    {
        failure = "Fields " + alpha.name() + (phi ? ", " + phi->name() : "") + " and "
                  + U.name() + " at time " + alpha.time().timeName() + ": "
                  + describe(bad);
    }
    messages_.throwIfAny<BadInput>(failure);
    if (phi)
    {
        // Only in its own cells a rank knows the fluxes through all faces.
        snapshot->U = cells_.cellValues(cells_.ownValues(snapshot->U));
    }
    return snapshot;
}

} // namespace Foam::stability
