// SPDX-License-Identifier: GPL-3.0-or-later

#include "shapes/MeshParts.H"

#include <algorithm>
#include <numeric>
#include <random>

namespace Foam::stability::shapes
{

namespace
{

// The cells of one rank as a mesh, with global numbers.
class OwnPart
{
public:
    OwnPart(
        const CellComplexInput& all, const labelList& ranks, const labelList& numbers
    )
        : all_(all), ranks_(ranks), numbers_(numbers), cells_(all.nCells, -1),
          points_(all.points.size(), -1)
    {
    }

    // `order`: all cells by their global numbers.
    CellComplexInput build(const labelList& order, label rank)
    {
        own_.patchNames = all_.patchNames;
        for (const label celli : order)
        {
            if (ranks_[celli] == rank)
            {
                cells_[celli] = own_.nCells++;
                own_.globalCells.append(numbers_[celli]);
            }
        }
        addFacesBetweenOwn();
        addBoundary();
        addFacesToOthers();
        return std::move(own_);
    }

private:
    bool isOwn(label celli) const { return cells_[celli] >= 0; }

    void addFace(face f, label celli)
    {
        for (label& pointi : f)
        {
            if (points_[pointi] < 0)
            {
                points_[pointi] = own_.points.size();
                own_.points.append(all_.points[pointi]);
                own_.globalPoints.append(pointi);
            }
            pointi = points_[pointi];
        }
        own_.faces.append(f);
        own_.owner.append(cells_[celli]);
    }

    void addFacesBetweenOwn()
    {
        forAll(all_.neighbour, facei)
        {
            if (isOwn(all_.owner[facei]) && isOwn(all_.neighbour[facei]))
            {
                addFace(all_.faces[facei], all_.owner[facei]);
                own_.neighbour.append(cells_[all_.neighbour[facei]]);
            }
        }
    }

    void
    addBoundaryValues(BoundaryKind kind, label patch, label number, label cellBehind)
    {
        own_.kinds.append(kind);
        own_.patches.append(patch);
        own_.globalBoundaryFaces.append(number);
        own_.cellBehind.append(cellBehind);
    }

    void addBoundary()
    {
        forAll(all_.kinds, i)
        {
            const label facei = all_.neighbour.size() + i;
            if (isOwn(all_.owner[facei]))
            {
                addFace(all_.faces[facei], all_.owner[facei]);
                addBoundaryValues(all_.kinds[i], all_.patches[i], i, -1);
            }
        }
    }

    void addFacesToOthers()
    {
        forAll(all_.neighbour, facei)
        {
            const label a = all_.owner[facei], b = all_.neighbour[facei];
            if (isOwn(a) != isOwn(b))
            {
                const face& f = all_.faces[facei];
                addFace(isOwn(a) ? f : f.reverseFace(), isOwn(a) ? a : b);
                addBoundaryValues(
                    BoundaryKind::coupledUnknown, -1, -1, numbers_[isOwn(a) ? b : a]
                );
            }
        }
    }

    const CellComplexInput& all_;
    const labelList& ranks_;
    const labelList& numbers_;
    labelList cells_, points_; // labels in the part, or -1
    CellComplexInput own_;
};

} // namespace

labelList slabs(const CellComplex& complex, label nRanks, const vector& across)
{
    labelList order(identity(complex.nCells()));
    const auto depth = [&](label celli)
    { return complex.cellCentres()[celli] & across; };
    std::stable_sort(
        order.begin(), order.end(),
        [&](label a, label b) { return depth(a) < depth(b); }
    );
    labelList ranks(order.size());
    forAll(order, i)
    {
        ranks[order[i]] = label(scalar(i) / order.size() * nRanks);
    }
    return ranks;
}

labelList irregularParts(const CellComplex& complex, label nRanks)
{
    std::mt19937 random(nRanks);
    pointField places(nRanks);
    for (point& x : places)
    {
        x = complex.cellCentres()[random() % complex.nCells()];
    }
    labelList ranks(complex.nCells());
    forAll(ranks, celli)
    {
        const auto nearer = [&](const point& a, const point& b)
        {
            const point& x = complex.cellCentres()[celli];
            return magSqr(a - x) < magSqr(b - x);
        };
        const auto nearest = std::min_element(places.begin(), places.end(), nearer);
        ranks[celli] = label(nearest - places.begin());
    }
    return ranks;
}

MeshParts::MeshParts(std::shared_ptr<const CellComplex> whole, const labelList& ranks)
    : whole_(std::move(whole)), ranks_(ranks), numbers_(ranks.size()),
      cells_(identity(ranks.size()))
{
    std::stable_sort(
        cells_.begin(), cells_.end(),
        [&](label a, label b) { return ranks_[a] < ranks_[b]; }
    );
    forAll(cells_, number)
    {
        numbers_[cells_[number]] = number;
    }
}

CellComplexInput MeshParts::own(label rank) const
{
    return OwnPart(whole_->input(), ranks_, numbers_).build(cells_, rank);
}

std::shared_ptr<const CellComplex>
MeshParts::part(const Exchange& exchange, const FetchReach& reach) const
{
    WholeMesh whole(whole_->whole());
    whole.firstCells = labelList(exchange.nRanks() + 1, label(0));
    for (const label rank : ranks_)
    {
        ++whole.firstCells[rank + 1];
    }
    std::partial_sum(
        whole.firstCells.begin(), whole.firstCells.end(), whole.firstCells.begin()
    );
    const bool alone = exchange.nRanks() == 1;
    CellComplexInput all(assemble(
        fetchRings(
            own(exchange.rank()), nullptr, exchange,
            alone ? FetchReach(0) : reach.within(whole.section)
        ),
        whole_->patchNames(), whole
    ));
    if (!alone)
    {
        all.own.setSize(all.globalCells.size());
        forAll(all.own, celli)
        {
            all.own[celli] = ranks_[cells_[all.globalCells[celli]]] == exchange.rank();
        }
    }
    return std::make_shared<const CellComplex>(std::move(all));
}

std::shared_ptr<FlowSnapshot> MeshParts::part(
    const std::shared_ptr<const CellComplex>& part, const FlowSnapshot& whole
) const
{
    auto snapshot = std::make_shared<FlowSnapshot>();
    snapshot->complex = part;
    snapshot->time = whole.time;
    snapshot->alphas.setSize(1, scalarField(part->nCells()));
    snapshot->U.setSize(part->nCells());
    for (label celli = 0; celli < part->nCells(); ++celli)
    {
        const label there = cells_[part->globalCell(celli)];
        snapshot->alphas[0][celli] = whole.alphas[0][there];
        snapshot->U[celli] = whole.U[there];
    }
    snapshot->boundaryAlphas.setSize(1, scalarField(part->nBoundaryFaces(), Zero));
    snapshot->boundaryU.setSize(part->nBoundaryFaces(), Zero);
    for (label i = 0; i < part->nBoundaryFaces(); ++i)
    {
        const label there = part->input().globalBoundaryFaces[i];
        if (there >= 0)
        {
            snapshot->boundaryAlphas[0][i] = whole.boundaryAlphas[0][there];
            snapshot->boundaryU[i] = whole.boundaryU[there];
        }
    }
    return snapshot;
}

} // namespace Foam::stability::shapes
