// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/reconstruction/volumeFit/VolumeFit.H"

#include "core/flow/FractionsAround.H"
#include "core/reconstruction/volumeFit/ComponentFit.H"
#include "core/reconstruction/volumeFit/FitHomes.H"
#include "core/reconstruction/volumeFit/MaterialShares.H"
#include "core/surface/pieces/Redistribution.H"

#include <algorithm>

namespace Foam::stability
{

namespace
{

// A triangle that was moved, for the rank that owns it.
struct MovedTriangle
{
    label triangle;                 // index among the owned ones
    FixedList<point, 3> points;     // [m]
    FixedList<label, 3> cells;      // global
    FixedList<scalar, 3> cellSizes; // [m]
};

// The largest size of a cell at a point, on any rank [m].
scalar largestCell(const SurfacePiece& owned, const Exchange& exchange)
{
    scalar size = VSMALL;
    for (const scalar h : owned.mesh.cellSizes)
    {
        size = std::max(size, h);
    }
    return largest(size, exchange);
}

// What touches the piece.
SurfaceHalo touching(
    const SurfacePiece& owned, const PeriodicImages* images, const Exchange& exchange
)
{
    const scalar h = largestCell(owned, exchange);
    VoxelMask mask(2 * h);
    for (const point& x : owned.mesh.points)
    {
        mask.add(x, 0.5 * h);
    }
    return SurfaceHalo(owned, mask, exchange, images);
}

// The space around the components that are fitted here.
VoxelMask spaceAround(const SurfacePiece& here, scalar voxelSize)
{
    VoxelMask space(voxelSize);
    forAll(here.mesh.points, pointi)
    {
        space.add(here.mesh.points[pointi], reachOfFit * here.mesh.cellSizes[pointi]);
    }
    return space;
}

// True for each triangle of the halo whose component is fitted on this rank.
List<bool>
fittedHere(const SurfaceHalo& halo, const labelList& homes, const Exchange& exchange)
{
    const labelList homesOfAll(halo.triangleValues(homes));
    List<bool> here(homesOfAll.size());
    forAll(here, trianglei)
    {
        here[trianglei] = homesOfAll[trianglei] == exchange.rank()
                          && halo.piece().keys[trianglei].image == 0;
    }
    return here;
}

// The triangles of each rank that were moved. `sent`: those that each rank sent here,
// by their index there; `here`: the same ones joined.
std::vector<DynamicList<MovedTriangle>> movedOfRanks(
    const std::vector<List<label>>& sent, const JoinedSurface& here,
    const SurfacePiece& halo, const InterfaceMesh& mesh, const List<bool>& moved,
    const CellComplex& complex
)
{
    std::vector<DynamicList<MovedTriangle>> result(sent.size());
    DynamicList<labelPair> sources; // the rank, the index there
    for (std::size_t ranki = 0; ranki < sent.size(); ++ranki)
    {
        for (const label trianglei : sent[ranki])
        {
            sources.append(labelPair(label(ranki), trianglei));
        }
    }
    forAll(here.triangleSources, i)
    {
        const label inHalo = label(
            std::lower_bound(halo.keys.begin(), halo.keys.end(), here.piece.keys[i])
            - halo.keys.begin()
        );
        if (!moved[inHalo])
        {
            continue;
        }
        const labelPair& source = sources[here.triangleSources[i]];
        MovedTriangle triangle;
        triangle.triangle = source.second();
        for (label k = 0; k < 3; ++k)
        {
            const label pointi = mesh.triangles[inHalo][k];
            triangle.points[k] = mesh.points[pointi];
            triangle.cells[k] = complex.globalCell(mesh.cells[pointi]);
            triangle.cellSizes[k] = mesh.cellSizes[pointi];
        }
        result[source.first()].append(triangle);
    }
    return result;
}

void moveOwned(const std::vector<List<MovedTriangle>>& moved, SurfacePiece& owned)
{
    for (const List<MovedTriangle>& triangles : moved)
    {
        for (const MovedTriangle& triangle : triangles)
        {
            for (label k = 0; k < 3; ++k)
            {
                const label pointi = owned.mesh.triangles[triangle.triangle][k];
                owned.mesh.points[pointi] = triangle.points[k];
                owned.mesh.cells[pointi] = triangle.cells[k];
                owned.mesh.cellSizes[pointi] = triangle.cellSizes[k];
                owned.startPositions[pointi] = triangle.points[k];
            }
        }
    }
}

VolumeFitResult totals(VolumeFitResult result, const Exchange& exchange)
{
    List<ExactSum> volume(1, result.volume);
    sum(volume, exchange);
    result.volume = volume[0];
    result.largestMove = largest(result.largestMove, exchange);
    for (label* count :
         {&result.nClosed, &result.nTooFar, &result.nFolded, &result.nOpen,
          &result.nHeld})
    {
        *count = exchange.total(*count);
    }
    return result;
}

} // namespace

const std::vector<std::string>& volumeFitNames()
{
    static const std::vector<std::string> names{"none", "component"};
    return names;
}

VolumeFitResult fitVolumes(
    SurfacePiece& owned, const std::shared_ptr<const FlowSnapshot>& snapshot,
    const Run& run
)
{
    constexpr label nRings = reachOfShares + 2; // cut cells are next to those of points
    const Exchange& exchange = run.ranks;
    const WholeMesh& whole = snapshot->complex->whole();
    const PeriodicImages* images = whole.images.get();
    labelList homes;
    {
        const SurfaceHalo halo(touching(owned, images, exchange));
        homes = fitHomes(
            owned, Components(halo, whole.bounds.centre(), exchange), exchange
        );
    }
    std::vector<DynamicList<label>> toRanks(exchange.nRanks());
    forAll(homes, trianglei)
    {
        if (homes[trianglei] >= 0)
        {
            toRanks[homes[trianglei]].append(trianglei);
        }
    }
    const JoinedSurface here(redistributed(owned, toRanks, exchange));
    const std::vector<List<label>> sent(exchange.exchangeLists(toRanks));
    const scalar voxelSize = reachOfFit * largestCell(owned, exchange);
    const SurfaceHalo around(
        owned, spaceAround(here.piece, voxelSize), exchange, images
    );
    const List<bool> isWhole(fittedHere(around, homes, exchange));
    const auto site =
        fractionsAround(snapshot, here.piece.mesh.cells, nRings, exchange);

    VolumeFitResult result;
    std::vector<DynamicList<MovedTriangle>> moved(exchange.nRanks());
    runOnAllRanks(
        exchange,
        [&]
        {
            if (here.piece.mesh.empty())
            {
                return;
            }
            InterfaceMesh mesh(around.mesh());
            useLocalCells(mesh, *site->complex);
            const ComponentFit fit(fitComponents(
                mesh, isWhole, *site->complex, VolumeFractions(*site), run.nThreads
            ));
            result = fit.result;
            moved = movedOfRanks(
                sent, here, around.piece(), mesh, fit.moved, *site->complex
            );
        }
    );
    moveOwned(exchange.exchangeLists(moved), owned);
    return totals(result, exchange);
}

} // namespace Foam::stability
