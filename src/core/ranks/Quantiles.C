// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/ranks/Quantiles.H"

#include "core/ranks/ExactSum.H"
#include "SubList.H"

#include <algorithm>
#include <array>
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

constexpr int allBits = 63; // of a value
constexpr int mostBits = 4; // found in one round

// The search for one quantile: it lies in [low, low + 2^nBits).
class Search
{
public:
    Search(const std::vector<Entry>& entries, scalar wanted)
        : entries_(entries), wanted_(wanted), last_(entries.size())
    {
    }

    // The weights here of what does not exceed the ends of the parts of the interval,
    // the last part left out.
    void weigh(UList<ExactSum>& weights)
    {
        ExactSum sum(before_);
        std::size_t from = first_;
        forAll(weights, i)
        {
            ends_[i] =
                std::upper_bound(
                    entries_.begin() + from, entries_.begin() + last_, endOf(i),
                    [](Bits value, const Entry& entry) { return value < entry.value; }
                )
                - entries_.begin();
            sum.add(weightOf(entries_, from, ends_[i]));
            from = ends_[i];
            weights[i] = weights_[i] = sum;
        }
    }

    // Goes on in one of the parts, by those weights of all ranks: in the first if there
    // is none.
    void choose(const UList<ExactSum>& weights)
    {
        label part = 0;
        while (part < weights.size() && weights[part].value() < wanted_)
        {
            ++part;
        }
        if (part < weights.size())
        {
            last_ = ends_[part];
        }
        if (part > 0)
        {
            first_ = ends_[part - 1];
            before_ = weights_[part - 1];
            low_ = endOf(part - 1) + 1;
        }
        nBits_ -= step();
    }

    // Bits that the next round finds.
    int step() const { return std::min(nBits_, mostBits); }

    scalar found() const { return valueOf(low_); }

private:
    Bits endOf(label part) const
    {
        return low_ + (Bits(part + 1) << (nBits_ - step())) - 1;
    }

    const std::vector<Entry>& entries_;
    scalar wanted_; // weight of all ranks up to the quantile
    Bits low_ = 0;
    int nBits_ = allBits;
    std::size_t first_ = 0, last_; // of the entries in the interval
    ExactSum before_;              // weight of those before
    std::array<std::size_t, (1 << mostBits) - 1> ends_; // of the parts
    std::array<ExactSum, (1 << mostBits) - 1> weights_; // here
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
    List<ExactSum> sums(1, weightOf(entries, 0, entries.size()));
    sum(sums, exchange);
    const scalar total = sums[0].value();
    std::vector<Search> searches;
    searches.reserve(fractions.size());
    for (const scalar fraction : fractions)
    {
        searches.emplace_back(entries, fraction * total);
    }
    // All ranks divide the same intervals, so that all end together.
    while (!searches.empty() && searches[0].step() > 0)
    {
        const label nEnds = (1 << searches[0].step()) - 1;
        sums.setSize(label(searches.size()) * nEnds);
        const auto weightsOf = [&](std::size_t i)
        { return SubList<ExactSum>(sums, nEnds, label(i) * nEnds); };
        for (std::size_t i = 0; i < searches.size(); ++i)
        {
            auto weights = weightsOf(i);
            searches[i].weigh(weights);
        }
        sum(sums, exchange);
        for (std::size_t i = 0; i < searches.size(); ++i)
        {
            searches[i].choose(weightsOf(i));
        }
    }
    std::vector<scalar> result;
    result.reserve(searches.size());
    for (const Search& search : searches)
    {
        result.push_back(search.found());
    }
    return result;
}

} // namespace Foam::stability
