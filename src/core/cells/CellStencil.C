// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/cells/CellStencil.H"

#include "symmTensor.H"
#include "tensor.H"

#include <algorithm>
#include <cmath>

namespace Foam::stability
{

const UList<label>& CellStencil::rings(const UList<label>& seeds, label nRings)
{
    if (++present_ == 0)
    {
        std::fill(marks_.begin(), marks_.end(), 0);
        present_ = 1;
    }
    cells_ = seeds;
    for (const label celli : seeds)
    {
        marks_[celli] = present_;
    }
    label begin = 0;
    for (label ring = 0; ring < nRings; ++ring)
    {
        const label end = cells_.size();
        for (; begin < end; ++begin)
        {
            for (const label other : complex_.pointNeighbours(cells_[begin]))
            {
                if (marks_[other] != present_)
                {
                    marks_[other] = present_;
                    cells_.append(other);
                }
            }
        }
    }
    return cells_;
}

bool touchesBoundary(const CellComplex& complex, label celli)
{
    for (const label facei : complex.cellFaces()[celli])
    {
        for (const label pointi : complex.faces()[facei])
        {
            if (!complex.pointBoundaryFaces()[pointi].empty())
            {
                return true;
            }
        }
    }
    return false;
}

scalar spanOf(const CellComplex& complex, label celli)
{
    const WholeMesh& whole = complex.whole();
    scalar farthest = 0;
    for (const label facei : complex.cellFaces()[celli])
    {
        for (const label pointi : complex.faces()[facei])
        {
            farthest = std::max(
                farthest, magSqr(whole.inPlane(
                              complex.points()[pointi] - complex.cellCentres()[celli]
                          ))
            );
        }
    }
    return 2 * std::sqrt(farthest / (whole.section ? 2 : 3));
}

vector gradientOver(
    const CellComplex& complex, const UList<label>& cells, const scalarField& values,
    scalar span
)
{
    const point& origin = complex.cellCentres()[cells[0]];
    vector meanX(Zero);
    scalar meanValue = 0;
    for (const label celli : cells)
    {
        meanX += complex.cellCentres()[celli] - origin;
        meanValue += values[celli];
    }
    meanX /= cells.size();
    meanValue /= cells.size();
    symmTensor matrix(Zero);
    vector moment(Zero);
    for (const label celli : cells)
    {
        const vector d = (complex.cellCentres()[celli] - origin - meanX) / span;
        matrix += sqr(d);
        moment += (values[celli] - meanValue) * d;
    }
    matrix += 1e-6 * symmTensor(I);
    return (inv(matrix) & moment) / span;
}

} // namespace Foam::stability
