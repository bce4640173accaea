// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/comparison/Statistics.H"

#include <gtest/gtest.h>

using namespace Foam;
using namespace Foam::stability;

namespace
{

// A strip of two right triangles (0 1 2) of area 1 and (1 3 2) of area 3; cell sizes
// and distances differ from point to point.
ClassifiedSurface strip()
{
    ClassifiedSurface surface;
    InterfaceMesh& mesh = surface.mesh;
    mesh.points =
        List<point>{point(0, 0, 0), point(2, 0, 0), point(0, 1, 0), point(6, 1, 0)};
    mesh.triangles = List<triFace>{triFace(0, 1, 2), triFace(1, 3, 2)};
    mesh.clearParametrization();
    mesh.cellSizes = scalarField(List<scalar>{0.1, 0.2, 0.4, 0.8});
    mesh.cells = labelList(4, 0);
    surface.stability = List<Stability>(4, Stability::stable);
    surface.distance = scalarField(List<scalar>{0.003, 0.03, 0.39, 2.4});
    surface.driftSpeed = scalarField(List<scalar>{-5, 2, -3, 7});
    surface.preimages = labelList(4, 1);
    surface.nearWall = List<bool>(4, false);
    surface.thin = List<bool>(4, false);
    surface.subGrid = List<bool>(4, false);
    surface.components = labelList(4, 0);
    surface.areas = mesh.pointAreas();
    surface.isPrimary = List<bool>(4, true);
    return surface;
}

const SerialExchange alone;

ClassifiedSurface nothing()
{
    ClassifiedSurface surface;
    return surface;
}

} // namespace

// Thirds of areas: point 0 has 1/3, points 1 and 2 have 4/3, point 3 has 1.
TEST(Statistics, areasAreWeightedByThirds)
{
    ClassifiedSurface interface(strip());
    interface.stability[0] = Stability::attached;
    interface.stability[3] = Stability::attached;
    ClassifiedSurface timeSurface(strip());
    timeSurface.stability[0] = Stability::detached;
    timeSurface.stability[1] = Stability::detached;
    timeSurface.stability[2] = Stability::left;
    timeSurface.nearWall[1] = true;

    Statistics statistics;
    addSurfaceStatistics(statistics, interface, timeSurface, Epsilon{0.5, true}, alone);
    EXPECT_NEAR(statistics.area, 4, 1e-14);
    EXPECT_NEAR(statistics.attachedArea, 4.0 / 3, 1e-14);
    EXPECT_NEAR(statistics.stableArea, 8.0 / 3, 1e-14);
    EXPECT_NEAR(statistics.stableFraction(), 2.0 / 3, 1e-14);
    EXPECT_NEAR(statistics.detachedNearWall, 4.0 / 3, 1e-14);
    EXPECT_NEAR(statistics.detachedElsewhere, 1.0 / 3, 1e-14);
    EXPECT_NEAR(statistics.detachedArea(), 5.0 / 3, 1e-14);
    EXPECT_NEAR(statistics.timeSurfaceArea, 8.0 / 3, 1e-14);
    EXPECT_NEAR(statistics.keptFraction(), 3.0 / 8, 1e-14);
    // epsilon = h/2, weighted by area
    const scalar exact = 0.5 * (0.1 / 3 + 0.2 * 4 / 3 + 0.4 * 4 / 3 + 0.8) / 4;
    EXPECT_NEAR(statistics.epsilon, exact, 1e-14);
    EXPECT_NEAR(statistics.epsilonCells, 0.5, 1e-14);
    EXPECT_EQ(statistics.nVertices, 4);
    EXPECT_EQ(statistics.nTriangles, 2);
}

// Points that another rank counts are left out; triangles all count.
TEST(Statistics, aPointOfSeveralRanksCountsOnce)
{
    ClassifiedSurface interface(strip());
    interface.stability[0] = Stability::attached;
    interface.isPrimary[0] = interface.isPrimary[3] = false;
    Statistics statistics;
    addSurfaceStatistics(statistics, interface, interface, Epsilon(), alone);
    EXPECT_EQ(statistics.nVertices, 2);
    EXPECT_EQ(statistics.nTriangles, 2);
    EXPECT_EQ(statistics.attachedArea, 0);
    EXPECT_NEAR(statistics.stableArea, 8.0 / 3, 1e-14);
    EXPECT_NEAR(statistics.area, 4, 1e-14);
    EXPECT_EQ(statistics.driftSpeeds, (std::array<scalar, 3>{2, 3, 3}));
}

