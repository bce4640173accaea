// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

#include "Table.H"

#include <cmath>
#include <fstream>
#include <sstream>
#include <vector>

namespace Foam::stability
{

namespace
{

std::vector<std::string> words(const std::string& line)
{
    std::istringstream stream(line);
    std::vector<std::string> result;
    for (std::string word; stream >> word;)
    {
        result.push_back(word);
    }
    return result;
}

} // namespace

TableRow readTableRow(const std::filesystem::path& path, double time)
{
    std::ifstream stream(path);
    std::vector<std::string> names;
    for (std::string line; std::getline(stream, line);)
    {
        if (line.rfind('#', 0) == 0)
        {
            names = words(line.substr(1));
            continue;
        }
        const std::vector<std::string> values = words(line);
        if (values.empty() || values.size() != names.size())
        {
            continue;
        }
        const double rowTime = std::strtod(values[0].c_str(), nullptr);
        if (std::abs(rowTime - time) > 1e-6 * std::max(1.0, std::abs(time)))
        {
            continue;
        }
        TableRow row;
        for (std::size_t i = 0; i < values.size(); ++i)
        {
            row[names[i]] = std::strtod(values[i].c_str(), nullptr);
        }
        return row;
    }
    return {};
}

} // namespace Foam::stability
