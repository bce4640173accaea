// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/reconstruction/GivenInterface.H"
#include "core/base/Errors.H"
#include "core/cells/CellWalk.H"
#include "core/surface/SurfaceTopology.H"
#include "core/cells/CellPlacement.H"
#include "core/surface/InterfaceMotion.H"
#include "core/cells/CanonicalOrder.H"
#include "core/flow/VolumeFractions.H"
#include "core/surface/pieces/SurfacePiece.H"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>

namespace Foam::stability
{

namespace
{

[[noreturn]] void fail(const GivenSurface& surface, const std::string& text)
{
    throw BadInput("The surface " + surface.name + ' ' + text + '.');
}

void checkFinite(const GivenSurface& surface)
{
    forAll(surface.points, pointi)
    {
        const point& x = surface.points[pointi];
        if (!std::isfinite(x.x()) || !std::isfinite(x.y()) || !std::isfinite(x.z()))
        {
            fail(
                surface,
                "has a point that is not finite, number " + std::to_string(pointi)
            );
        }
    }
}

// The name of each point; points of one name are copies of one.
labelList namesOf(const GivenSurface& surface)
{
    if (surface.welding == Welding::byName)
    {
        return surface.vertex;
    }
    labelList names(surface.points.size());
    std::iota(names.begin(), names.end(), label(0));
    if (surface.welding == Welding::byPosition)
    {
        const pointField& x = surface.points;
        labelList order(names);
        std::stable_sort(
            order.begin(), order.end(),
            [&](label a, label b) { return beforeByPosition(x[a], x[b]); }
        );
        for (label i = 1; i < order.size(); ++i)
        {
            if (x[order[i]] == x[order[i - 1]])
            {
                names[order[i]] = names[order[i - 1]];
            }
        }
    }
    return names;
}

// Points and triangles of the result, in the order of the names, and the sizes of cells
// that are told; points without a triangle are dropped.
void weld(const GivenSurface& surface, InterfaceMesh& mesh)
{
    const labelList names = namesOf(surface);
    std::vector<std::pair<label, label>> used; // name, point
    for (const triFace& t : surface.triangles)
    {
        for (const label pointi : t)
        {
            used.emplace_back(names[pointi], pointi);
        }
    }
    std::sort(used.begin(), used.end());
    labelList numbers(surface.points.size(), -1);
    DynamicList<point> points;
    DynamicList<scalar> sizes;
    for (std::size_t i = 0; i < used.size(); ++i)
    {
        const point& x = surface.points[used[i].second];
        if (i == 0 || used[i].first != used[i - 1].first)
        {
            points.append(x);
            if (!surface.cellSizes.empty())
            {
                sizes.append(surface.cellSizes[used[i].second]);
            }
        }
        else if (x != points.last())
        {
            fail(
                surface, "has points of the same number in its array vertex at "
                             + textOf(x) + " and " + textOf(points.last())
            );
        }
        numbers[used[i].second] = points.size() - 1;
    }
    mesh.points.transfer(points);
    mesh.cellSizes.transfer(sizes);
    DynamicList<triFace> triangles;
    for (const triFace& t : surface.triangles)
    {
        const triFace welded(numbers[t[0]], numbers[t[1]], numbers[t[2]]);
        if (welded[0] != welded[1] && welded[1] != welded[2] && welded[2] != welded[0])
        {
            triangles.append(welded);
        }
    }
    mesh.triangles.transfer(triangles);
}

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
    // point is in no cell, or not all cells around it are known.
    label cellOf(const point& x)
    {
        const Location location = locate(complex_, x, hint_);
        const bool inCell = location.where == Location::Where::inside
                            || location.where == Location::Where::outside;
        // A point beyond a wall is put back to 1e-6 in front of it.
        if (!inCell || !complex_.hasAllNeighbours(location.cell)
            || (location.boundaryFace >= 0
                && mag(location.position - x) > 2 * toleranceIn(location.cell)))
        {
            return -1;
        }
        return settledCell(complex_, location.cell, x);
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
            fail(
                surface, "has a point outside the domain, at " + textOf(mesh.points[i])
            );
        }
    }
}

// The mesh is the master's; the cells are those of all ranks. Collective.
void place(
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

bool isClosed(const InterfaceMesh& mesh)
{
    const SurfaceTopology topology(mesh.points.size(), mesh.triangles);
    const List<SurfaceEdge>& edges = topology.edges();
    return std::all_of(
        edges.begin(), edges.end(),
        [](const SurfaceEdge& edge) { return edge.nTriangles == 2; }
    );
}

// Of the first material, which may be the one outside; `all`: the volume of all cells.
ExactSum
enclosed(const InterfaceMesh& mesh, const ExactSum& all, const WholeMesh& whole)
{
    const point origin = whole.bounds.centre();
    ExactSum volume;
    forAll(mesh.triangles, trianglei)
    {
        volume.add(
            (mesh.centre(trianglei) - origin) & (mesh.areaVector(trianglei) / 3)
        );
    }
    if (volume < 0)
    {
        volume.add(all);
    }
    return volume;
}

// The volume of the cells of all ranks; `nInside` and `nOutside`: numbers of the cells
// on each side of 1/2. Collective.
ExactSum countCells(
    const CellComplex& complex, const VolumeFractions& fractions, label& nInside,
    label& nOutside, const Exchange& exchange
)
{
    List<ExactSum> volume(1);
    forAll(fractions.cells, celli)
    {
        if (complex.own(celli))
        {
            volume[0].add(complex.cellVolumes()[celli]);
            ++(VolumeFractions::inside(fractions.cells[celli]) ? nInside : nOutside);
        }
    }
    nInside = exchange.total(nInside);
    nOutside = exchange.total(nOutside);
    sum(volume, exchange);
    return volume[0];
}

} // namespace

ReconstructionResult
placedSurface(const FlowSnapshot& snapshot, const Exchange& exchange)
{
    const CellComplex& complex = *snapshot.complex;
    const GivenSurface* surface = snapshot.surface.get();
    const VolumeFractions fractions(
        makeOnAllRanks(exchange, [&] { return VolumeFractions(snapshot); })
    );
    label nInside = 0, nOutside = 0;
    const ExactSum allCells(countCells(complex, fractions, nInside, nOutside, exchange)
    );
    ReconstructionResult result;
    result.alphaVolume = fractions.volume;
    result.volume = fractions.volume;
    const auto read = [&]
    {
        if (!surface)
        {
            throw BadInput(
                "The reconstruction fromFiles needs a surface for every time."
            );
        }
        checkFinite(*surface);
        weld(*surface, result.mesh);
        if (result.mesh.empty() && nInside > 0 && nOutside > 0)
        {
            fail(
                *surface, "has no triangles, but the volume fraction has an interface"
            );
        }
    };
    runOnMaster(exchange, read);
    place(surface, complex, result.mesh, exchange);
    label closed = 0; // 1 on the master, if it is
    const auto measure = [&]
    {
        closed = !result.mesh.empty() && isClosed(result.mesh);
        if (closed)
        {
            result.volume = enclosed(result.mesh, allCells, complex.whole());
        }
    };
    runOnMaster(exchange, measure);
    if (exchange.total(closed) > 0 && !exchange.isMaster())
    {
        result.volume = ExactSum();
    }
    return result;
}

ReconstructionResult GivenInterface::extract(const FlowSnapshot& snapshot) const
{
    ReconstructionResult result(placedSurface(snapshot, SerialExchange()));
    useLocalCells(result.mesh, *snapshot.complex);
    return result;
}

} // namespace Foam::stability
