// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/ranks/RankCells.H"

#include "core/cells/HomeNumbers.H"
#include "foam/errors/Failures.H"
#include "emptyPolyPatch.H"
#include "globalMeshData.H"
#include "processorPolyPatch.H"
#include "symmetryPlanePolyPatch.H"
#include "symmetryPolyPatch.H"
#include "syncTools.H"
#include "wallPolyPatch.H"
#include "wedgePolyPatch.H"

namespace Foam::stability
{

namespace
{

// There are cells behind it.
bool leadsOn(const polyPatch& patch)
{
    return isA<processorPolyPatch>(patch) || isCyclic(patch);
}

BoundaryKind kindOf(const polyPatch& patch)
{
    if (leadsOn(patch))
    {
        return BoundaryKind::coupledUnknown;
    }
    if (isA<emptyPolyPatch>(patch) || isA<wedgePolyPatch>(patch))
    {
        throw BadInput(
            "Patch " + patch.name() + " is of type " + patch.type()
            + ", which interfaceStability does not support yet; allowed are walls, "
              "symmetries, cyclic and open patches of a three-dimensional mesh."
        );
    }
    if (isA<wallPolyPatch>(patch))
    {
        return BoundaryKind::wall;
    }
    if (isA<symmetryPolyPatch>(patch) || isA<symmetryPlanePolyPatch>(patch))
    {
        return BoundaryKind::symmetry;
    }
    return BoundaryKind::open;
}

// Its other side is interpolated (cyclicAMI, overset): an open boundary. These types
// say of themselves that they constrain fields, but not always that they are coupled.
bool interpolates(const polyPatch& patch)
{
    const bool constrains = patch.coupled() || polyPatch::constraintType(patch.type());
    const bool understood = leadsOn(patch) || isA<emptyPolyPatch>(patch)
                            || isA<wedgePolyPatch>(patch)
                            || kindOf(patch) == BoundaryKind::symmetry;
    return constrains && !understood;
}

CellComplexInput complexInput(const fvMesh& mesh)
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
    DynamicList<word> names;
    for (const polyPatch& patch : mesh.boundaryMesh())
    {
        if (!isA<processorPolyPatch>(patch))
        {
            names.append(patch.name());
        }
        if (patch.empty())
        {
            continue; // without faces it does no harm, whatever its type
        }
        const label start = patch.start() - mesh.nInternalFaces();
        const BoundaryKind kind = kindOf(patch);
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

WholeMesh wholeOf(const CellComplexInput& own, const RankMessages& messages)
{
    Packet packet;
    packet.put(boundBox(own.points, false));
    packet.put(own.nCells);
    WholeMesh whole;
    whole.firstCells = labelList(1, label(0));
    for (Packet& of : messages.toAll(packet))
    {
        whole.bounds.add(of.get<boundBox>());
        whole.firstCells.append(whole.firstCells.last() + of.get<label>());
    }
    return whole;
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

} // namespace

RankCells::RankCells(
    const fvMesh& mesh, const RankMessages& messages, const FetchReach& reach
)
    : messages_(messages), nOwn_(mesh.nCells()), cellNumbers_(mesh.nCells()),
      boundaryNumbers_(mesh.nFaces() - mesh.nInternalFaces())
{
    const CellComplexInput own(ownPiece(mesh));
    const bool alone = messages.nRanks() == 1 && !images_;
    const Rows cellFaces(facesOfCells(own));
    WholeMesh whole(wholeOf(own, messages));
    whole.images = images_;
    CellComplexInput all(assemble(
        fetchRings(own, images_.get(), messages, alone ? FetchReach(0) : reach),
        own.patchNames, whole
    ));
    labelList realCells(all.globalCells);
    if (images_)
    {
        for (label& celli : realCells)
        {
            celli = images_->realCell(celli);
        }
    }
    cells_ = sourceOf(realCells, cellNumbers_);
    boundaryFaces_ = sourceOf(all.globalBoundaryFaces, boundaryNumbers_);
    if (alone)
    {
        all.globalCells.clear(); // numbers of its own will do
    }
    else
    {
        all.own.setSize(all.globalCells.size());
        forAll(all.own, celli)
        {
            all.own[celli] = cellNumbers_.isLocal(all.globalCells[celli]);
        }
    }
    messages.throwIfAny<BadInput>(failureOf(
        [&] { complex_ = std::make_shared<const CellComplex>(std::move(all)); }
    ));
    matchFaces(own, cellFaces);
    findOpenCoupled(mesh);
}

void RankCells::findOpenCoupled(const fvMesh& mesh)
{
    for (const polyPatch& patch : mesh.boundaryMesh())
    {
        if (interpolates(patch) && messages_.total(patch.size()) > 0)
        {
            openCoupled_.append(patch.name() + " (" + patch.type() + ")");
        }
    }
}

CellComplexInput RankCells::ownPiece(const fvMesh& mesh)
{
    CellComplexInput own;
    // A patch may have faces on some ranks only.
    messages_.throwIfAny<BadInput>(failureOf([&] { own = complexInput(mesh); }));
    own.globalCells = globalNumbers(cellNumbers_);
    own.globalBoundaryFaces = globalNumbers(boundaryNumbers_);
    own.cellBehind.setSize(own.globalBoundaryFaces.size(), -1);
    const CyclicPatches cyclic(mesh, messages_);
    if (messages_.nRanks() == 1 && !cyclic.any())
    {
        own.globalPoints = identity(mesh.nPoints());
        return own;
    }
    labelList unique;
    const label nPoints =
        mesh.globalData().mergePoints(own.globalPoints, unique)->size();
    if (cyclic.any())
    {
        images_ = std::make_shared<const PeriodicImages>(
            cyclic.motions(), mesh.bounds(), cellNumbers_.size(), nPoints
        );
        const labelList home(homePoints(mesh, own.globalPoints));
        const pointField homes(homesOf(mesh, own.globalPoints, home));
        messages_.throwIfAny<BadInput>(
            failureOf([&] { numberFromHome(own, home, homes, *images_); })
        );
    }
    findBehind(mesh, cyclic, own);
    return own;
}

void RankCells::findBehind(
    const fvMesh& mesh, const CyclicPatches& cyclic, CellComplexInput& own
) const
{
    labelList behind;
    syncTools::swapBoundaryCellList(mesh, own.globalCells, behind);
    for (const polyPatch& patch : mesh.boundaryMesh())
    {
        if (patch.empty() || !leadsOn(patch))
        {
            continue;
        }
        const label image =
            isCyclic(patch) ? images_->indexOf(cyclic.motionOf(patch)) : 0;
        for (label facei = patch.start(); facei < patch.start() + patch.size(); ++facei)
        {
            const label i = facei - mesh.nInternalFaces();
            own.cellBehind[i] = image ? images_->cell(behind[i], image) : behind[i];
        }
    }
}

// Collective: tells the ranks what is wanted of them.
RankCells::Source
RankCells::sourceOf(const labelList& global, const globalIndex& numbers) const
{
    const label nRanks = messages_.nRanks();
    Source source;
    source.fromOwn.setSize(global.size(), -1);
    source.received.resize(nRanks);
    std::vector<DynamicList<label>> wanted(nRanks), places(nRanks);
    forAll(global, i)
    {
        if (global[i] >= 0 && numbers.isLocal(global[i]))
        {
            source.fromOwn[i] = numbers.toLocal(global[i]);
        }
        else if (global[i] >= 0)
        {
            const label ranki = numbers.whichProcID(global[i]);
            wanted[ranki].append(numbers.toLocal(ranki, global[i]));
            places[ranki].append(i);
        }
    }
    source.sent = messages_.exchangeLists(wanted);
    for (label ranki = 0; ranki < nRanks; ++ranki)
    {
        source.received[ranki] = labelList(std::move(places[ranki]));
    }
    return source;
}

void RankCells::matchFaces(const CellComplexInput& own, const Rows& cellFaces)
{
    const CellComplexInput& all = complex_->input();
    const auto pointsOf = [](const face& f, const labelList& numbers)
    {
        labelList points(f.size());
        forAll(f, k)
        {
            points[k] = numbers[f[k]];
        }
        Foam::sort(points);
        return points;
    };
    const label nInternal = all.neighbour.size();
    meshFaces_.setSize(all.faces.size(), -1);
    sameWay_.setSize(meshFaces_.size(), true);
    forAll(meshFaces_, facei)
    {
        const bool byOwner = isOwn(all.owner[facei]);
        if (!byOwner && (facei >= nInternal || !isOwn(all.neighbour[facei])))
        {
            continue;
        }
        const label celli =
            cells_.fromOwn[byOwner ? all.owner[facei] : all.neighbour[facei]];
        const labelList points(pointsOf(all.faces[facei], all.globalPoints));
        for (const label meshFacei : cellFaces[celli])
        {
            if (pointsOf(own.faces[meshFacei], own.globalPoints) == points)
            {
                meshFaces_[facei] = meshFacei;
                sameWay_[facei] = (own.owner[meshFacei] == celli) == byOwner;
            }
        }
    }
}

scalarField RankCells::fluxes(const UList<scalar>& own) const
{
    scalarField values(meshFaces_.size(), 0);
    forAll(values, facei)
    {
        if (meshFaces_[facei] >= 0)
        {
            const scalar flux = own[meshFaces_[facei]];
            values[facei] = sameWay_[facei] ? flux : -flux;
        }
    }
    return values;
}

} // namespace Foam::stability
