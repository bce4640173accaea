// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

#include "foam/ranks/OnAll.H"

#include "foam/errors/Failures.H"

namespace Foam::stability
{

void onAll(const RankMessages& messages, const std::function<void()>& work)
{
    if (messages.nRanks() == 1)
    {
        work();
    }
    else
    {
        messages.agree<std::runtime_error>(failureOf(work));
    }
}

void onMaster(const RankMessages& messages, const std::function<void()>& work)
{
    onAll(
        messages,
        [&]
        {
            if (messages.rank() == 0)
            {
                work();
            }
        }
    );
}

} // namespace Foam::stability
