// SPDX-License-Identifier: GPL-3.0-or-later

#include "Table.H"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
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

bool isNumber(const std::string& word, double& value)
{
    char* end = nullptr;
    value = std::strtod(word.c_str(), &end);
    return !word.empty() && !*end;
}

} // namespace

std::vector<std::pair<std::string, TableRow>>
readNamedRows(const std::filesystem::path& path)
{
    std::ifstream stream(path);
    std::vector<std::string> names;
    std::vector<std::pair<std::string, TableRow>> rows;
    int lineNumber = 0;
    for (std::string line; std::getline(stream, line);)
    {
        ++lineNumber;
        const bool comment = line.rfind('#', 0) == 0;
        const std::vector<std::string> values = words(comment ? line.substr(1) : line);
        if (comment)
        {
            names = values;
        }
        else if (!values.empty())
        {
            bool good = values.size() == names.size() && !stream.eof();
            TableRow row;
            for (std::size_t i = 1; i < values.size() && good; ++i)
            {
                good = isNumber(values[i], row[names[i]]);
            }
            if (!good)
            {
                throw std::runtime_error(
                    "The table " + path.string() + " is damaged: line "
                    + std::to_string(lineNumber)
                    + " has no number for each of its columns."
                );
            }
            rows.emplace_back(values[0], row);
        }
    }
    return rows;
}

TableRow readTableRow(const std::filesystem::path& path, int index, double time)
{
    constexpr double near = 1e-4; // tables may have few digits
    const auto rows = readNamedRows(path);
    double rowTime = 0;
    const bool found = index >= 0 && std::size_t(index) < rows.size()
                       && isNumber(rows[index].first, rowTime)
                       && std::abs(rowTime - time) <= near * std::abs(time);
    return found ? rows[index].second : TableRow();
}

} // namespace Foam::stability
