// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/cells/CellComplex.H"

#include "core/base/Errors.H"
#include "core/cells/FaceGeometry.H"

#include "DynamicList.H"
#include "FixedList.H"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace Foam::stability
{

namespace
{

// Volume of a tetrahedron over the cube of its longest edge at `apex`: 0 if flat,
// negative if the triangle is seen from behind.
scalar tetQuality(const point& apex, const point& a, const point& b, const point& c)
{
    const vector da = a - apex;
    const vector db = b - apex;
    const vector dc = c - apex;
    const scalar longest = std::sqrt(max(max(magSqr(da), magSqr(db)), magSqr(dc)));
    return ((da ^ db) & dc) / max(pow3(longest), VSMALL);
}

} // namespace

Rows facesOfCells(const CellComplexInput& mesh)
{
    using Key = FixedList<label, 3>; // the lowest points
    std::vector<std::pair<Key, label>> order;
    order.reserve(mesh.faces.size());
    forAll(mesh.faces, facei)
    {
        labelList points(mesh.faces[facei]);
        std::partial_sort(points.begin(), points.begin() + 3, points.end());
        order.push_back({Key{points[0], points[1], points[2]}, facei});
    }
    std::sort(order.begin(), order.end());
    return Rows(
        mesh.nCells,
        [&](const auto& add)
        {
            for (const auto& [key, facei] : order)
            {
                add(mesh.owner[facei], facei);
                if (facei < mesh.neighbour.size())
                {
                    add(mesh.neighbour[facei], facei);
                }
            }
        }
    );
}

boundBox boundsOf(const CellComplexInput& mesh)
{
    boundBox bounds;
    for (const face& f : mesh.faces)
    {
        for (const label pointi : f)
        {
            bounds.add(mesh.points[pointi]);
        }
    }
    return bounds;
}

CellComplex::CellComplex(CellComplexInput input) : input_(std::move(input))
{
    if (input_.nCells == 0 && !(input_.whole && input_.whole->nCells() > 0))
    {
        throw BadInput("The mesh has no cells: nothing can be analysed on it.");
    }
    bounds_ = boundsOf(input_);
    if (!input_.whole)
    {
        input_.whole.emplace();
        input_.whole->bounds = bounds_;
    }
    computeAddressing();
    computeFaces();
    computeCells();
    chooseTetBases();
    bins_ = CellBins(*this);
    countRings();
    forAll(input_.globalCells, celli)
    {
        localCells_.insert(input_.globalCells[celli], celli);
    }
}

void CellComplex::countRings()
{
    if (input_.own.empty())
    {
        return;
    }
    rings_ = labelList(nCells(), labelMax);
    DynamicList<label> front, next;
    forAll(rings_, celli)
    {
        if (input_.own[celli])
        {
            rings_[celli] = 0;
            front.append(celli);
        }
    }
    List<bool> met(nPoints(), false);
    for (label ring = 1; !front.empty(); ++ring)
    {
        next.clear();
        for (const label celli : front)
        {
            for (const label facei : cellFaces_[celli])
            {
                for (const label pointi : input_.faces[facei])
                {
                    if (met[pointi])
                    {
                        continue;
                    }
                    met[pointi] = true;
                    for (const label other : pointCells_[pointi])
                    {
                        if (rings_[other] == labelMax)
                        {
                            rings_[other] = ring;
                            next.append(other);
                        }
                    }
                }
            }
        }
        front = next;
    }
}

labelList CellComplex::cellsAround(label celli) const
{
    DynamicList<label> points, cells;
    for (const label facei : cellFaces_[celli])
    {
        points.append(input_.faces[facei]);
    }
    const auto sortUnique = [](DynamicList<label>& list)
    {
        std::sort(list.begin(), list.end());
        list.setSize(label(std::unique(list.begin(), list.end()) - list.begin()));
    };
    sortUnique(points);
    for (const label pointi : points)
    {
        cells.append(pointCells_[pointi]);
    }
    sortUnique(cells);
    return labelList(std::move(cells));
}

void CellComplex::computeAddressing()
{
    const label nCells = input_.nCells;
    cellCentres_.setSize(nCells);

    cellFaces_ = facesOfCells(input_);

    pointNeighbours_ = LazyValues<labelList>(nCells);
    pointCells_ = Rows(
        nPoints(),
        [&](const auto& add)
        {
            labelList lastCell(nPoints(), -1);
            for (label celli = 0; celli < nCells; ++celli)
            {
                for (const label facei : cellFaces_[celli])
                {
                    for (const label pointi : faces()[facei])
                    {
                        if (lastCell[pointi] != celli)
                        {
                            lastCell[pointi] = celli;
                            add(pointi, celli);
                        }
                    }
                }
            }
        }
    );
    addressBoundary();
}

void CellComplex::addressBoundary()
{
    nearWall_.setSize(nCells(), false);
    atRim_.setSize(nCells(), false);
    pointBoundaryFaces_ = Rows(
        nPoints(),
        [&](const auto& add)
        {
            for (label facei = nInternalFaces(); facei < nFaces(); ++facei)
            {
                if (kinds()[facei - nInternalFaces()] != BoundaryKind::coupledUnknown
                    && !isEnd(facei))
                {
                    for (const label pointi : faces()[facei])
                    {
                        add(pointi, facei);
                    }
                }
            }
        }
    );
    for (label i = 0; i < nBoundaryFaces(); ++i)
    {
        if (kinds()[i] == BoundaryKind::wall)
        {
            nearWall_[owner()[nInternalFaces() + i]] = true;
        }
        else if (kinds()[i] == BoundaryKind::coupledUnknown)
        {
            for (const label pointi : faces()[nInternalFaces() + i])
            {
                for (const label celli : pointCells_[pointi])
                {
                    atRim_[celli] = true;
                }
            }
        }
    }
}

void CellComplex::computeFaces()
{
    faceCentres_.setSize(nFaces());
    faceAreas_.setSize(nFaces());
    for (label facei = 0; facei < nFaces(); ++facei)
    {
        faceGeometry(faces()[facei], points(), faceCentres_[facei], faceAreas_[facei]);
        faceCentres_[facei] =
            isEnd(facei) ? faceCentres_[facei] : whole().inMiddle(faceCentres_[facei]);
    }
}

void CellComplex::computeCells()
{
    cellVolumes_.setSize(nCells());
    cellSizes_.setSize(nCells());
    const std::optional<PlaneSection>& section = whole().section;
    for (label celli = 0; celli < nCells(); ++celli)
    {
        const auto& cellFaces = cellFaces_[celli];
        if (cellFaces.size() < 4)
        {
            throw NumericalFailure(
                "Cell " + std::to_string(globalCell(celli)) + " of the mesh has "
                + std::to_string(cellFaces.size())
                + " faces, but a cell has at least 4: run checkMesh."
            );
        }
        point estimate(Zero);
        for (const label facei : cellFaces)
        {
            estimate += faceCentres_[facei];
        }
        estimate /= cellFaces.size();

        scalar volume = 0;
        vector moment(Zero);
        for (const label facei : cellFaces)
        {
            const vector outward =
                owner()[facei] == celli ? faceAreas_[facei] : -faceAreas_[facei];
            const vector arm = faceCentres_[facei] - estimate;
            const scalar pyramid = (outward & arm) / 3;
            volume += pyramid;
            moment += pyramid * 0.75 * arm;
        }
        if (!(volume > VSMALL))
        {
            throw NumericalFailure(
                "The cell of the mesh around " + textOf(estimate) + " has the volume "
                + std::to_string(volume) + " m3: run checkMesh."
            );
        }
        cellVolumes_[celli] = volume;
        cellSizes_[celli] =
            section ? std::sqrt(volume / section->thickness) : std::cbrt(volume);
        cellCentres_[celli] = whole().inMiddle(estimate + moment / volume);
    }
}

void CellComplex::chooseTetBases()
{
    tetBase_.setSize(nFaces(), 0);
    for (label facei = 0; facei < nFaces(); ++facei)
    {
        const face& f = faces()[facei];
        scalar best = -GREAT;
        for (label base = 0; f.size() > 3 && base < f.size(); ++base)
        {
            scalar worst = GREAT;
            for (label k = 1; k + 1 < f.size(); ++k)
            {
                const point& a = points()[f[base]];
                const point& b = points()[f[(base + k) % f.size()]];
                const point& c = points()[f[(base + k + 1) % f.size()]];
                worst = min(worst, tetQuality(cellCentres_[owner()[facei]], a, b, c));
                if (facei < nInternalFaces())
                {
                    const point& other = cellCentres_[neighbour()[facei]];
                    worst = min(worst, tetQuality(other, a, c, b));
                }
            }
            // A later point must be clearly better, so that round-off decides nothing.
            if (worst > best + 1e-6)
            {
                best = worst;
                tetBase_[facei] = base;
            }
        }
    }
}

bool CellComplex::holds(label celli, const point& x) const
{
    for (const label facei : cellFaces_[celli])
    {
        const scalar side = (x - faceCentres_[facei]) & faceAreas_[facei];
        if ((owner()[facei] == celli ? side : -side) > 0)
        {
            return false;
        }
    }
    return true;
}

} // namespace Foam::stability
