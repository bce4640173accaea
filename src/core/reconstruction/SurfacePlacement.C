// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/reconstruction/SurfacePlacement.H"

#include "core/base/Errors.H"
#include "core/cells/CellPlacement.H"
#include "core/cells/CellWalk.H"
#include "core/surface/InterfaceMotion.H"

#include <algorithm>
#include <limits>

namespace Foam::stability
{

namespace
{

// A point of the surface that a rank is asked for.
struct AskedPoint
{
    label number;
    point x;     // [m]
    scalar told; // [m], size of its cell; negative: not told
};

// The cell in which a rank found it.
struct FoundPoint
{
    label number;
    label cell; // global
    scalar cellSize;
    label boundaryFace; // see InterfaceMesh
};

// Finds the cells of points among those that this rank knows.
class Placement
{
public:
    explicit Placement(const CellComplex& complex)
        : complex_(complex), roundOff_(roundOffIn(complex.whole().bounds))
    {
    }

    // [m], of coordinates in single precision.
    static scalar roundOffIn(const boundBox& bounds)
    {
        const scalar largest =
            max(cmptMax(cmptMag(bounds.min())), cmptMax(cmptMag(bounds.max())));
        return std::numeric_limits<float>::epsilon() * largest;
    }

    // Those found; the others may be in cells of other ranks.
    DynamicList<FoundPoint> found(const UList<AskedPoint>& asked)
    {
        DynamicList<FoundPoint> result;
        for (const AskedPoint& p : asked)
        {
            label celli = cellOf(p.x);
            if (celli < 0)
            {
                continue;
            }
            if (p.told >= 0)
            {
                celli = cellOfSize(p.told, celli, p.x);
            }
            result.append(FoundPoint{
                p.number, complex_.globalCell(celli), complex_.cellSizes()[celli],
                boundaryFaceAt(complex_, celli, p.x, toleranceIn(celli))});
        }
        return result;
    }

private:
    scalar toleranceIn(label celli) const
    {
        constexpr scalar onBoundary = 1e-6; // in cells
        return onBoundary * complex_.cellSizes()[celli] + roundOff_;
    }

    // The lowest of the cells that touch the point, as in an extraction; -1 where the
    // point is in no cell, or not all cells around it are known. The way from the point
    // before may end at an obstacle: then the search begins anew, near the point.
    label cellOf(const point& x)
    {
        Location location = locate(complex_, x, hint_);
        if (!isAt(location, x))
        {
            hint_ = CellHint();
            hint_.cell = complex_.findCell(x);
            location = locate(complex_, x, hint_);
        }
        return isAt(location, x) && complex_.hasAllNeighbours(location.cell)
                   ? settledCell(complex_, location.cell, x)
                   : -1;
    }

    // A point beyond a wall is put back to 1e-6 in front of it.
    bool isAt(const Location& location, const point& x) const
    {
        const bool inCell = location.where == Location::Where::inside
                            || location.where == Location::Where::outside;
        return inCell
               && (location.boundaryFace < 0
                   || mag(location.position - x) <= 2 * toleranceIn(location.cell));
    }

    // The first cell of that size among those around this one that touch the point, or
    // this one if there is none.
    label cellOfSize(scalar size, label celli, const point& x) const
    {
        constexpr scalar touches = 0.3; // in cells: badly warped faces bulge by less
        if (complex_.cellSizes()[celli] == size)
        {
            return celli;
        }
        Surroundings around(complex_, celli);
        std::sort(around.cells.begin(), around.cells.end());
        labelList alike(around.cells.size());
        label n = 0;
        for (const label other : around.cells)
        {
            if (complex_.cellSizes()[other] == size)
            {
                alike[n++] = other;
            }
        }
        alike.setSize(n);
        const label found = n > 0 ? holdingCell(complex_, alike, x) : celli;
        return liesWithin(complex_, found, x, touches) ? found : celli;
    }

    const CellComplex& complex_;
    scalar roundOff_; // [m]
    CellHint hint_;
};

// The points of the mesh, on the master, for each rank in whose box they are.
std::vector<DynamicList<AskedPoint>>
askedOf(const InterfaceMesh& mesh, const std::vector<List<boundBox>>& boxes)
{
    std::vector<DynamicList<AskedPoint>> asked(boxes.size());
    for (std::size_t ranki = 0; ranki < boxes.size(); ++ranki)
    {
        for (const boundBox& box : boxes[ranki])
        {
            forAll(mesh.points, i)
            {
                if (box.contains(mesh.points[i]))
                {
                    const scalar told = mesh.cellSizes.empty() ? -1 : mesh.cellSizes[i];
                    asked[ranki].append(AskedPoint{i, mesh.points[i], told});
                }
            }
        }
    }
    return asked;
}

// Fills cells (global), cell sizes and boundary faces; where several ranks found a
// point, they agree.
void adopt(
    const std::vector<List<FoundPoint>>& found, const GivenSurface& surface,
    InterfaceMesh& mesh
)
{
    const label n = mesh.points.size();
    mesh.cells = labelList(n, -1);
    mesh.cellSizes.setSize(n);
    mesh.boundaryFaces.setSize(n);
    for (const List<FoundPoint>& points : found)
    {
        for (const FoundPoint& p : points)
        {
            if (mesh.cells[p.number] < 0)
            {
                mesh.cells[p.number] = p.cell;
                mesh.cellSizes[p.number] = p.cellSize;
                mesh.boundaryFaces[p.number] = p.boundaryFace;
            }
        }
    }
    forAll(mesh.cells, i)
    {
        if (mesh.cells[i] < 0)
        {
            failFor(
                surface, "has a point outside the domain, at " + textOf(mesh.points[i])
            );
        }
    }
}

} // namespace

void failFor(const GivenSurface& surface, const std::string& text)
{
    throw BadInput("The surface " + surface.name + ' ' + text + '.');
}

void placeInCells(
    const GivenSurface* surface, const CellComplex& complex, InterfaceMesh& mesh,
    const Exchange& exchange
)
{
    DynamicList<boundBox> mine;
    if (complex.nCells() > 0)
    {
        const scalar margin = Placement::roundOffIn(complex.whole().bounds)
                              + 1e-3 * complex.bounds().mag();
        const vector wide(margin, margin, margin);
        mine.append(
            boundBox(complex.bounds().min() - wide, complex.bounds().max() + wide)
        );
    }
    const std::vector<List<boundBox>> boxes(exchange.listsToMaster(mine));
    std::vector<DynamicList<AskedPoint>> asked(exchange.nRanks());
    runOnMaster(exchange, [&] { asked = askedOf(mesh, boxes); });
    const List<AskedPoint> here(exchange.exchangeLists(asked)[0]);
    DynamicList<FoundPoint> found;
    runOnAllRanks(exchange, [&] { found = Placement(complex).found(here); });
    const std::vector<List<FoundPoint>> all(exchange.listsToMaster(found));
    runOnMaster(
        exchange,
        [&]
        {
            adopt(all, *surface, mesh);
            mesh.clearParametrization();
        }
    );
}

} // namespace Foam::stability
