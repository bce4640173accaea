// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/matching/Matching.H"

#include "shapes/ChartedSurfaces.H"

#include <gtest/gtest.h>

using namespace Foam;
using namespace Foam::stability;
using namespace Foam::stability::shapes;

namespace
{

const vector2D corner(-0.7, 0.4), opposite(1.9, 2.3);

InterfaceMesh sheet(scalar z, scalar cellSize)
{
    return flatSheet(corner, opposite, 7, 6, z, cellSize);
}

InterfaceMesh turnedOver(InterfaceMesh mesh)
{
    for (triFace& t : mesh.triangles)
    {
        t.flip();
    }
    return mesh;
}

InterfaceMesh both(const InterfaceMesh& a, const InterfaceMesh& b)
{
    InterfaceMesh mesh(a);
    mesh.points.append(b.points);
    for (triFace t : b.triangles)
    {
        for (label& pointi : t)
        {
            pointi += a.points.size();
        }
        mesh.triangles.append(t);
    }
    complete(mesh, a.cellSizes[0]);
    return mesh;
}

Match matchAt(
    const InterfaceMesh& mesh, const MatchingOptions& options, const point& x,
    scalar cellSize, const vector& normal = vector(0, 0, 1)
)
{
    return MatchTarget(mesh, options).match({x, normal, cellSize});
}

} // namespace

// B16: the classifier alone, both ways, absolute and relative to the cell.
TEST(Matching, isSharpAtEpsilon)
{
    const scalar h = 0.37;
    for (const bool relative : {true, false})
    {
        MatchingOptions options;
        options.epsilon.relative = relative;
        options.epsilon.value = relative ? 0.5 : 0.11;
        const scalar epsilon = options.epsilon.at(h);
        for (const scalar side : {-1.0, 1.0})
        {
            const InterfaceMesh m = sheet(0, h);
            const InterfaceMesh near = sheet(side * epsilon * (1 - 1e-9), h);
            const InterfaceMesh far = sheet(side * epsilon * (1 + 1e-9), h);
            const auto expectAll =
                [&](const InterfaceMesh& from, const InterfaceMesh& to, bool stable)
            {
                for (const Match& match :
                     matchPoints(from, MatchTarget(to, options), options))
                {
                    EXPECT_EQ(match.stable, stable);
                    EXPECT_EQ(match.nPreimages, stable ? 1 : 0);
                    EXPECT_NEAR(match.nearest.distance, epsilon, 2e-9 * epsilon);
                }
            };
            expectAll(m, near, true);
            expectAll(near, m, true);
            expectAll(m, far, false);
            expectAll(far, m, false);
        }
    }
}

TEST(Matching, epsilonItselfIsNotStable)
{
    MatchingOptions options;
    options.epsilon = {0.25, false};
    const Match match = matchAt(sheet(0, 1), options, point(0.1, 1.1, 0.25), 1);
    EXPECT_EQ(match.nearest.distance, 0.25);
    EXPECT_FALSE(match.stable);
    EXPECT_EQ(match.nPreimages, 0);
}

TEST(Matching, distanceIsExactUpToTheRadiusAndTheRadiusBeyond)
{
    const scalar h = 0.2;
    MatchingOptions options;
    const InterfaceMesh m = sheet(0, h);
    const Match within = matchAt(m, options, point(0.1, 1.1, 2.9 * h), h);
    EXPECT_NEAR(within.nearest.distance, 2.9 * h, 1e-14);
    EXPECT_GE(within.nearest.triangle, 0);
    const Match beyond = matchAt(m, options, point(0.1, 1.1, 3.1 * h), h);
    EXPECT_EQ(beyond.nearest.triangle, -1);
    EXPECT_DOUBLE_EQ(beyond.nearest.distance, 3 * h);

    options.epsilon = {5, true};
    const Match wide = matchAt(m, options, point(0.1, 1.1, 4.9 * h), h);
    EXPECT_TRUE(wide.stable);
    EXPECT_NEAR(wide.nearest.distance, 4.9 * h, 1e-14);
}

TEST(Matching, openBoundaryMatchesTheEdge)
{
    MatchingOptions options;
    const scalar h = 0.2;
    const Match match =
        matchAt(sheet(0, h), options, point(corner.x() - 0.05, 1.1, 0), h);
    EXPECT_TRUE(match.stable);
    EXPECT_NEAR(match.nearest.position.x(), corner.x(), 1e-14);
    EXPECT_NEAR(match.nearest.distance, 0.05, 1e-14);
}

// A film thinner than epsilon: its other face looks the other way.
TEST(Matching, gateKeepsTheOtherSideOfAFilmOut)
{
    const scalar h = 0.2, thickness = 0.3 * h;
    const InterfaceMesh film = both(sheet(0, h), turnedOver(sheet(-thickness, h)));
    const point x(0.13, 1.21, -0.8 * thickness);

    MatchingOptions options;
    const Match gated = matchAt(film, options, x, h);
    EXPECT_NEAR(gated.nearest.distance, 0.8 * thickness, 1e-14);
    EXPECT_EQ(gated.nPreimages, 1);

    const Match other = matchAt(film, options, x, h, vector(0, 0, -1));
    EXPECT_NEAR(other.nearest.distance, 0.2 * thickness, 1e-14);

    const Match ungated = matchAt(film, options, x, h, vector(Zero));
    EXPECT_NEAR(ungated.nearest.distance, 0.2 * thickness, 1e-14);
    EXPECT_EQ(ungated.nPreimages, 2);

    options.normalGate = false;
    const Match open = matchAt(film, options, x, h);
    EXPECT_NEAR(open.nearest.distance, 0.2 * thickness, 1e-14);
    EXPECT_EQ(open.nPreimages, 2);
}

