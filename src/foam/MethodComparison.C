// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

#include "foam/MethodComparison.H"

#include "core/base/FileReplacement.H"
#include "core/base/Version.H"
#include "OSspecific.H"

#include <iomanip>
#include <sstream>
#include <stdexcept>

namespace Foam::stability
{

void MethodComparison::write(const fileName& path) const
{
    constexpr int width = 23, precision = 15;
    std::ostringstream os;
    os << "# " << generator()
       << "\n# Means over the classified times; meanDistance in cells, area in m2\n# "
       << std::left << std::setw(width - 2) << "method";
    for (const std::string& name : MethodScore::columns())
    {
        os << '\t' << std::setw(width) << name;
    }
    os << '\n' << std::setprecision(precision);
    for (const MethodScore& score : scores_)
    {
        os << std::setw(width) << score.name();
        for (const scalar value : score.values())
        {
            os << '\t' << std::setw(width) << value;
        }
        os << '\n';
    }
    if (!mkDir(path.path()))
    {
        throw std::runtime_error("Cannot make the folder " + path.path() + ".");
    }
    replaceFile(path, os.str());
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
