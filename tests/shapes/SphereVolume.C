// SPDX-License-Identifier: GPL-3.0-or-later

#include "shapes/SphereVolume.H"

#include "mathematicalConstants.H"

#include <algorithm>
#include <cmath>

using Foam::point;
using Foam::scalar;
using Foam::vector;

namespace
{

// In the plane of a face at the distance d from the centre of the ball, the flux
// density is g(s) d, s the distance from the foot of the centre. With G' = g s the
// integral over the part within the disk of radius S is the boundary integral of
// G dtheta: of straight pieces inside the disk, and of arcs of its rim.
struct Disk
{
    scalar distance; // |d|
    scalar radius;   // R of the ball
    scalar rim2;     // S^2 = R^2 - d^2

    // G(S) per radian of the rim
    scalar arc() const
    {
        const scalar r3 = radius * radius * radius;
        return (rim2 / 2 + r3 * (1 / radius - 1 / distance)) / 3;
    }

    // Integral of G dtheta along a line at the distance a from the foot, between the
    // positions u0 and u1 along it, that turns by the angle theta.
    scalar straight(scalar a, scalar u0, scalar u1, scalar theta) const
    {
        const scalar r3 = radius * radius * radius;
        const scalar hypotenuse = std::hypot(a, distance);
        const auto part = [&](scalar u)
        { return std::asin(distance / hypotenuse * u / std::hypot(a, u)); };
        const scalar inverse = (part(u1) - part(u0)) / distance;
        return (a * (u1 - u0) / 2 + r3 * (inverse - theta / distance)) / 3;
    }
};

// One edge of the polygon: outside the disk the rim between the same directions
// takes its place. Angles are counted right-handed about the normal.
scalar edgeIntegral(
    const vector& from, const vector& to, const vector& normal, const Disk& disk
)
{
    const vector along = to - from;
    const scalar length = Foam::mag(along);
    if (length < Foam::VSMALL)
    {
        return 0;
    }
    const vector t = along / length;
    const scalar a = normal & (from ^ t); // signed: positive if the foot is left of it
    const scalar u0 = from & t;
    const scalar u1 = to & t;
    if (std::abs(a) < 1e-14 * disk.radius)
    {
        return 0; // seen from the foot the edge does not turn
    }

    const auto angle = [a](scalar v0, scalar v1)
    { return std::atan(v1 / a) - std::atan(v0 / a); };
    const scalar reach2 = disk.rim2 - a * a;
    if (reach2 <= 0)
    {
        return disk.arc() * angle(u0, u1);
    }
    const scalar reach = std::sqrt(reach2);
    const scalar w0 = std::clamp(-reach, u0, u1);
    const scalar w1 = std::clamp(reach, u0, u1);
    const scalar sign = a > 0 ? 1 : -1;
    return disk.arc() * (angle(u0, w0) + angle(w1, u1))
           + disk.straight(std::abs(a), sign * w0, sign * w1, angle(w0, w1));
}

} // namespace

namespace Foam::stability::shapes
{

scalar Ball::volume() const
{
    return 4 * constant::mathematical::pi / 3 * radius * radius * radius;
}

scalar faceFlux(const UList<point>& polygon, const Ball& ball)
{
    vector area(Zero);
    for (label i = 2; i < polygon.size(); ++i)
    {
        area += (polygon[i - 1] - polygon[0]) ^ (polygon[i] - polygon[0]);
    }
    const vector normal = area / mag(area);
    const scalar d = normal & (polygon[0] - ball.centre);

    const Disk disk{std::abs(d), ball.radius, ball.radius * ball.radius - d * d};
    if (disk.rim2 <= 0 || disk.distance < 1e-13 * ball.radius)
    {
        return 0;
    }
    const point foot = ball.centre + d * normal;
    scalar integral = 0;
    for (label i = 0; i < polygon.size(); ++i)
    {
        const point& next = polygon[(i + 1) % polygon.size()];
        integral += edgeIntegral(polygon[i] - foot, next - foot, normal, disk);
    }
    return d * integral;
}

} // namespace Foam::stability::shapes
