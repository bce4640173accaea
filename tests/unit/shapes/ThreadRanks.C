// SPDX-License-Identifier: GPL-3.0-or-later

#include "shapes/ThreadRanks.H"

#include <gtest/gtest.h>

#include <stdexcept>

using namespace Foam;
using namespace Foam::stability;
using namespace Foam::stability::shapes;

// Twice, lest the second packets overtake the first. A packet that is not sent arrives
// empty.
TEST(ThreadRanks, ExchangePackets)
{
    const label n = 3;
    std::vector<labelList> received(n, labelList(2 * n, -1));
    onRanks(
        n,
        [&](const Exchange& exchange)
        {
            for (label round = 0; round < 2; ++round)
            {
                std::vector<Packet> packets(n);
                for (label to = 0; to < n; ++to)
                {
                    if (to != 1 || exchange.rank() != 2)
                    {
                        packets[to].put(100 * round + 10 * exchange.rank() + to);
                    }
                }
                packets = exchange.exchange(std::move(packets));
                for (label from = 0; from < n; ++from)
                {
                    received[exchange.rank()][round * n + from] =
                        packets[from].empty() ? -2 : packets[from].get<label>();
                }
            }
        }
    );
    EXPECT_EQ(received[0], labelList({0, 10, 20, 100, 110, 120}));
    EXPECT_EQ(received[1], labelList({1, 11, -2, 101, 111, -2}));
    EXPECT_EQ(received[2], labelList({2, 12, 22, 102, 112, 122}));
}

TEST(ThreadRanks, AddUpAndFindTheFirst)
{
    for (const label n : {1, 2, 5})
    {
        labelList totals(n, -1);
        std::vector<std::string> firsts(n);
        onRanks(
            n,
            [&](const Exchange& exchange)
            {
                const label rank = exchange.rank();
                totals[rank] = exchange.total(rank + 3);
                firsts[rank] = exchange.firstNonEmpty(
                    rank == 0 && n > 1 ? "" : std::to_string(rank)
                );
            }
        );
        for (label rank = 0; rank < n; ++rank)
        {
            EXPECT_EQ(totals[rank], n * (n - 1) / 2 + 3 * n);
            EXPECT_EQ(firsts[rank], n > 1 ? "1" : "0");
        }
    }
}

// What is thrown on one rank reaches the test, and nobody waits for that rank.
TEST(ThreadRanks, EndWithTheFailureOfTheLowest)
{
    const auto work = [](const Exchange& exchange)
    {
        if (exchange.rank() == 0)
        {
            throw std::out_of_range("broken");
        }
        exchange.total(1);
    };
    EXPECT_THROW(onRanks(3, work), std::out_of_range);
    EXPECT_THROW(
        onRanks(
            2,
            [](const Exchange& exchange)
            {
                if (exchange.rank() == 0)
                {
                    exchange.total(1);
                }
            }
        ),
        std::logic_error
    );
}

TEST(ThreadRanks, FailTogether)
{
    labelList failed(3, 0);
    onRanks(
        3,
        [&](const Exchange& exchange)
        {
            try
            {
                runOnAllRanks(
                    exchange,
                    [&]
                    {
                        if (exchange.rank() == 1)
                        {
                            throw std::runtime_error("on rank 1");
                        }
                    }
                );
            }
            catch (const NumericalFailure& failure)
            {
                failed[exchange.rank()] = std::string(failure.what()) == "on rank 1";
            }
        }
    );
    EXPECT_EQ(failed, labelList(3, 1));
}
