// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/reconstruction/sharpening/FaceSmoothing.H"

#include <cmath>

namespace Foam::stability
{

scalarField smoothedOverFaces(const CellComplex& complex, const scalarField& alpha)
{
    scalarField sums(alpha.size(), 0);
    for (label facei = 0; facei < complex.nInternalFaces(); ++facei)
    {
        const label a = complex.owner()[facei], b = complex.neighbour()[facei];
        sums[a] += alpha[b] - alpha[a];
        sums[b] += alpha[a] - alpha[b];
    }
    forAll(sums, celli)
    {
        sums[celli] =
            alpha[celli] + 0.5 * sums[celli] / complex.cellFaces()[celli].size();
    }
    return sums;
}

scalar smoothedSquare(const CellComplex& complex, label celli, const CellFrame& frame)
{
    scalar squares = 0;
    for (const label facei : complex.cellFaces()[celli])
    {
        if (facei < complex.nInternalFaces())
        {
            const label other = complex.owner()[facei] == celli
                                    ? complex.neighbour()[facei]
                                    : complex.owner()[facei];
            squares += magSqr(
                frame.local(complex.cellCentres()[other] - complex.cellCentres()[celli])
            );
        }
    }
    const scalar neighbours = 0.5 * squares / complex.cellFaces()[celli].size() / 3;
    const scalar share = complex.cellVolumes()[celli] / frame.volume;
    return std::cbrt(sqr(share)) / 12 + neighbours;
}

} // namespace Foam::stability
