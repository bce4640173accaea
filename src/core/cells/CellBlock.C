// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/cells/CellBlock.H"

#include "DynamicList.H"
#include "Map.H"

#include <algorithm>

namespace Foam::stability
{

namespace
{

class BlockWriter
{
public:
    explicit BlockWriter(const CellComplexInput& mesh)
        : mesh_(mesh), nInternal_(mesh.neighbour.size())
    {
    }

    void add(label celli, const UList<label>& faces)
    {
        cells_.append(mesh_.globalCells[celli]);
        if (!mesh_.cellHomes.empty())
        {
            cellHomes_.append(mesh_.cellHomes[celli]);
        }
        nFaces_.append(faces.size());
        for (const label facei : faces)
        {
            addFace(celli, facei);
        }
    }

    CellBlock take()
    {
        CellBlock block;
        block.cells.transfer(cells_);
        block.nFaces.transfer(nFaces_);
        block.faces.transfer(faces_);
        block.cellBehind.transfer(behind_);
        block.boundaryFaces.transfer(boundaryFaces_);
        block.kinds.transfer(kinds_);
        block.patches.transfer(patches_);
        block.pointIds.transfer(pointIds_);
        block.points.transfer(points_);
        block.homes.transfer(homes_);
        block.cellHomes.transfer(cellHomes_);
        return block;
    }

private:
    void addFace(label celli, label facei)
    {
        const bool isOwner = mesh_.owner[facei] == celli;
        face f(isOwner ? mesh_.faces[facei] : mesh_.faces[facei].reverseFace());
        for (label& pointi : f)
        {
            const label global = mesh_.globalPoints[pointi];
            if (known_.insert(global))
            {
                pointIds_.append(global);
                points_.append(mesh_.points[pointi]);
                if (!mesh_.homes.empty())
                {
                    homes_.append(mesh_.homes[pointi]);
                }
            }
            pointi = global;
        }
        faces_.append(f);

        const label i = facei - nInternal_;
        const bool internal = i < 0;
        const bool beyond = !internal && mesh_.kinds[i] == BoundaryKind::coupledUnknown;
        const bool boundary = !internal && !beyond;
        behind_.append(
            internal ? mesh_.globalCells
                           [isOwner ? mesh_.neighbour[facei] : mesh_.owner[facei]]
            : beyond ? mesh_.cellBehind[i]
                     : -1
        );
        boundaryFaces_.append(boundary ? mesh_.globalBoundaryFaces[i] : -1);
        kinds_.append(boundary ? mesh_.kinds[i] : BoundaryKind::coupledUnknown);
        patches_.append(boundary ? mesh_.patches[i] : -1);
    }

    const CellComplexInput& mesh_;
    label nInternal_;
    labelHashSet known_;
    DynamicList<label> cells_, nFaces_, behind_, boundaryFaces_, patches_, pointIds_;
    DynamicList<face> faces_;
    DynamicList<BoundaryKind> kinds_;
    DynamicList<point> points_, homes_, cellHomes_;
};

class Assembly
{
public:
    explicit Assembly(const std::vector<CellBlock>& blocks) : blocks_(blocks)
    {
        for (const CellBlock& block : blocks)
        {
            numberPoints(block);
            numberCells(block);
        }
    }

    CellComplexInput
    run(const wordList& patchNames, const std::optional<WholeMesh>& whole)
    {
        for (std::size_t i = 0; i < blocks_.size(); ++i)
        {
            addFaces(blocks_[i], isFirst_[i]);
        }
        join();
        mesh_.patchNames = patchNames;
        mesh_.whole = whole;
        return ordered();
    }

private:
    // A boundary face of one cell.
    struct Side
    {
        label celli;
        label cellBehind, boundaryFace;
        BoundaryKind kind;
        label patch;
    };

    void numberPoints(const CellBlock& block)
    {
        forAll(block.pointIds, i)
        {
            if (pointNumbers_.insert(block.pointIds[i], points_.size()))
            {
                points_.append(block.points[i]);
                pointIds_.append(block.pointIds[i]);
                if (!block.homes.empty())
                {
                    homes_.append(block.homes[i]);
                }
            }
        }
    }

    void numberCells(const CellBlock& block)
    {
        isFirst_.emplace_back(block.cells.size(), false);
        forAll(block.cells, i)
        {
            if (cellNumbers_.insert(block.cells[i], cells_.size()))
            {
                isFirst_.back()[i] = true;
                cells_.append(block.cells[i]);
                if (!block.cellHomes.empty())
                {
                    cellHomes_.append(block.cellHomes[i]);
                }
            }
        }
    }

