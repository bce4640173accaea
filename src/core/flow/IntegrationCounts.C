// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/flow/IntegrationCounts.H"

namespace Foam::stability
{

IntegrationCounts& IntegrationCounts::operator+=(const IntegrationCounts& part)
{
    nSteps += part.nSteps;
    nRejected += part.nRejected;
    nLeft += part.nLeft;
    nStuck += part.nStuck;
    nLost += part.nLost;
    nElsewhere += part.nElsewhere;
    return *this;
}

IntegrationCounts total(const IntegrationCounts& here, const Exchange& exchange)
{
    IntegrationCounts all;
    all.nSteps = exchange.total(here.nSteps);
    all.nRejected = exchange.total(here.nRejected);
    all.nLeft = exchange.total(here.nLeft);
    all.nStuck = exchange.total(here.nStuck);
    all.nLost = exchange.total(here.nLost);
    return all;
}

} // namespace Foam::stability
