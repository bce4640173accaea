// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/comparison/SmallScales.H"

#include "core/cells/CellFrame.H"
#include "core/comparison/ThinSheets.H"
#include "core/ranks/ExactSum.H"
#include "core/flow/FractionsAround.H"

#include <algorithm>
#include <cmath>

namespace Foam::stability
{

namespace
{

constexpr scalar around = 4; // [cells], of what a droplet is judged by
constexpr label nRings = 6;

// The extents of the cells of the points along their normals [m]: of round cells, and
// of those that are not known here, their sizes. What is farther than three cells is
// not searched for.
scalarField extentsAt(const InterfaceMesh& mesh, const CellComplex& complex)
{
    constexpr scalar farthest = 3 / thinnestResolved;
    scalarField extents(mesh.cellSizes);
    const vectorField normals(mesh.pointNormals());
    forAll(extents, pointi)
    {
        const label celli = complex.localCell(mesh.cells[pointi]);
        if (celli >= 0)
        {
            const CellFrame frame(frameOf(complex, celli));
            const scalar size = std::cbrt(frame.volume);
            const scalar flatness = frame.along(normals[pointi]) / size;
            if (mag(flatness - 1) > 1e-9)
            {
                extents[pointi] *= std::min(flatness, farthest);
            }
        }
    }
    return extents;
}

List<bool> smallTriangles(
    const SurfacePiece& owned, const Components& components, const WholeMesh& mesh
)
{
    List<bool> small(owned.mesh.triangles.size());
    forAll(small, trianglei)
    {
        const Components::Body& body = components.bodyOf(trianglei);
        small[trianglei] =
            body.closed && mayBeSubGrid(body.volume, body.cellSize, mesh.section);
    }
    return small;
}

// The space that decides on the droplets of this rank.
VoxelMask regionOf(const WholeComponents& droplets, scalar size)
{
    const InterfaceMesh& mesh = droplets.piece.mesh;
    Map<boundBox> boxes;
    forAll(mesh.triangles, trianglei)
    {
        boundBox& box = boxes(droplets.components[trianglei]);
        for (const label pointi : mesh.triangles[trianglei])
        {
            const scalar reach = around * mesh.cellSizes[pointi];
            const vector wide(reach, reach, reach);
            box.add(mesh.points[pointi] - wide);
            box.add(mesh.points[pointi] + wide);
        }
    }
    VoxelMask region(size);
    forAllConstIters(boxes, box)
    {
        region.add(*box);
    }
    return region;
}

// Numbers without gaps for those of components, in the same order.
class Renumbering
{
public:
    explicit Renumbering(const labelList& used) : numbers_(used)
    {
        std::sort(numbers_.begin(), numbers_.end());
        numbers_.setSize(
            std::unique(numbers_.begin(), numbers_.end()) - numbers_.begin()
        );
    }

    label of(label number) const
    {
        return std::lower_bound(numbers_.begin(), numbers_.end(), number)
               - numbers_.begin();
    }

    label operator[](label i) const { return numbers_[i]; }

