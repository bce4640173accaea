// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/parametrization/SurfaceShape.H"

#include "shapes/Surfaces.H"

#include <gtest/gtest.h>

using namespace Foam;
using namespace Foam::stability;
using namespace Foam::stability::shapes;

// Two triangles that touch in a point are two fans.
TEST(SurfaceShape, SplitsFans)
{
    const List<triFace> triangles({triFace(0, 1, 2), triFace(2, 3, 4)});
    const SurfaceTopology topology(5, triangles);
    const Fans fans =
        splitFans(topology, triangles, List<bool>(topology.edges().size(), false));
    EXPECT_EQ(fans.points, labelList({0, 1, 2, 2, 3, 4}));
    EXPECT_NE(fans.corners[0][2], fans.corners[1][0]);
}

// Along a cut from rim to rim all points are doubled; a cut that ends inside leaves
// its end whole.
TEST(SurfaceShape, SplitsFansAlongCuts)
{
    const label n = 6;
    const PlainSurface square =
        grid([&](scalar u, scalar v) { return point(n * u, n * v, 0); }, n, n);
    const SurfaceTopology topology(square.points.size(), square.triangles);
    for (const scalar end : {scalar(n), 3.0})
    {
        List<bool> cut(topology.edges().size(), false);
        forAll(cut, edgei)
        {
            const point& a = square.points[topology.edges()[edgei].a];
            const point& b = square.points[topology.edges()[edgei].b];
            cut[edgei] = mag(a.x() - 2) < 1e-9 && mag(b.x() - 2) < 1e-9
                         && max(a.y(), b.y()) < end + 1e-9;
        }
        const Fans fans = splitFans(topology, square.triangles, cut);
        const label nDoubled = end < n ? 3 : n + 1;
        EXPECT_EQ(fans.points.size(), square.points.size() + nDoubled);
    }
}

TEST(SurfaceShape, FindsLoopsInTheDirectionOfTriangles)
{
    const PlainSurface ring = annulus(0.5, 1, 16, 2);
    const List<labelList> loops = boundaryLoops(ring.points.size(), ring.triangles);
    ASSERT_EQ(loops.size(), 2);
    for (const labelList& loop : loops)
    {
        EXPECT_EQ(loop.size(), 16);
        scalar area = 0;
        forAll(loop, i)
        {
            area +=
                0.5 * (ring.points[loop[i]] ^ ring.points[loop[loop.fcIndex(i)]]).z();
        }
        // The surface lies to the left: outside of the inner loop.
        const bool outer = mag(ring.points[loop[0]]) > 0.9;
        EXPECT_EQ(area > 0, outer);
    }
}

TEST(SurfaceShape, TellsDisksFromOthers)
{
    const PlainSurface cap = hemisphere(point(0, 0, 0), 1, 2);
    EXPECT_TRUE(shapeOf(cap.points.size(), cap.triangles).isDisk());
    const PlainSurface ball = sphere(point(0, 0, 0), 1, 2);
    EXPECT_EQ(shapeOf(ball.points.size(), ball.triangles).euler, 2);
    EXPECT_FALSE(shapeOf(ball.points.size(), ball.triangles).isDisk());

    // Unused points do not count; three triangles at an edge are not manifold.
    List<triFace> book({triFace(0, 1, 2), triFace(1, 0, 3), triFace(0, 1, 5)});
    EXPECT_FALSE(shapeOf(9, book).manifold);
    book.setSize(2);
    EXPECT_TRUE(shapeOf(9, book).isDisk());
}
