// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

#include "core/analysis/Quantiles.H"

#include "core/ranks/ExactSum.H"

#include <algorithm>
#include <cstring>

namespace Foam::stability
{

namespace
{

// The bits of values that are not negative are ordered as the values.
using Bits = std::uint64_t;

Bits bitsOf(scalar value)
{
    Bits bits;
    value += 0; // not -0
    std::memcpy(&bits, &value, sizeof(bits));
    return bits;
}

scalar valueOf(Bits bits)
{
    scalar value;
    std::memcpy(&value, &bits, sizeof(value));
    return value;
}

struct Entry
{
    Bits value;
    scalar weight;
};

// The search for one quantile: it lies in [low, high].
struct Search
{
    Bits low = 0, high = bitsOf(VGREAT);
    std::size_t first = 0, last; // of the entries that may still decide
    ExactSum before;             // weight of those before them

    Bits middle() const { return low + (high - low) / 2; }
};

std::vector<Entry> sorted(const scalarField& values, const scalarField& weights)
{
    std::vector<Entry> entries;
    forAll(values, i)
    {
        if (weights[i] > 0)
        {
            entries.push_back({bitsOf(values[i]), weights[i]});
        }
    }
    std::sort(
        entries.begin(), entries.end(),
        [](const Entry& a, const Entry& b) { return a.value < b.value; }
    );
    return entries;
}

} // namespace

std::vector<scalar> weightedQuantiles(
    const scalarField& values, const scalarField& weights,
    const std::vector<scalar>& fractions, const Exchange& exchange
)
{
    const std::vector<Entry> entries(sorted(values, weights));
    List<ExactSum> total(1);
    for (const Entry& entry : entries)
    {
        total[0].add(entry.weight);
    }
    sum(total, exchange);
    const scalar all = total[0].value();
    if (!(all > 0))
    {
        return std::vector<scalar>(fractions.size(), 0);
    }

    std::vector<Search> searches(fractions.size());
    for (Search& search : searches)
    {
        search.last = entries.size();
    }
    // All ranks halve the same intervals, so that all end together.
    for (Bits width = bitsOf(VGREAT); width > 0; width /= 2)
    {
        List<ExactSum> here(label(searches.size()));
        std::vector<std::size_t> ends(searches.size());
        for (std::size_t i = 0; i < searches.size(); ++i)
        {
            const Search& search = searches[i];
            here[i] = search.before;
            std::size_t& end = ends[i];
            for (end = search.first;
                 end < search.last && entries[end].value <= search.middle(); ++end)
            {
                here[i].add(entries[end].weight);
            }
        }
        List<ExactSum> everywhere(here);
        sum(everywhere, exchange);
        for (std::size_t i = 0; i < searches.size(); ++i)
        {
            Search& search = searches[i];
            const bool reached = everywhere[i].value() >= fractions[i] * all;
            if (search.low == search.high)
            {
                continue;
            }
            if (reached)
            {
                search.high = search.middle();
                search.last = ends[i];
            }
            else
            {
                search.low = search.middle() + 1;
                search.first = ends[i];
                search.before = here[i];
            }
        }
    }
    std::vector<scalar> result;
    for (const Search& search : searches)
    {
        result.push_back(valueOf(search.low));
    }
    return result;
}

} // namespace Foam::stability
