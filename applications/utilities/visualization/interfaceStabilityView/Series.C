// SPDX-License-Identifier: GPL-3.0-or-later

#include "Series.H"

#include <vtk_jsoncpp.h>

#include <fstream>
#include <stdexcept>

namespace Foam::stability
{

namespace
{

// interface_000042.vtp: 42
int trailingNumber(const std::string& file)
{
    const std::string stem = std::filesystem::path(file).stem().string();
    const auto start = stem.find_last_not_of("0123456789") + 1;
    return std::stoi(stem.substr(start));
}

} // namespace

std::vector<SeriesEntry> readSeries(const std::filesystem::path& path)
{
    std::ifstream stream(path);
    if (!stream)
    {
        return {};
    }
    std::vector<SeriesEntry> result;
    try
    {
        Json::Value list;
        stream >> list;
        for (const Json::Value& entry : list["files"])
        {
            const std::string file = entry["name"].asString();
            result.push_back({file, trailingNumber(file), entry["time"].asDouble()});
        }
    }
    catch (const std::exception&)
    {
        throw std::runtime_error(
            "The file " + path.string() + " is no list of numbered files and times."
        );
    }
    return result;
}

} // namespace Foam::stability