TEST(Statistics, anAbsoluteEpsilonIsTakenAsItIs)
{
    Statistics statistics;
    addSurfaceStatistics(statistics, strip(), nothing(), Epsilon{0.07, false}, alone);
    EXPECT_NEAR(statistics.epsilon, 0.07, 1e-15);
    const scalar cells = 0.07 * (1 / 0.1 / 3 + 4 / 0.2 / 3 + 4 / 0.4 / 3 + 1 / 0.8) / 4;
    EXPECT_NEAR(statistics.epsilonCells, cells, 1e-14);
    statistics.interval = 0.02;
    EXPECT_NEAR(statistics.smallestVisibleDrift(), 3.5, 1e-13);
}

// By walls 1/3, thin 4/3, sub-grid 1, and 4/3 that is neither.
TEST(Statistics, whatDetachesIsByWallsThinOrResolved)
{
    ClassifiedSurface timeSurface(strip());
    timeSurface.stability = Stability::detached;
    timeSurface.nearWall[0] = true;
    timeSurface.thin[0] = timeSurface.thin[1] = true;
    timeSurface.subGrid[0] = timeSurface.subGrid[3] = true;
    Statistics statistics;
    addSurfaceStatistics(statistics, strip(), timeSurface, Epsilon(), alone);
    EXPECT_NEAR(statistics.detachedNearWall, 1.0 / 3, 1e-14);
    EXPECT_NEAR(statistics.detachedThin, 7.0 / 3, 1e-14);
    EXPECT_NEAR(statistics.detachedResolved, 4.0 / 3, 1e-14);
    EXPECT_NEAR(statistics.detachedElsewhere, 11.0 / 3, 1e-14);
}

TEST(Statistics, whatAttachesIsByWallsThinOrResolved)
{
    ClassifiedSurface interface(strip());
    interface.stability = Stability::attached;
    interface.nearWall[0] = true;
    interface.thin[0] = interface.thin[1] = true;
    interface.subGrid[0] = interface.subGrid[3] = true;
    Statistics statistics;
    addSurfaceStatistics(statistics, interface, strip(), Epsilon(), alone);
    EXPECT_NEAR(statistics.attachedNearWall, 1.0 / 3, 1e-14);
    EXPECT_NEAR(statistics.attachedThin, 7.0 / 3, 1e-14);
    EXPECT_NEAR(statistics.attachedResolved, 4.0 / 3, 1e-14);
}

// Distances in cells: 0.03, 0.15, 0.975, and 3 up to round-off.
TEST(Statistics, survivalCountsInCells)
{
    ClassifiedSurface timeSurface(strip());
    timeSurface.stability[1] = Stability::left; // out of the account
    Statistics statistics;
    addSurfaceStatistics(statistics, strip(), timeSurface, Epsilon{0.5, true}, alone);
    const std::array<scalar, 8> attached{
        (4.0 / 3 + 4.0 / 3 + 1) / 4,
        (4.0 / 3 + 4.0 / 3 + 1) / 4,
        (4.0 / 3 + 1) / 4,
        (4.0 / 3 + 1) / 4,
        0.25,
        0.25,
        0.25,
        0.25};
    const scalar rest = 8.0 / 3;
    const std::array<scalar, 8> detached{
        (4.0 / 3 + 1) / rest,
        (4.0 / 3 + 1) / rest,
        (4.0 / 3 + 1) / rest,
        (4.0 / 3 + 1) / rest,
        1 / rest,
        1 / rest,
        1 / rest,
        1 / rest};
    for (int i = 0; i < 8; ++i)
    {
        EXPECT_NEAR(statistics.attachedFraction[i], attached[i], 1e-14) << i;
        EXPECT_NEAR(statistics.detachedFraction[i], detached[i], 1e-14) << i;
    }
}