TEST(Matching, parallelSheetsThatFaceTheSameWayAreTwoPreimages)
{
    const scalar h = 0.2;
    MatchingOptions options;
    const InterfaceMesh sheets = both(sheet(0, h), sheet(0.6 * h, h));
    const scalar x = 0.13, y = 1.21;
    EXPECT_EQ(matchAt(sheets, options, point(x, y, 0.3 * h), h).nPreimages, 2);
    EXPECT_EQ(matchAt(sheets, options, point(x, y, 0.05 * h), h).nPreimages, 1);
    EXPECT_EQ(matchAt(sheets, options, point(x, y, -0.7 * h), h).nPreimages, 0);
}

TEST(Matching, aSeamDoesNotMakeTwoPreimages)
{
    const scalar h = 0.5;
    InterfaceMesh seamed = sheet(0, h);
    addCharts(
        seamed, [](const point& x) { return x.x() < 0.5 ? 0 : 1; },
        [](label region, const point& x)
        { return vector2D(0.1 * x.x() + 0.4 * region, 0.1 * x.y()); }
    );
    MatchingOptions options;
    for (const Match& match :
         matchPoints(sheet(0.1 * h, h), MatchTarget(seamed, options), options))
    {
        EXPECT_EQ(match.nPreimages, 1);
    }
}

TEST(Matching, nothingMatchesNothing)
{
    MatchingOptions options;
    const InterfaceMesh m = sheet(0, 0.3);
    InterfaceMesh empty;
    complete(empty, 0.3);
    const List<Match> matches = matchPoints(m, MatchTarget(empty, options), options);
    ASSERT_EQ(matches.size(), m.points.size());
    for (const Match& match : matches)
    {
        EXPECT_FALSE(match.stable);
        EXPECT_EQ(match.nearest.triangle, -1);
        EXPECT_DOUBLE_EQ(match.nearest.distance, 0.9);
    }
    EXPECT_EQ(matchPoints(empty, MatchTarget(m, options), options).size(), 0);
}

TEST(Matching, doesNotDependOnThreads)
{
    Revolution target, source;
    source.nPhi = 53;
    source.jitter = 0.3;
    source.phase = 0.4;
    const InterfaceMesh t = target(onCylinder), m = source(onCylinder);
    MatchingOptions options;
    const MatchTarget matchTarget(t, options);
    const List<Match> one = matchPoints(m, matchTarget, options);
    options.nThreads = 4;
    const List<Match> four = matchPoints(m, matchTarget, options);
    forAll(one, i)
    {
        EXPECT_EQ(one[i].nearest.triangle, four[i].nearest.triangle);
        EXPECT_EQ(one[i].nearest.distance, four[i].nearest.distance);
        EXPECT_EQ(one[i].nearest.weights, four[i].nearest.weights);
        EXPECT_EQ(one[i].nPreimages, four[i].nPreimages);
    }
}

// Polygons side by side, as plic has them, make one sheet, and those of two sheets two.
TEST(Matching, polygonsSideBySideAreOneSheet)
{
    const scalar h = 0.4;
    const auto loose = [&](scalar z)
    {
        const InterfaceMesh whole(sheet(z, h));
        InterfaceMesh mesh;
        forAll(whole.triangles, trianglei)
        {
            const scalar step = 0.05 * h * (trianglei % 3);
            triFace corners;
            for (label k = 0; k < 3; ++k)
            {
                corners[k] = mesh.points.size();
                mesh.points.append(
                    whole.points[whole.triangles[trianglei][k]] + vector(0, 0, step)
                );
            }
            mesh.triangles.append(corners);
        }
        complete(mesh, h);
        return mesh;
    };
    MatchingOptions options;
    options.epsilon.value = 1.2;
    const InterfaceMesh points(sheet(0.02, h));
    const auto sheets = [&](const InterfaceMesh& target)
    {
        label most = 0, least = 9;
        for (const Match& match :
             matchPoints(points, MatchTarget(target, options), options))
        {
            most = max(most, match.nPreimages);
            least = min(least, match.nPreimages);
        }
        return labelPair(least, most);
    };
    EXPECT_EQ(sheets(loose(0)), labelPair(1, 1));
    EXPECT_EQ(sheets(both(loose(0), loose(0.6 * h))), labelPair(2, 2));
    EXPECT_EQ(sheets(both(loose(0), turnedOver(loose(0.6 * h)))), labelPair(1, 1));
    EXPECT_EQ(sheets(both(sheet(0, h), sheet(0.6 * h, h))), labelPair(2, 2));
    EXPECT_EQ(sheets(both(sheet(0, h), sheet(0.2 * h, h))), labelPair(2, 2));
}
