// SPDX-License-Identifier: GPL-3.0-or-later

#include "shapes/SphereVolume.H"

#include "mathematicalConstants.H"

#include <gtest/gtest.h>

#include <array>

using namespace Foam;
using namespace Foam::stability;
using namespace Foam::stability::shapes;

namespace
{

const Ball ball{{0.726, 0.393, 0.508}, 0.15};

// Volume that the ball shares with the image of the box [low, high] under the shear
// x += 0.3 y + 0.1 z, which keeps its faces planar.
scalar shared(const point& low, const point& high)
{
    const auto corner = [&](int x, int y, int z)
    {
        const point p((x ? high : low).x(), (y ? high : low).y(), (z ? high : low).z());
        return p + vector(0.3 * p.y() + 0.1 * p.z(), 0, 0);
    };
    const std::array<std::array<int, 4>, 6> faces{
        {{0, 4, 6, 2},
         {1, 3, 7, 5},
         {0, 1, 5, 4},
         {2, 6, 7, 3},
         {0, 2, 3, 1},
         {4, 5, 7, 6}}};
    const scalar x = ball.centre.x() - 0.3 * ball.centre.y() - 0.1 * ball.centre.z();
    const point back(x, ball.centre.y(), ball.centre.z());
    const bool holds = cmptMin(back - low) > 0 && cmptMin(high - back) > 0;
    scalar volume = holds ? ball.volume() : 0;
    for (const auto& face : faces)
    {
        pointField polygon(4);
        for (int i = 0; i < 4; ++i)
        {
            polygon[i] = corner(face[i] & 1, face[i] >> 1 & 1, face[i] >> 2 & 1);
        }
        volume += faceFlux(polygon, ball);
    }
    return volume;
}

} // namespace

TEST(SphereVolume, isThatOfACap)
{
    // In the slab 0.46 < y < 0.54 lies a piece between two parallel planes.
    const scalar a = 0.46 - ball.centre.y();
    const scalar b = 0.54 - ball.centre.y();
    const scalar exact = constant::mathematical::pi
                         * (sqr(ball.radius) * (b - a) - (pow3(b) - pow3(a)) / 3);
    EXPECT_NEAR(shared({-9, 0.46, -9}, {9, 0.54, 9}) / exact, 1, 1e-12);
}

TEST(SphereVolume, fillsObliqueCells)
{
    scalar sum = 0;
    const label n = 9;
    for (label i = 0; i < n * n * n; ++i)
    {
        const point low(i % n, i / n % n, i / (n * n));
        const point origin(0.35, 0.2, 0.3);
        const scalar h = 0.4 / n;
        const scalar part = shared(origin + h * low, origin + h * (low + vector::one));
        EXPECT_GE(part, -1e-15);
        EXPECT_LE(part, pow3(h) * (1 + 1e-12));
        sum += part;
    }
    EXPECT_NEAR(sum / ball.volume(), 1, 1e-12);
}

TEST(SphereVolume, agreesWithCounting)
{
    // A corner of the box in the ball, its edges and faces leaving through the sphere.
    const point low(0.5, 0.45, 0.55);
    const scalar h = 0.08;
    const label n = 100;
    label inside = 0;
    for (label i = 0; i < n * n * n; ++i)
    {
        point x =
            low + h / n * (vector(i % n, i / n % n, i / (n * n)) + 0.5 * vector::one);
        x.x() += 0.3 * x.y() + 0.1 * x.z();
        inside += magSqr(x - ball.centre) < sqr(ball.radius);
    }
    const scalar fraction = scalar(inside) / pow3(scalar(n));
    EXPECT_GT(fraction, 0.1);
    EXPECT_LT(fraction, 0.9);
    EXPECT_NEAR(shared(low, low + h * vector::one) / pow3(h), fraction, 2e-4);
}
