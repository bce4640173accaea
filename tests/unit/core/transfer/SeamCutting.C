// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/transfer/SeamCutting.H"

#include "shapes/ChartedSurfaces.H"
#include "shapes/OneRank.H"

#include <gtest/gtest.h>

#include <set>

using namespace Foam;
using namespace Foam::stability;
using namespace Foam::stability::shapes;

namespace
{

constexpr scalar h = 0.5;
constexpr scalar chartScale = 0.05;

// Isometric up to the scale, so that extrapolation is exact; regions lie apart.
vector2D isometricChart(label region, const point& x)
{
    return chartScale * vector2D(x.x(), x.y())
           + vector2D(0.31 + 0.17 * (region % 3), 0.3 + 0.19 * (region / 3));
}

struct Treated
{
    InterfaceMesh mesh;
    List<Match> matches;
    TransferResult result;
};

Treated carry(
    const InterfaceMesh& from, const InterfaceMesh& to,
    const TransferOptions& options = TransferOptions(),
    const MatchingOptions& matching = MatchingOptions()
)
{
    const MatchTarget target(from, matching);
    Treated t{to, matchPoints(to, target, matching), {}};
    t.result = transfer(t.mesh, t.matches, target, options);
    return t;
}

// The square [-2, 2]^2 in cells of 0.25.
template<class RegionOf>
InterfaceMesh chartedSquare(const RegionOf& regionOf, scalar z = 0)
{
    InterfaceMesh mesh = flatSheet(vector2D(-2, -2), vector2D(2, 2), 16, 16, z, h);
    addCharts(mesh, regionOf, isometricChart);
    return mesh;
}

InterfaceMesh oneTriangle(const point& a, const point& b, const point& c)
{
    return triangles(
        pointField(List<point>{a, b, c}), List<triFace>{triFace(0, 1, 2)}, h
    );
}

InterfaceMesh jittered(label n, unsigned seed)
{
    InterfaceMesh mesh =
        flatSheet(vector2D(-1.87, -1.83), vector2D(1.91, 1.79), n, n, 0.04, h);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> shift(-0.25 / n, 0.25 / n);
    for (label j = 0; j <= n; ++j)
    {
        for (label i = 0; i <= n; ++i)
        {
            const vector move(shift(random), shift(random), 0);
            if (i % n != 0 && j % n != 0)
            {
                mesh.points[j * (n + 1) + i] += 3.7 * move;
            }
        }
    }
    return mesh;
}

// Do all corners of a triangle lie on the chart of one region, that of its centre?
template<class RegionOf>
void expectCharts(const InterfaceMesh& mesh, const RegionOf& regionOf, scalar tolerance)
{
    forAll(mesh.triangles, trianglei)
    {
        ASSERT_TRUE(mesh.parametrized(trianglei));
        const label region = regionOf(mesh.centre(trianglei));
        for (label k = 0; k < 3; ++k)
        {
            const vector2D p = mesh.parameters[mesh.corners[trianglei][k]];
            const point& x = mesh.points[mesh.triangles[trianglei][k]];
            EXPECT_LT(mag(p - isometricChart(region, x)), tolerance);
        }
    }
}

// Splitting moves nothing: same area, oriented, no crack, no edge of three triangles.
void expectSameSurface(const InterfaceMesh& after, const InterfaceMesh& before)
{
    EXPECT_NEAR(after.area() / before.area(), 1, 1e-12);
    forAll(after.triangles, trianglei)
    {
        EXPECT_GT(after.areaVector(trianglei).z(), 0);
    }
    const auto boundary = [](const InterfaceMesh& mesh)
    {
        scalar length = 0;
        const SurfaceTopology topology(mesh.points.size(), mesh.triangles);
        EXPECT_EQ(topology.nNonManifoldEdges(), 0);
        for (const SurfaceEdge& edge : topology.edges())
        {
            if (edge.nTriangles == 1)
            {
                length += mag(mesh.points[edge.b] - mesh.points[edge.a]);
            }
        }
        return length;
    };
    EXPECT_NEAR(boundary(after) / boundary(before), 1, 1e-12);
}

// All lists cover what was added, and what was there is still there.
void expectCovered(const Treated& t, const InterfaceMesh& before)
{
    const label nPoints = t.mesh.points.size();
    EXPECT_EQ(t.mesh.cells.size(), nPoints);
    EXPECT_EQ(t.mesh.boundaryFaces.size(), nPoints);
    EXPECT_EQ(t.mesh.cellSizes.size(), nPoints);
    EXPECT_EQ(t.mesh.origins.size(), nPoints);
    EXPECT_EQ(t.matches.size(), nPoints);
    EXPECT_EQ(t.mesh.materials.size(), t.mesh.triangles.size());
    EXPECT_EQ(t.mesh.corners.size(), t.mesh.triangles.size());
    forAll(before.points, pointi)
    {
        EXPECT_EQ(t.mesh.points[pointi], before.points[pointi]);
    }
    for (label pointi = before.points.size(); pointi < nPoints; ++pointi)
    {
        EXPECT_TRUE(t.matches[pointi].stable);
        EXPECT_EQ(t.mesh.cellSizes[pointi], h);
        const point& y = t.matches[pointi].nearest.position;
        EXPECT_LT(mag(t.mesh.origins[pointi] - y), 1e-14); // T is at its origin
    }
}

// The edges of the mesh along which p jumps.
std::vector<SurfaceEdge> seamsOf(const InterfaceMesh& mesh)
{
    std::vector<SurfaceEdge> seams;
    const SurfaceTopology topology(mesh.points.size(), mesh.triangles);
    for (const SurfaceEdge& edge : topology.edges())
    {
        if (isSeam(mesh, edge))
        {
            seams.push_back(edge);
        }
    }
    return seams;
}

label thirds(const point& x)
{
    return x.x() < 0 ? 0 : x.y() > 0 ? 1 : 2;
}

InterfaceMesh aroundTheOrigin()
{
    return oneTriangle(
        point(-0.41, 0.03, 0.02), point(0.37, -0.33, 0.02), point(0.36, 0.39, 0.02)
    );
}

label halves(const point& x)
{
    return x.x() < 0.25 ? 0 : 1;
}

// The surface came from two places: the origins of region 1 are shifted [m].
template<class RegionOf>
void comeFromElsewhere(
    InterfaceMesh& mesh, const RegionOf& regionOf, const vector& shift
)
{
    std::map<label, label> indices;
    forAll(mesh.triangles, trianglei)
    {
        for (label k = 0; k < 3 && regionOf(mesh.centre(trianglei)) == 1; ++k)
        {
            const label pointi = mesh.triangles[trianglei][k];
            const auto known = indices.insert({pointi, mesh.origins.size()});
            if (known.second)
            {
                mesh.origins.append(mesh.points[pointi] + shift);
            }
            mesh.originCorners[trianglei][k] = known.first->second;
        }
    }
}

} // namespace

