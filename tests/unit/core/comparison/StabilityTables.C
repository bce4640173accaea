// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/comparison/StabilityTables.H"

#include <gtest/gtest.h>

#include <map>

using namespace Foam;
using namespace Foam::stability;

namespace
{

std::map<std::string, scalar>
valuesOf(const TableLayout<Statistics>& table, const Statistics& statistics)
{
    std::map<std::string, scalar> values;
    for (const TableColumn<Statistics>& column : table.columns)
    {
        EXPECT_TRUE(values.emplace(column.name, column.value(statistics)).second)
            << column.name << " is there twice";
    }
    return values;
}

} // namespace

TEST(StabilityTables, namesTellTheirValues)
{
    Statistics s;
    s.time = 1.5;
    s.nVertices = 2;
    s.nTriangles = 3;
    s.area = 16;
    s.stableArea = 4;
    s.attachedArea = 5;
    s.attachedNearWall = 21;
    s.attachedThin = 22;
    s.attachedResolved = 23;
    s.timeSurfaceArea = 32;
    s.keptArea = 20;
    s.enteredArea = 8;
    s.detachedNearWall = 6;
    s.detachedElsewhere = 7;
    s.detachedThin = 8;
    s.detachedResolved = 9;
    s.leftArea = 10;
    s.parametrizedArea = 12;
    s.nParticles = 13;
    s.nMerged = 14;
    s.nSplit = 15;
    s.volumeError = -0.125;
    s.epsilon = 0.5;
    s.noiseFloor = 0.375;
    s.displacement = 17;
    s.interval = 0.125;
    s.driftSpeeds = {18, 19, 20};
    const std::map<std::string, scalar> expected{
        {"Time", 1.5},
        {"vertices", 2},
        {"triangles", 3},
        {"area", 16},
        {"stableArea", 4},
        {"attachedArea", 5},
        {"detachedNearWalls", 6},
        {"detachedElsewhere", 7},
        {"leftArea", 10},
        {"stableFraction", 0.5},
        {"coverage", 0.75},
        {"particles", 13},
        {"mergedTriangles", 14},
        {"splitTriangles", 15},
        {"volumeError", -0.125},
        {"epsilon", 0.5},
        {"displacement", 17},
        {"epsilonPerInterval", 4},
        {"driftSpeed50", 18},
        {"driftSpeed90", 19},
        {"driftSpeed99", 20},
        {"noiseFloor", 0.375},
        {"detachedThin", 8},
        {"detachedResolved", 9},
        {"attachedNearWalls", 21},
        {"attachedThin", 22},
        {"attachedResolved", 23},
        {"enteredArea", 8},
        {"keptFraction", 0.625},
    };
    EXPECT_EQ(valuesOf(stabilityTable(), s), expected);
}

TEST(StabilityTables, survivalHasBothSidesByDistance)
{
    Statistics s;
    s.time = 0.75;
    s.detachedFraction = {1, 2, 3, 4, 5, 6, 7, 8};
    s.attachedFraction = {11, 12, 13, 14, 15, 16, 17, 18};
    const std::map<std::string, scalar> expected{
        {"Time", 0.75},         {"detached(0.05)", 1}, {"detached(0.1)", 2},
        {"detached(0.25)", 3},  {"detached(0.5)", 4},  {"detached(1)", 5},
        {"detached(1.5)", 6},   {"detached(2)", 7},    {"detached(3)", 8},
        {"attached(0.05)", 11}, {"attached(0.1)", 12}, {"attached(0.25)", 13},
        {"attached(0.5)", 14},  {"attached(1)", 15},   {"attached(1.5)", 16},
        {"attached(2)", 17},    {"attached(3)", 18},
    };
    EXPECT_EQ(valuesOf(survivalTable(), s), expected);
}
