// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/surface/SurfaceLocator.H"

#include <gtest/gtest.h>

#include <random>

using namespace Foam;
using namespace Foam::stability;

namespace
{

struct Soup
{
    pointField points;
    List<triFace> triangles;
};

std::mt19937 generator(42);

point randomPoint(scalar halfWidth)
{
    std::uniform_real_distribution<double> x(-halfWidth, halfWidth);
    return point(x(generator) + 0.3, x(generator) - 7, x(generator) + 11);
}

// Small triangles, needles, degenerate ones and, if wished, one that spans them all.
Soup randomSoup(label n, scalar size, bool huge)
{
    Soup soup;
    const auto add = [&](const point& a, const point& b, const point& c)
    {
        const label first = soup.points.size();
        soup.points.append(a);
        soup.points.append(b);
        soup.points.append(c);
        soup.triangles.append(triFace(first, first + 1, first + 2));
    };
    for (label i = 0; i < n; ++i)
    {
        const point a = randomPoint(1);
        const vector u = size * (randomPoint(1) - randomPoint(1));
        const vector v = size * (randomPoint(1) - randomPoint(1));
        add(a, a + u, i % 7 == 0 ? a + 0.3 * u : i % 5 == 0 ? a + 20 * u + v : a + v);
    }
    if (huge)
    {
        add(point(-3000, -7, 11), point(3000, -7.1, 11), point(0, 2000, 11.2));
    }
    return soup;
}

SurfacePoint bruteForce(const Soup& soup, const point& x, scalar radius)
{
    SurfacePoint best;
    forAll(soup.triangles, trianglei)
    {
        const triFace& t = soup.triangles[trianglei];
        SurfacePoint p =
            closestPoint(x, soup.points[t[0]], soup.points[t[1]], soup.points[t[2]]);
        if (p.distance < best.distance && p.distance < radius)
        {
            best = p;
            best.triangle = trianglei;
        }
    }
    return best;
}

// Optimality on a convex set: no corner lies on the near side of the plane through
// the closest point, perpendicular to the way to it.
void expectClosest(const point& x, const point& a, const point& b, const point& c)
{
    const SurfacePoint p = closestPoint(x, a, b, c);
    const scalar size = mag(x - a) + mag(b - a) + mag(c - a);
    EXPECT_NEAR(p.weights[0] + p.weights[1] + p.weights[2], 1, 1e-12);
    EXPECT_GE(std::min({p.weights[0], p.weights[1], p.weights[2]}), -1e-12);
    const point y = p.weights[0] * a + p.weights[1] * b + p.weights[2] * c;
    EXPECT_LT(mag(y - p.position), 1e-12 * size);
    EXPECT_NEAR(mag(x - y), p.distance, 1e-12 * size);
    for (const point& corner : {a, b, c})
    {
        EXPECT_LE((x - y) & (corner - y), 1e-11 * size * size);
    }
}

} // namespace

TEST(ClosestPoint, isOptimalForAnyTriangle)
{
    for (label i = 0; i < 3000; ++i)
    {
        const point a = randomPoint(1), b = randomPoint(1), c = randomPoint(1);
        const point x = randomPoint(2);
        expectClosest(x, a, b, c);
        expectClosest(x, a, b, a + 1e-5 * (c - a)); // a needle
        expectClosest(x, a, b, a + 0.37 * (b - a)); // three points on a line
        expectClosest(x, a, b, b);
        expectClosest(x, a, a, a);
    }
}

TEST(SurfaceLocator, findsWhatASearchOfAllTrianglesFinds)
{
    for (const bool huge : {false, true})
    {
        const Soup soup = randomSoup(400, 0.05, huge);
        for (const scalar spacing : {1e-9, 0.02, 0.3, 100.0})
        {
            const SurfaceLocator locator(soup.points, soup.triangles, spacing);
            for (label i = 0; i < 300; ++i)
            {
                const point x = randomPoint(i % 3 == 0 ? 3 : 1);
                const scalar radius = i % 2 ? 0.1 : 5.0;
                const SurfacePoint truth = bruteForce(soup, x, radius);
                const SurfacePoint found = locator.closest(x, radius);
                EXPECT_EQ(found.triangle, truth.triangle);
                EXPECT_EQ(found.distance, truth.distance);
            }
        }
    }
}

