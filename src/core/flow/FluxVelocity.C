// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

#include "core/flow/FluxVelocity.H"

#include "core/Errors.H"
#include "symmTensor.H"

#include <cmath>
#include <string>

namespace Foam::stability
{

namespace
{

void check(const CellComplex& complex, const scalarField& fluxes)
{
    if (fluxes.size() != complex.nFaces())
    {
        throw BadInput(
            "The flux has " + std::to_string(fluxes.size()) + " values, the mesh has "
            + std::to_string(complex.nFaces()) + " faces."
        );
    }
    forAll(fluxes, facei)
    {
        if (!std::isfinite(fluxes[facei]))
        {
            throw BadInput(
                "The flux is not finite at " + textOf(complex.faceCentres()[facei])
                + "."
            );
        }
    }
}

// The velocity U that minimises the sum of (U & Sf - phi)^2/|Sf| over these faces. A
// face that is seen from its other side changes neither sum.
vector
bestFit(const UList<label>& faces, const vectorField& areas, const scalarField& fluxes)
{
    symmTensor matrix(Zero); // [m2], sum of Sf Sf/|Sf|
    vector side(Zero);       // [m3/s], sum of Sf/|Sf| phi
    for (const label facei : faces)
    {
        const scalar size = mag(areas[facei]);
        if (size > VSMALL)
        {
            const vector normal = areas[facei] / size;
            matrix += size * sqr(normal);
            side += fluxes[facei] * normal;
        }
    }
    return inv(matrix) & side;
}

} // namespace

vectorField fluxVelocity(const CellComplex& complex, const scalarField& fluxes)
{
    check(complex, fluxes);
    vectorField U(complex.nCells());
    forAll(U, celli)
    {
        U[celli] = bestFit(complex.cellFaces()[celli], complex.faceAreas(), fluxes);
    }
    return U;
}

} // namespace Foam::stability
