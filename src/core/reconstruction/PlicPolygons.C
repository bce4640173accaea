// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/reconstruction/PlicPolygons.H"
#include "core/cells/CellPlacement.H"
#include "core/reconstruction/InterfaceOrder.H"
#include "core/reconstruction/sharpening/PlicFits.H"
#include "core/reconstruction/sharpening/SectionShape.H"
#include "DynamicList.H"

#include <algorithm>
#include <vector>

namespace Foam::stability
{

namespace
{

using Polygon = std::vector<point>; // right-handed normal into the second material

// Corners that coincide come from planes through points of the cell.
void dropRepeated(Polygon& polygon, scalar tolerance)
{
    const auto end = std::unique(
        polygon.begin(), polygon.end(),
        [&](const point& a, const point& b) { return mag(a - b) < tolerance; }
    );
    polygon.erase(end, polygon.end());
    while (polygon.size() > 1 && mag(polygon.front() - polygon.back()) < tolerance)
    {
        polygon.pop_back();
    }
}

// [m2], twice the area.
vector twiceArea(const Polygon& polygon)
{
    vector total(Zero);
    for (std::size_t i = 2; i < polygon.size(); ++i)
    {
        total += (polygon[i - 1] - polygon[0]) ^ (polygon[i] - polygon[0]);
    }
    return total;
}

point centroid(const Polygon& polygon)
{
    const vector total = twiceArea(polygon);
    const vector n = total / max(mag(total), VSMALL);
    vector moment(Zero);
    for (std::size_t i = 2; i < polygon.size(); ++i)
    {
        const vector a = polygon[i - 1] - polygon[0], b = polygon[i] - polygon[0];
        moment += ((a ^ b) & n) * (a + b) / 3;
    }
    return polygon[0] + moment / max(mag(total), VSMALL);
}

class PolygonSoup
{
public:
    explicit PolygonSoup(const CellComplex& complex) : complex_(complex) {}

    // False where nothing is left of it.
    bool add(label celli, Polygon polygon)
    {
        constexpr scalar same = 1e-8; // in cells
        dropRepeated(polygon, same * complex_.cellSizes()[celli]);
        if (polygon.size() < 3)
        {
            return false;
        }
        if (complex_.whole().section)
        {
            return addStrip(celli, polygon);
        }
        const label first = points_.size();
        const label n = polygon.size();
        for (const point& x : polygon)
        {
            addPoint(celli, x);
        }
        if (n == 3)
        {
            addTriangle(celli, triFace(first, first + 1, first + 2));
            return true;
        }
        addPoint(celli, centroid(polygon));
        for (label k = 0; k < n; ++k)
        {
            addTriangle(celli, triFace(first + n, first + k, first + (k + 1) % n));
        }
        return true;
    }

    InterfaceMesh takeMesh()
    {
        InterfaceMesh mesh;
        mesh.points.transfer(points_);
        mesh.triangles.transfer(triangles_);
        mesh.triangleCells.transfer(triangleCells_);
        mesh.cells.transfer(cells_);
        mesh.boundaryFaces.transfer(boundaryFaces_);
        mesh.cellSizes = scalarField(complex_.cellSizes(), mesh.cells);
        mesh.clearParametrization();
        return mesh;
    }

private:
    // In two dimensions: a rectangle across the section.
    bool addStrip(label celli, const Polygon& polygon)
    {
        const PlaneSection& section = *complex_.whole().section;
        const label n = polygon.size();
        for (label k = 0; k < n; ++k)
        {
            const point &a = polygon[k], &b = polygon[(k + 1) % n];
            if (section.isLow(a) && section.isLow(b))
            {
                const label first = points_.size();
                addPoint(celli, section.inLow(a));
                addPoint(celli, section.inLow(b));
                addPoint(celli, section.inHigh(b));
                addPoint(celli, section.inHigh(a));
                addTriangle(celli, triFace(first, first + 1, first + 2));
                addTriangle(celli, triFace(first, first + 2, first + 3));
                return true;
            }
        }
        return false;
    }

    void addTriangle(label celli, const triFace& t)
    {
        triangles_.append(t);
        triangleCells_.append(celli);
    }

