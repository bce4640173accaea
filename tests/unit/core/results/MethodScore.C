// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/results/MethodScore.H"

#include <gtest/gtest.h>

#include <map>

using namespace Foam;
using namespace Foam::stability;

namespace
{

// Everything lies as far as this, which is one of the distances of the table.
Statistics allAt(scalar distance)
{
    Statistics s;
    s.interval = 1;
    s.area = s.stableArea = 2;
    s.volumeError = -0.1;
    for (std::size_t i = 0; i < Statistics::survivalDistances.size(); ++i)
    {
        const bool beyond = Statistics::survivalDistances[i] <= distance;
        s.detachedFraction[i] = s.attachedFraction[i] = beyond ? 1 : 0;
    }
    return s;
}

} // namespace

TEST(MethodScore, meanDistanceIsTheAreaUnderTheCurve)
{
    MethodScore score("a");
    score.add(allAt(0.5));
    // Full up to 0.5, then straight down to nothing at 1.
    EXPECT_NEAR(score.meanDistance(), 0.75, 1e-14);
    score.add(allAt(1.5)); // 1.75 of its own
    EXPECT_NEAR(score.meanDistance(), 1.25, 1e-14);
    EXPECT_EQ(score.nTimes(), 2);
}

TEST(MethodScore, leavesOutTimesThatCompareNothing)
{
    MethodScore score("a");
    Statistics first = allAt(1);
    first.interval = 0;
    score.add(first);
    Statistics empty = allAt(1);
    empty.area = 0;
    score.add(empty);
    EXPECT_EQ(score.nTimes(), 0);
    score.add(allAt(0.05));
    std::map<std::string, scalar> values;
    for (const TableColumn<MethodScore>& column : methodTable().columns)
    {
        if (!column.text)
        {
            values[column.name] = column.value(score);
        }
    }
    EXPECT_EQ(methodTable().columns[0].text(score), "a");
    EXPECT_EQ(values.size() + 1, methodTable().columns.size());
    EXPECT_EQ(values.at("times"), 1);
    EXPECT_NEAR(values.at("stableFraction"), 1, 1e-14);
    EXPECT_NEAR(values.at("volumeError"), 0.1, 1e-14);
    EXPECT_NEAR(values.at("attached(0.05)"), 1, 1e-14);
    EXPECT_EQ(values.at("attached(0.1)"), 0);
}

TEST(MethodScore, theNearestIsMostConsistent)
{
    std::vector<MethodScore> scores{
        MethodScore("a"), MethodScore("b"), MethodScore("c")};
    scores[0].add(allAt(1));
    scores[1].add(allAt(0.25));
    scores[2].add(allAt(0.25));
    EXPECT_EQ(mostConsistent(scores), 1u);
}
