// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

#include "core/reconstruction/CellStencil.H"

#include "symmTensor.H"
#include "tensor.H"

#include <algorithm>
#include <cmath>

namespace Foam::stability
{

PointNeighbours::PointNeighbours(
    const CellComplex& complex, const std::vector<label>& seeds, label nRings,
    label nThreads
)
    : complex_(complex), cells_(seeds), rows_(complex.nCells(), -1)
{
    for (std::size_t i = 0; i < cells_.size(); ++i)
    {
        rows_[cells_[i]] = i;
    }
    std::size_t begin = 0;
    for (label ring = 0; ring <= nRings; ++ring)
    {
        const std::size_t end = cells_.size();
        list(begin, nThreads);
        for (; begin < end && ring < nRings; ++begin)
        {
            for (const label other : lists_[begin])
            {
                if (rows_[other] < 0)
                {
                    rows_[other] = cells_.size();
                    cells_.push_back(other);
                }
            }
        }
    }
}

void PointNeighbours::list(std::size_t begin, label nThreads)
{
    lists_.resize(cells_.size());
#pragma omp parallel for schedule(dynamic, 256) num_threads(nThreads)
    for (std::size_t i = begin; i < cells_.size(); ++i)
    {
        std::vector<label>& around = lists_[i];
        static thread_local std::vector<label> points;
        points.clear();
        for (const label facei : complex_.cellFaces()[cells_[i]])
        {
            const face& f = complex_.faces()[facei];
            points.insert(points.end(), f.begin(), f.end());
        }
        std::sort(points.begin(), points.end());
        points.erase(std::unique(points.begin(), points.end()), points.end());
        for (const label pointi : points)
        {
            const UList<label> cells = complex_.pointCells()[pointi];
            around.insert(around.end(), cells.begin(), cells.end());
        }
        std::sort(around.begin(), around.end());
        around.erase(std::unique(around.begin(), around.end()), around.end());
    }
}

const std::vector<label>& CellStencil::rings(label celli, label nRings)
{
    if (++present_ == 0)
    {
        std::fill(marks_.begin(), marks_.end(), 0);
        present_ = 1;
    }
    cells_.assign(1, celli);
    marks_[celli] = present_;
    std::size_t begin = 0;
    for (label ring = 0; ring < nRings; ++ring)
    {
        const std::size_t end = cells_.size();
        for (; begin < end; ++begin)
        {
            for (const label other : neighbours_.of(cells_[begin]))
            {
                if (marks_[other] != present_)
                {
                    marks_[other] = present_;
                    cells_.push_back(other);
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
    scalar farthest = 0;
    for (const label facei : complex.cellFaces()[celli])
    {
        for (const label pointi : complex.faces()[facei])
        {
            farthest = std::max(
                farthest,
                magSqr(complex.points()[pointi] - complex.cellCentres()[celli])
            );
        }
    }
    return 2 * std::sqrt(farthest / 3);
}

vector gradientOver(
    const CellComplex& complex, const std::vector<label>& cells,
    const scalarField& values, scalar span
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
