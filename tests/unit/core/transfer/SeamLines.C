// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/transfer/SeamLines.H"

#include <gtest/gtest.h>

using namespace Foam;
using namespace Foam::stability;

namespace
{

List<triFace> edgesAlong(const labelList& line)
{
    List<triFace> edges;
    for (label i = 1; i < line.size(); ++i)
    {
        edges.append(triFace(line[i - 1], line[i], line[i]));
    }
    return edges;
}

} // namespace

TEST(SeamLines, straightLineHasItsEndsAlone)
{
    const pointField points(List<point>{
        point(0, 0, 0), point(1, 0.001, 0), point(3, 0, 0.001), point(4, 0, 0)});
    const SeamCorners corners =
        seamCorners(points, edgesAlong({0, 1, 2, 3}), scalarField(4, 0.01));
    EXPECT_EQ(corners.points, labelList({0, 3}));
    EXPECT_EQ(corners.isNode, List<bool>({true, true}));
}

TEST(SeamLines, turnsFartherThanTheToleranceStay)
{
    const pointField points(List<point>{
        point(0, 0, 0), point(1, 0.2, 0), point(2, 0.011, 0), point(3, 0, 0.2),
        point(4, 0, 0)});
    const auto kept = [&](scalar tolerance)
    {
        return seamCorners(
                   points, edgesAlong({0, 1, 2, 3, 4}), scalarField(5, tolerance)
        )
            .points;
    };
    EXPECT_EQ(kept(0.3), labelList({0, 4}));
    EXPECT_EQ(kept(0.15), labelList({0, 1, 3, 4}));
    EXPECT_EQ(kept(0.01), labelList({0, 1, 2, 3, 4}));
}

TEST(SeamLines, whereThreeLinesMeetIsANode)
{
    const pointField points(List<point>{
        point(0, 0, 0), point(1, 0, 0), point(-0.5, 0.9, 0), point(-0.5, -0.9, 0)});
    const List<triFace> edges{triFace(0, 1, 1), triFace(2, 0, 0), triFace(0, 3, 3)};
    const SeamCorners corners = seamCorners(points, edges, scalarField(4, 1e-3));
    EXPECT_EQ(corners.points, labelList({0, 1, 2, 3}));
    EXPECT_EQ(corners.isNode, List<bool>({true, true, true, true}));
}

TEST(SeamLines, closedLineKeepsItsShape)
{
    const label n = 48;
    pointField points(n);
    labelList line;
    forAll(points, i)
    {
        const scalar angle = 2 * M_PI * i / n;
        points[i] = point(std::cos(angle), std::sin(angle), 3);
        line.append(i);
    }
    line.append(0);
    const scalar tolerance = 0.05;
    const SeamCorners corners =
        seamCorners(points, edgesAlong(line), scalarField(n, tolerance));
    EXPECT_GE(corners.points.size(), 6);
    EXPECT_LE(corners.points.size(), 16);
    EXPECT_EQ(corners.points[0], 0);
    forAll(corners.points, i)
    {
        EXPECT_FALSE(corners.isNode[i]);
        // The chord from one to the next stays within the tolerance of the circle.
        const label next = corners.points[(i + 1) % corners.points.size()];
        const point middle = 0.5 * (points[corners.points[i]] + points[next]);
        EXPECT_LT(1 - std::hypot(middle.x(), middle.y()), tolerance);
    }
}

TEST(SeamLines, noSeamsNoCorners)
{
    const pointField points(3, point(Zero));
    EXPECT_EQ(seamCorners(points, List<triFace>(), scalarField(3, 1)).points.size(), 0);
}
