// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/cells/CellPlacement.H"
#include "shapes/BoxMesh.H"

#include <gtest/gtest.h>

using namespace Foam;
using namespace Foam::stability;

TEST(CellPlacement, findsTheHoldingCellNotTheOneWithTheNearestCentre)
{
    shapes::BoxOptions options;
    options.n = Vector<label>(2, 1, 1);
    options.map = [](const point& x)
    { return point(x.x() == 0.5 ? 0.2 : x.x(), x.y(), x.z()); };
    const auto complex = shapes::box(options); // centres at x = 0.1 and 0.6
    const labelList both{0, 1};
    EXPECT_EQ(holdingCell(*complex, both, point(0.3, 0.4, 0.4)), 1);
    EXPECT_EQ(holdingCell(*complex, both, point(0.15, 0.4, 0.4)), 0);
    EXPECT_EQ(holdingCell(*complex, both, point(0.2, 0.4, 0.4)), 0); // the first
    EXPECT_EQ(holdingCell(*complex, both, point(1.1, 0.4, 0.4)), 1); // the nearest
    EXPECT_TRUE(liesWithin(*complex, 0, point(0.2, 1, 0)));
    EXPECT_FALSE(liesWithin(*complex, 0, point(0.2001, 1, 0)));
}

TEST(CellPlacement, findsTheLowestFaceOfTheBoundaryThatPasses)
{
    const auto complex = shapes::unitCube(3);
    const auto patchAt = [&](const point& x, scalar tolerance)
    {
        const label celli = complex->findCell(point(0.2, 0.5, 0.1));
        const label facei = boundaryFaceAt(*complex, celli, x, tolerance);
        return facei < 0 ? -1 : complex->patches()[facei];
    };
    EXPECT_EQ(patchAt(point(0.2, 0.5, 0), 1e-9), 4);
    EXPECT_EQ(patchAt(point(0.2, 0.5, 1e-3), 1e-9), -1);
    EXPECT_EQ(patchAt(point(0.2, 0.5, 1e-3), 2e-3), 4);
    EXPECT_EQ(patchAt(point(0.2, 0.5, 0.5), 1e-9), -1);
    EXPECT_EQ(patchAt(point(0, 0.9, 0.2), 1e-9), 0); // around the cell, not its own
    EXPECT_EQ(patchAt(point(0, 0.5, 0), 1e-9), 0);
}
