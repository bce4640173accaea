// SPDX-License-Identifier: GPL-3.0-or-later

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

std::vector<std::pair<std::string, TableRow>>
readNamedRows(const std::filesystem::path& path)
{
    std::ifstream stream(path);
    std::vector<std::string> names;
    std::vector<std::pair<std::string, TableRow>> rows;
    for (std::string line; std::getline(stream, line);)
    {
        if (line.rfind('#', 0) == 0)
        {
            names = words(line.substr(1));
            continue;
        }
        const std::vector<std::string> values = words(line);
        if (!values.empty() && values.size() == names.size())
        {
            TableRow row;
            for (std::size_t i = 1; i < values.size(); ++i)
            {
                row[names[i]] = std::strtod(values[i].c_str(), nullptr);
            }
            rows.emplace_back(values[0], row);
        }
    }
    return rows;
}

TableRow readTableRow(const std::filesystem::path& path, double time)
{
    TableRow none;
    for (const auto& [name, row] : readNamedRows(path))
    {
        const double rowTime = std::strtod(name.c_str(), nullptr);
        if (std::abs(rowTime - time) <= 1e-6 * std::max(1.0, std::abs(time)))
        {
            return row;
        }
    }
    return none;
}

} // namespace Foam::stability
