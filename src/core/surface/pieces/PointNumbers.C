// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/surface/pieces/PointNumbers.H"

#include <functional>
#include <unordered_map>

namespace Foam::stability
{

namespace
{

struct HashOfKey
{
    std::size_t operator()(const PointKey& key) const
    {
        return std::hash<label>()(key.number) + 31 * std::size_t(key.image);
    }
};

} // namespace

label sumBefore(label nHere, const Exchange& exchange)
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

// The hash of a key determines the rank that numbers it.
labelList pointNumbers(const SurfaceOrder& piece, const Exchange& exchange)
{
    const label n = piece.pointKeys.size(), nRanks = exchange.nRanks();
    if (nRanks == 1 || !piece.sharesPoints)
    {
        return identity(n, sumBefore(n, exchange));
    }
    std::vector<DynamicList<PointKey>> asked(nRanks);
    labelList asksFrom(n);
    forAll(piece.pointKeys, i)
    {
        asksFrom[i] = label(HashOfKey()(piece.pointKeys[i]) % std::size_t(nRanks));
        asked[asksFrom[i]].append(piece.pointKeys[i]);
    }
    std::unordered_map<PointKey, label, HashOfKey> known;
    std::vector<DynamicList<label>> numbers(nRanks);
    const std::vector<List<PointKey>> toNumber(exchange.exchangeLists(asked));
    for (label ranki = 0; ranki < nRanks; ++ranki)
    {
        for (const PointKey& key : toNumber[ranki])
        {
            numbers[ranki].append(known.insert({key, label(known.size())}).first->second
            );
        }
    }
    const label start = sumBefore(label(known.size()), exchange);
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