TEST(SurfaceLocator, radiusIsStrict)
{
    const pointField points(List<point>{point(0, 0, 0), point(1, 0, 0), point(0, 1, 0)}
    );
    const List<triFace> triangles{triFace(0, 1, 2)};
    const SurfaceLocator locator(points, triangles, 0.1);
    const point x(0.2, 0.2, 0.5);
    EXPECT_EQ(locator.closest(x, 0.5).triangle, -1);
    EXPECT_EQ(locator.closest(x, 0.5 * (1 + 1e-12)).triangle, 0);
}

TEST(SurfaceLocator, equalDistanceGoesToTheLowestAdmittedTriangle)
{
    // Four triangles around one point, in an order that no grid would give.
    const pointField points(List<point>{
        point(0, 0, 0), point(1, 0, 0), point(0, 1, 0), point(-1, 0, 0),
        point(0, -1, 0)});
    const List<triFace> triangles{
        triFace(0, 3, 4), triFace(0, 1, 2), triFace(0, 4, 1), triFace(0, 2, 3)};
    const SurfaceLocator locator(points, triangles, 0.1);
    const point x(0, 0, 0.25);
    EXPECT_EQ(locator.closest(x, 1).triangle, 0);
    const auto notFirst = [](label trianglei) { return trianglei > 0; };
    EXPECT_EQ(locator.closest(x, 1, notFirst).triangle, 1);
}

TEST(SurfaceLocator, candidatesHoldAllNearTrianglesOnce)
{
    const Soup soup = randomSoup(400, 0.05, true);
    const SurfaceLocator locator(soup.points, soup.triangles, 0.05);
    for (label i = 0; i < 100; ++i)
    {
        const point x = randomPoint(1);
        DynamicList<label> candidates{-5};
        locator.candidates(x, 0.2, candidates);
        EXPECT_TRUE(std::is_sorted(candidates.begin(), candidates.end()));
        EXPECT_EQ(
            std::adjacent_find(candidates.begin(), candidates.end()), candidates.end()
        );
        forAll(soup.triangles, trianglei)
        {
            if (locator.closestOn(trianglei, x).distance < 0.2)
            {
                EXPECT_TRUE(
                    std::binary_search(candidates.begin(), candidates.end(), trianglei)
                );
            }
        }
    }
}

TEST(SurfaceLocator, leavesOutWhatIsNotFinite)
{
    const scalar nan = std::numeric_limits<double>::quiet_NaN();
    const pointField points(List<point>{
        point(0, 0, 0), point(1, 0, 0), point(0, 1, 0), point(nan, 0, 0)});
    const List<triFace> triangles{triFace(0, 1, 3), triFace(0, 1, 2)};
    const SurfaceLocator locator(points, triangles, 0.1);
    EXPECT_EQ(locator.closest(point(0.1, 0.1, 0.1), 1).triangle, 1);
    EXPECT_EQ(locator.closest(point(0, nan, 0), 1).triangle, -1);
    DynamicList<label> candidates;
    locator.candidates(point(nan, 0, 0), 1, candidates);
    EXPECT_EQ(candidates.size(), 0);
}

TEST(SurfaceLocator, findsNothingOnNothing)
{
    const pointField points;
    const List<triFace> triangles;
    const SurfaceLocator locator(points, triangles, 0.1);
    const SurfacePoint found = locator.closest(point(1, 2, 3), GREAT);
    EXPECT_EQ(found.triangle, -1);
    EXPECT_EQ(found.distance, GREAT);
}

TEST(SurfaceLocator, answersFromFarAway)
{
    const pointField points(List<point>{point(0, 0, 0), point(1, 0, 0), point(0, 1, 0)}
    );
    const List<triFace> triangles{triFace(0, 1, 2)};
    const SurfaceLocator locator(points, triangles, 1e-3);
    const SurfacePoint found = locator.closest(point(0.2, 0.2, 1e9), GREAT);
    EXPECT_EQ(found.triangle, 0);
    EXPECT_DOUBLE_EQ(found.distance, 1e9);
}
