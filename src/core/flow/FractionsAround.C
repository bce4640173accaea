// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/flow/FractionsAround.H"

#include "core/flow/FractionPackets.H"

namespace Foam::stability
{

namespace
{

// Grows a set of cells by those that share a point with it, as far as they are known.
labelList ringsAround(const CellComplex& complex, const UList<label>& seeds, label n)
{
    labelHashSet cells(seeds);
    labelHashSet front(cells);
    for (label ring = 0; ring < n; ++ring)
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
    return cells.sortedToc();
}

} // namespace

std::shared_ptr<const FlowSnapshot> fractionsAround(
    const std::shared_ptr<const FlowSnapshot>& snapshot, const labelList& cells,
    label nRings, const Exchange& exchange
)
{
    const CellComplex& complex = *snapshot->complex;
    if (exchange.nRanks() == 1 && !complex.whole().images)
    {
        return snapshot;
    }
    std::vector<DynamicList<label>> requests(exchange.nRanks());
    for (const label celli : cells)
    {
        const WholeMesh& whole = complex.whole();
        requests[whole.rankOf(celli)].append(
            whole.images ? whole.images->realCell(celli) : celli
        );
    }
    std::vector<Packet> answers(exchange.nRanks());
    std::vector<List<label>> asked = exchange.exchangeLists(requests);
    runOnAllRanks(
        exchange,
        [&]
        {
            for (std::size_t ranki = 0; ranki < asked.size(); ++ranki)
            {
                for (label& celli : asked[ranki])
                {
                    celli = complex.localCell(celli);
                }
                if (!asked[ranki].empty())
                {
                    answers[ranki] = packedFractions(
                        *snapshot, ringsAround(complex, asked[ranki], nRings)
                    );
                }
            }
        }
    );
    answers = exchange.exchange(std::move(answers));
    std::shared_ptr<const FlowSnapshot> result(snapshot);
    runOnAllRanks(
        exchange,
        [&]
        {
            if (auto assembled = assembledFractions(answers, complex))
            {
                assembled->time = snapshot->time;
                result = assembled;
            }
        }
    );
    return result;
}

} // namespace Foam::stability
