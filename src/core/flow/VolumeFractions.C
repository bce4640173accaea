// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/flow/VolumeFractions.H"
#include "core/base/Errors.H"
#include "core/cells/CanonicalOrder.H"
#include "core/cells/CellFrame.H"
#include "symmTensor.H"
#include "tensor.H"

#include <algorithm>
#include <cmath>
#include <string>

namespace Foam::stability
{

namespace
{

scalarField clamped(const scalarField& alpha)
{
    scalarField result(alpha.size());
    forAll(alpha, i)
    {
        result[i] = VolumeFractions::rounded(min(max(alpha[i], scalar(0)), scalar(1)));
    }
    return result;
}

// Least-squares gradient of alpha over the cells across the faces of a cell [1/m];
// zero along a direction in which the cell has no neighbour.
vector faceGradient(const CellComplex& complex, const scalarField& alpha, label celli)
{
    const CellFrame frame(frameOf(complex, celli));
    symmTensor matrix(Zero);
    vector moment(Zero);
    for (const label facei : complex.cellFaces()[celli])
    {
        if (facei < complex.nInternalFaces())
        {
            const label other = complex.owner()[facei] == celli
                                    ? complex.neighbour()[facei]
                                    : complex.owner()[facei];
            const vector d = frame.local(
                complex.cellCentres()[other] - complex.cellCentres()[celli]
            );
            matrix += sqr(d);
            moment += (alpha[other] - alpha[celli]) * d;
        }
    }
    // A little of the unit matrix: a cell without neighbours along a direction.
    matrix += 1e-6 * symmTensor(I);
    return frame.local(inv(matrix) & moment);
}

// Boundary values; those that are equal to the cell's (zero gradient) are extrapolated
// from the cells: an interface then meets a wall at its own angle, and a film is there
// down to a third of a cell.
scalarField extrapolated(
    const CellComplex& complex, const scalarField& cells, const scalarField& boundary
)
{
    constexpr scalar roundOff = 1e-9;
    scalarField result(boundary);
    forAll(boundary, i)
    {
        const label facei = complex.nInternalFaces() + i;
        const label celli = complex.owner()[facei];
        if (mag(boundary[i] - cells[celli]) < roundOff)
        {
            const vector d =
                complex.faceCentres()[facei] - complex.cellCentres()[celli];
            const scalar value =
                cells[celli] + (faceGradient(complex, cells, celli) & d);
            result[i] = VolumeFractions::rounded(min(max(value, scalar(0)), scalar(1)));
        }
    }
    return result;
}

// Weighted by 1/distance, summed in an order given by position: a start from setFields
// has means of exactly 1/2, which must not depend on the numbering.
template<class Alpha>
scalar meanByDistance(
    const CellComplex& complex, label pointi, const UList<label>& around,
    const pointField& centres, const Alpha& alpha
)
{
    labelList ordered(around);
    std::sort(
        ordered.begin(), ordered.end(),
        [&](label a, label b) { return beforeByPosition(centres[a], centres[b]); }
    );
    scalar sum = 0, weights = 0;
    for (const label i : ordered)
    {
        const scalar distance =
            mag(complex.whole().inPlane(centres[i] - complex.points()[pointi]));
        const scalar weight = 1 / max(distance, VSMALL);
        sum += weight * alpha(i);
        weights += weight;
    }
    return VolumeFractions::rounded(sum / weights);
}

} // namespace

VolumeFractions::VolumeFractions(const FlowSnapshot& snapshot)
{
    const label n = snapshot.alphas.size();
    if (n < 1 || n > 2 || snapshot.boundaryAlphas.size() != n)
    {
        throw BadInput(
            "The reconstruction of interfaces supports two materials, found "
            + std::to_string(n) + " volume fractions."
        );
    }
    cells = clamped(snapshot.alphas[0]);
    boundaryFaces =
        extrapolated(*snapshot.complex, cells, clamped(snapshot.boundaryAlphas[0]));

    const CellComplex& complex = *snapshot.complex;
    forAll(cells, celli)
    {
        if (complex.own(celli))
        {
            volume.add(cells[celli] * complex.volumeInMesh(celli));
        }
    }
}

scalar VolumeFractions::atPoint(const CellComplex& complex, label pointi) const
{
    const UList<label> faces = complex.pointBoundaryFaces()[pointi];
    if (faces.empty())
    {
        return meanByDistance(
            complex, pointi, complex.pointCells()[pointi], complex.cellCentres(),
            [&](label celli) { return cells[celli]; }
        );
    }
    return meanByDistance(
        complex, pointi, faces, complex.faceCentres(),
        [&](label facei) { return boundaryFaces[facei - complex.nInternalFaces()]; }
    );
}

scalar VolumeFractions::rounded(scalar alpha)
{
    return std::round(alpha * 1e12) / 1e12; // 1/2 stays exact
}

} // namespace Foam::stability
