// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/reconstruction/volumeFit/ComponentCells.H"

namespace Foam::stability
{

std::vector<char>
markRings(const CellComplex& complex, std::vector<label> cells, label nRings)
{
    std::vector<char> marks(complex.nCells(), 0);
    for (const label celli : cells)
    {
        marks[celli] = 1;
    }
    std::vector<label> next;
    for (label ring = 0; ring < nRings; ++ring)
    {
        next.clear();
        for (const label celli : cells)
        {
            for (const label other : complex.pointNeighbours(celli))
            {
                if (!marks[other])
                {
                    marks[other] = 1;
                    next.push_back(other);
                }
            }
        }
        cells.swap(next);
    }
    return marks;
}

ComponentCells::ComponentCells(const InterfaceMesh& mesh, const CellComplex& complex)
    : mesh_(mesh), complex_(complex), marks_(complex.nCells(), 0),
      visits_(complex.nCells(), -1)
{
}

const std::vector<label>& ComponentCells::of(const SurfaceComponent& component)
{
    ++component_;
    cells_.clear();
    for (const label trianglei : component.triangles)
    {
        addCellsOf(trianglei);
    }
    return cells_;
}

void ComponentCells::addCellsOf(label trianglei)
{
    triangle_ = trianglei;
    front_.clear();
    boundBox box;
    for (const label pointi : mesh_.triangles[trianglei])
    {
        box.add(mesh_.points[pointi]);
        visit(mesh_.cells[pointi]);
    }
    for (std::size_t i = 0; i < front_.size(); ++i)
    {
        const label celli = front_[i];
        if (boundsOf(complex_, celli).overlaps(box))
        {
            if (marks_[celli] != component_)
            {
                marks_[celli] = component_;
                cells_.push_back(celli);
            }
            visitAround(celli);
        }
    }
}

void ComponentCells::visit(label celli)
{
    if (visits_[celli] != triangle_)
    {
        visits_[celli] = triangle_;
        front_.push_back(celli);
    }
}

// The cells that share a point with this one.
void ComponentCells::visitAround(label celli)
{
    for (const label facei : complex_.cellFaces()[celli])
    {
        for (const label pointi : complex_.faces()[facei])
        {
            for (const label other : complex_.pointCells()[pointi])
            {
                visit(other);
            }
        }
    }
}

} // namespace Foam::stability