TEST(SeamCutting, oneSeamCutsAtItsPlace)
{
    const InterfaceMesh from = chartedSquare(halves);
    const InterfaceMesh to = jittered(9, 3);
    const TransferOptions options;
    const Treated t = carry(from, to, options);
    EXPECT_GT(t.result.nCrossing, 15);
    EXPECT_EQ(t.result.nCrossing, t.result.nSplit);
    EXPECT_EQ(t.result.nUnresolved, 0);
    expectSameSurface(t.mesh, to);
    expectCovered(t, to);

    const scalar longest = 0.9;
    expectCharts(t.mesh, halves, options.delta * longest * chartScale);
    scalar length = 0;
    for (const SurfaceEdge& edge : seamsOf(t.mesh))
    {
        for (const label pointi : {edge.a, edge.b})
        {
            EXPECT_NEAR(t.mesh.points[pointi].x(), 0.25, options.delta * longest);
        }
        length += mag(t.mesh.points[edge.b] - t.mesh.points[edge.a]);
    }
    EXPECT_NEAR(length, 3.6, 0.1); // from boundary to boundary, once

    // Away from the seam the corners around a point share one index.
    std::map<label, std::set<label>> indices;
    forAll(t.mesh.triangles, trianglei)
    {
        for (label k = 0; k < 3; ++k)
        {
            indices[t.mesh.triangles[trianglei][k]].insert(t.mesh.corners[trianglei][k]
            );
        }
    }
    for (const auto& entry : indices)
    {
        const bool onSeam = std::abs(t.mesh.points[entry.first].x() - 0.25) < 1e-3;
        EXPECT_EQ(entry.second.size(), onSeam ? 2u : 1u);
    }
}

