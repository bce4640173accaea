// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/reconstruction/sharpening/FaceSmoothing.H"

#include <cmath>

namespace Foam::stability
{

namespace
{

// The faces of a cell across which there may be a neighbour: in two dimensions without
// those in the planes of the section.
label nSides(const CellComplex& complex, label celli)
{
    return complex.cellFaces()[celli].size() - (complex.whole().section ? 2 : 0);
}

} // namespace

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
        sums[celli] = alpha[celli] + 0.5 * sums[celli] / nSides(complex, celli);
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
    const label nDimensions = complex.whole().section ? 2 : 3;
    const scalar neighbours = 0.5 * squares / nSides(complex, celli) / nDimensions;
    return sqr(complex.cellSizes()[celli] / std::cbrt(frame.volume)) / 12 + neighbours;
}

} // namespace Foam::stability
