// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/flow/FluxVelocity.H"

#include "core/base/Errors.H"

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

} // namespace

// U minimises the sum of (U & Sf - phi)^2/|Sf| over the faces of a cell. A face that is
// seen from its other side changes nothing.
FluxVelocity::FluxVelocity(const CellComplex& complex)
    : complex_(complex), normals_(complex.nFaces(), Zero),
      inverses_(complex.nCells(), symmTensor(Zero))
{
    scalarField sizes(mag(complex.faceAreas()));
    forAll(normals_, facei)
    {
        if (sizes[facei] > VSMALL)
        {
            normals_[facei] = complex.faceAreas()[facei] / sizes[facei];
        }
    }
    forAll(inverses_, celli)
    {
        if (complex.own(celli))
        {
            symmTensor matrix(Zero); // [m2], sum of Sf Sf/|Sf|
            for (const label facei : complex.cellFaces()[celli])
            {
                matrix += sizes[facei] * sqr(normals_[facei]);
            }
            inverses_[celli] = inv(matrix);
        }
    }
}

vectorField FluxVelocity::operator()(const scalarField& fluxes) const
{
    check(complex_, fluxes);
    vectorField U(complex_.nCells(), Zero);
    forAll(U, celli)
    {
        if (complex_.own(celli))
        {
            vector side(Zero); // [m3/s], sum of Sf/|Sf| phi
            for (const label facei : complex_.cellFaces()[celli])
            {
                side += fluxes[facei] * normals_[facei];
            }
            U[celli] = inverses_[celli] & side;
        }
    }
    return U;
}

} // namespace Foam::stability
