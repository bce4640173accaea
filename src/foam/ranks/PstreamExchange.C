// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

#include "foam/ranks/PstreamExchange.H"

#include "foam/Failures.H"
#include "foam/ranks/CellPackets.H"
#include "foam/ranks/SurfaceMerge.H"

#include <algorithm>
#include <map>

namespace Foam::stability
{

namespace
{

// Grows a set of cells by those that share a point with it, as far as they are known.
labelHashSet ringsAround(const CellComplex& complex, labelHashSet cells, label nRings)
{
    labelHashSet front(cells);
    for (label ring = 0; ring < nRings; ++ring)
    {
        labelHashSet next;
        for (const label celli : front)
        {
            for (const label facei : complex.cellFaces()[celli])
            {
                for (const label pointi : complex.faces()[facei])
                {
                    for (const label otheri : complex.pointCells()[pointi])
                    {
                        if (cells.insert(otheri))
                        {
                            next.insert(otheri);
                        }
                    }
                }
            }
        }
        front = std::move(next);
    }
    return cells;
}

} // namespace

PstreamExchange::PstreamExchange(const RankMessages& messages, label nOwnCells)
    : messages_(messages), firstCells_(messages.nRanks() + 1, 0)
{
    Packet mine;
    mine.put(nOwnCells);
    std::vector<Packet> all = messages.toAll(mine);
    for (label ranki = 0; ranki < messages.nRanks(); ++ranki)
    {
        firstCells_[ranki + 1] = firstCells_[ranki] + all[ranki].get<label>();
    }
}

label PstreamExchange::rankOf(label globalCell) const
{
    return std::upper_bound(firstCells_.begin(), firstCells_.end(), globalCell)
           - firstCells_.begin() - 1;
}

void PstreamExchange::sum(UList<scalar>& values) const
{
    Packet mine;
    mine.putList(values);
    values = scalar(0);
    for (Packet& packet : messages_.toMaster(std::move(mine)))
    {
        if (!packet.empty())
        {
            const List<scalar> some(packet.getList<scalar>());
            forAll(values, i)
            {
                values[i] += some[i];
            }
        }
    }
    Packet all;
    all.putList(values);
    values.deepCopy(messages_.fromMaster(std::move(all)).getList<scalar>());
}

void PstreamExchange::agree(const std::string& failure) const
{
    messages_.agree<NumericalFailure>(failure);
}

void PstreamExchange::travel(
    DynamicList<Pathline>& pathlines, const CellComplex& complex,
    const std::function<void(UList<Pathline>&)>& advance
) const
{
    DynamicList<Pathline> arrived(std::move(pathlines));
    pathlines.clear();
    constexpr label maxRounds = 10000;
    for (label round = 0;; ++round)
    {
        agree(
            round < maxRounds ? failureOf([&] { advance(arrived); })
                              : "A pathline travels between ranks without end."
        );

        std::vector<DynamicList<Pathline>> leaving(nRanks());
        label nLeaving = 0;
        for (Pathline& path : arrived)
        {
            const label celli = path.hint.cell;
            const bool waits = path.state == PathlineState::moving && celli >= 0
                               && !complex.complete(celli);
            if (waits && rankOf(complex.globalCell(celli)) == messages_.rank())
            {
                path.state = PathlineState::lost; // nobody knows all around its cell
                pathlines.append(path);
            }
            else if (waits)
            {
                path.hint.cell = complex.globalCell(celli);
                leaving[rankOf(path.hint.cell)].append(path);
                ++nLeaving;
            }
            else
            {
                pathlines.append(path);
            }
        }
        if (messages_.total(nLeaving) == 0)
        {
            return;
        }
        arrived.clear();
        for (const List<Pathline>& paths : messages_.exchangeLists(leaving))
        {
            for (Pathline path : paths)
            {
                path.hint.cell = complex.localCell(path.hint.cell);
                path.earlierHint = path.hint;
                arrived.append(path);
            }
        }
    }
}

void PstreamExchange::collect(
    DynamicList<Pathline>& pathlines, const CellComplex& complex
) const
{
    for (Pathline& path : pathlines)
    {
        if (path.hint.cell >= 0)
        {
            path.hint.cell = complex.globalCell(path.hint.cell);
        }
    }
    Packet mine;
    mine.putList(pathlines);
    pathlines.clear();
    for (Packet& packet : messages_.toMaster(std::move(mine)))
    {
        if (!packet.empty())
        {
            pathlines.append(packet.getList<Pathline>());
        }
    }
    std::sort(
        pathlines.begin(), pathlines.end(),
        [](const Pathline& a, const Pathline& b) { return a.id < b.id; }
    );
}

void PstreamExchange::disperse(
    DynamicList<Pathline>& pathlines, const CellComplex& complex
) const
{
    std::vector<DynamicList<Pathline>> there(nRanks());
    for (const Pathline& path : pathlines)
    {
        there[path.hint.cell < 0 ? messages_.rank() : rankOf(path.hint.cell)].append(
            path
        );
    }
    pathlines.clear();
    for (const List<Pathline>& paths : messages_.exchangeLists(there))
    {
        pathlines.append(paths);
    }
    for (Pathline& path : pathlines)
    {
        path.hint.cell =
            path.hint.cell < 0 ? path.hint.cell : complex.localCell(path.hint.cell);
    }
}

ReconstructionResult PstreamExchange::gather(
    const ReconstructionResult& local, const CellComplex& complex
) const
{
    std::vector<Packet> pieces = messages_.toMaster(surfacePiece(local, complex));
    ReconstructionResult whole;
    onMaster([&] { whole = mergedSurface(pieces); });
    return whole;
}

// Per rank what the master asks of it; returns the labels of the cells that this rank
// knows of.
labelList PstreamExchange::askFor(
    const CellComplex& complex, const std::function<DynamicList<CellRequest>()>& wanted
) const
{
    std::vector<DynamicList<CellRequest>> requests(nRanks());
    if (isMaster())
    {
        for (const CellRequest& request : wanted())
        {
            requests[rankOf(request.cell)].append(request);
        }
    }
    std::map<label, labelHashSet> byRings;
    for (const List<CellRequest>& asked : messages_.exchangeLists(requests))
    {
        for (const CellRequest& request : asked)
        {
            byRings[request.nRings].insert(complex.localCell(request.cell));
        }
    }
    labelHashSet all;
    for (const auto& [nRings, cells] : byRings)
    {
        all += ringsAround(complex, cells, nRings);
    }
    return all.sortedToc();
}

std::shared_ptr<const FlowSnapshot> PstreamExchange::around(
    const std::shared_ptr<const FlowSnapshot>& snapshot,
    const std::function<DynamicList<CellRequest>()>& wanted
) const
{
    const CellComplex& complex = *snapshot->complex;
    const labelList cells(askFor(complex, wanted));
    std::vector<Packet> packets = messages_.toMaster(
        cells.empty() ? Packet() : packedFractions(*snapshot, cells)
    );
    std::shared_ptr<const FlowSnapshot> result(snapshot);
    onMaster(
        [&]
        {
            auto assembled = assembledFractions(packets, complex);
            if (assembled) // else there is no surface
            {
                assembled->time = snapshot->time;
                result = assembled;
            }
        }
    );
    return result;
}

// What the master does alone; if it fails, all ranks throw.
void PstreamExchange::onMaster(const std::function<void()>& work) const
{
    agree(isMaster() ? failureOf(work) : std::string());
}

} // namespace Foam::stability