TEST(SeamCutting, withoutItTrianglesStretchOverTheCharts)
{
    TransferOptions options;
    options.seamTreatment = false;
    const InterfaceMesh to = jittered(9, 3);
    const Treated t = carry(chartedSquare(halves), to, options);
    EXPECT_EQ(t.mesh.points.size(), to.points.size());
    label nMixed = 0;
    forAll(t.mesh.triangles, trianglei)
    {
        const vector2D p = centroidParameter(t.mesh, trianglei);
        const point x = t.mesh.centre(trianglei);
        nMixed += mag(p - isometricChart(0, x)) > 0.01
                  && mag(p - isometricChart(1, x)) > 0.01;
    }
    EXPECT_GT(nMixed, 15);
}

// Nine charts; triangles larger and smaller than the charts, so that all patterns of
// cuts come: several seams within an edge, junctions of four charts.
TEST(SeamCutting, manyCharts)
{
    const auto ninths = [](const point& x)
    {
        return (x.x() < -0.5  ? 0
                : x.x() < 0.5 ? 1
                              : 2)
               + 3
                     * (x.y() < -0.5  ? 0
                        : x.y() < 0.5 ? 1
                                      : 2);
    };
    for (const label n : {2, 3, 5, 11, 40})
    {
        const InterfaceMesh to = jittered(n, n);
        const Treated t = carry(chartedSquare(ninths), to);
        expectSameSurface(t.mesh, to);
        expectCovered(t, to);
        EXPECT_EQ(t.result.nUnresolved, 0);

        // A triangle in the middle of three cuts at a junction reaches over to its
        // neighbours; all the others lie on the chart of their centre.
        scalar wrong = 0;
        forAll(t.mesh.triangles, trianglei)
        {
            const point x = t.mesh.centre(trianglei);
            const vector2D p = centroidParameter(t.mesh, trianglei);
            if (mag(p - isometricChart(ninths(x), x)) > 1e-3 * chartScale)
            {
                wrong += mag(t.mesh.areaVector(trianglei));
            }
        }
        const scalar atJunctions = 4 * sqr(3.7 / n);
        EXPECT_LT(wrong, std::min(atJunctions, 0.05 * to.area())) << n;
    }
}

// Where three seams meet on T, M gets a vertex, and every part lies on one chart.
TEST(SeamCutting, threeChartsThatMeetInsideATriangle)
{
    const InterfaceMesh to = aroundTheOrigin();
    const Treated t = carry(chartedSquare(thirds), to);
    EXPECT_EQ(t.result.nCrossing, 1);
    EXPECT_EQ(t.result.nSplit, 1);
    EXPECT_EQ(t.mesh.triangles.size(), 6);
    ASSERT_EQ(t.mesh.points.size(), 7);
    EXPECT_LT(mag(t.mesh.points[3] - point(0, 0, 0.02)), 1e-4);
    expectSameSurface(t.mesh, to);
    expectCharts(t.mesh, thirds, 1e-3 * chartScale);
}

// Without the gate a surface that faces the other way gets the vertex, too.
TEST(SeamCutting, withoutTheGateSeamsMeetOnWhatFacesTheOtherWay)
{
    InterfaceMesh to = aroundTheOrigin();
    to.triangles[0].flip();
    MatchingOptions matching;
    matching.normalGate = false;
    const Treated t = carry(chartedSquare(thirds), to, TransferOptions(), matching);
    EXPECT_EQ(t.mesh.triangles.size(), 6);
    ASSERT_EQ(t.mesh.points.size(), 7);
    EXPECT_LT(mag(t.mesh.points[3] - point(0, 0, 0.02)), 1e-4);
    expectCharts(t.mesh, thirds, 1e-3 * chartScale);
}

// Three islands that touch have no such point: three cuts, and a triangle in the
// middle whose third corner is extrapolated.
TEST(SeamCutting, threeIslandsThatMeetInsideATriangle)
{
    const InterfaceMesh charted = chartedSquare(thirds);
    InterfaceMesh from;
    std::map<std::pair<label, label>, label> points;
    forAll(charted.triangles, trianglei)
    {
        const label region = thirds(charted.centre(trianglei));
        triFace t;
        for (label k = 0; k < 3; ++k)
        {
            const label pointi = charted.triangles[trianglei][k];
            const auto known = points.insert({{region, pointi}, from.points.size()});
            if (known.second)
            {
                from.points.append(charted.points[pointi]);
            }
            t[k] = known.first->second;
        }
        from.triangles.append(t);
    }
    complete(from, h);
    from.parameters = charted.parameters;
    from.corners = charted.corners;

    const InterfaceMesh to = aroundTheOrigin();
    const Treated t = carry(from, to);
    EXPECT_EQ(t.mesh.triangles.size(), 4);
    EXPECT_EQ(t.mesh.points.size(), 6);
    expectSameSurface(t.mesh, to);
    expectCharts(t.mesh, thirds, 1e-3 * chartScale);
}

