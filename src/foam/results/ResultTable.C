// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

#include "foam/results/ResultTable.H"

#include "core/base/FileReplacement.H"
#include "core/base/Version.H"

#include <iomanip>
#include <sstream>

namespace Foam::stability
{

namespace
{

constexpr int addedWidth = 8; // sign, point and exponent

} // namespace

void ResultTable::setColumns(const std::vector<std::string>& names)
{
    const label width = precision_ + addedWidth;
    std::ostringstream os;
    os << "# " << generator() << "\n# " << title_ << "\n# " << std::left;
    for (std::size_t i = 0; i < names.size(); ++i)
    {
        os << (i ? "\t" : "") << std::setw(i ? width : width - 2) << names[i];
    }
    os << '\n';
    header_ = os.str();
}

void ResultTable::addRow(const std::vector<scalar>& values)
{
    std::ostringstream os;
    os << std::left << std::setprecision(precision_);
    for (std::size_t i = 0; i < values.size(); ++i)
    {
        os << (i ? "\t" : "") << std::setw(precision_ + addedWidth) << values[i];
    }
    os << '\n';
    lastRow_ = rows_.size();
    rows_ += os.str();
}

void ResultTable::dropLastRow()
{
    rows_.resize(lastRow_);
}

void ResultTable::write(const fileName& path) const
{
    replaceFile(path, header_ + rows_);
}

} // namespace Foam::stability
