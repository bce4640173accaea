// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/results/ResultFolder.H"

#include "core/base/Errors.H"
#include "core/base/FileOperations.H"
#include "core/comparison/StabilityTables.H"

namespace Foam::stability
{

ResultFolder::ResultFolder(const fileName& path, label precision)
    : path_(path), files_(path), stability_(stabilityTable(), precision),
      survival_(survivalTable(), precision), droplets_(dropletTable(), precision),
      charts_(chartTable(), precision), timing_(timingTable(), precision)
{
    const std::string inTheWay = inTheWayOf(path_);
    if (!inTheWay.empty())
    {
        throw BadInput("Results cannot be written: " + inTheWay);
    }
}

void ResultFolder::open()
{
    if (!opened_)
    {
        files_.begin();
        for (const std::string& table :
             {stabilityTable().file, survivalTable().file, dropletTable().file,
              chartTable().file, timingTable().file})
        {
            files_.add(table);
        }
        opened_ = true;
    }
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
    if (c.parametrization)
    {
        for (const ChartReport& chart : c.parametrization->charts)
        {
            charts_.addRow({chart, statistics.time});
        }
    }
    charts_.write(path_);
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
