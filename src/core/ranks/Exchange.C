// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/ranks/Exchange.H"

#include "core/base/Errors.H"

#include <algorithm>

namespace Foam::stability
{

std::vector<Packet> Exchange::toMaster(Packet packet) const
{
    std::vector<Packet> toRanks(nRanks());
    toRanks[0] = std::move(packet);
    return exchange(std::move(toRanks));
}

Packet Exchange::fromMaster(const Packet& packet) const
{
    return std::move(
        exchange(std::vector<Packet>(nRanks(), isMaster() ? packet : Packet()))[0]
    );
}

// In rounds: in each, a rank passes on as much as it has, to the rank as many places
// below it (Bruck et al., IEEE Transactions on Parallel and Distributed Systems 8,
// 1997).
std::vector<Packet> Exchange::toAll(const Packet& packet) const
{
    const label n = nRanks();
    std::vector<Packet> here{packet}; // of this rank, the next one, and so on
    for (label step = 1; step < n; step *= 2)
    {
        std::vector<Packet> toRanks(n);
        const label nPassed = std::min(step, n - step);
        Packet& passed = toRanks[(rank() - step + n) % n];
        for (label i = 0; i < nPassed; ++i)
        {
            passed.putList(here[i].bytes());
        }
        toRanks = exchange(std::move(toRanks));
        Packet& received = toRanks[(rank() + step) % n];
        for (label i = 0; i < nPassed; ++i)
        {
            here.emplace_back(received.getList<char>());
        }
    }
    std::rotate(here.begin(), here.end() - rank(), here.end());
    return here;
}

void runOnAllRanks(const Exchange& exchange, const std::function<void()>& work)
{
    if (exchange.nRanks() == 1)
    {
        work();
        return;
    }
    exchange.forget();
    std::string failure;
    try
    {
        work();
    }
    catch (const std::exception& caught)
    {
        if (exchange.allThrew())
        {
            throw; // a collective call, or an inner runOnAllRanks
        }
        failure = describe(caught);
    }
    exchange.throwIfAny<NumericalFailure>(failure);
}

void runOnMaster(const Exchange& exchange, const std::function<void()>& work)
{
    runOnAllRanks(
        exchange,
        [&]
        {
            if (exchange.isMaster())
            {
                work();
            }
        }
    );
}

} // namespace Foam::stability