// Sizes 2, 3, 5, 7 up to 1/3, 2/3, 3/4 and all of the area.
TEST(Statistics, driftSpeedsAreSizesByArea)
{
    ClassifiedSurface interface(strip());
    interface.driftSpeed *= 10; // T tells, not M
    ClassifiedSurface timeSurface(strip());
    Statistics statistics;
    addSurfaceStatistics(statistics, interface, timeSurface, Epsilon(), alone);
    EXPECT_EQ(statistics.driftSpeeds, (std::array<scalar, 3>{3, 7, 7}));

    // Up to 4/9, 8/9 and all of the rest.
    timeSurface.stability[3] = Stability::left;
    addSurfaceStatistics(
        statistics = Statistics(), interface, timeSurface, Epsilon(), alone
    );
    EXPECT_EQ(statistics.driftSpeeds, (std::array<scalar, 3>{3, 5, 5}));

    timeSurface.mesh.points[0] = timeSurface.mesh.points[1]; // no area
    timeSurface.areas = timeSurface.mesh.pointAreas();
    addSurfaceStatistics(
        statistics = Statistics(), interface, timeSurface, Epsilon(), alone
    );
    EXPECT_EQ(statistics.driftSpeeds, (std::array<scalar, 3>{2, 3, 3}));
}

TEST(Statistics, coverageCountsTrianglesWithParameters)
{
    ClassifiedSurface interface(strip());
    interface.mesh.parameters = List<vector2D>(3, vector2D(0.5, 0.5));
    interface.mesh.corners[1] = CornerIndices(1);
    Statistics statistics;
    addSurfaceStatistics(statistics, interface, nothing(), Epsilon(), alone);
    EXPECT_NEAR(statistics.coverage(), 0.75, 1e-14);
}

TEST(Statistics, nothingIsAWholeShareOfNothing)
{
    Statistics statistics;
    addSurfaceStatistics(statistics, nothing(), nothing(), Epsilon(), alone);
    EXPECT_EQ(statistics.stableFraction(), 0);
    EXPECT_EQ(statistics.keptFraction(), 0);
    EXPECT_EQ(statistics.coverage(), 0);
    EXPECT_EQ(statistics.epsilon, 0);
    EXPECT_EQ(statistics.detachedFraction[0], 0);
    EXPECT_EQ(statistics.driftSpeeds[2], 0);
    EXPECT_EQ(statistics.smallestVisibleDrift(), 0);
}

// Nothing is kept of what detached or left without a successor; where there was
// nothing, nothing was lost.
TEST(Statistics, whatTearsOrDrainsAwayIsNotKept)
{
    ClassifiedSurface gone(strip());
    gone.stability = Stability::detached;
    Statistics statistics;
    addSurfaceStatistics(statistics, nothing(), gone, Epsilon(), alone);
    EXPECT_EQ(statistics.keptFraction(), 0);
    gone.stability = Stability::left;
    addSurfaceStatistics(statistics = Statistics(), nothing(), gone, Epsilon(), alone);
    EXPECT_EQ(statistics.keptFraction(), 0);
    addSurfaceStatistics(
        statistics = Statistics(), strip(), nothing(), Epsilon(), alone
    );
    EXPECT_EQ(statistics.keptFraction(), 1);
    EXPECT_EQ(statistics.stableFraction(), 1);
}

TEST(Statistics, displacementIsRmsInCellsByArea)
{
    const ClassifiedSurface surface(strip());
    pointField startPositions(surface.mesh.points);
    startPositions[3] += vector(0, 0, 1.6); // two cells
    startPositions[0] -= vector(0.3, 0, 0); // three cells
    Statistics statistics;
    addMotion(statistics, surface, startPositions, alone);
    EXPECT_NEAR(statistics.displacement, std::sqrt((1 * 4 + 9 / 3.0) / 4), 1e-14);
    EXPECT_NEAR(statistics.largestDisplacement, 3, 1e-14);
}

// Point 3 was at x = 4 and went 1.5 beyond x = 3, where point 1 stays 0.5 before it:
// three quarters of that edge left; point 2, 3 before it, keeps two thirds of its edge.
TEST(Statistics, whatLeftHasTheAreaThatItHadBefore)
{
    ClassifiedSurface surface(strip());
    surface.stability[3] = Stability::left;
    Crossings& left = surface.crossings = Crossings(4);
    left.crossed[3] = true;
    left.ends =
        List<point>{point(-1, 5, 0), point(2.5, 0, 7), point(0, 1, 9), point(3, 2, 0)};
    left.beyond[3] = vector(1.5, 0, 0);
    pointField startPositions(surface.mesh.points);
    startPositions[3].x() = 4; // the triangle had 2 m2
    Statistics statistics;
    addMotion(statistics, surface, startPositions, alone);
    EXPECT_NEAR(statistics.leftArea, 2 * (3.0 / 4) * (1.0 / 3), 1e-14);
}
