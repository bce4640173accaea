// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/parametrization/seams/SeamLayout.H"

#include "core/parametrization/Remeshing.H"
#include "core/parametrization/SurfaceShape.H"
#include "core/parametrization/seams/CurvaturePeaks.H"
#include "core/parametrization/seams/DiskCut.H"
#include "core/parametrization/seams/EdgePaths.H"
#include "core/parametrization/seams/SteinerTree.H"
#include "core/parametrization/seams/TreeCotree.H"
#include "core/parametrization/seams/Visibility.H"
#include "shapes/RaggedSurface.H"
#include "shapes/Surfaces.H"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace Foam;
using namespace Foam::stability;
using namespace Foam::stability::shapes;

namespace
{

scalar lengthOf(const PlainSurface& surface, const labelList& edges)
{
    const SurfaceTopology topology(surface.points.size(), surface.triangles);
    const scalarField lengths(edgeLengths(surface.points, topology));
    scalar sum = 0;
    for (const label edgei : edges)
    {
        sum += lengths[edgei];
    }
    return sum;
}

// Three faces of a cube that meet near the origin, as reconstructed and remeshed.
PlainSurface corner(scalar edge)
{
    const boundBox box(point(-1, -1, -1), point(1, 1, 1));
    const auto level = [](const point& p)
    { return max(max(p.x() - .013, p.y() + .021), p.z() - .007); };
    return remesh(marchingTetrahedra(level, box, 20), edge).surface;
}

labelList pointsNear(const PlainSurface& surface, const point& x, scalar radius)
{
    DynamicList<label> points;
    forAll(surface.points, i)
    {
        if (mag(surface.points[i] - x) < radius)
        {
            points.append(i);
        }
    }
    return labelList(std::move(points));
}

// A ball with two thin spikes.
PlainSurface spiked()
{
    PlainSurface surface = sphere(point(0, 0, 0), 1, 4);
    for (point& p : surface.points)
    {
        for (const vector& d : {vector(1, 0, 0), vector(0, 0.6, 0.8)})
        {
            const scalar angle = std::acos(min(1.0, p & d) / mag(p));
            p *= 1 + 1.5 * max(0.0, 1 - angle / 0.4);
        }
    }
    return surface;
}

} // namespace

// Around the tube once, and around the hole once: not longer than along the edges of
// the grid, where the surface can be seen and where not.
TEST(SeamLayout, CutsAHandleAlongShortLoops)
{
    const PlainSurface surface = torus(1, 0.4, 48, 24);
    const SeamLayout layout = topologicalSeams(surface);
    EXPECT_TRUE(layout.terminals.empty());
    const scalar shortest = 2 * M_PI * (0.4 + 0.6);
    const scalar length = lengthOf(surface, layout.edges);
    EXPECT_GT(length, 0.97 * shortest);
    EXPECT_LT(length, 1.1 * shortest);
    // Around the hole it runs on the inner side, which is hidden as well as short.
    const SurfaceTopology topology(surface.points.size(), surface.triangles);
    label nInside = 0;
    for (const label edgei : layout.edges)
    {
        const point& p = surface.points[topology.edges()[edgei].a];
        nInside += std::hypot(p.x(), p.y()) < 0.7;
    }
    EXPECT_GE(nInside, 40);
}

// A sphere with three holes has a loop left over for each hole beside the first: they
// are joined, and nothing else is cut.
TEST(SeamLayout, JoinsBoundaryLoops)
{
    PlainSurface surface = sphere(point(0, 0, 0), 1, 4);
    DynamicList<triFace> triangles;
    const vector holes[] = {
        vector(0, 0, 1), vector(0, std::sin(0.9), std::cos(0.9)),
        vector(std::sin(1.4), 0, std::cos(1.4))};
    for (const triFace& t : surface.triangles)
    {
        const vector centre = normalised(t.centre(surface.points));
        if (std::none_of(
                std::begin(holes), std::end(holes),
                [&](const vector& h) { return (centre & h) > std::cos(0.2); }
            ))
        {
            triangles.append(t);
        }
    }
    // Points inside of the holes go.
    labelList numbers(surface.points.size(), -1);
    DynamicList<point> points;
    for (triFace& t : triangles)
    {
        for (label& pointi : t)
        {
            if (numbers[pointi] < 0)
            {
                numbers[pointi] = points.size();
                points.append(surface.points[pointi]);
            }
            pointi = numbers[pointi];
        }
    }
    surface = {pointField(points), List<triFace>(std::move(triangles))};
    const SurfaceShape shape = shapeOf(surface.points.size(), surface.triangles);
    ASSERT_EQ(shape.nLoops, 3);
    ASSERT_EQ(shape.euler, -1);
    const SeamLayout layout = topologicalSeams(surface);
    // Two gaps of 0.5 and 1 radian.
    EXPECT_NEAR(lengthOf(surface, layout.edges), 0.5 + 1, 0.15);
    const DiskCut cut(surface, layout);
    EXPECT_TRUE(shapeOf(cut.disk().points.size(), cut.disk().triangles).isDisk());
}

