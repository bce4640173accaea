// SPDX-License-Identifier: GPL-3.0-or-later

#include "shapes/DiscShare.H"

#include "mathematicalConstants.H"

#include <gtest/gtest.h>

namespace Foam::stability::shapes
{

namespace
{

// The integral over the rectangle of what lies in the disc, by the midpoint rule.
PlaneShare
summed(const vector2D& low, const vector2D& high, const vector2D& centre, scalar radius)
{
    constexpr label n = 1000;
    PlaneShare sum;
    const scalar dx = (high.x() - low.x()) / n, dy = (high.y() - low.y()) / n;
    for (label i = 0; i < n; ++i)
    {
        for (label j = 0; j < n; ++j)
        {
            const vector2D x(low.x() + (i + 0.5) * dx, low.y() + (j + 0.5) * dy);
            if (mag(x - centre) < radius)
            {
                sum.area += dx * dy;
                sum.moment += x.y() * dx * dy;
            }
        }
    }
    return sum;
}

List<vector2D> rectangle(const vector2D& low, const vector2D& high)
{
    return {low, {high.x(), low.y()}, high, {low.x(), high.y()}};
}

} // namespace

TEST(DiscShare, aPolygonAroundTheDiscHasAllOfIt)
{
    const PlaneShare share = discShare(rectangle({-3, 1}, {4, 9}), {0.5, 4}, 2);
    EXPECT_NEAR(share.area, 4 * constant::mathematical::pi, 1e-12);
    EXPECT_NEAR(share.moment, 16 * constant::mathematical::pi, 1e-12);
}

TEST(DiscShare, aPolygonWithinTheDiscIsWhole)
{
    const auto polygon = rectangle({0.2, 0.5}, {0.7, 1.5});
    EXPECT_NEAR(polygonShare(polygon).area, 0.5, 1e-14);
    EXPECT_NEAR(polygonShare(polygon).moment, 0.5, 1e-14);
    const PlaneShare share = discShare(polygon, {0.3, 0.9}, 3);
    EXPECT_NEAR(share.area, 0.5, 1e-14);
    EXPECT_NEAR(share.moment, 0.5, 1e-14);
}

TEST(DiscShare, anyOverlapIsThatOfTheMidpointRule)
{
    const vector2D low(0.1, 0.3), high(1.3, 1.1);
    for (const vector2D& centre :
         {vector2D(0.2, 0.4), vector2D(0.7, 0.2), vector2D(1.45, 1.3),
          vector2D(0.7, 0.7)})
    {
        const PlaneShare share = discShare(rectangle(low, high), centre, 0.45);
        const PlaneShare expected = summed(low, high, centre, 0.45);
        EXPECT_NEAR(share.area, expected.area, 3e-5) << centre.x();
        EXPECT_NEAR(share.moment, expected.moment, 3e-5) << centre.x();
        EXPECT_GT(share.area, 0.01);
    }
}

TEST(DiscShare, whatLiesApartSharesNothing)
{
    const PlaneShare share = discShare(rectangle({0, 0}, {1, 1}), {3, 3}, 1.2);
    EXPECT_NEAR(share.area, 0, 1e-14);
    EXPECT_NEAR(share.moment, 0, 1e-14);
}

} // namespace Foam::stability::shapes
