// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/cells/ThinWalls.H"

#include "boundBox.H"

#include <algorithm>
#include <cmath>

namespace Foam::stability
{

namespace
{

using BoxIndex = std::array<std::int64_t, 3>;

// 21 bits each: what wraps around is told apart when lines and triangles are crossed.
std::uint64_t boxKey(const BoxIndex& box)
{
    constexpr std::uint64_t mask = (1u << 21) - 1;
    return (std::uint64_t(box[0]) & mask) << 42 | (std::uint64_t(box[1]) & mask) << 21
           | (std::uint64_t(box[2]) & mask);
}

// Calls visit(box) for all boxes from low to high until it returns true; then it
// returns true.
template<class Visit>
bool anyBox(const BoxIndex& low, const BoxIndex& high, const Visit& visit)
{
    for (std::int64_t i = low[0]; i <= high[0]; ++i)
    {
        for (std::int64_t j = low[1]; j <= high[1]; ++j)
        {
            for (std::int64_t k = low[2]; k <= high[2]; ++k)
            {
                if (visit(BoxIndex{i, j, k}))
                {
                    return true;
                }
            }
        }
    }
    return false;
}

// Möller and Trumbore (1997); edges count, so that no line slips through between two
// triangles.
bool crosses(const point& a, const point& b, const ThinWalls::Triangle& t)
{
    constexpr scalar onEdge = 1e-6;
    const vector way = b - a;
    const vector e1 = t[1] - t[0], e2 = t[2] - t[0];
    const vector p = way ^ e2;
    const scalar determinant = p & e1;
    if (mag(determinant) <= 1e-12 * mag(way) * mag(e1 ^ e2))
    {
        return false; // along the wall
    }
    const vector from = a - t[0];
    const vector q = from ^ e1;
    const scalar u = (from & p) / determinant, v = (way & q) / determinant,
                 along = (e2 & q) / determinant;
    return u >= -onEdge && v >= -onEdge && u + v <= 1 + onEdge && along > 0
           && along < 1;
}

boundBox boundsOf(const UList<point>& points)
{
    return boundBox(points, false);
}

} // namespace

ThinWalls::ThinWalls(std::vector<Triangle> triangles) : triangles_(std::move(triangles))
{
    scalar spans = 0;
    for (const Triangle& t : triangles_)
    {
        spans += boundsOf(UList<point>(const_cast<point*>(t.data()), 3)).mag();
    }
    width_ = std::max(spans / scalar(triangles_.size()), scalar(VSMALL));
    for (std::size_t i = 0; i < triangles_.size(); ++i)
    {
        point* corners = triangles_[i].data();
        const boundBox bounds(boundsOf(UList<point>(corners, 3)));
        const vector margin(1e-3 * width_ * vector::one);
        anyBox(
            boxOf(bounds.min() - margin), boxOf(bounds.max() + margin),
            [&](const BoxIndex& box)
            {
                boxes_[boxKey(box)].push_back(label(i));
                return false;
            }
        );
    }
}

BoxIndex ThinWalls::boxOf(const point& x) const
{
    BoxIndex box;
    for (direction d = 0; d < 3; ++d)
    {
        box[d] = std::int64_t(std::floor(x[d] / width_));
    }
    return box;
}

bool ThinWalls::part(const point& a, const point& b) const
{
    if (!std::isfinite(mag(a) + mag(b)))
    {
        return false;
    }
    const auto crossed = [&](label i) { return crosses(a, b, triangles_[i]); };
    // A long line passes more boxes than there are triangles.
    if (mag(b - a) > width_ * std::cbrt(scalar(8 + triangles_.size())))
    {
        for (std::size_t i = 0; i < triangles_.size(); ++i)
        {
            if (crossed(label(i)))
            {
                return true;
            }
        }
        return false;
    }
    return anyBox(
        boxOf(min(a, b)), boxOf(max(a, b)),
        [&](const BoxIndex& box)
        {
            const auto found = boxes_.find(boxKey(box));
            return found != boxes_.end()
                   && std::any_of(found->second.begin(), found->second.end(), crossed);
        }
    );
}

} // namespace Foam::stability
