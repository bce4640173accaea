// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/parametrization/SmallestBox.H"

#include <algorithm>
#include <cmath>
#include <vector>

namespace Foam::stability
{

namespace
{

// Convex hull, counter-clockwise (Andrew's monotone chain).
std::vector<vector2D> convexHull(const List<vector2D>& chart)
{
    std::vector<vector2D> points(chart.begin(), chart.end());
    std::sort(
        points.begin(), points.end(),
        [](const vector2D& a, const vector2D& b)
        { return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y()); }
    );
    std::vector<vector2D> hull;
    for (label side = 0; side < 2; ++side)
    {
        const std::size_t start = hull.size();
        for (const vector2D& p : points)
        {
            while (hull.size() >= start + 2
                   && (hull.back() - hull[hull.size() - 2]).perp(p - hull.back()) <= 0)
            {
                hull.pop_back();
            }
            hull.push_back(p);
        }
        hull.pop_back();
        std::reverse(points.begin(), points.end());
    }
    return hull;
}

// Turns what lies along `along` into the first coordinate.
void turn(List<vector2D>& chart, const vector2D& along)
{
    for (vector2D& p : chart)
    {
        p = vector2D(along & p, along.perp(p));
    }
}

} // namespace

void turnIntoSmallestBox(List<vector2D>& chart)
{
    const std::vector<vector2D> hull = convexHull(chart);
    scalar smallest = VGREAT;
    vector2D along(1, 0);
    for (std::size_t i = 0; i < hull.size(); ++i)
    {
        const vector2D edge = hull[(i + 1) % hull.size()] - hull[i];
        const scalar length = mag(edge);
        if (!(length > 0))
        {
            continue;
        }
        const vector2D d = edge / length;
        scalar low = VGREAT, high = -VGREAT, top = 0;
        for (const vector2D& p : hull)
        {
            low = std::min(low, d & p);
            high = std::max(high, d & p);
            top = std::max(top, d.perp(p - hull[i]));
        }
        if ((high - low) * top < smallest)
        {
            smallest = (high - low) * top;
            along = d;
        }
    }
    turn(chart, along);
}

void turnIntoSmallestSquare(List<vector2D>& chart)
{
    const std::vector<vector2D> hull = convexHull(chart);
    constexpr label nAngles = 360; // over a right angle
    scalar shortest = VGREAT;
    vector2D along(1, 0);
    for (label i = 0; i < nAngles; ++i)
    {
        const scalar angle = 0.5 * M_PI * i / nAngles;
        const vector2D d(std::cos(angle), std::sin(angle));
        vector2D low(VGREAT, VGREAT), high(-VGREAT, -VGREAT);
        for (const vector2D& p : hull)
        {
            const vector2D turned(d & p, d.perp(p));
            low = min(low, turned);
            high = max(high, turned);
        }
        const scalar side = std::max(high.x() - low.x(), high.y() - low.y());
        if (side < shortest)
        {
            shortest = side;
            along = d;
        }
    }
    turn(chart, along);
}

} // namespace Foam::stability
