// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/ranks/Exchange.H"

#include "shapes/ThreadRanks.H"

#include <gtest/gtest.h>

#include <cmath>
#include <new>

using namespace Foam;
using namespace Foam::stability;

namespace
{

// Counts what is sent to other ranks.
class CountingExchange : public Exchange
{
public:
    explicit CountingExchange(const Exchange& exchange) : exchange_(exchange) {}

    label nRanks() const override { return exchange_.nRanks(); }
    label rank() const override { return exchange_.rank(); }
    std::string firstNonEmpty(const std::string& text) const override
    {
        return exchange_.firstNonEmpty(text);
    }

    label nMessages() const { return nMessages_; }

private:
    std::vector<Packet> send(std::vector<Packet> toRanks) const override
    {
        for (label ranki = 0; ranki < nRanks(); ++ranki)
        {
            nMessages_ += ranki != rank() && !toRanks[ranki].empty();
        }
        return exchange_.exchange(std::move(toRanks));
    }
    label sumOf(label value) const override { return exchange_.total(value); }

    const Exchange& exchange_;
    mutable label nMessages_ = 0;
};

} // namespace

// One packet of each rank on all, in the order of the ranks, also an empty one; in as
// many messages as it takes to double up to the number of ranks.
TEST(Exchange, toAllNeedsFewMessages)
{
    for (const label n : {1, 2, 3, 4, 5, 8, 9})
    {
        std::vector<labelList> received(n);
        labelList nMessages(n);
        shapes::onRanks(
            n,
            [&](const Exchange& ranks)
            {
                const CountingExchange exchange(ranks);
                Packet packet;
                if (exchange.rank() != 1)
                {
                    packet.put(exchange.rank() + 10);
                }
                for (Packet& other : exchange.toAll(packet))
                {
                    received[exchange.rank()].append(
                        other.empty() ? -1 : other.get<label>()
                    );
                }
                nMessages[exchange.rank()] = exchange.nMessages();
            }
        );
        labelList wanted;
        for (label ranki = 0; ranki < n; ++ranki)
        {
            wanted.append(ranki == 1 ? -1 : ranki + 10);
        }
        for (label ranki = 0; ranki < n; ++ranki)
        {
            EXPECT_EQ(received[ranki], wanted) << n << ' ' << ranki;
            EXPECT_EQ(nMessages[ranki], label(std::ceil(std::log2(n))));
        }
    }
}

// A rank that fails between collective calls, or within an inner runOnAllRanks; the
// others throw its message at whatever they call next, and all can go on afterwards.
TEST(Exchange, whatFailsOnOneRankFailsOnAll)
{
    for (label at = 0; at < 4; ++at)
    {
        std::vector<std::string> messages(3);
        labelList totals(3, -1);
        const auto work = [&](const Exchange& exchange)
        {
            const auto fail = [&](label here)
            {
                if (here == at && exchange.rank() == 1)
                {
                    throw std::bad_alloc();
                }
            };
            const auto several = [&]
            {
                fail(0);
                exchange.total(1);
                runOnAllRanks(exchange, [&] { fail(1); });
                fail(2);
                exchange.toAll(Packet());
                fail(3);
            };
            try
            {
                runOnAllRanks(exchange, several);
            }
            catch (const NumericalFailure& failure)
            {
                messages[exchange.rank()] = failure.what();
            }
            totals[exchange.rank()] = exchange.total(2);
        };
        shapes::onRanks(3, work);
        EXPECT_FALSE(messages[0].empty()) << at;
        EXPECT_EQ(messages[1], messages[0]) << at;
        EXPECT_EQ(messages[2], messages[0]) << at;
        EXPECT_EQ(totals, labelList(3, label(6))) << at;
    }
}