TEST(SeamCutting, twoSeamsWithinOneEdge)
{
    const auto stripes = [](const point& x) {
        return x.x() < -0.25 ? 0 : x.x() < 0.25 ? 1 : 2;
    };
    const InterfaceMesh to = oneTriangle(
        point(-0.5, 0, 0.02), point(0.5, 0.05, 0.02), point(-0.45, 0.4, 0.02)
    );
    const Treated t = carry(chartedSquare(stripes), to);
    EXPECT_EQ(t.result.nSplit, 1);
    EXPECT_EQ(t.result.nUnresolved, 0);
    expectSameSurface(t.mesh, to);
    expectCharts(t.mesh, stripes, 1e-3 * chartScale);
    std::set<label> found;
    forAll(t.mesh.triangles, trianglei)
    {
        found.insert(stripes(t.mesh.centre(trianglei)));
    }
    EXPECT_EQ(found, (std::set<label>{0, 1, 2}));
}

// 7.2: with seams planted at .3 and .7 of an edge both are found.
TEST(SeamCutting, bisectionFindsEverySeam)
{
    const auto stripes = [](const point& x) {
        return x.x() < -0.25 ? 0 : x.x() < 0.25 ? 1 : 2;
    };
    const InterfaceMesh from = chartedSquare(stripes);
    const MatchingOptions matching;
    const MatchTarget target(from, matching);
    const SeamShape seams(seamShape(from, target.topology()));
    const ParameterSheets sheets(target, seams);
    const TransferOptions options;
    const SeamBisection bisection(target, sheets, options);
    const vector up(0, 0, 1);
    const SheetPoint a = bisection.locate(point(-0.625, 0.11, 0.01), up, h);
    const SheetPoint b = bisection.locate(point(0.625, 0.13, 0.03), up, h);
    const std::vector<SeamEvent> cuts = bisection.cuts(a, b);
    ASSERT_EQ(cuts.size(), 2u);
    EXPECT_NEAR(cuts[0].at, 0.3, options.delta);
    EXPECT_NEAR(cuts[1].at, 0.7, options.delta);
    EXPECT_LT(mag(cuts[0].before.sheet.p - isometricChart(0, cuts[0].before.x)), 1e-14);
    EXPECT_LT(mag(cuts[0].after.sheet.p - isometricChart(1, cuts[0].after.x)), 1e-14);
    EXPECT_LT(mag(cuts[1].after.sheet.p - isometricChart(2, cuts[1].after.x)), 1e-14);
    EXPECT_EQ(bisection.cuts(a, a).size(), 0u);
}

TEST(SeamCutting, attachmentBetweenTwoCharts)
{
    const auto gap = [](const point& x) {
        return x.x() < -0.25 ? 0 : x.x() < 0.25 ? -1 : 2;
    };
    const InterfaceMesh to = jittered(3, 8);
    const Treated t = carry(chartedSquare(gap), to);
    EXPECT_GT(t.result.nCrossing, 3);
    expectSameSurface(t.mesh, to);
    label nWhole = 0, nMixed = 0;
    forAll(t.mesh.triangles, trianglei)
    {
        label n = 0;
        for (label k = 0; k < 3; ++k)
        {
            n += t.mesh.corners[trianglei][k] >= 0;
        }
        nMixed += n > 0 && n < 3;
        if (n == 3)
        {
            ++nWhole;
            const point x = t.mesh.centre(trianglei);
            const vector2D p = centroidParameter(t.mesh, trianglei);
            EXPECT_LT(mag(p - isometricChart(x.x() < 0 ? 0 : 2, x)), 1e-12);
        }
    }
    EXPECT_GT(nWhole, 10);
    EXPECT_GT(nMixed, 3);
}

TEST(SeamCutting, aHoleThatOneCanWalkAroundIsNoSeam)
{
    const auto hole = [](const point& x)
    { return std::abs(x.x() - 0.12) < 0.13 && std::abs(x.y() - 0.12) < 0.13 ? -1 : 0; };
    const InterfaceMesh from = chartedSquare(hole);
    const InterfaceMesh to = oneTriangle(
        point(-0.2, 0.12, 0.02), point(0.41, 0.13, 0.02), point(0.1, 0.6, 0.02)
    );
    const Treated t = carry(from, to);
    EXPECT_EQ(t.result.nSplit, 0);
    EXPECT_EQ(t.result.nCrossing, 0);
    expectCharts(
        t.mesh, [](const point&) { return 0; }, 1e-14
    );
}