    void addFaces(const CellBlock& block, const std::vector<bool>& isFirst)
    {
        label k = 0;
        forAll(block.cells, i)
        {
            for (const label end = k + block.nFaces[i]; k < end; ++k)
            {
                if (!isFirst[i])
                {
                    continue;
                }
                const label celli = cellNumbers_[block.cells[i]];
                const auto behind = cellNumbers_.cfind(block.cellBehind[k]);
                face f(block.faces[k]);
                for (label& pointi : f)
                {
                    pointi = pointNumbers_[pointi];
                }
                if (!behind.found())
                {
                    boundary_.append(f);
                    sides_.append(
                        {celli, block.cellBehind[k], block.boundaryFaces[k],
                         block.kinds[k], block.patches[k]}
                    );
                }
                else if (celli < behind.val()) // each once
                {
                    internal_.append(f);
                    owner_.append(celli);
                    neighbour_.append(behind.val());
                }
            }
        }
    }

    void join()
    {
        mesh_.nCells = cells_.size();
        mesh_.points.transfer(points_);
        mesh_.globalPoints.transfer(pointIds_);
        mesh_.globalCells.transfer(cells_);
        mesh_.homes.transfer(homes_);
        mesh_.cellHomes.transfer(cellHomes_);
        internal_.append(boundary_);
        mesh_.faces.transfer(internal_);
        for (const Side& side : sides_)
        {
            owner_.append(side.celli);
            kinds_.append(side.kind);
            patches_.append(side.patch);
            boundaryFaces_.append(side.boundaryFace);
            behind_.append(side.cellBehind);
        }
        mesh_.owner.transfer(owner_);
        mesh_.neighbour.transfer(neighbour_);
        mesh_.kinds.transfer(kinds_);
        mesh_.patches.transfer(patches_);
    }

    CellComplexInput ordered()
    {
        const CanonicalOrder order = orderByPosition(mesh_);
        const label nInternal = mesh_.neighbour.size();
        mesh_.globalBoundaryFaces.setSize(boundaryFaces_.size());
        mesh_.cellBehind.setSize(behind_.size());
        forAll(mesh_.cellBehind, i)
        {
            const label old = order.faces[nInternal + i] - nInternal;
            mesh_.globalBoundaryFaces[i] = boundaryFaces_[old];
            mesh_.cellBehind[i] = behind_[old];
        }
        return std::move(mesh_);
    }

    const std::vector<CellBlock>& blocks_;
    std::vector<std::vector<bool>>
        isFirst_; // per block and cell: not in an earlier one
    Map<label> pointNumbers_, cellNumbers_;
    DynamicList<point> points_, homes_, cellHomes_;
    DynamicList<label> pointIds_, cells_, owner_, neighbour_;
    DynamicList<face> internal_, boundary_;
    DynamicList<Side> sides_;
    DynamicList<BoundaryKind> kinds_;
    DynamicList<label> patches_, boundaryFaces_, behind_;
    CellComplexInput mesh_;
};

} // namespace

CellBlock
blockOf(const CellComplexInput& mesh, const Rows& cellFaces, const labelList& cells)
{
    BlockWriter writer(mesh);
    for (const label celli : cells)
    {
        writer.add(celli, cellFaces[celli]);
    }
    return writer.take();
}

CellBlock moved(CellBlock block, label image, const PeriodicImages& images)
{
    const auto moveCell = [&](label& cell) { cell = images.movedCell(cell, image); };
    std::for_each(block.cells.begin(), block.cells.end(), moveCell);
    for (label& cell : block.cellBehind)
    {
        if (cell >= 0)
        {
            moveCell(cell);
        }
    }
    Map<label> numbers(2 * block.pointIds.size());
    forAll(block.pointIds, i)
    {
        const label id = images.movedPoint(block.pointIds[i], block.homes[i], image);
        numbers.insert(block.pointIds[i], id);
        block.pointIds[i] = id;
        block.points[i] = images.place(id, block.homes[i]);
    }
    for (face& f : block.faces)
    {
        for (label& pointi : f)
        {
            pointi = numbers[pointi];
        }
    }
    return block;
}

CellComplexInput assemble(
    const std::vector<CellBlock>& blocks, const wordList& patchNames,
    const std::optional<WholeMesh>& whole
)
{
    return Assembly(blocks).run(patchNames, whole);
}

} // namespace Foam::stability
