// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/cells/ThinWalls.H"

#include "core/cells/ThinWallSearch.H"
#include "shapes/BoxMesh.H"
#include "shapes/CutOut.H"
#include "shapes/ThreadRanks.H"

#include <gtest/gtest.h>

using namespace Foam;
using namespace Foam::stability;

namespace
{

// The unit cube with a wall at x = 1/2 up to z = 1/2.
CellComplexInput withWall()
{
    return shapes::cutOut(
        shapes::boxInput(shapes::BoxOptions()), [](const point&) { return false; },
        [](const point& x) { return mag(x.x() - 0.5) < 0.05 && x.z() < 0.5; }
    );
}

void expectWall(const ThinWalls& walls)
{
    EXPECT_TRUE(walls.part(point(0.4, 0.5, 0.2), point(0.6, 0.5, 0.2)));
    EXPECT_TRUE(walls.part(point(0.6, 0.1, 0.3), point(0.45, 0.3, 0.4)));
    EXPECT_TRUE(walls.part(point(0.01, 0.5, 0.1), point(0.99, 0.5, 0.15)));
    // Through an edge, and through a corner, of faces.
    EXPECT_TRUE(walls.part(point(0.4, 0.25, 0.2), point(0.6, 0.25, 0.2)));
    EXPECT_TRUE(walls.part(point(0.4, 0.25, 0.125), point(0.6, 0.25, 0.125)));
    // Above its rim, on one side, along it, and too short.
    EXPECT_FALSE(walls.part(point(0.4, 0.5, 0.51), point(0.6, 0.5, 0.52)));
    EXPECT_FALSE(walls.part(point(0.4, 0.5, 0.2), point(0.49, 0.9, 0.2)));
    EXPECT_FALSE(walls.part(point(0.5, 0.5, 0.2), point(0.5, 0.9, 0.2)));
    EXPECT_FALSE(walls.part(point(0.4, 0.5, 0.2), point(0.499, 0.5, 0.2)));
    EXPECT_FALSE(walls.part(point(0.01, 0.5, 0.7), point(0.99, 0.5, 0.75)));
}

} // namespace

TEST(ThinWalls, partWhatLiesOnTheirTwoSides)
{
    const SerialExchange alone;
    const auto walls = findThinWalls(withWall(), nullptr, alone);
    ASSERT_TRUE(walls);
    expectWall(*walls);
}

TEST(ThinWalls, areNotSeenInSolidObstacles)
{
    const SerialExchange alone;
    const auto inObstacle = [](const point& x)
    { return mag(x - point(0.5, 0.5, 0.5)) < 0.2; };
    EXPECT_FALSE(findThinWalls(
        shapes::cutOut(shapes::boxInput(shapes::BoxOptions()), inObstacle), nullptr,
        alone
    ));
}

// The wall lies where the mesh is cut: each rank has one side.
TEST(ThinWalls, areTheSameOnAllRanks)
{
    const CellComplexInput whole(withWall());
    for (const bool alongWall : {true, false})
    {
        shapes::onRanks(
            2,
            [&](const Exchange& exchange)
            {
                const auto mine = [&](const point& x) {
                    return ((alongWall ? x.x() : x.y()) < 0.5)
                           == (exchange.rank() == 0);
                };
                CellComplexInput part(
                    shapes::cutOut(whole, [&](const point& x) { return !mine(x); })
                );
                // Behind what was cut here alone the mesh goes on.
                const label n = part.neighbour.size();
                forAll(part.kinds, i)
                {
                    const point centre(part.faces[n + i].centre(part.points));
                    const scalar across = alongWall ? centre.x() : centre.y();
                    const bool cut = mag(across - 0.5) < 1e-6;
                    if (cut && !(alongWall && centre.z() < 0.5))
                    {
                        part.kinds[i] = BoundaryKind::coupledUnknown;
                    }
                }
                const auto walls = findThinWalls(part, nullptr, exchange);
                ASSERT_TRUE(walls);
                expectWall(*walls);
            }
        );
    }
}
