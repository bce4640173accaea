// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/cells/CellNeeds.H"

#include <algorithm>

namespace Foam::stability
{

CellNeeds::CellNeeds(
    const CellComplexInput& own, const Rows& cellFaces, const FetchReach& reach
)
    : reach_(reach), reaches_(own, cellFaces, reach.cells, reach.across)
{
    forAll(own.kinds, i)
    {
        if (own.kinds[i] == BoundaryKind::coupledUnknown)
        {
            for (const label pointi : own.faces[own.neighbour.size() + i])
            {
                ofPoints_.set(own.globalPoints[pointi], reach.nRings);
            }
        }
    }
}

label CellNeeds::needAround(const Cell& cell) const
{
    label most = 0;
    for (std::size_t i = cell.begin; i < cell.end; ++i)
    {
        most = std::max(most, at(points_[i]));
    }
    return std::max(most - 1, label(0));
}

label CellNeeds::needByReach(
    const CellBlock& block, const Map<label>& places, const Cell& cell, label nFaces
) const
{
    List<point> points(label(cell.end - cell.begin));
    forAll(points, i)
    {
        points[i] = block.points[places[points_[cell.begin + i]]];
    }
    switch (reaches_.of(points, nFaces))
    {
    case CellReaches::Nearness::near:
        return reach_.stencil;
    case CellReaches::Nearness::onTheWay:
        return 1;
    default:
        return 0;
    }
}

void CellNeeds::raise(Cell& cell, label need)
{
    cell.need = need;
    for (std::size_t i = cell.begin; i < cell.end; ++i)
    {
        label& known = ofPoints_(points_[i], 0);
        known = std::max(known, need);
    }
}

void CellNeeds::add(const CellBlock& block)
{
    Map<label> places(2 * block.pointIds.size());
    forAll(block.pointIds, i)
    {
        places.insert(block.pointIds[i], i);
    }
    label facei = 0;
    forAll(block.cells, i)
    {
        const std::size_t begin = points_.size();
        for (const label end = facei + block.nFaces[i]; facei < end; ++facei)
        {
            const face& f = block.faces[facei];
            points_.insert(points_.end(), f.begin(), f.end());
        }
        std::sort(points_.begin() + begin, points_.end());
        points_.erase(
            std::unique(points_.begin() + begin, points_.end()), points_.end()
        );
        Cell cell{begin, points_.size(), 0};
        const label around = needAround(cell);
        label need = around;
        if (need < reach_.stencil)
        {
            need = std::max(need, needByReach(block, places, cell, block.nFaces[i]));
        }
        raised_ = raised_ || need > around;
        raise(cell, need);
        cells_.push_back(cell);
    }
}

void CellNeeds::spread()
{
    while (raised_)
    {
        raised_ = false;
        for (Cell& cell : cells_)
        {
            const label around = needAround(cell);
            if (around > cell.need)
            {
                raised_ = true;
                raise(cell, around);
            }
        }
    }
}

} // namespace Foam::stability
