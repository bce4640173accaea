// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/ranks/RankCells.H"

#include "core/cells/ThinWallSearch.H"
#include "foam/errors/Failures.H"

namespace Foam::stability
{

namespace
{

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

} // namespace

RankCells::RankCells(
    const fvMesh& mesh, const RankMessages& messages, const FetchReach& reach,
    const wordHashSet& walls
)
    : messages_(messages), nOwn_(mesh.nCells()),
      cellNumbers_(messages.numbersOf(mesh.nCells())),
      openCoupled_(openCoupledPatches(mesh, messages))
{
    const OwnPiece piece(ownPiece(mesh, cellNumbers_, messages, walls));
    const CellComplexInput& own = piece.cells;
    boundaryNumbers_ = messages.numbersOf(own.kinds.size());
    meshBoundary_.setSize(own.kinds.size());
    forAll(meshBoundary_, i)
    {
        meshBoundary_[i] =
            piece.meshFaces[own.neighbour.size() + i] - mesh.nInternalFaces();
    }
    const bool alone = messages.nRanks() == 1 && !piece.images;
    const Rows cellFaces(facesOfCells(own));
    WholeMesh whole(wholeOf(own, messages));
    whole.images = piece.images;
    whole.section = piece.section;
    whole.thinWalls = findThinWalls(own, piece.images.get(), messages);
    CellComplexInput all(assemble(
        fetchRings(
            own, piece.images.get(), messages,
            alone ? FetchReach(0) : reach.within(piece.section)
        ),
        own.patchNames, whole
    ));
    labelList realCells(all.globalCells);
    if (piece.images)
    {
        for (label& celli : realCells)
        {
            celli = piece.images->realCell(celli);
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
    matchFaces(piece, cellFaces);
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

void RankCells::matchFaces(const OwnPiece& piece, const Rows& cellFaces)
{
    const CellComplexInput& own = piece.cells;
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
        for (const label ownFacei : cellFaces[celli])
        {
            if (pointsOf(own.faces[ownFacei], own.globalPoints) == points)
            {
                meshFaces_[facei] = piece.meshFaces[ownFacei];
                sameWay_[facei] = (own.owner[ownFacei] == celli) == byOwner;
            }
        }
    }
}

scalarField RankCells::fluxes(const UList<scalar>& own) const
{
    const std::optional<PlaneSection>& section = complex_->whole().section;
    scalarField values(meshFaces_.size(), 0);
    forAll(values, facei)
    {
        const label meshFacei = meshFaces_[facei];
        if (meshFacei >= 0 && !complex_->isEnd(facei))
        {
            const scalar share =
                section ? section->factor(complex_->faceCentres()[facei]) : 1;
            values[facei] = (sameWay_[facei] ? 1 : -1) * own[meshFacei] / share;
        }
    }
    return values;
}

} // namespace Foam::stability