    bool found(label number) const
    {
        return std::binary_search(numbers_.begin(), numbers_.end(), number);
    }

private:
    labelList numbers_;
};

std::vector<Droplet> dropletsOf(
    const SurfaceHalo& halo, const labelList& ofTriangles, const FlowSnapshot& site
)
{
    InterfaceMesh mesh(halo.mesh());
    useLocalCells(mesh, *site.complex);
    const Renumbering dense(ofTriangles);
    labelList components(mesh.points.size(), 0);
    forAll(mesh.triangles, trianglei)
    {
        for (const label pointi : mesh.triangles[trianglei])
        {
            components[pointi] = dense.of(ofTriangles[trianglei]);
        }
    }
    std::vector<Droplet> found(subGridDroplets(mesh, components, site));
    for (Droplet& droplet : found)
    {
        droplet.component = dense[droplet.component];
    }
    return found;
}

// The droplets at home here, by the surface and the fractions around them of all ranks.
std::vector<Droplet> dropletsAtHome(
    const SurfacePiece& owned, const Components& components,
    const std::shared_ptr<const FlowSnapshot>& snapshot, const Exchange& exchange
)
{
    const WholeComponents whole(wholeComponents(
        owned, components,
        smallTriangles(owned, components, snapshot->complex->whole()), exchange
    ));
    if (exchange.total(whole.components.size()) == 0)
    {
        return {};
    }
    scalar size = VSMALL;
    for (const scalar h : owned.mesh.cellSizes)
    {
        size = std::max(size, around * h);
    }
    const SurfaceHalo near(owned, regionOf(whole, largest(size, exchange)), exchange);
    const labelList ofTriangles(near.triangleValues(components.ofOwnedTriangles()));
    const auto site =
        fractionsAround(snapshot, whole.piece.mesh.cells, nRings, exchange);
    std::vector<Droplet> found;
    runOnAllRanks(exchange, [&] { found = dropletsOf(near, ofTriangles, *site); });
    const Renumbering atHome(whole.components);
    found.erase(
        std::remove_if(
            found.begin(), found.end(),
            [&](const Droplet& droplet) { return !atHome.found(droplet.component); }
        ),
        found.end()
    );
    return found;
}

// One entry per owned triangle: true if it belongs to a droplet, which may be at home
// on another rank.
List<bool> ofDroplets(
    const SurfacePiece& owned, const Components& components, const WholeMesh& mesh,
    const std::vector<Droplet>& droplets, const Exchange& exchange
)
{
    const List<bool> small(smallTriangles(owned, components, mesh));
    const labelList numbers(components.ofOwnedTriangles());
    std::vector<DynamicList<label>> questions(exchange.nRanks());
    forAll(small, trianglei)
    {
        if (small[trianglei])
        {
            questions[components.homeOf(trianglei)].append(numbers[trianglei]);
        }
    }
    labelList known(droplets.size());
    forAll(known, i)
    {
        known[i] = droplets[i].component;
    }
    const Renumbering subGrid(known);
    std::vector<DynamicList<bool>> answers(exchange.nRanks());
    const std::vector<List<label>> asked(exchange.exchangeLists(questions));
    for (std::size_t ranki = 0; ranki < asked.size(); ++ranki)
    {
        for (const label number : asked[ranki])
        {
            answers[ranki].append(subGrid.found(number));
        }
    }
    const std::vector<List<bool>> told(exchange.exchangeLists(answers));
    labelList next(exchange.nRanks(), 0);
    List<bool> result(small);
    forAll(result, trianglei)
    {
        if (small[trianglei])
        {
            const label home = components.homeOf(trianglei);
            result[trianglei] = told[home][next[home]++];
        }
    }
    return result;
}

} // namespace

SmallScales smallScales(
    const SurfacePiece& owned, const SurfaceHalo& halo, const Components& components,
    const std::shared_ptr<const FlowSnapshot>& snapshot, const Run& run
)
{
    SmallScales scales;
    runOnAllRanks(
        run.ranks,
        [&]
        {
            scales.thin = thinPoints(
                halo.mesh(), extentsAt(halo.mesh(), *snapshot->complex), run.nThreads
            );
        }
    );
    scales.droplets = dropletsAtHome(owned, components, snapshot, run.ranks);
    const List<bool> triangles(ofDroplets(
        owned, components, snapshot->complex->whole(), scales.droplets, run.ranks
    ));
    scales.subGrid.setSize(halo.mesh().points.size(), false);
    forAll(halo.mesh().triangles, trianglei)
    {
        const label own = halo.ownTriangle(trianglei);
        for (const label pointi : halo.mesh().triangles[trianglei])
        {
            scales.subGrid[pointi] =
                scales.subGrid[pointi] || (own >= 0 && triangles[own]);
        }
    }
    return scales;
}

std::vector<Droplet>
gatheredDroplets(const std::vector<Droplet>& here, const Exchange& exchange)
{
    DynamicList<Droplet> mine;
    for (const Droplet& droplet : here)
    {
        mine.append(droplet);
    }
    const DynamicList<Droplet> joined(exchange.joinedOnMaster(mine));
    std::vector<Droplet> all(joined.begin(), joined.end());
    std::sort(
        all.begin(), all.end(),
        [](const Droplet& a, const Droplet& b) { return a.component < b.component; }
    );
    return all;
}

} // namespace Foam::stability