TEST(SeamCutting, aCutNearACornerMovesIntoIt)
{
    const scalar away = 2e-4; // less than snap times the edge
    const InterfaceMesh to = triangles(
        pointField(List<point>{
            point(0.25 + away, 0, 0.02), point(-0.3, -0.5, 0.02),
            point(0.8, -0.4, 0.02), point(0.7, 0.5, 0.02), point(-0.4, 0.6, 0.02)}),
        List<triFace>{
            triFace(0, 1, 2), triFace(0, 2, 3), triFace(0, 3, 4), triFace(0, 4, 1)},
        h
    );
    const Treated t = carry(chartedSquare(halves), to);
    EXPECT_EQ(t.mesh.points.size(), 7); // one on each outer edge, none at point 0
    expectSameSurface(t.mesh, to);
    expectCharts(t.mesh, halves, 2 * away * chartScale);
    std::set<label> atCorner;
    forAll(t.mesh.triangles, trianglei)
    {
        for (label k = 0; k < 3; ++k)
        {
            if (t.mesh.triangles[trianglei][k] == 0)
            {
                atCorner.insert(t.mesh.corners[trianglei][k]);
            }
        }
    }
    EXPECT_EQ(atCorner.size(), 2u);
}

// Seams of T are edges of M: every vertex there has both sides equally near.
TEST(SeamCutting, theSameSurfaceKeepsItsSeams)
{
    const auto quarters = [](const point& x)
    { return (x.x() < 0.25 ? 0 : 1) + (x.y() < -0.5 ? 0 : 3); };
    const InterfaceMesh from = chartedSquare(quarters);
    InterfaceMesh to(from);
    to.clearParametrization();
    const Treated t = carry(from, to);
    EXPECT_EQ(t.mesh.points.size(), from.points.size());
    EXPECT_EQ(t.mesh.triangles, from.triangles);
    EXPECT_EQ(t.result.nSplit, 0);
    expectCharts(t.mesh, quarters, 1e-14);
    EXPECT_EQ(seamsOf(t.mesh).size(), seamsOf(from).size());
}

// A slit closes at its end: p is there on both sides the same.
TEST(SeamCutting, aSlitEndsWhereItEndsOnT)
{
    InterfaceMesh from = flatSheet(vector2D(-2, -2), vector2D(2, 2), 16, 16, 0, h);
    const auto sides = [](const point& x) { return x.y() > 0 ? 0 : 1; };
    const auto cone = [](label side, const point& x)
    {
        const scalar turn =
            x.y() == 0 && x.x() < 0 ? (side ? -M_PI : M_PI) : std::atan2(x.y(), x.x());
        const scalar r = chartScale * std::hypot(x.x(), x.y());
        return vector2D(0.5 + r * std::cos(0.8 * turn), 0.5 + r * std::sin(0.8 * turn));
    };
    addCharts(from, sides, cone);
    const InterfaceMesh to = jittered(7, 5);
    const Treated t = carry(from, to);
    expectSameSurface(t.mesh, to);
    scalar length = 0, last = -GREAT;
    for (const SurfaceEdge& edge : seamsOf(t.mesh))
    {
        for (const label pointi : {edge.a, edge.b})
        {
            EXPECT_LT(std::abs(t.mesh.points[pointi].y()), 0.02);
            last = std::max(last, t.mesh.points[pointi].x());
        }
        length += mag(t.mesh.points[edge.b] - t.mesh.points[edge.a]);
    }
    EXPECT_NEAR(last, 0, 0.03);
    EXPECT_NEAR(length, 1.87, 0.1);
}

