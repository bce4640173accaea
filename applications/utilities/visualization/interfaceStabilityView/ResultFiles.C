// SPDX-License-Identifier: GPL-3.0-or-later

#include "ResultFiles.H"

#include "Series.H"
#include "Table.H"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace Foam::stability
{

namespace
{

namespace fs = std::filesystem;

constexpr const char* interfaceSeries = "interface.vtp.series";

// The list of a family: of whole files, or of those that name pieces.
fs::path seriesIn(const fs::path& folder, const std::string& family)
{
    std::error_code ignored;
    const fs::path pieces = folder / (family + ".pvtp.series");
    return fs::exists(pieces, ignored) ? pieces : folder / (family + ".vtp.series");
}

bool holdsResults(const fs::path& folder)
{
    std::error_code ignored;
    return fs::exists(seriesIn(folder, "interface"), ignored);
}

// The folder below `parent` whose list of interfaces is the newest.
fs::path newestBelow(const fs::path& parent)
{
    std::error_code none;
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(parent, none))
    {
        if (holdsResults(entry.path()))
        {
            found.push_back(entry.path());
        }
    }
    const auto age = [](const fs::path& folder)
    {
        std::error_code ignored;
        return fs::last_write_time(seriesIn(folder, "interface"), ignored);
    };
    std::sort(found.begin(), found.end()); // equal ages: not left to the file system
    const auto newest = std::max_element(
        found.begin(), found.end(),
        [&](const fs::path& a, const fs::path& b) { return age(a) < age(b); }
    );
    return newest == found.end() ? fs::path() : *newest;
}

fs::path findResults(const fs::path& folder)
{
    if (holdsResults(folder))
    {
        return folder;
    }
    const fs::path below = fs::path("postProcessing") / "interfaceStability";
    for (const fs::path& parent : {folder / below, folder})
    {
        const fs::path newest = newestBelow(parent);
        if (!newest.empty())
        {
            return newest;
        }
    }
    throw std::runtime_error(
        "No results of interfaceStability in " + folder.string() + ": there is neither "
        + (folder / interfaceSeries).string() + " nor "
        + (folder / below / "<startTime>" / interfaceSeries).string() + "."
    );
}

std::string shortText(double value)
{
    std::ostringstream text;
    text << value;
    return text.str();
}

// "0 to 125" or "0, 2, 5": what can be asked for.
std::string available(const std::vector<Frame>& frames)
{
    std::ostringstream text;
    text << "there are " << frames.size() << " from index " << frames.front().index
         << " (time " << frames.front().time << ") to index " << frames.back().index
         << " (time " << frames.back().time << ")";
    if (frames.size() > 1 && frames.size() <= 12)
    {
        text << ":";
        for (const Frame& frame : frames)
        {
            text << ' ' << frame.index << " (" << frame.time << ")";
        }
    }
    return text.str();
}

} // namespace

ResultFiles::ResultFiles(const fs::path& folder) : path_(findResults(folder))
{
    const fs::path interfaces = seriesIn(path_, "interface");
    const auto particles = readSeries(seriesIn(path_, "particles"));
    for (const SeriesEntry& entry : readSeries(interfaces))
    {
        Frame frame{entry.index, entry.time, path_ / entry.file, {}};
        for (const SeriesEntry& cloud : particles)
        {
            if (cloud.index == entry.index)
            {
                frame.particles = path_ / cloud.file;
            }
        }
        frames_.push_back(frame);
    }
    if (frames_.empty())
    {
        throw std::runtime_error(
            "The list " + interfaces.string() + " names no interface."
        );
    }
    std::sort(
        frames_.begin(), frames_.end(),
        [](const Frame& a, const Frame& b) { return a.index < b.index; }
    );
}

fs::path ResultFiles::caseFolder() const
{
    fs::path folder = fs::absolute(path_).lexically_normal();
    for (int level = 0; level < 5 && folder.has_relative_path(); ++level)
    {
        std::error_code ignored;
        if (fs::exists(folder / "system" / "controlDict", ignored)
            || fs::exists(folder / "constant" / "polyMesh", ignored))
        {
            return folder;
        }
        folder = folder.parent_path();
    }
    return {};
}

std::vector<Frame> ResultFiles::selected(const Arguments& arguments) const
{
    if (arguments.all)
    {
        return frames_;
    }
    std::vector<Frame> result;
    const auto add = [&](const auto& distance, double near, const std::string& wanted)
    {
        const auto found = std::min_element(
            frames_.begin(), frames_.end(),
            [&](const Frame& a, const Frame& b) { return distance(a) < distance(b); }
        );
        if (!(distance(*found) <= near))
        {
            throw std::runtime_error(
                "No result with " + wanted + " in " + path_.string() + ": "
                + available(frames_) + "."
            );
        }
        const bool twice = std::any_of(
            result.begin(), result.end(),
            [&](const Frame& f) { return f.index == found->index; }
        );
        if (!twice)
        {
            result.push_back(*found);
        }
    };
    for (const int index : arguments.indices)
    {
        add([&](const Frame& f) { return std::abs(double(f.index) - index); }, 0,
            "index " + std::to_string(index));
    }
    for (const double time : arguments.times)
    {
        const double last = std::abs(frames_.back().time);
        add([&](const Frame& f) { return std::abs(f.time - time); },
            1e-6 * std::max(last, std::abs(time)), "time " + shortText(time));
    }
    return result.empty() ? std::vector<Frame>{frames_.back()} : result;
}

FrameNumbers ResultFiles::numbers(const Frame& frame) const
{
    const TableRow row = readTableRow(path_ / "stability.dat", frame.index, frame.time);
    const auto value = [&](const char* name)
    {
        const auto found = row.find(name);
        return found == row.end() ? std::optional<double>() : found->second;
    };
    return {
        value("epsilon"), value("stableFraction"), value("keptFraction"),
        value("coverage"), value("particles")};
}

} // namespace Foam::stability
