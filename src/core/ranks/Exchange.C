// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/ranks/Exchange.H"

#include "core/base/Errors.H"

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

std::vector<Packet> Exchange::toAll(const Packet& packet) const
{
    return exchange(std::vector<Packet>(nRanks(), packet));
}

void runOnAllRanks(const Exchange& exchange, const std::function<void()>& work)
{
    if (exchange.nRanks() == 1)
    {
        work();
        return;
    }
    std::string failure;
    try
    {
        work();
    }
    catch (const std::exception& caught)
    {
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
