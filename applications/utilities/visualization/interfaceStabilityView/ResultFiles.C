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

// The folders of results below `parent`, that with the newest list of interfaces first.
std::vector<fs::path> foldersBelow(const fs::path& parent)
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
    std::stable_sort(
        found.begin(), found.end(),
        [&](const fs::path& a, const fs::path& b) { return age(a) > age(b); }
    );
    return found;
}

// The folder itself, or those of a case. Throws std::runtime_error where there is none.
std::vector<fs::path> resultFolders(const fs::path& folder)
{
    if (holdsResults(folder))
    {
        return {folder};
    }
    const fs::path below = fs::path("postProcessing") / "interfaceStability";
    for (const fs::path& parent : {folder / below, folder})
    {
        const std::vector<fs::path> found = foldersBelow(parent);
        if (!found.empty())
        {
            return found;
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

ResultFiles::ResultFiles(const fs::path& folder) : path_(folder)
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

std::optional<Frame> ResultFiles::nearest(double time) const
{
    const auto distance = [&](const Frame& f) { return std::abs(f.time - time); };
    const auto found = std::min_element(
        frames_.begin(), frames_.end(),
        [&](const Frame& a, const Frame& b) { return distance(a) < distance(b); }
    );
    const double size = std::max(std::abs(frames_.back().time), std::abs(time));
    return distance(*found) <= 1e-6 * size ? std::optional<Frame>(*found)
                                           : std::nullopt;
}

void ResultFiles::select(std::optional<Frame> frame, const std::string& wanted)
{
    if (!frame)
    {
        throw std::runtime_error(
            "No result with " + wanted + " in " + path_.string() + ": "
            + available(frames_) + "."
        );
    }
    const bool twice = std::any_of(
        selected_.begin(), selected_.end(),
        [&](const Frame& f) { return f.index == frame->index; }
    );
    if (!twice)
    {
        selected_.push_back(*frame);
    }
}

void ResultFiles::select(const Arguments& arguments)
{
    for (const int index : arguments.indices)
    {
        const auto found = std::find_if(
            frames_.begin(), frames_.end(),
            [&](const Frame& f) { return f.index == index; }
        );
        select(
            found == frames_.end() ? std::nullopt : std::optional<Frame>(*found),
            "index " + std::to_string(index)
        );
    }
    if (arguments.all)
    {
        selected_ = frames_;
    }
    else if (arguments.indices.empty() && arguments.times.empty())
    {
        selected_ = {frames_.back()};
    }
}

std::vector<ResultFiles> selectedResults(const Arguments& arguments)
{
    std::vector<ResultFiles> runs;
    for (const fs::path& folder : resultFolders(arguments.folder))
    {
        runs.emplace_back(folder);
        if (arguments.times.empty())
        {
            break; // the newest will do
        }
    }
    runs.front().select(arguments);
    for (const double time : arguments.times)
    {
        const auto run = std::find_if(
            runs.begin(), runs.end(),
            [&](const ResultFiles& files) { return files.nearest(time).has_value(); }
        );
        ResultFiles& files = run == runs.end() ? runs.front() : *run;
        files.select(files.nearest(time), "time " + shortText(time));
    }
    const auto unused = std::remove_if(
        runs.begin(), runs.end(),
        [](const ResultFiles& files) { return files.selected().empty(); }
    );
    runs.erase(unused, runs.end());
    return runs;
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
