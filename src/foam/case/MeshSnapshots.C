// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/case/MeshSnapshots.H"

#include "core/base/Errors.H"
#include "foam/errors/Failures.H"
#include "fvMesh.H"

#include <algorithm>
#include <cmath>
#include <sstream>

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

// Beyond so much outside [0, 1] a volume fraction is told.
constexpr scalar smallExcess = 0.01;

// Beyond that much it is wrong, which no more than this share of the cells may be.
constexpr scalar largeExcess = 0.1;
constexpr scalar largestShare = 0.01;

scalar excess(scalar alpha)
{
    return max(-alpha, alpha - 1);
}

label nBeyond(const UList<scalar>& alphas, scalar limit)
{
    return std::count_if(
        alphas.begin(), alphas.end(),
        [&](scalar alpha) { return excess(alpha) > limit; }
    );
}

// Values that are not finite stay; they are told elsewhere.
void clip(scalarField& alphas)
{
    for (scalar& alpha : alphas)
    {
        if (std::isfinite(alpha))
        {
            alpha = min(max(alpha, scalar(0)), scalar(1));
        }
    }
}

// The worst of the cells, if it is to be told.
std::string worst(const volScalarField& alpha)
{
    const scalarField& values = alpha.primitiveField();
    label worst = -1;
    forAll(values, i)
    {
        const bool worse = worst < 0 || excess(values[i]) > excess(values[worst]);
        worst = excess(values[i]) > smallExcess && worse ? i : worst;
    }
    if (worst < 0)
    {
        return "";
    }
    std::ostringstream text;
    text << values[worst] << " at " << textOf(alpha.mesh().cellCentres()[worst]);
    return text.str();
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

// A solver that leaves [0, 1] in a few cells must not end the analysis.
scalarField MeshSnapshots::clipped(const volScalarField& alpha)
{
    scalarField values(alpha.primitiveField());
    const label nCells = messages_.total(values.size());
    const label nFar = messages_.total(nBeyond(values, largeExcess));
    if (nFar == 0 && toldClipped_)
    {
        clip(values);
        return values;
    }
    const label nOutside = messages_.total(nBeyond(values, smallExcess));
    if (nOutside == 0)
    {
        clip(values);
        return values;
    }
    const std::string place(messages_.firstNonEmpty(worst(alpha)));
    std::ostringstream found;
    found << "Field " << alpha.name() << " at time " << alpha.time().timeName();
    if (nFar > largestShare * nCells)
    {
        found << ": the volume fraction of " << nFar << " of " << nCells
              << " cells is outside [0, 1] by more than " << largeExcess << ", such as "
              << place << "; allowed is that in " << 100 * largestShare
              << " % of the cells, which are clipped.";
        throw BadInput(found.str());
    }
    if (!toldClipped_)
    {
        toldClipped_ = true;
        Info << "interfaceStability: " << found.str().c_str()
             << " is outside [0, 1] by "
             << "more than " << smallExcess << " in " << nOutside << " cells, such as "
             << place.c_str() << ": it is clipped. Told once." << nl << endl;
    }
    clip(values);
    return values;
}

std::shared_ptr<FlowSnapshot> MeshSnapshots::take(
    const volScalarField& alpha, const volVectorField& U, scalar time,
    const FaceFluxes* phi
)
{
    const CellComplex& complex = *cells_.complex();
    auto snapshot = std::make_shared<FlowSnapshot>();
    snapshot->complex = cells_.complex();
    snapshot->time = time;
    snapshot->alphas.setSize(1, cells_.cellValues(clipped(alpha)));
    snapshot->boundaryAlphas.setSize(1, cells_.boundaryValues(boundaryValues(alpha)));
    clip(snapshot->boundaryAlphas[0]);
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
            snapshot->U = (*fluxVelocity_)(cells_.fluxes(phi->values));
        }
        snapshot->check();
    }
    catch (const std::exception& bad)
    {
        failure = "Fields " + alpha.name() + (phi ? ", " + phi->name : "") + " and "
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
