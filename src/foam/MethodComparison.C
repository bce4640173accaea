// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/MethodComparison.H"

#include "core/base/FileOperations.H"
#include "foam/results/ResultSet.H"
#include "foam/results/ResultTable.H"

#include <iomanip>
#include <sstream>

namespace Foam::stability
{

void MethodComparison::prepare(const fileName& folder, const Exchange& exchange)
{
    runOnMaster(
        exchange,
        [&]
        {
            makeFolders(folder);
            const fileName file(folder / methodTable().file);
            if (isThere(file) && !isOwnTable(file))
            {
                refuseInTheWay(file);
            }
        }
    );
}

void MethodComparison::write(const fileName& folder) const
{
    constexpr label precision = 15;
    ResultTable<MethodScore> table(methodTable(), precision);
    for (const MethodScore& score : scores_)
    {
        table.addRow(score);
    }
    table.write(folder);
}

std::string MethodComparison::verdict() const
{
    const std::size_t best = mostConsistent(scores_);
    std::ostringstream os;
    os << std::setprecision(3) << "Most consistent with the flow is "
       << scores_[best].name() << ": its interfaces lie "
       << scores_[best].meanDistance() << " cells on average from where the flow "
       << "carried them";
    for (std::size_t i = 0; i < scores_.size(); ++i)
    {
        if (i != best)
        {
            os << ", " << scores_[i].name() << "'s " << scores_[i].meanDistance();
        }
    }
    os << '.';
    return os.str();
}

} // namespace Foam::stability
