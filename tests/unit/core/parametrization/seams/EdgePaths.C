// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/parametrization/seams/EdgePaths.H"

#include "shapes/Surfaces.H"

#include <gtest/gtest.h>

using namespace Foam;
using namespace Foam::stability;
using namespace Foam::stability::shapes;

// On a grid of squares with one diagonal each, shortest paths are known: diagonals
// as long as both coordinates go on, then straight.
TEST(EdgePaths, KnowDistancesOnAGrid)
{
    const label n = 7;
    const PlainSurface surface =
        grid([&](scalar u, scalar v) { return point(n * u, n * v, 2); }, n, n);
    const SurfaceTopology topology(surface.points.size(), surface.triangles);
    label origin = -1, corner = -1, probe = -1;
    forAll(surface.points, i)
    {
        origin = mag(surface.points[i] - point(0, 0, 2)) < 1e-9 ? i : origin;
        corner = mag(surface.points[i] - point(0, n, 2)) < 1e-9 ? i : corner;
        probe = mag(surface.points[i] - point(5, 2, 2)) < 1e-9 ? i : probe;
    }
    const EdgePaths paths(surface.points, topology, labelList(1, origin));
    EXPECT_NEAR(paths.distances()[probe], 2 * std::sqrt(2.0) + 3, 1e-12);
    EXPECT_NEAR(paths.distances()[corner], n, 1e-12);
    EXPECT_EQ(paths.edgesTo(probe).size(), 5);
    EXPECT_TRUE(paths.edgesTo(origin).empty());

    // The path is one: its lengths add up to the distance.
    scalar length = 0;
    for (const label edgei : paths.edgesTo(probe))
    {
        const SurfaceEdge& e = topology.edges()[edgei];
        length += mag(surface.points[e.a] - surface.points[e.b]);
    }
    EXPECT_NEAR(length, paths.distances()[probe], 1e-12);

    const scalar farthest = paths.distances()[paths.farthest()];
    EXPECT_NEAR(farthest, n * std::sqrt(2.0), 1e-12);
}

// The nearer of two ways wins, though its first leg is the longer one.
TEST(EdgePaths, LookFurtherThanTheNearestPoint)
{
    const pointField points(
        {point(0, 0, 0), point(1, 0, 0), point(0.9, 1, 0), point(1, 4, 0)}
    );
    const List<triFace> triangles({triFace(0, 1, 2), triFace(1, 3, 2)});
    const SurfaceTopology topology(points.size(), triangles);
    const EdgePaths paths(points, topology, labelList(1, 0));
    const scalar expected = mag(points[2]) + mag(points[3] - points[2]);
    EXPECT_NEAR(paths.distances()[3], expected, 1e-12);
    EXPECT_EQ(paths.farthest(), 3);
}

TEST(EdgePaths, DoNotLeadToOtherComponents)
{
    const PlainSurface two =
        inOneScene({sphere(point(0, 0, 0), 1, 1), sphere(point(9, 0, 0), 1, 1)});
    const SurfaceTopology topology(two.points.size(), two.triangles);
    const EdgePaths paths(two.points, topology, labelList(1, 0));
    const label last = two.points.size() - 1;
    EXPECT_GE(paths.distances()[last], GREAT);
    EXPECT_TRUE(paths.edgesTo(last).empty());
    EXPECT_LT(paths.farthest(), two.points.size() / 2);
}
