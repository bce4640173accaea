// SPDX-License-Identifier: GPL-3.0-or-later

#include "shapes/DiscShare.H"

#include <algorithm>
#include <cmath>
#include <vector>

namespace Foam::stability::shapes
{

namespace
{

scalar cross(const vector2D& a, const vector2D& b)
{
    return a.x() * b.y() - a.y() * b.x();
}

// The triangle of the origin, a and b.
PlaneShare triangle(const vector2D& a, const vector2D& b)
{
    const scalar area = 0.5 * cross(a, b);
    return {area, area * (a.y() + b.y()) / 3};
}

// The sector of the disc around the origin from the direction of a to that of b.
PlaneShare sector(const vector2D& a, const vector2D& b, scalar radius)
{
    const scalar angle = std::atan2(cross(a, b), a & b);
    const scalar chord = a.x() / mag(a) - b.x() / mag(b);
    return {0.5 * sqr(radius) * angle, pow3(radius) / 3 * chord};
}

// Where the line from a to b crosses the circle around the origin: shares of its
// length.
std::vector<scalar> crossings(const vector2D& a, const vector2D& b, scalar radius)
{
    const vector2D way(b - a);
    const scalar square = magSqr(way), half = a & way;
    const scalar root = sqr(half) - square * (magSqr(a) - sqr(radius));
    std::vector<scalar> shares{0, 1};
    if (root > 0)
    {
        for (const scalar share :
             {(-half - std::sqrt(root)) / square, (-half + std::sqrt(root)) / square})
        {
            if (share > 0 && share < 1)
            {
                shares.push_back(share);
            }
        }
    }
    std::sort(shares.begin(), shares.end());
    return shares;
}

void add(PlaneShare& sum, const PlaneShare& part)
{
    sum.area += part.area;
    sum.moment += part.moment;
}

} // namespace

PlaneShare polygonShare(const UList<vector2D>& polygon)
{
    PlaneShare sum;
    forAll(polygon, i)
    {
        add(sum, triangle(polygon[i], polygon[polygon.fcIndex(i)]));
    }
    return sum;
}

// Green's theorem: each edge gives what lies between it and the centre.
PlaneShare
discShare(const UList<vector2D>& polygon, const vector2D& centre, scalar radius)
{
    PlaneShare sum;
    forAll(polygon, i)
    {
        const vector2D a(polygon[i] - centre), b(polygon[polygon.fcIndex(i)] - centre);
        const std::vector<scalar> cuts(crossings(a, b, radius));
        for (std::size_t k = 0; k + 1 < cuts.size(); ++k)
        {
            const vector2D from(a + cuts[k] * (b - a)), to(a + cuts[k + 1] * (b - a));
            const bool inside = mag(0.5 * (from + to)) < radius;
            add(sum, inside ? triangle(from, to) : sector(from, to, radius));
        }
    }
    sum.moment += centre.y() * sum.area;
    return sum;
}

} // namespace Foam::stability::shapes
