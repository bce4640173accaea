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

constexpr Bits largestBits = 0x7fefffffffffffff; // of the largest finite value

ExactSum
weightOf(const std::vector<Entry>& entries, std::size_t first, std::size_t last)
{
    ExactSum weight;
    for (; first < last; ++first)
    {
        weight.add(entries[first].weight);
    }
    return weight;
}

// The search for one quantile: it lies in [low, high].
class Search
{
public:
    Search(const std::vector<Entry>& entries, scalar wanted, const ExactSum& weight)
        : entries_(entries), wanted_(wanted), last_(entries.size()), inside_(weight)
    {
    }

    // The weight here of what does not exceed the middle of the interval.
    ExactSum weightUpToMiddle()
    {
        end_ = std::upper_bound(
                   entries_.begin() + first_, entries_.begin() + last_, middle(),
                   [](Bits value, const Entry& entry) { return value < entry.value; }
               )
               - entries_.begin();
        // Of both parts the shorter one is summed: in all every entry about once.
        if (end_ - first_ < last_ - end_)
        {
            lower_ = weightOf(entries_, first_, end_);
        }
        else
        {
            lower_ = inside_;
            lower_.subtract(weightOf(entries_, end_, last_));
        }
        ExactSum weight(before_);
        weight.add(lower_);
        return weight;
    }

    // Halves the interval by that weight of all ranks: down to 0 if there is none.
    void halve(scalar weight)
    {
        if (low_ == high_)
        {
            return;
        }
        if (weight >= wanted_)
        {
            high_ = middle();
            last_ = end_;
            inside_ = lower_;
        }
        else
        {
            low_ = middle() + 1;
            first_ = end_;
            before_.add(lower_);
            inside_.subtract(lower_);
        }
    }

    scalar found() const { return valueOf(low_); }

private:
    Bits middle() const { return low_ + (high_ - low_) / 2; }

    const std::vector<Entry>& entries_;
    scalar wanted_; // weight of all ranks up to the quantile
    Bits low_ = 0, high_ = largestBits;
    std::size_t first_ = 0, last_, end_ = 0; // of entries in the interval; of its half
    ExactSum before_, inside_, lower_;       // weights of those
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
    const ExactSum here(weightOf(entries, 0, entries.size()));
    List<ExactSum> sums(1, here);
    sum(sums, exchange);
    const scalar total = sums[0].value();
    std::vector<Search> searches;
    for (const scalar fraction : fractions)
    {
        searches.emplace_back(entries, fraction * total, here);
    }
    sums.setSize(label(searches.size()));
    // All ranks halve the same intervals, so that all end together.
    for (Bits width = largestBits; width > 0; width /= 2)
    {
        std::transform(
            searches.begin(), searches.end(), sums.begin(),
            [](Search& search) { return search.weightUpToMiddle(); }
        );
        sum(sums, exchange);
        for (std::size_t i = 0; i < searches.size(); ++i)
        {
            searches[i].halve(sums[label(i)].value());
        }
    }
    std::vector<scalar> result;
    for (const Search& search : searches)
    {
        result.push_back(search.found());
    }
    return result;
}

} // namespace Foam::stability
