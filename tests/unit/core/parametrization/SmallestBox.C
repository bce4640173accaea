// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/parametrization/SmallestBox.H"

#include <gtest/gtest.h>

#include <cmath>

using namespace Foam;
using namespace Foam::stability;

namespace
{

vector2D sizeOfBox(const List<vector2D>& points)
{
    vector2D low = points[0], high = points[0];
    for (const vector2D& p : points)
    {
        low = min(low, p);
        high = max(high, p);
    }
    return high - low;
}

} // namespace

// A rectangle with points inside, turned by any angle, gets its own size as box.
TEST(SmallestBox, IsThatOfATurnedRectangle)
{
    for (const scalar angle : {0.0, 0.3, 1.2, 2.5, -0.7, 0.5 * M_PI})
    {
        List<vector2D> points;
        for (label i = 0; i <= 8; ++i)
        {
            for (label j = 0; j <= 3; ++j)
            {
                const scalar x = 5 + 0.7 * i, y = 0.2 * j - 9;
                points.append(vector2D(
                    x * std::cos(angle) - y * std::sin(angle),
                    x * std::sin(angle) + y * std::cos(angle)
                ));
            }
        }
        const List<vector2D> before = points;
        turnIntoSmallestBox(points);
        const vector2D size = sizeOfBox(points);
        EXPECT_NEAR(max(size.x(), size.y()), 5.6, 1e-12);
        EXPECT_NEAR(min(size.x(), size.y()), 0.6, 1e-12);

        // Turned, neither stretched nor mirrored.
        const vector2D a = before[9] - before[0], b = before[31] - before[0];
        EXPECT_NEAR(
            (points[9] - points[0]).perp(points[31] - points[0]), a.perp(b), 1e-12
        );
        EXPECT_NEAR((points[9] - points[0]) & (points[31] - points[0]), a & b, 1e-12);
    }
}

// A long rectangle fits along the diagonal: of a x b the square has (a + b) / sqrt(2).
TEST(SmallestBox, SquareTakesTheDiagonal)
{
    for (const scalar angle : {0.0, 0.3, 1.2})
    {
        List<vector2D> points;
        for (const vector2D& p :
             {vector2D(0, 0), vector2D(7, 0), vector2D(7, 1), vector2D(0, 1)})
        {
            points.append(vector2D(
                p.x() * std::cos(angle) - p.y() * std::sin(angle) + 3,
                p.x() * std::sin(angle) + p.y() * std::cos(angle)
            ));
        }
        turnIntoSmallestSquare(points);
        const vector2D size = sizeOfBox(points);
        EXPECT_NEAR(max(size.x(), size.y()), 8 / std::sqrt(2.0), 0.03);
        EXPECT_NEAR((points[1] - points[0]).perp(points[3] - points[0]), 7, 1e-12);
    }
}

TEST(SmallestBox, OfOnePointIsLegal)
{
    List<vector2D> points(1, vector2D(3, 4));
    turnIntoSmallestBox(points);
    EXPECT_EQ(sizeOfBox(points), vector2D(0, 0));
    points = List<vector2D>(2, vector2D(3, 4));
    turnIntoSmallestBox(points);
    EXPECT_EQ(sizeOfBox(points), vector2D(0, 0));
}
