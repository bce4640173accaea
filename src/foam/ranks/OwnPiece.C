// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/ranks/OwnPiece.H"

#include "core/cells/HomeNumbers.H"
#include "core/cells/ThinWallPoints.H"
#include "foam/errors/Failures.H"
#include "foam/ranks/CellLayer.H"
#include "foam/ranks/CoupledPoints.H"
#include "cyclicPolyPatch.H"
#include "emptyPolyPatch.H"
#include "processorPolyPatch.H"
#include "syncTools.H"
#include "wallPolyPatch.H"
#include "wedgePolyPatch.H"

namespace Foam::stability
{

namespace
{

// It is coupled face by face: there are cells behind it, if it is not at an end of a
// layer of cells.
bool isCoupled(const polyPatch& patch)
{
    return isA<processorPolyPatch>(patch) || isA<cyclicPolyPatch>(patch);
}

// It is at the ends of a layer of cells.
bool isEnd(const polyPatch& patch)
{
    return isA<emptyPolyPatch>(patch) || isA<wedgePolyPatch>(patch);
}

BoundaryKind kindOf(const polyPatch& patch)
{
    return isCoupled(patch)                    ? BoundaryKind::coupledUnknown
           : isA<wallPolyPatch>(patch)         ? BoundaryKind::wall
           : isEnd(patch) || isSymmetry(patch) ? BoundaryKind::symmetry
                                               : BoundaryKind::open;
}

// Its other side is interpolated (cyclicAMI, overset): an open boundary. These types
// say of themselves that they constrain fields, but not always that they are coupled.
bool interpolates(const polyPatch& patch)
{
    const bool constrains = patch.coupled() || polyPatch::constraintType(patch.type());
    const bool understood = isCoupled(patch) || kindOf(patch) == BoundaryKind::symmetry;
    return constrains && !understood;
}

CellComplexInput
cellsOf(const fvMesh& mesh, const wordHashSet& walls, const labelHashSet& cyclicEnds)
{
    const label nBoundaryFaces = mesh.nFaces() - mesh.nInternalFaces();
    CellComplexInput input;
    input.nCells = mesh.nCells();
    input.points = mesh.points();
    input.faces = mesh.faces();
    input.owner = mesh.faceOwner();
    input.neighbour = SubList<label>(mesh.faceNeighbour(), mesh.nInternalFaces());
    input.kinds.setSize(nBoundaryFaces, BoundaryKind::open);
    input.patches.setSize(nBoundaryFaces, -1);
    input.cellBehind.setSize(nBoundaryFaces, -1);
    DynamicList<word> names;
    for (const polyPatch& patch : mesh.boundaryMesh())
    {
        if (!isA<processorPolyPatch>(patch))
        {
            names.append(patch.name());
        }
        const label start = patch.start() - mesh.nInternalFaces();
        const BoundaryKind kind = walls.found(patch.name()) ? BoundaryKind::wall
                                  : cyclicEnds.found(patch.index())
                                      ? BoundaryKind::symmetry
                                      : kindOf(patch);
        for (label i = 0; i < patch.size(); ++i)
        {
            input.kinds[start + i] = kind;
            input.patches[start + i] =
                kind == BoundaryKind::coupledUnknown ? -1 : patch.index();
        }
    }
    input.patchNames = wordList(std::move(names));
    return input;
}

labelList globalNumbers(const globalIndex& numbers)
{
    labelList result(numbers.localSize());
    forAll(result, i)
    {
        result[i] = numbers.toGlobal(i);
    }
    return result;
}

void findBehind(
    const fvMesh& mesh, const RankMessages& messages, const CyclicPatches& cyclic,
    const PeriodicImages* images, CellComplexInput& own
)
{
    labelList behind;
    messages.meet();
    syncTools::swapBoundaryCellList(mesh, own.globalCells, behind);
    for (const polyPatch& patch : mesh.boundaryMesh())
    {
        if (patch.empty() || !(cyclic.contain(patch) || isA<processorPolyPatch>(patch)))
        {
            continue;
        }
        const label image =
            cyclic.contain(patch) ? images->indexOf(cyclic.motionOf(patch)) : 0;
        for (label facei = patch.start(); facei < patch.start() + patch.size(); ++facei)
        {
            const label i = facei - mesh.nInternalFaces();
            own.cellBehind[i] = image ? images->cell(behind[i], image) : behind[i];
        }
    }
}

// The home points of a mesh with cyclic patches, of which each point is an image.
struct Homes
{
    labelList points;  // numbers in the whole mesh
    pointField places; // [m]
};

// Those of the points of the extruded section.
Homes extruded(
    const Homes& mesh, const labelList& meshPoints, const PlaneSection& section
)
{
    Homes homes;
    homes.points.setSize(meshPoints.size());
    homes.places.setSize(meshPoints.size());
    forAll(meshPoints, i)
    {
        const bool low = i % 2 == 0;
        const point& x = mesh.places[meshPoints[i]];
        homes.points[i] = 2 * mesh.points[meshPoints[i]] + (low ? 0 : 1);
        homes.places[i] = low ? section.inLow(x) : section.inHigh(x);
    }
    return homes;
}

} // namespace

OwnPiece ownPiece(
    const fvMesh& mesh, const globalIndex& cellNumbers, const RankMessages& messages,
    const wordHashSet& walls
)
{
    OwnPiece piece;
    const std::optional<CellLayer> layer(findLayer(mesh, messages));
    const labelHashSet cyclicEnds(layer ? layer->cyclicEnds : labelHashSet());
    const CyclicPatches cyclic(mesh, messages, cyclicEnds);
    CellComplexInput& own = piece.cells;
    own = cellsOf(mesh, walls, cyclicEnds);
    splitThinWallPoints(own);
    own.globalCells = globalNumbers(cellNumbers);
    const CoupledPoints points(mesh, own, cyclic, messages);
    const bool shares = messages.nRanks() > 1 || cyclic.any();
    own.globalPoints = shares ? points.numbers() : identity(own.points.size());
    label nPoints = points.total();
    boundBox bounds(mesh.bounds()); // of all ranks
    if (layer)
    {
        piece.section = layer->section;
        nPoints *= 2;
        bounds = boundBox(
            piece.section->inLow(bounds.min()), piece.section->inHigh(bounds.max())
        );
    }
    Homes homes;
    if (cyclic.any())
    {
        piece.images = std::make_shared<const PeriodicImages>(
            cyclic.motions(), bounds, cellNumbers.size(), nPoints
        );
        homes.points = points.homePoints(own.globalPoints);
        homes.places = points.homesOf(own.globalPoints, homes.points);
    }
    findBehind(mesh, messages, cyclic, piece.images.get(), own);
    messages.throwIfAny<BadInput>(failureOf(
        [&]
        {
            piece.meshFaces = identity(own.faces.size());
            if (layer)
            {
                ExtrudedSection section(
                    extrudedSection(own, layer->ends, layer->section)
                );
                own = std::move(section.prisms);
                piece.meshFaces = std::move(section.meshFaces);
                homes = cyclic.any()
                            ? extruded(homes, section.meshPoints, layer->section)
                            : homes;
            }
            if (cyclic.any())
            {
                numberFromHome(own, homes.points, homes.places, *piece.images);
            }
        }
    ));
    own.globalBoundaryFaces = globalNumbers(messages.numbersOf(own.kinds.size()));
    return piece;
}

DynamicList<std::string>
openCoupledPatches(const fvMesh& mesh, const RankMessages& messages)
{
    DynamicList<std::string> patches;
    for (const polyPatch& patch : mesh.boundaryMesh())
    {
        if (interpolates(patch) && messages.total(patch.size()) > 0)
        {
            patches.append(patch.name() + " (" + patch.type() + ")");
        }
    }
    return patches;
}

} // namespace Foam::stability
