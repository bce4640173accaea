// SPDX-License-Identifier: GPL-3.0-or-later

#include "shapes/PlaneVolume.H"

#include <gtest/gtest.h>

using namespace Foam;
using Foam::stability::shapes::boxShareBehind;

// By counting on a fine lattice.
TEST(PlaneVolume, isWhatCountingGives)
{
    constexpr label n = 60;
    for (const vector& rises : {vector(0.3, -0.7, 0.2), vector(1, 1, 1e-3)})
    {
        for (const scalar level : {-0.47, -0.1, 0.0, 0.23, 0.58})
        {
            label nBehind = 0;
            for (label i = 0; i < n * n * n; ++i)
            {
                const vector x(i % n, i / n % n, i / (n * n));
                const vector fromCentre = (x + vector::one / 2) / n - vector::one / 2;
                nBehind += level + (rises & fromCentre) < 0;
            }
            EXPECT_NEAR(boxShareBehind(level, rises), nBehind / pow3(scalar(n)), 0.01);
        }
    }
}

TEST(PlaneVolume, alongAxesAndInCorners)
{
    EXPECT_NEAR(boxShareBehind(0.25, vector(0, 0, -2)), 0.375, 1e-15);
    EXPECT_NEAR(boxShareBehind(0, vector(1, -1, 0)), 0.5, 1e-15);
    // The corner is 0.3 of the edges deep.
    EXPECT_NEAR(boxShareBehind(1.2, vector(1, 1, 1)), 0.027 / 6, 1e-15);
    EXPECT_NEAR(boxShareBehind(-1.2, vector(1, 1, 1)), 1 - 0.027 / 6, 1e-15);
}

TEST(PlaneVolume, allOrNothing)
{
    EXPECT_EQ(boxShareBehind(1.6, vector(1, 1, 1)), 0);
    EXPECT_EQ(boxShareBehind(-1.6, vector(1, 1, 1)), 1);
    EXPECT_EQ(boxShareBehind(-1, vector::zero), 1);
    EXPECT_EQ(boxShareBehind(1, vector::zero), 0);
}
