// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/comparison/StabilityTables.H"

#include <sstream>

namespace Foam::stability
{

namespace
{

TableColumn<Statistics> driftSpeedColumn(const std::string& name, std::size_t i)
{
    return {
        name, "m/s",
        "size of the drift speed that 50, 90 and 99 % of the area of T do not exceed, "
        "without what left",
        [i](const Statistics& s) { return s.driftSpeeds[i]; }};
}

std::vector<TableColumn<Statistics>> stabilityColumns()
{
    using S = Statistics;
    return {
        {"Time", "s", "the classified time", &S::time},
        {"vertices", "-", "points of M, welded along seams", &S::nVertices},
        {"triangles", "-", "triangles of M", &S::nTriangles},
        {"area", "m2", "area of M", &S::area},
        {"stableArea", "m2", "stable area of M", &S::stableArea},
        {"attachedArea", "m2", "attached area of M", &S::attachedArea},
        {"detachedNearWalls", "m2", "detached area of T in cells with a wall face",
         &S::detachedNearWall},
        {"detachedElsewhere", "m2", "detached area of T elsewhere",
         &S::detachedElsewhere},
        {"leftArea", "m2",
         "area of T that left the domain, as it was at the last classified time",
         &S::leftArea},
        {"stableFraction", "-",
         "fraction of the area of M, without what entered, that is stable",
         &S::stableFraction},
        {"coverage", "-", "fraction of the area of M with parameters", &S::coverage},
        {"particles", "-", "instability particles that were shed since the start",
         &S::nParticles},
        {"mergedTriangles", "-", "triangles of M near several sheets of T",
         &S::nMerged},
        {"splitTriangles", "-", "triangles of M that were split along seams",
         &S::nSplit},
        {"volumeError", "-", "relative volume error of the reconstruction",
         &S::volumeError},
        {"epsilon", "m", "the band, mean over the area of M", &S::epsilon},
        {"displacement", "cells",
         "how far T moved since the last classified time, rms over its area",
         &S::displacement},
        {"epsilonPerInterval", "m/s",
         "epsilon over the interval: a drift between interface and flow that is slower "
         "cannot be seen",
         &S::smallestVisibleDrift},
        driftSpeedColumn("driftSpeed50", 0),
        driftSpeedColumn("driftSpeed90", 1),
        driftSpeedColumn("driftSpeed99", 2),
        {"noiseFloor", "cells",
         "noise floor of the reconstruction: an estimate of what 99.9 % of the points "
         "of "
         "M are off at most",
         &S::noiseFloor},
        {"detachedThin", "m2", "part of `detachedElsewhere` that was thin or sub-grid",
         &S::detachedThin},
        {"detachedResolved", "m2", "part of `detachedElsewhere` that was neither",
         &S::detachedResolved},
        {"attachedNearWalls", "m2", "attached area of M in cells with a wall face",
         &S::attachedNearWall},
        {"attachedThin", "m2", "attached area of M elsewhere that is thin or sub-grid",
         &S::attachedThin},
        {"attachedResolved", "m2", "attached area of M elsewhere that is neither",
         &S::attachedResolved},
        {"enteredArea", "m2",
         "area of M that the flow brought in through open boundaries since the last "
         "classified time",
         &S::enteredArea},
        {"keptFraction", "-",
         "fraction of the area of T, without what left, that is stable",
         &S::keptFraction},
    };
}

std::vector<TableColumn<Statistics>> survivalColumns()
{
    using S = Statistics;
    std::vector<TableColumn<S>> columns{{"Time", "s", "the classified time", &S::time}};
    for (std::size_t i = 0; i < S::survivalDistances.size(); ++i)
    {
        columns.push_back(
            {survivalColumn("detached", i), "-",
             "fraction of the area of T, without what left, farther than so many cells "
             "from M",
             [i](const S& s) { return s.detachedFraction[i]; }}
        );
    }
    for (std::size_t i = 0; i < S::survivalDistances.size(); ++i)
    {
        columns.push_back(
            {survivalColumn("attached", i), "-",
             "fraction of the area of M, without what entered, farther than so many "
             "cells from T",
             [i](const S& s) { return s.attachedFraction[i]; }}
        );
    }
    return columns;
}

} // namespace

const TableLayout<Statistics>& stabilityTable()
{
    static const TableLayout<Statistics> table{
        "stability.dat", "Areas in m2, displacement in cells, speeds in m/s",
        stabilityColumns()};
    return table;
}

const TableLayout<Statistics>& survivalTable()
{
    static const TableLayout<Statistics> table{
        "survival.dat",
        "Fractions of T (detached) and M (attached) farther away than so many cells",
        survivalColumns()};
    return table;
}

std::string survivalColumn(const std::string& side, std::size_t i)
{
    std::ostringstream name;
    name << side << "(" << Statistics::survivalDistances[i] << ")";
    return name.str();
}

} // namespace Foam::stability
