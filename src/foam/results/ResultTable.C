// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/results/ResultTable.H"

#include "core/base/FileReplacement.H"
#include "core/base/Version.H"

#include <iomanip>

namespace Foam::stability
{

// Sign, point and exponent are added to the digits.
int TableText::width() const
{
    return precision_ + 8;
}

void TableText::setHeader(
    const std::string& comment, const std::vector<std::string>& names
)
{
    std::ostringstream os;
    os << "# " << generator() << "\n# " << comment << "\n# " << std::left;
    for (std::size_t i = 0; i < names.size(); ++i)
    {
        os << (i ? "\t" : "") << std::setw(i ? width() : width() - 2) << names[i];
    }
    os << '\n';
    header_ = os.str();
}

std::ostream& TableText::nextCell()
{
    row_ << (row_.tellp() > 0 ? "\t" : "");
    return row_ << std::left << std::setprecision(precision_) << std::setw(width());
}

void TableText::addNumber(scalar value)
{
    nextCell() << value;
}

void TableText::addWords(const std::string& words)
{
    nextCell() << words;
}

void TableText::endRow()
{
    lastRow_ = rows_.size();
    rows_ += row_.str() + '\n';
    row_ = std::ostringstream();
}

void TableText::dropLastRow()
{
    rows_.resize(lastRow_);
}

void TableText::write(const fileName& path) const
{
    replaceFile(path, header_ + rows_);
}

} // namespace Foam::stability
