// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/reconstruction/GivenInterface.H"
#include "core/base/Errors.H"
#include "core/cells/CellWalk.H"
#include "core/surface/SurfaceTopology.H"
#include "core/cells/CellPlacement.H"
#include "core/surface/InterfaceMotion.H"
#include "core/cells/CanonicalOrder.H"
#include "core/flow/VolumeFractions.H"

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

class Placement
{
public:
    Placement(const GivenSurface& surface, const CellComplex& complex)
        : surface_(surface), complex_(complex)
    {
        const boundBox& bounds = complex.whole().bounds;
        const scalar largest =
            max(cmptMax(cmptMag(bounds.min())), cmptMax(cmptMag(bounds.max())));
        roundOff_ = std::numeric_limits<float>::epsilon() * largest;
    }

    // On entry the sizes of cells that are told, or none.
    void place(InterfaceMesh& mesh)
    {
        const label n = mesh.points.size();
        const scalarField told(mesh.cellSizes);
        mesh.cells.setSize(n);
        mesh.cellSizes.setSize(n);
        mesh.boundaryFaces.setSize(n);
        for (label i = 0; i < n; ++i)
        {
            const point& x = mesh.points[i];
            mesh.cells[i] = cellOf(x);
            if (!told.empty())
            {
                mesh.cells[i] = cellOfSize(told[i], mesh.cells[i], x);
            }
            mesh.cellSizes[i] = complex_.cellSizes()[mesh.cells[i]];
            mesh.boundaryFaces[i] =
                boundaryFaceAt(complex_, mesh.cells[i], x, toleranceIn(mesh.cells[i]));
        }
    }

private:
    scalar toleranceIn(label celli) const
    {
        constexpr scalar onBoundary = 1e-6; // in cells
        return onBoundary * complex_.cellSizes()[celli] + roundOff_;
    }

    // The lowest of the cells that touch the point, as in an extraction.
    label cellOf(const point& x)
    {
        const Location location = locate(complex_, x, hint_);
        const bool found = location.where != Location::Where::nowhere;
        // A point beyond a wall is put back to 1e-6 in front of it.
        if (!found
            || (location.boundaryFace >= 0
                && mag(location.position - x) > 2 * toleranceIn(location.cell)))
        {
            fail(surface_, "has a point outside the domain, at " + textOf(x));
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

    const GivenSurface& surface_;
    const CellComplex& complex_;
    scalar roundOff_; // [m]
    CellHint hint_;
};

bool isClosed(const InterfaceMesh& mesh)
{
    const SurfaceTopology topology(mesh.points.size(), mesh.triangles);
    const List<SurfaceEdge>& edges = topology.edges();
    return std::all_of(
        edges.begin(), edges.end(),
        [](const SurfaceEdge& edge) { return edge.nTriangles == 2; }
    );
}

// [m3] of the first material, which may be the one outside.
scalar enclosed(const InterfaceMesh& mesh, const CellComplex& complex)
{
    const point origin = complex.whole().bounds.centre();
    scalar flux = 0;
    forAll(mesh.triangles, trianglei)
    {
        flux += (mesh.centre(trianglei) - origin) & mesh.areaVector(trianglei);
    }
    return flux < 0 ? sum(complex.cellVolumes()) + flux / 3 : flux / 3;
}

// True if there are cells of both materials.
bool hasInterface(const VolumeFractions& fractions)
{
    const scalarField& cells = fractions.cells;
    return std::any_of(
        cells.begin(), cells.end(),
        [&](scalar alpha)
        { return VolumeFractions::inside(alpha) != VolumeFractions::inside(cells[0]); }
    );
}

} // namespace

ReconstructionResult GivenInterface::extract(const FlowSnapshot& snapshot) const
{
    if (!snapshot.surface)
    {
        throw BadInput("The reconstruction fromFiles needs a surface for every time.");
    }
    const GivenSurface& surface = *snapshot.surface;
    const VolumeFractions fractions(snapshot);
    ReconstructionResult result;
    result.alphaVolume = fractions.volume;
    result.volume = fractions.volume;

    checkFinite(surface);
    weld(surface, result.mesh);
    if (result.mesh.empty() && hasInterface(fractions))
    {
        fail(surface, "has no triangles, but the volume fraction has an interface");
    }
    Placement(surface, *snapshot.complex).place(result.mesh);
    result.mesh.clearParametrization();
    if (!result.mesh.empty() && isClosed(result.mesh))
    {
        result.volume = enclosed(result.mesh, *snapshot.complex);
    }
    return result;
}

} // namespace Foam::stability