// The tips of spikes lie on the seam, whose layout is the same on every run.
TEST(SeamLayout, PassesThroughPeaks)
{
    const PlainSurface surface = spiked();
    const SeamLayout layout = seamsThroughPeaks(surface);
    ASSERT_GE(layout.terminals.size(), 2);
    const DiskCut cut(surface, layout);
    EXPECT_TRUE(shapeOf(cut.disk().points.size(), cut.disk().triangles).isDisk());
    for (const vector& tip : {vector(2.5, 0, 0), vector(0, 1.5, 2)})
    {
        label nNear = 0;
        for (const labelPair& seam : cut.seams())
        {
            nNear += mag(surface.points[seam.first()] - tip) < 0.3
                     || mag(surface.points[seam.second()] - tip) < 0.3;
        }
        EXPECT_GT(nNear, 0);
    }
    EXPECT_EQ(layout.edges, seamsThroughPeaks(surface).edges);
    EXPECT_TRUE(seamsThroughPeaks(sphere(point(0, 0, 0), 1, 4)).terminals.empty());
}

// The corner of a cube has an angle of 3/2 pi, its edges and faces lack nothing.
TEST(CurvaturePeaks, FindTheCornerOfACube)
{
    for (const scalar edge : {0.1, 0.05})
    {
        const PlainSurface surface = corner(edge);
        const labelList peaks = curvaturePeaks(surface);
        ASSERT_EQ(peaks.size(), 1);
        EXPECT_LT(mag(surface.points[peaks[0]]), 0.2);
        EXPECT_NEAR(regionalCurvature(surface)[peaks[0]], 0.5 * M_PI, 0.3);
    }
    const PlainSurface flat =
        grid([](scalar u, scalar v) { return point(3 * u, v, 0); }, 30, 20);
    EXPECT_LT(max(regionalCurvature(flat)), 1e-9);
    EXPECT_TRUE(curvaturePeaks(flat).empty());
    // A drop is curved everywhere, and nowhere more than elsewhere.
    const PlainSurface drop = sphere(point(0, 0, 0), 1, 2);
    EXPECT_GT(min(regionalCurvature(drop)), 1);
    EXPECT_TRUE(curvaturePeaks(drop).empty());
}

// Three points of a grid are joined over the one in the middle of an L, not along the
// three sides of a triangle.
TEST(SteinerTree, JoinsGroups)
{
    const label n = 6;
    const PlainSurface surface =
        grid([&](scalar u, scalar v) { return point(n * u, n * v, 0); }, n, n);
    const SurfaceTopology topology(surface.points.size(), surface.triangles);
    const scalarField lengths(edgeLengths(surface.points, topology));
    const auto at = [&](scalar x, scalar y)
    { return labelList(1, pointsNear(surface, point(x, y, 0), 1e-9)[0]); };
    const labelList tree = steinerTree(
        surface.points.size(), topology, lengths, {at(0, 0), at(4, 0), at(0, 4)}
    );
    EXPECT_NEAR(lengthOf(surface, tree), 8, 1e-12);
    // A group is one: both of its ends are reached already.
    labelList group(at(0, 0));
    group.append(at(4, 0)[0]);
    const labelList two = steinerTree(
        surface.points.size(), topology, lengths, {group, at(5, 0), at(0, 2)}
    );
    EXPECT_NEAR(lengthOf(surface, two), 1 + 2, 1e-12);
}

// The bottom of a deep pit is seen through its mouth only.
TEST(Visibility, IsLessInAPit)
{
    const PlainSurface ball = sphere(point(1, 2, 3), 0.01, 3);
    EXPECT_EQ(min(visibility(ball)), 1);
    const PlainSurface pit = grid(
        [](scalar u, scalar v)
        {
            const scalar x = 4 * u - 2, y = 4 * v - 2;
            return point(x, y, -3 * std::exp(-4 * (x * x + y * y)));
        },
        60, 60
    );
    const scalarField seen = visibility(pit);
    EXPECT_LT(seen[pointsNear(pit, point(0, 0, -3), 1e-6)[0]], 0.3);
    EXPECT_EQ(seen[pointsNear(pit, point(2, 2, 0), 1e-6)[0]], 1);
}

// Of a double torus two loops for each handle stay, and the rest is one disk.
TEST(TreeCotree, LeavesADisk)
{
    const PlainSurface surface = columns({"XXXXX", "X X X", "XXXXX"});
    const SurfaceTopology topology(surface.points.size(), surface.triangles);
    const List<bool> loops = openingLoops(
        surface, topology, List<bool>(topology.edges().size(), false),
        edgeLengths(surface.points, topology), 0
    );
    SeamLayout layout;
    forAll(loops, edgei)
    {
        if (loops[edgei])
        {
            layout.edges.append(edgei);
        }
    }
    EXPECT_NO_THROW(DiskCut(surface, layout));
    const PlainSurface ball = sphere(point(0, 0, 0), 1, 2);
    const SurfaceTopology ofBall(ball.points.size(), ball.triangles);
    const List<bool> none = openingLoops(
        ball, ofBall, List<bool>(ofBall.edges().size(), false),
        edgeLengths(ball.points, ofBall), 0
    );
    EXPECT_EQ(std::count(none.begin(), none.end(), true), 0);
}
