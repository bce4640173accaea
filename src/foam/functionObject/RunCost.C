// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/functionObject/RunCost.H"

#include "Pstream.H"
#include "PstreamReduceOps.H"

#include <iomanip>
#include <sstream>

#include <sys/resource.h>

namespace Foam::stability
{

std::string RunCost::text() const
{
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const scalar total =
        returnReduce(ScopedTimer::secondsSince(begin_), maxOp<scalar>());
    const scalar seconds = returnReduce(seconds_, maxOp<scalar>());
    const scalar memory =
        returnReduce(scalar(usage.ru_maxrss), maxOp<scalar>()); // [kB]
    std::ostringstream os;
    os << std::fixed << std::setprecision(2) << "the analysis took " << seconds
       << " s, " << std::setprecision(1) << (total > 0 ? 100 * seconds / total : 0)
       << " % of " << std::setprecision(2) << total
       << " s since it began; peak memory of the process " << std::setprecision(0)
       << memory / 1024 << " MB";
    return os.str();
}

} // namespace Foam::stability
