// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/transfer/CarriedOrigins.H"

#include "core/transfer/Transfer.H"
#include "shapes/ChartedSurfaces.H"
#include "shapes/OneRank.H"

#include <gtest/gtest.h>

#include <set>

using namespace Foam;
using namespace Foam::stability;
using namespace Foam::stability::shapes;

namespace
{

constexpr scalar sizeOfCells = 0.25;

// Regions that meet at (bend, 0.25) on the line x = bend: 0 | 1 below, 2 above.
InterfaceMesh sheet(scalar bend, const vector2D& shift)
{
    InterfaceMesh mesh =
        flatSheet(vector2D(-1, -1), vector2D(1, 1), 8, 8, 0.5, sizeOfCells);
    const auto region = [](const point& x) {
        return x.x() < 0 ? 0 : x.y() < 0.25 ? 1 : 2;
    };
    labelList regions(mesh.triangles.size());
    forAll(regions, i)
    {
        regions[i] = region(mesh.centre(i));
    }
    for (point& x : mesh.points)
    {
        x.x() += bend * (1 - sqr(x.x())); // the seam is bent away, the rim stays
    }
    label next = 0;
    addCharts(
        mesh, [&](const point&) { return regions[next++]; },
        [](label r, const point& x)
        { return vector2D(0.1 * x.x() + 0.3 * r, 0.1 * x.y() + 0.2); }
    );
    mesh.setOrigins(mesh.points);
    for (point& x : mesh.points)
    {
        x += vector(shift.x(), shift.y(), 0);
    }
    return mesh;
}

InterfaceMesh carried(const InterfaceMesh& T, const StartChart& chart)
{
    InterfaceMesh mesh =
        flatSheet(vector2D(-0.6, -0.7), vector2D(0.9, 0.8), 9, 8, 0.51, sizeOfCells);
    MatchingOptions matching;
    const MatchTarget target(T, matching);
    List<Match> matches = matchPoints(mesh, target, matching);
    transfer(mesh, matches, target, TransferOptions(), chart);
    return mesh;
}

// Places, at the start, of the points of M with this many p.
pointField pointsWith(const InterfaceMesh& mesh, std::size_t nParameters)
{
    List<std::set<label>> parameters(mesh.points.size());
    forAll(mesh.triangles, trianglei)
    {
        for (label k = 0; k < 3; ++k)
        {
            parameters[mesh.triangles[trianglei][k]].insert(mesh.corners[trianglei][k]);
        }
    }
    pointField places;
    forAll(parameters, pointi)
    {
        if (parameters[pointi].size() == nParameters)
        {
            places.append(mesh.origins[pointi]);
        }
    }
    return places;
}

} // namespace

// T's seams have crept away by 0.01 m, the origins know it: M's lie where they began.
TEST(CarriedOrigins, bringSeamsToWhereTheyBegan)
{
    const StartChart chart(startChart(sheet(0, vector2D(0, 0))));
    const InterfaceMesh T = sheet(0.01, vector2D(0.13, 0.07));
    const auto farthest = [](const pointField& places)
    {
        scalar worst = 0;
        for (const point& x : places)
        {
            const scalar vertical = mag(x.x()), level = mag(x.y() - 0.25);
            worst = max(worst, x.x() > 0.1 ? min(vertical, level) : vertical);
        }
        return worst;
    };
    const pointField crept = pointsWith(carried(T, StartChart()), 2);
    const pointField settled = pointsWith(carried(T, chart), 2);
    ASSERT_GT(crept.size(), 15);
    ASSERT_GT(settled.size(), 15);
    EXPECT_GT(farthest(crept), 0.007);
    EXPECT_LT(farthest(settled), 1e-3 * sizeOfCells);
}

TEST(CarriedOrigins, bringMeetingsToWhereTheyBegan)
{
    const StartChart chart(startChart(sheet(0, vector2D(0, 0))));
    const InterfaceMesh T = sheet(0.02, vector2D(0.13, 0.07));
    const MatchTarget target(T, MatchingOptions());
    const CarriedOrigins origins(target, chart);
    label nMeetings = 0;
    for (const SeamNode& node : origins.settled(seamShape(T, target.topology()).nodes))
    {
        if (node.isEnd)
        {
            ++nMeetings;
            EXPECT_LT(mag(node.x - point(0.13, 0.32, 0.5)), 1e-12);
        }
    }
    EXPECT_EQ(nMeetings, 1);
}

// Where a match has corners that attached, what surrounds it tells the origin.
TEST(CarriedOrigins, areNotMixedWithThoseOfWhatAttached)
{
    InterfaceMesh T = sheet(0, vector2D(0.13, 0.07));
    const label triangle = 70, source = 71; // they share two corners
    const label stranger = T.triangles[triangle][1];
    T.origins[stranger] = point(5, 6, 7);
    T.corners[triangle][1] = InterfaceMesh::noParameter;
    const MatchTarget target(T, MatchingOptions());
    const StartChart chart;
    const CarriedOrigins origins(target, chart);
    Match match;
    match.stable = true;
    match.nearest.triangle = triangle;
    match.nearest.weights = FixedList<scalar, 3>{0.4, 0.2, 0.4};
    for (label k = 0; k < 3; ++k)
    {
        match.nearest.position +=
            match.nearest.weights[k] * T.points[T.triangles[triangle][k]];
    }
    const point exact = match.nearest.position - vector(0.13, 0.07, 0);
    const bool shares = T.triangles[source][0] == stranger
                        || T.triangles[source][1] == stranger
                        || T.triangles[source][2] == stranger;
    ASSERT_FALSE(shares);
    EXPECT_LT(mag(origins.at(match, source) - exact), 1e-12);
    EXPECT_GT(mag(origins.at(match, -1) - exact), 1);
}

// A sliver with a small error says nothing sensible of what lies beside it.
TEST(CarriedOrigins, areNotCarriedFarBeyondATriangle)
{
    InterfaceMesh T;
    T.points = List<point>{
        point(0, 0, 0), point(1, 0, 0), point(0.5, 1e-6, 0), point(0.5, -1, 0)};
    T.triangles = List<triFace>{triFace(0, 1, 2), triFace(1, 0, 3)};
    T.cells = labelList(4, -1);
    T.boundaryFaces = labelList(4, -1);
    T.cellSizes = scalarField(4, 1);
    T.clearParametrization();
    T.parameters = List<vector2D>{vector2D(0, 0), vector2D(1, 0), vector2D(0.5, 0.1)};
    T.corners[0] = CornerIndices{0, 1, 2};
    T.setOrigins(T.points);
    T.origins[2].z() = 1e-3;
    const MatchTarget target(T, MatchingOptions());
    const StartChart none;
    const CarriedOrigins origins(target, none);
    Match match;
    match.nearest = target.locator().closestOn(1, point(0.5, -0.1, 0));
    const point near(origins.at(match, 0));
    EXPECT_LE(mag(near - point(0.5, 0, 0)), 4 * 0.1 + 1e-3);
    EXPECT_GT(mag(near - point(0.5, 0, 0)), 0.05); // it does extrapolate
}