    void addPoint(label celli, const point& x)
    {
        constexpr scalar onBoundary = 1e-9; // in cells
        const scalar tolerance = onBoundary * complex_.cellSizes()[celli];
        points_.append(x);
        cells_.append(celli);
        boundaryFaces_.append(boundaryFaceAt(complex_, celli, x, tolerance));
    }

    const CellComplex& complex_;
    DynamicList<point> points_;
    DynamicList<triFace> triangles_;
    DynamicList<label> triangleCells_;
    DynamicList<label> cells_;
    DynamicList<label> boundaryFaces_;
};

// The normal of a plane points into the first material.
Polygon polygonOf(const CellComplex& complex, label celli, const PlicPlane& plane)
{
    if (!plane.converged)
    {
        return Polygon();
    }
    Polygon polygon = polygonIn(complex, celli, plane);
    std::reverse(polygon.begin(), polygon.end());
    return polygon;
}

// From the full cell of a face to the empty one: the face itself.
Polygon polygonOn(const CellComplex& complex, label facei, bool ownerIsFull)
{
    Polygon polygon;
    for (const label pointi : complex.faces()[facei])
    {
        polygon.push_back(complex.points()[pointi]);
    }
    if (!ownerIsFull)
    {
        std::reverse(polygon.begin(), polygon.end());
    }
    return polygon;
}

// A face from a nearly full to a nearly empty cell is the interface where the polygons
// of these, projected on it, hide less than half of it: planes cut slivers and wedges
// from such cells, or are not there at all.
class BareFaces
{
public:
    BareFaces(
        const CellComplex& complex, const scalarField& alpha, const PlicFits& plic,
        const std::vector<Polygon>& polygons
    )
        : complex_(complex), alpha_(alpha), areas_(complex.nCells(), Zero)
    {
        for (std::size_t i = 0; i < polygons.size(); ++i)
        {
            areas_[plic.fits[i].cell] = 0.5 * twiceArea(polygons[i]);
        }
    }

    bool holds(label facei) const
    {
        constexpr scalar full = 0.9, empty = 0.1, leastHidden = 0.5;
        const label owner = complex_.owner()[facei];
        const label neighbour = complex_.neighbour()[facei];
        if (max(alpha_[owner], alpha_[neighbour]) <= full
            || min(alpha_[owner], alpha_[neighbour]) >= empty)
        {
            return false;
        }
        const vector& S = complex_.faceAreas()[facei];
        const vector towardsEmpty = ownerIsFull(facei) ? S : -S;
        const scalar hidden = max(areas_[owner] & towardsEmpty, scalar(0))
                              + max(areas_[neighbour] & towardsEmpty, scalar(0));
        return hidden < leastHidden * magSqr(S);
    }

    bool ownerIsFull(label facei) const
    {
        return alpha_[complex_.owner()[facei]] > alpha_[complex_.neighbour()[facei]];
    }

private:
    const CellComplex& complex_;
    const scalarField& alpha_;
    vectorField areas_; // [m2], per cell: of its polygon, into the second material
};

} // namespace

ReconstructionResult PlicPolygons::extract(const FlowSnapshot& snapshot) const
{
    const CellComplex& complex = *snapshot.complex;
    const VolumeFractions fractions(snapshot);
    const PlicFits plic = fitPlic(complex, fractions, options_.nThreads);
    std::vector<Polygon> polygons(plic.nCells);
#pragma omp parallel for schedule(dynamic, 64) num_threads(options_.nThreads)
    for (label i = 0; i < plic.nCells; ++i)
    {
        polygons[i] = polygonOf(complex, plic.fits[i].cell, plic.planes[i]);
    }
    ReconstructionResult result;
    PolygonSoup soup(complex);
    for (label i = 0; i < plic.nCells; ++i)
    {
        const label celli = plic.fits[i].cell;
        result.nFailed += !soup.add(celli, polygons[i]) && complex.own(celli);
    }
    const BareFaces bare(complex, fractions.cells, plic, polygons);
    for (label facei = 0; facei < complex.nInternalFaces(); ++facei)
    {
        if (bare.holds(facei))
        {
            soup.add(
                complex.owner()[facei],
                polygonOn(complex, facei, bare.ownerIsFull(facei))
            );
        }
    }
    result.mesh = soup.takeMesh();
    orderByCells(result.mesh);
    result.alphaVolume = fractions.volume;
    result.volume = fractions.volume;
    return result;
}

} // namespace Foam::stability