// Two islands that have come to touch: there is no seam on T, but no way either.
TEST(SeamCutting, islandsThatMeetAreKeptApart)
{
    InterfaceMesh from = flatSheet(vector2D(-2, -2), vector2D(0.1, 2), 9, 16, 0, h);
    const InterfaceMesh other =
        flatSheet(vector2D(0.02, -2), vector2D(2, 2), 7, 15, 0.05, h);
    const label nPoints = from.points.size(), nFirst = from.triangles.size();
    from.points.append(other.points);
    for (triFace t : other.triangles)
    {
        for (label& pointi : t)
        {
            pointi += nPoints;
        }
        from.triangles.append(t);
    }
    complete(from, h);
    const SurfaceTopology topology(from.points.size(), from.triangles);
    label trianglei = 0;
    addCharts(
        from, [&](const point&) { return trianglei++ < nFirst ? 0 : 1; }, isometricChart
    );

    const InterfaceMesh to = jittered(9, 4);
    const Treated t = carry(from, to);
    EXPECT_GT(t.result.nCrossing, 10);
    EXPECT_GT(t.result.nMerged, 10);
    expectSameSurface(t.mesh, to);
    forAll(t.mesh.triangles, i)
    {
        ASSERT_TRUE(t.mesh.parametrized(i));
        const point x = t.mesh.centre(i);
        // The upper sheet is nearer from here on.
        const label region =
            x.x() < 0.02 - std::sqrt(0.04 * 0.04 - 0.01 * 0.01) ? 0 : 1;
        const vector2D p = centroidParameter(t.mesh, i);
        EXPECT_LT(mag(p - isometricChart(region, x)), 0.1 * chartScale);
    }
}

// The triangle beside a cut edge is split too, though it lacks p at a corner; new
// points on the boundary know their face.
TEST(SeamCutting, neighboursShareTheCut)
{
    InterfaceMesh to = triangles(
        pointField(List<point>{
            point(0.1, 0, 0.02), point(0.5, 0.05, 0.02), point(0.3, 0.5, 0.02),
            point(0.3, -0.4, 0.9)}),
        List<triFace>{triFace(0, 1, 2), triFace(1, 0, 3)}, h
    );
    to.boundaryFaces[0] = 4;
    to.boundaryFaces[1] = 5;
    to.boundaryFaces[2] = 6;
    to.materials[1] = labelPair(0, 2);
    const Treated t = carry(chartedSquare(halves), to);
    EXPECT_FALSE(t.matches[3].stable);
    EXPECT_EQ(t.result.nCrossing, 1);
    EXPECT_EQ(t.result.nSplit, 2);
    ASSERT_EQ(t.mesh.points.size(), 6);
    ASSERT_EQ(t.mesh.triangles.size(), 5);
    EXPECT_NEAR(t.mesh.area() / to.area(), 1, 1e-12);
    EXPECT_EQ(nBoundaryEdges(t.mesh), 5);
    // Of the two new points that on the inner edge lies inside the domain.
    for (label pointi = 4; pointi < 6; ++pointi)
    {
        const bool inner = t.mesh.points[pointi].y() < 0.06;
        EXPECT_EQ(t.mesh.boundaryFaces[pointi] < 0, inner);
    }
    label nBeside = 0;
    forAll(t.mesh.triangles, trianglei)
    {
        nBeside += t.mesh.materials[trianglei] == labelPair(0, 2);
    }
    EXPECT_EQ(nBeside, 2);
}

TEST(SeamCutting, doesNotDependOnThreads)
{
    const InterfaceMesh from = chartedSquare(halves), to = jittered(13, 6);
    TransferOptions options;
    const Treated one = carry(from, to, options);
    options.nThreads = 4;
    const Treated four = carry(from, to, options);
    EXPECT_EQ(one.mesh.points, four.mesh.points);
    EXPECT_EQ(one.mesh.triangles, four.mesh.triangles);
    EXPECT_EQ(one.mesh.corners, four.mesh.corners);
    EXPECT_EQ(one.mesh.parameters, four.mesh.parameters);
    EXPECT_EQ(one.mesh.origins, four.mesh.origins);
}

// At a merger p and the origin jump together, so no triangle lies between two places.
TEST(SeamCutting, aMergerHasAnOriginOnEachSide)
{
    const auto halves = [](const point& x) { return x.x() > 0 ? 1 : 0; };
    const vector shift(0.3, 10, -4);
    InterfaceMesh from = chartedSquare(halves);
    comeFromElsewhere(from, halves, shift);
    const InterfaceMesh to = jittered(13, 7);
    const Treated t = carry(from, to);

    EXPECT_GT(t.mesh.origins.size(), t.mesh.points.size() + 10);
    forAll(t.mesh.triangles, trianglei)
    {
        const label region = halves(t.mesh.centre(trianglei));
        for (label k = 0; k < 3; ++k)
        {
            point x = t.mesh.points[t.mesh.triangles[trianglei][k]];
            x.z() = 0; // T lies there
            EXPECT_LT(
                mag(t.mesh.origin(trianglei, k) - (x + region * shift)), 1e-3 * h
            );
        }
    }
}
