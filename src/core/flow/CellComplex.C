// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

#include "core/flow/CellComplex.H"

#include "core/Errors.H"

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

// The points of a face from the lowest towards the lower of its neighbours. Says
// whether that is against the direction of the face.
bool inCanonicalDirection(const face& f, DynamicList<label>& points)
{
    const label n = f.size();
    const label first = std::min_element(f.begin(), f.end()) - f.begin();
    const bool reversed = f[f.rcIndex(first)] < f[f.fcIndex(first)];
    points.setSize(n);
    for (label k = 0; k < n; ++k)
    {
        points[k] = f[(reversed ? first - k + n : first + k) % n];
    }
    return reversed;
}

// Area-weighted centre and area vector of a polygon: triangles around the mean of
// its points, as OpenFOAM's primitiveMesh. To the last bit the same from both sides.
void faceGeometry(const face& f, const pointField& points, point& centre, vector& area)
{
    DynamicList<label, 16> ring;
    const bool reversed = inCanonicalDirection(f, ring);
    point mean(Zero);
    for (const label pointi : ring)
    {
        mean += points[pointi];
    }
    mean /= ring.size();

    vector sum(Zero);
    const auto corner = [&](label i) -> const point&
    { return points[ring[i % ring.size()]]; };
    for (label i = 0; i < ring.size(); ++i)
    {
        sum += 0.5 * ((corner(i) - mean) ^ (corner(i + 1) - mean));
    }
    area = reversed ? -sum : sum;

    const vector direction = sum / max(mag(sum), VSMALL);
    scalar weight = 0;
    vector moment(Zero);
    for (label i = 0; i < ring.size(); ++i)
    {
        const point& a = corner(i);
        const point& b = corner(i + 1);
        const scalar part = 0.5 * (((a - mean) ^ (b - mean)) & direction);
        weight += part;
        moment += part * (a + b - 2 * mean) / 3;
    }
    centre = weight > VSMALL ? mean + moment / weight : mean;
}

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

