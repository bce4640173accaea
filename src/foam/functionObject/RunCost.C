// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

#include "foam/functionObject/RunCost.H"

#include <iomanip>
#include <sstream>

#include <sys/resource.h>

namespace Foam::stability
{

std::string RunCost::text() const
{
    const scalar total = Busy::secondsSince(begin_);
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    std::ostringstream os;
    os << std::fixed << std::setprecision(2) << "the analysis took " << seconds_
       << " s, " << std::setprecision(1) << (total > 0 ? 100 * seconds_ / total : 0)
       << " % of " << std::setprecision(2) << total
       << " s since it began; peak memory of the process " << std::setprecision(0)
       << scalar(usage.ru_maxrss) / 1024 << " MB"; // from kB
    return os.str();
}

} // namespace Foam::stability
