// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/surface/pieces/PointNumbers.H"

#include <functional>
#include <unordered_map>

namespace Foam::stability
{

namespace
{

struct HashOfSeed
{
    std::size_t operator()(const point& x) const
    {
        const std::hash<scalar> hash; // the same for 0 and -0
        std::size_t sum = hash(x.x());
        for (const scalar coordinate : {x.y(), x.z()})
        {
            sum = 31 * sum + hash(coordinate);
        }
        return sum ^ (sum >> 32);
    }
};

// The sum of nHere over the ranks before this one.
label before(label nHere, const Exchange& exchange)
{
    Packet mine;
    mine.put(nHere);
    std::vector<Packet> counts = exchange.toAll(mine);
    label sum = 0;
    for (label ranki = 0; ranki < exchange.rank(); ++ranki)
    {
        sum += counts[ranki].get<label>();
    }
    return sum;
}

} // namespace

// The hash of a start position determines the rank that numbers it.
labelList pointNumbers(const SurfaceOrder& piece, const Exchange& exchange)
{
    const label n = piece.startPositions.size(), nRanks = exchange.nRanks();
    if (nRanks == 1 || !piece.sharesPoints)
    {
        return identity(n, before(n, exchange));
    }
    std::vector<DynamicList<point>> asked(nRanks);
    labelList asksFrom(n);
    forAll(piece.startPositions, i)
    {
        asksFrom[i] =
            label(HashOfSeed()(piece.startPositions[i]) % std::size_t(nRanks));
        asked[asksFrom[i]].append(piece.startPositions[i]);
    }
    std::unordered_map<point, label, HashOfSeed> known;
    std::vector<DynamicList<label>> numbers(nRanks);
    const std::vector<List<point>> toNumber(exchange.exchangeLists(asked));
    for (label ranki = 0; ranki < nRanks; ++ranki)
    {
        for (const point& startPosition : toNumber[ranki])
        {
            numbers[ranki].append(
                known.insert({startPosition, label(known.size())}).first->second
            );
        }
    }
    const label start = before(label(known.size()), exchange);
    for (DynamicList<label>& ofRank : numbers)
    {
        for (label& number : ofRank)
        {
            number += start;
        }
    }
    const std::vector<List<label>> answers(exchange.exchangeLists(numbers));
    labelList next(nRanks, 0), result(n);
    forAll(result, i)
    {
        const label ranki = asksFrom[i];
        result[i] = answers[ranki][next[ranki]++];
    }
    return result;
}

} // namespace Foam::stability