scalar shareOfTetrahedra(const Rows& cellFaces)
{
    label n = 0;
    for (label celli = 0; celli < cellFaces.size(); ++celli)
    {
        n += cellFaces[celli].size() == 4;
    }
    return scalar(n) / cellFaces.size();
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
        mesh.owner.empty() ? 0 : max(mesh.owner) + 1,
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

CellComplex::CellComplex(CellComplexInput input) : input_(std::move(input))
{
    if (input_.owner.empty())
    {
        throw BadInput("The mesh has no cells: nothing can be analysed on it.");
    }
    computeAddressing();
    computeFaces();
    computeCells();
    chooseTetBases();
    binCells();
    countRings();
    forAll(input_.globalCells, celli)
    {
        localCells_.insert(input_.globalCells[celli], celli);
    }
    if (!input_.whole)
    {
        input_.whole.emplace();
        input_.whole->bounds = bounds_;
        input_.whole->tetrahedra = shareOfTetrahedra(cellFaces_);
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
    const label nCells = max(input_.owner) + 1;
    cellCentres_.setSize(nCells);

    cellFaces_ = facesOfCells(input_);

    pointNeighbours_ = LazyLists(nCells);
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

    nearWall_.setSize(nCells, false);
    atRim_.setSize(nCells, false);
    pointBoundaryFaces_ = Rows(
        nPoints(),
        [&](const auto& add)
        {
            for (label facei = nInternalFaces(); facei < nFaces(); ++facei)
            {
                if (kinds()[facei - nInternalFaces()] != BoundaryKind::beyond)
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
        else if (kinds()[i] == BoundaryKind::beyond)
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
    }
}

void CellComplex::computeCells()
{
    cellVolumes_.setSize(nCells());
    cellSizes_.setSize(nCells());
    for (label celli = 0; celli < nCells(); ++celli)
    {
        const auto& cellFaces = cellFaces_[celli];
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
        cellSizes_[celli] = std::cbrt(volume);
        cellCentres_[celli] = estimate + moment / volume;
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

namespace
{

// The bin of a position along each direction of a grid over a box.
Vector<label> binOf(const point& x, const boundBox& box, const Vector<label>& n)
{
    Vector<label> bin(0, 0, 0);
    for (direction d = 0; d < 3; ++d)
    {
        const scalar length = max(box.span()[d], VSMALL);
        const scalar position = (x[d] - box.min()[d]) / length;
        bin[d] = label(max(scalar(0), min(position, scalar(1))) * n[d]);
        bin[d] = min(bin[d], n[d] - 1);
    }
    return bin;
}

} // namespace

void CellComplex::binCells()
{
    bounds_ = boundBox(points(), false);
    const scalar volume = max(sum(cellVolumes_), VSMALL);
    const scalar spacing = 2 * std::cbrt(volume / nCells());
    for (direction d = 0; d < 3; ++d)
    {
        nBins_[d] = max(label(1), min(label(256), label(bounds_.span()[d] / spacing)));
    }

    const auto visit = [&](const auto& add)
    {
        for (label celli = 0; celli < nCells(); ++celli)
        {
            boundBox box;
            for (const label facei : cellFaces_[celli])
            {
                for (const label pointi : faces()[facei])
                {
                    box.add(points()[pointi]);
                }
            }
            const Vector<label> low = binOf(box.min(), bounds_, nBins_);
            const Vector<label> high = binOf(box.max(), bounds_, nBins_);
            for (label k = low.z(); k <= high.z(); ++k)
            {
                for (label j = low.y(); j <= high.y(); ++j)
                {
                    for (label i = low.x(); i <= high.x(); ++i)
                    {
                        add(i + nBins_.x() * (j + nBins_.y() * k), celli);
                    }
                }
            }
        }
    };
    bins_ = Rows(nBins_.x() * nBins_.y() * nBins_.z(), visit);
}

label CellComplex::findCell(const point& x) const
{
    const Vector<label> bin = binOf(x, bounds_, nBins_);
    for (const label celli : bins_[binIndex(bin)])
    {
        if (holds(celli, x))
        {
            return celli;
        }
    }
    // Ring by ring of bins; one more than the first that has cells.
    label nearest = -1;
    label last = nBins_.x() + nBins_.y() + nBins_.z();
    for (label ring = 0; ring <= last; ++ring)
    {
        const label found = nearestInRing(x, bin, ring);
        if (found >= 0)
        {
            last = nearest < 0 ? ring + 1 : last;
            const bool nearer =
                nearest < 0
                || magSqr(x - cellCentres_[found]) < magSqr(x - cellCentres_[nearest]);
            nearest = nearer ? found : nearest;
        }
    }
    return nearest;
}

label CellComplex::binIndex(const Vector<label>& bin) const
{
    return bin.x() + nBins_.x() * (bin.y() + nBins_.y() * bin.z());
}

// The cell with the nearest centre in the bins at this Chebyshev distance.
label CellComplex::nearestInRing(const point& x, const Vector<label>& bin, label ring)
    const
{
    Vector<label> low, high;
    for (direction d = 0; d < 3; ++d)
    {
        low[d] = max(label(0), bin[d] - ring);
        high[d] = min(nBins_[d] - 1, bin[d] + ring);
    }
    label nearest = -1;
    Vector<label> b;
    for (b.z() = low.z(); b.z() <= high.z(); ++b.z())
    {
        for (b.y() = low.y(); b.y() <= high.y(); ++b.y())
        {
            for (b.x() = low.x(); b.x() <= high.x(); ++b.x())
            {
                if (cmptMax(cmptMag(b - bin)) != ring)
                {
                    continue;
                }
                for (const label celli : bins_[binIndex(b)])
                {
                    if (nearest < 0
                        || magSqr(x - cellCentres_[celli])
                               < magSqr(x - cellCentres_[nearest]))
                    {
                        nearest = celli;
                    }
                }
            }
        }
    }
    return nearest;
}

} // namespace Foam::stability
