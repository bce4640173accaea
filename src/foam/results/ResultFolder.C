// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/results/ResultFolder.H"

#include "core/base/Errors.H"
#include "core/comparison/StabilityTables.H"
#include "foam/results/ResultSeries.H"
#include "OSspecific.H"

namespace Foam::stability
{

namespace
{

const fileName previousName("previous");

// A part of the path that exists and is no folder; empty if there is none.
fileName obstacle(const fileName& path)
{
    for (fileName part = path; !part.empty() && part != "/" && part != ".";
         part = part.path())
    {
        if (isFile(part, false))
        {
            return part;
        }
    }
    return fileName();
}

} // namespace

ResultFolder::ResultFolder(const fileName& path, label precision)
    : path_(path), stability_(stabilityTable(), precision),
      survival_(survivalTable(), precision), droplets_(dropletTable(), precision),
      timing_(timingTable(), precision)
{
    const fileName inTheWay(obstacle(path_));
    if (!inTheWay.empty())
    {
        throw BadInput(
            inTheWay + " is a file, but the results belong into the folder " + path_
            + ": move the file away."
        );
    }
}

void ResultFolder::open()
{
    if (!opened_)
    {
        if (!mkDir(path_))
        {
            throw std::runtime_error("Cannot make the folder " + path_ + ".");
        }
        putEarlierResultsAside();
        opened_ = true;
    }
}

// The lists and tables first: no moment shows lists of files that are gone.
std::vector<fileName> ResultFolder::results(const fileName& folder)
{
    std::vector<fileName> names(ResultSeries::files(folder));
    for (const std::string& table :
         {stabilityTable().file, survivalTable().file, dropletTable().file,
          timingTable().file})
    {
        if (isFile(folder / table, false))
        {
            names.insert(names.begin(), table);
        }
    }
    return names;
}

void ResultFolder::remove(const fileName& path)
{
    if (isDir(path))
    {
        rmDir(path, true);
    }
    else
    {
        rm(path);
    }
}

// A run that breaks off must not cost the results of the one before. Where there are
// such already, the results in place are those of a run that broke off.
void ResultFolder::putEarlierResultsAside() const
{
    const fileName aside(path_ / previousName);
    const bool kept = isDir(aside);
    for (const fileName& name : results(path_))
    {
        if (kept)
        {
            remove(path_ / name);
        }
        else if (isDir(aside) || mkDir(aside))
        {
            mv(path_ / name, aside / name);
        }
    }
}

void ResultFolder::complete() const
{
    const fileName aside(path_ / previousName);
    if (!isDir(aside))
    {
        return;
    }
    for (const fileName& name : results(aside))
    {
        remove(aside / name);
    }
    rmDir(aside); // if nothing of the user's is in it
}

void ResultFolder::writeTables(const Classification& c)
{
    open();
    const Statistics& statistics = c.statistics;
    stability_.addRow(statistics);
    stability_.write(path_);
    survival_.addRow(statistics);
    survival_.write(path_);
    for (const Droplet& droplet : c.droplets)
    {
        droplets_.addRow({droplet, statistics.time});
    }
    droplets_.write(path_);
}

void ResultFolder::writeTimings(const TimingRow& row)
{
    if (row.time == timingRow_)
    {
        timing_.dropLastRow();
    }
    timingRow_ = row.time;
    timing_.addRow(row);
    timing_.write(path_);
}

} // namespace Foam::stability
