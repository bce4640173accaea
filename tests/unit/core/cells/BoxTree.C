// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/cells/BoxTree.H"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace Foam::stability
{

TEST(BoxTree, findsWhatAListWouldFind)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<scalar> number(0, 1);
    const auto box = [&](scalar size)
    {
        const point x(number(random), number(random), number(random));
        const vector s(number(random), number(random), number(random));
        return boundBox(x, x + size * s);
    };
    DynamicList<boundBox> boxes;
    for (label i = 0; i < 500; ++i)
    {
        boxes.append(box(i % 50 ? 0.05 : 0.5));
    }
    const BoxTree tree(boxes);
    label nFound = 0;
    for (label i = 0; i < 200; ++i)
    {
        const boundBox wanted(box(0.1));
        std::set<label> expected, found;
        forAll(boxes, k)
        {
            if (boxes[k].overlaps(wanted))
            {
                expected.insert(k);
            }
        }
        const bool stopped = tree.meets(
            wanted,
            [&](label k)
            {
                EXPECT_TRUE(found.insert(k).second);
                return false;
            }
        );
        EXPECT_FALSE(stopped);
        EXPECT_EQ(found, expected);
        EXPECT_EQ(tree.meets(wanted), !expected.empty());
        nFound += found.size();
    }
    EXPECT_GT(nFound, 30);
}

TEST(BoxTree, withoutBoxesFindsNothing)
{
    EXPECT_FALSE(BoxTree().meets(boundBox(point::zero, point::one)));
    EXPECT_FALSE(BoxTree(List<boundBox>()).meets(boundBox(point::zero, point::one)));
}

} // namespace Foam::stability
