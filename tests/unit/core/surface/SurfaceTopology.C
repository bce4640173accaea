// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/surface/SurfaceTopology.H"

#include <gtest/gtest.h>

using namespace Foam;
using namespace Foam::stability;

namespace
{

const List<triFace> tetrahedron{
    triFace(0, 2, 1), triFace(0, 1, 3), triFace(1, 2, 3), triFace(0, 3, 2)};

} // namespace

TEST(SurfaceTopology, closedSurfaceHasTwoTrianglesAtEachEdge)
{
    const SurfaceTopology topology(4, tetrahedron);
    ASSERT_EQ(topology.edges().size(), 6);
    for (label edgei = 0; edgei < 6; ++edgei)
    {
        const SurfaceEdge& edge = topology.edges()[edgei];
        EXPECT_LT(edge.a, edge.b);
        EXPECT_EQ(edge.nTriangles, 2);
        EXPECT_LT(edge.triangles[0], edge.triangles[1]);
        if (edgei > 0)
        {
            const SurfaceEdge& last = topology.edges()[edgei - 1];
            EXPECT_LT(std::make_pair(last.a, last.b), std::make_pair(edge.a, edge.b));
        }
    }
    EXPECT_EQ(topology.nComponents(), 1);
    EXPECT_EQ(topology.nNonManifoldEdges(), 0);
}

TEST(SurfaceTopology, edgesAndNeighboursBelongToTheSameCorners)
{
    const SurfaceTopology topology(4, tetrahedron);
    forAll(tetrahedron, trianglei)
    {
        for (label k = 0; k < 3; ++k)
        {
            const label p = tetrahedron[trianglei][k];
            const label q = tetrahedron[trianglei][(k + 1) % 3];
            const SurfaceEdge& edge =
                topology.edges()[topology.triangleEdges()[trianglei][k]];
            EXPECT_EQ(edge.a, std::min(p, q));
            EXPECT_EQ(edge.b, std::max(p, q));

            const label other = topology.neighbour(trianglei, k);
            ASSERT_GE(other, 0);
            EXPECT_NE(other, trianglei);
            EXPECT_GE(tetrahedron[other].find(p), 0);
            EXPECT_GE(tetrahedron[other].find(q), 0);
        }
    }
}

TEST(SurfaceTopology, boundaryHasNoNeighbour)
{
    const List<triFace> pair{triFace(0, 1, 2), triFace(2, 1, 3)};
    const SurfaceTopology topology(4, pair);
    EXPECT_EQ(topology.neighbour(0, 0), -1);
    EXPECT_EQ(topology.neighbour(0, 1), 1);
    EXPECT_EQ(topology.neighbour(0, 2), -1);
    EXPECT_EQ(topology.neighbour(1, 0), 0);
}

TEST(SurfaceTopology, componentsAreNumberedByTheirLowestPoint)
{
    // The triangle of the highest points comes first; two fans share point 3 alone.
    const List<triFace> triangles{
        triFace(7, 8, 9), triFace(3, 4, 5), triFace(0, 1, 2), triFace(1, 3, 2),
        triFace(3, 5, 6)};
    const SurfaceTopology topology(10, triangles);
    EXPECT_EQ(topology.nComponents(), 3);
    EXPECT_EQ(topology.components(), labelList({2, 1, 0, 0, 1}));
}

TEST(SurfaceTopology, threeTrianglesAtAnEdgeAreCountedAndNotCrossed)
{
    const List<triFace> fan{triFace(0, 1, 2), triFace(1, 0, 3), triFace(0, 1, 4)};
    const SurfaceTopology topology(5, fan);
    EXPECT_EQ(topology.nNonManifoldEdges(), 1);
    EXPECT_EQ(topology.neighbour(0, 0), -1);
    EXPECT_EQ(topology.neighbour(2, 0), -1);
    EXPECT_EQ(topology.nComponents(), 1);
}

TEST(SurfaceTopology, nothingHasNoEdges)
{
    const SurfaceTopology topology(0, List<triFace>());
    EXPECT_EQ(topology.edges().size(), 0);
    EXPECT_EQ(topology.nComponents(), 0);
}
