// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/reconstruction/GivenInterface.H"
#include "core/base/Errors.H"
#include "core/surface/SurfaceTopology.H"
#include "core/cells/CanonicalOrder.H"
#include "core/flow/VolumeFractions.H"
#include "core/reconstruction/SurfacePlacement.H"
#include "core/surface/pieces/SurfacePiece.H"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace Foam::stability
{

namespace
{

void checkFinite(const GivenSurface& surface)
{
    forAll(surface.points, pointi)
    {
        const point& x = surface.points[pointi];
        if (!std::isfinite(x.x()) || !std::isfinite(x.y()) || !std::isfinite(x.z()))
        {
            failFor(
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
            failFor(
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
            failFor(
                *surface, "has no triangles, but the volume fraction has an interface"
            );
        }
    };
    runOnMaster(exchange, read);
    placeInCells(surface, complex, result.mesh, exchange);
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
