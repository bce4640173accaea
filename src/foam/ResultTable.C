// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

#include "foam/ResultTable.H"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <stdexcept>

namespace Foam::stability
{

namespace
{

constexpr int precision = 15; // digits: what a table must keep to be compared
constexpr int width = precision + 8;

} // namespace

void writeWholeFile(const fileName& path, const std::string& text)
{
    const std::string temporary = path + ".part";
    errno = 0;
    std::ofstream file(temporary, std::ios::binary | std::ios::trunc);
    file << text;
    file.close();
    if (!file || std::rename(temporary.c_str(), path.c_str()) != 0)
    {
        const std::string cause = errno ? std::strerror(errno) : "unknown cause";
        std::remove(temporary.c_str());
        throw std::runtime_error("Cannot write " + path + ": " + cause + ".");
    }
}

void ResultTable::setColumns(const std::vector<std::string>& names)
{
    std::ostringstream os;
    os << "# " << title_ << "\n# " << std::left;
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
    os << std::left << std::setprecision(precision);
    for (std::size_t i = 0; i < values.size(); ++i)
    {
        os << (i ? "\t" : "") << std::setw(width) << values[i];
    }
    os << '\n';
    rows_ += os.str();
}

void ResultTable::write(const fileName& path) const
{
    writeWholeFile(path, header_ + rows_);
}

} // namespace Foam::stability
