// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/surface/pieces/KeyOrder.H"
#include "shapes/ThreadRanks.H"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

using namespace Foam;
using namespace Foam::stability;

namespace
{

// In their order: by x, y, z and place, each of which decides.
List<TriangleKey> orderedKeys()
{
    DynamicList<TriangleKey> keys;
    for (const scalar x : {-2.0, -0.5, 0.3})
    {
        for (const scalar y : {-1.0, 1e-300, 7.0})
        {
            for (const scalar z : {-4.0, -3.9999999999999996, 0.0})
            {
                for (const label place : {0, 2, 10})
                {
                    keys.append(TriangleKey{point(x, y, z), place});
                }
            }
        }
    }
    return List<TriangleKey>(keys);
}

} // namespace

// Dealt out at random; the second of several ranks gets nothing.
TEST(KeyOrder, placesAreThoseAmongTheKeysOfAllRanks)
{
    const List<TriangleKey> keys(orderedKeys());
    std::vector<label> dealt(keys.size());
    std::iota(dealt.begin(), dealt.end(), label(0));
    std::shuffle(dealt.begin(), dealt.end(), std::mt19937(5));
    for (const label n : {1, 2, 3, 5})
    {
        std::vector<labelList> truths(n), found(n, labelList(1, -1));
        std::vector<List<TriangleKey>> hands(n);
        for (std::size_t i = 0; i < dealt.size(); ++i)
        {
            const label rank = n > 1 && label(i) % n == 1 ? 0 : label(i) % n;
            truths[rank].append(dealt[i]);
            hands[rank].append(keys[dealt[i]]);
        }
        shapes::onRanks(
            n,
            [&](const Exchange& exchange)
            {
                const label rank = exchange.rank();
                found[rank] = placesInOrder(hands[rank], exchange);
            }
        );
        for (label rank = 0; rank < n; ++rank)
        {
            EXPECT_EQ(found[rank], truths[rank]) << rank << " of " << n;
        }
    }
}

TEST(KeyOrder, ofNothingIsNothing)
{
    List<labelList> found(3, labelList(1, -1));
    shapes::onRanks(
        3, [&](const Exchange& exchange)
        { found[exchange.rank()] = placesInOrder(List<TriangleKey>(), exchange); }
    );
    for (const labelList& places : found)
    {
        EXPECT_TRUE(places.empty());
    }
}
