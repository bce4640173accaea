// SPDX-License-Identifier: GPL-3.0-or-later

// The statistics of a surface in pieces are those of the whole, to the last bit.

#include "core/comparison/StabilityTables.H"
#include "shapes/Surfaces.H"
#include "shapes/ThreadRanks.H"

#include <gtest/gtest.h>

#include <random>

using namespace Foam;
using namespace Foam::stability;

namespace
{

// Hilly, of cells of all sizes, with every class and kind of point; some triangles have
// no p.
ClassifiedSurface hills(unsigned seed)
{
    const auto height = [](scalar u, scalar v)
    { return point(3 * u, 2 * v * v + u, std::sin(7 * u) * std::cos(4 * v)); };
    ClassifiedSurface surface;
    surface.mesh = shapes::asInterface(shapes::grid(height, 17, 13), 0.1);
    InterfaceMesh& mesh = surface.mesh;
    const label n = mesh.points.size();
    mesh.parameters = List<vector2D>(3, vector2D(0.5, 0.5));
    for (label i = 0; i < mesh.triangles.size(); i += 3)
    {
        mesh.corners[i] = CornerIndices(1);
    }
    std::mt19937 random(seed);
    std::uniform_real_distribution<scalar> unit(0, 1);
    const auto often = [&] { return unit(random) < 0.4; };
    surface.stability.setSize(n);
    surface.distance.setSize(n);
    surface.driftSpeed.setSize(n);
    for (List<bool>* flags : {&surface.nearWall, &surface.thin, &surface.subGrid})
    {
        flags->setSize(n);
    }
    for (label i = 0; i < n; ++i)
    {
        mesh.cellSizes[i] = 0.02 + unit(random);
        surface.stability[i] = often()   ? Stability::stable
                               : often() ? Stability::left
                                         : Stability::detached;
        surface.distance[i] = 4 * mesh.cellSizes[i] * unit(random);
        surface.driftSpeed[i] = unit(random) - 0.7;
        surface.nearWall[i] = often();
        surface.thin[i] = often();
        surface.subGrid[i] = often();
    }
    surface.crossings = Crossings(n);
    surface.crossings.ends = mesh.points;
    for (label i = 0; i < n; ++i)
    {
        surface.crossings.crossed[i] = surface.stability[i] == Stability::left;
        surface.crossings.beyond[i] = vector(unit(random), unit(random), 0.1);
    }
    surface.areas = mesh.pointAreas();
    surface.isPrimary = List<bool>(n, true);
    return surface;
}

ClassifiedSurface hillsOfInterface()
{
    ClassifiedSurface surface(hills(1));
    for (Stability& stability : surface.stability)
    {
        stability =
            stability == Stability::detached ? Stability::attached : Stability::stable;
    }
    return surface;
}

// Shifts of the points of a surface [m].
pointField seedsOf(const ClassifiedSurface& surface)
{
    pointField startPositions(surface.mesh.points);
    forAll(startPositions, i)
    {
        startPositions[i] += vector(0.01 * i, std::cos(scalar(i)), 0.3);
    }
    return startPositions;
}

// Some triangles with their points. Of several ranks the lowest counts a point.
struct Piece
{
    ClassifiedSurface surface;
    pointField startPositions;
};

label rankOf(label trianglei, label n)
{
    const label nFull = std::max(n - 1, label(1)); // the last has nothing
    return (trianglei / 5) % nFull;
}

Piece pieceOf(const ClassifiedSurface& whole, label rank, label n)
{
    const InterfaceMesh& mesh = whole.mesh;
    labelList lowest(mesh.points.size(), n), places(mesh.points.size(), -1);
    DynamicList<label> points;
    Piece piece;
    piece.surface = whole;
    InterfaceMesh& own = piece.surface.mesh;
    own.triangles.clear();
    own.corners.clear();
    forAll(mesh.triangles, trianglei)
    {
        const label owner = rankOf(trianglei, n);
        triFace triangle(mesh.triangles[trianglei]);
        for (label& pointi : triangle)
        {
            lowest[pointi] = std::min(lowest[pointi], owner);
            if (owner == rank)
            {
                if (places[pointi] < 0)
                {
                    places[pointi] = points.size();
                    points.append(pointi);
                }
                pointi = places[pointi];
            }
        }
        if (owner == rank)
        {
            own.triangles.append(triangle);
            own.corners.append(mesh.corners[trianglei]);
        }
    }
    select(piece.surface, points);
    own.points = pointField(UIndirectList<point>(mesh.points, points));
    own.cellSizes = scalarField(UIndirectList<scalar>(mesh.cellSizes, points));
    piece.startPositions = pointField(UIndirectList<point>(seedsOf(whole), points));
    forAll(points, i)
    {
        piece.surface.isPrimary[i] = lowest[points[i]] == rank;
    }
    return piece;
}

std::vector<scalar> allValues(const Statistics& statistics)
{
    std::vector<scalar> all;
    for (const auto* table : {&stabilityTable(), &survivalTable()})
    {
        for (const TableColumn<Statistics>& column : table->columns)
        {
            all.push_back(column.value(statistics));
        }
    }
    all.push_back(statistics.timeSurfaceArea);
    all.push_back(statistics.epsilonCells);
    all.push_back(statistics.largestDisplacement);
    return all;
}

std::vector<std::vector<scalar>> valuesOn(label n)
{
    const ClassifiedSurface interface(hillsOfInterface()), timeSurface(hills(2));
    std::vector<std::vector<scalar>> values(n);
    shapes::onRanks(
        n,
        [&](const Exchange& exchange)
        {
            const label rank = exchange.rank();
            const Piece m(pieceOf(interface, rank, n));
            const Piece t(pieceOf(timeSurface, rank, n));
            Statistics statistics;
            addSurfaceStatistics(
                statistics, m.surface, t.surface, Epsilon{0.3, true}, exchange
            );
            addMotion(statistics, t.surface, t.startPositions, exchange);
            values[rank] = allValues(statistics);
        }
    );
    return values;
}

} // namespace

TEST(StatisticsOverRanks, areThoseOfTheWhole)
{
    Statistics whole;
    const ClassifiedSurface interface(hillsOfInterface()), timeSurface(hills(2));
    addSurfaceStatistics(
        whole, interface, timeSurface, Epsilon{0.3, true}, SerialExchange()
    );
    addMotion(whole, timeSurface, seedsOf(timeSurface), SerialExchange());
    const std::vector<scalar> truth(allValues(whole));
    const scalar area = interface.mesh.area();
    EXPECT_NEAR(whole.area, area, 1e-13 * area);
    EXPECT_EQ(whole.nVertices, interface.mesh.points.size());
    EXPECT_EQ(whole.nTriangles, interface.mesh.triangles.size());
    EXPECT_NEAR(whole.coverage(), 0.33, 0.05);
    for (const scalar part :
         {whole.stableArea, whole.attachedArea, whole.enteredArea,
          whole.detachedNearWall, whole.detachedThin, whole.detachedResolved})
    {
        EXPECT_GT(part, 0.02 * area);
        EXPECT_LT(part, 0.9 * area);
    }
    EXPECT_GT(whole.leftArea, 0.02 * area);
    for (const label n : {1, 2, 3, 5})
    {
        for (const std::vector<scalar>& ofRank : valuesOn(n))
        {
            EXPECT_EQ(ofRank, truth) << n;
        }
    }
}
