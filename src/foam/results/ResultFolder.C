// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

#include "foam/results/ResultFolder.H"

#include "core/base/Errors.H"
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
    : path_(path),
      stability_("Areas in m2, displacement in cells, speeds in m/s", precision),
      survival_(
          "Fractions of T (detached) and M (attached) farther away than so many cells",
          precision
      ),
      droplets_(
          "Droplets and bubbles below 1.5 cells: radius in cells, volume in m3, "
          "centroid in m",
          precision
      ),
      timing_(
          "Seconds of wall-clock time, by phase, since the last classified time",
          precision
      )
{
    const fileName inTheWay(obstacle(path_));
    if (!inTheWay.empty())
    {
        throw BadInput(
            inTheWay + " is a file, but the results belong into the folder " + path_
            + ": move the file away."
        );
    }
    stability_.setColumns(Statistics::columns());
    survival_.setColumns(Statistics::survivalColumns());
    droplets_.setColumns(Droplet::columns());
    std::vector<std::string> phases(phaseNames());
    phases.insert(phases.begin(), "time");
    timing_.setColumns(phases);
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
    for (const char* table :
         {"stability.dat", "survival.dat", "droplets.dat", "timing.dat"})
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
    stability_.addRow(statistics.values());
    stability_.write(path_ / "stability.dat");
    survival_.addRow(statistics.survivalValues());
    survival_.write(path_ / "survival.dat");
    for (const Droplet& droplet : c.droplets)
    {
        droplets_.addRow(droplet.values(statistics.time));
    }
    droplets_.write(path_ / "droplets.dat");
}

void ResultFolder::writeTimings(scalar time, const std::vector<scalar>& seconds)
{
    if (time == timingRow_)
    {
        timing_.dropLastRow();
    }
    timingRow_ = time;
    std::vector<scalar> row(seconds);
    row.insert(row.begin(), time);
    timing_.addRow(row);
    timing_.write(path_ / "timing.dat");
}

} // namespace Foam::stability
