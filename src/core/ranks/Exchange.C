// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

#include "core/ranks/Exchange.H"

#include "core/base/Errors.H"
#include "error.H"

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

void together(const Exchange& exchange, const std::function<void()>& work)
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
    catch (const Foam::error& caught) // it does not tell by what()
    {
        failure = "OpenFOAM: " + caught.message();
    }
    catch (const std::exception& caught)
    {
        failure = caught.what();
        failure += failure.empty() ? "an exception without a text" : "";
    }
    exchange.agree<NumericalFailure>(failure);
}

} // namespace Foam::stability
