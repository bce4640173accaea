// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/surface/SurfaceLocator.H"

#include <algorithm>

namespace Foam::stability
{

namespace
{

SurfacePoint pointAt(
    const point& x, const point& a, const point& b, const point& c, scalar wb, scalar wc
)
{
    SurfacePoint result;
    result.weights[0] = 1 - wb - wc;
    result.weights[1] = wb;
    result.weights[2] = wc;
    result.position = a + wb * (b - a) + wc * (c - a);
    result.distance = mag(x - result.position);
    return result;
}

// The point of the segment (a, b) closest to x, as a share of the segment from a.
scalar closestShare(const point& x, const point& a, const point& b)
{
    const vector ab = b - a;
    const scalar length2 = magSqr(ab);
    return length2 > 0 ? std::min(std::max(((x - a) & ab) / length2, 0.0), 1.0) : 0;
}

// A triangle without area is the union of its edges.
SurfacePoint
closestOnEdges(const point& x, const point& a, const point& b, const point& c)
{
    SurfacePoint best = pointAt(x, a, b, c, closestShare(x, a, b), 0);
    const scalar bc = closestShare(x, b, c);
    const SurfacePoint onBC = pointAt(x, a, b, c, 1 - bc, bc);
    const SurfacePoint onAC = pointAt(x, a, b, c, 0, closestShare(x, a, c));
    if (onBC.distance < best.distance)
    {
        best = onBC;
    }
    return onAC.distance < best.distance ? onAC : best;
}

} // namespace

FixedList<scalar, 3>
planeWeights(const point& x, const point& a, const point& b, const point& c)
{
    const vector n = (b - a) ^ (c - a);
    const scalar n2 = magSqr(n);
    FixedList<scalar, 3> weights(1.0 / 3.0);
    if (n2 > VSMALL)
    {
        weights[1] = (((x - a) ^ (c - a)) & n) / n2;
        weights[2] = (((b - a) ^ (x - a)) & n) / n2;
        weights[0] = 1 - weights[1] - weights[2];
    }
    return weights;
}

// Ericson, Real-Time Collision Detection (2005), section 5.1.5.
SurfacePoint
closestPoint(const point& x, const point& a, const point& b, const point& c)
{
    const vector ab = b - a, ac = c - a, ap = x - a;
    const scalar longest2 = std::max(std::max(magSqr(ab), magSqr(ac)), magSqr(c - b));
    constexpr scalar thinnest = 1e-12; // sine of the smallest angle
    if (mag(ab ^ ac) <= thinnest * longest2)
    {
        return closestOnEdges(x, a, b, c);
    }

    const scalar d1 = ab & ap, d2 = ac & ap;
    if (d1 <= 0 && d2 <= 0)
    {
        return pointAt(x, a, b, c, 0, 0);
    }
    const vector bp = x - b;
    const scalar d3 = ab & bp, d4 = ac & bp;
    if (d3 >= 0 && d4 <= d3)
    {
        return pointAt(x, a, b, c, 1, 0);
    }
    const scalar vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0)
    {
        return pointAt(x, a, b, c, d1 / (d1 - d3), 0);
    }
    const vector cp = x - c;
    const scalar d5 = ab & cp, d6 = ac & cp;
    if (d6 >= 0 && d5 <= d6)
    {
        return pointAt(x, a, b, c, 0, 1);
    }
    const scalar vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0)
    {
        return pointAt(x, a, b, c, 0, d2 / (d2 - d6));
    }
    const scalar va = d3 * d6 - d5 * d4;
    const scalar onBC = d4 - d3, onCB = d5 - d6;
    if (va <= 0 && onBC >= 0 && onCB >= 0)
    {
        const scalar share = onBC / (onBC + onCB);
        return pointAt(x, a, b, c, 1 - share, share);
    }
    const scalar sum = va + vb + vc;
    return pointAt(x, a, b, c, vb / sum, vc / sum);
}

SurfaceLocator::SurfaceLocator(
    const pointField& points, const UList<triFace>& triangles, scalar spacing
)
    : points_(points), triangles_(triangles), nBoxes_(0), first_(triangles.size()),
      last_(triangles.size())
{
    chooseSpacing(spacing);
    fillBoxes();
}

bool SurfaceLocator::isFinite(label trianglei) const
{
    for (const label pointi : triangles_[trianglei])
    {
        for (const scalar s :
             {points_[pointi].x(), points_[pointi].y(), points_[pointi].z()})
        {
            if (!std::isfinite(s))
            {
                return false;
            }
        }
    }
    return true;
}

// Not smaller than the mean edge, and so large that the boxes number at most a few
// per triangle and 2^20 per direction: one huge triangle must not fill the memory.
void SurfaceLocator::chooseSpacing(scalar spacing)
{
    point low(GREAT, GREAT, GREAT), high(-GREAT, -GREAT, -GREAT);
    scalar edges = 0;
    label nFinite = 0;
    List<vector> extents(triangles_.size(), vector(-1, -1, -1));
    forAll(triangles_, trianglei)
    {
        if (isFinite(trianglei))
        {
            const triFace& t = triangles_[trianglei];
            const point &a = points_[t[0]], &b = points_[t[1]], &c = points_[t[2]];
            low = min(low, min(a, min(b, c)));
            high = max(high, max(a, max(b, c)));
            extents[trianglei] = max(a, max(b, c)) - min(a, min(b, c));
            edges += (mag(b - a) + mag(c - b) + mag(a - c)) / 3;
            ++nFinite;
        }
    }
    if (nFinite == 0)
    {
        return;
    }
    lowest_ = low;
    spacing_ =
        std::max(std::max(spacing, edges / nFinite), cmptMax(high - low) / (1 << 20));
    if (!(spacing_ > 0))
    {
        spacing_ = 1;
    }

    const scalar mostBoxes = 4096 + 16.0 * nFinite;
    const auto nEntries = [&]
    {
        scalar n = 0;
        for (const vector& e : extents)
        {
            if (e.x() >= 0)
            {
                n += (e.x() / spacing_ + 1) * (e.y() / spacing_ + 1)
                     * (e.z() / spacing_ + 1);
            }
        }
        return n;
    };
    while (nEntries() > mostBoxes)
    {
        spacing_ *= 1.5;
    }
    for (label d = 0; d < 3; ++d)
    {
        nBoxes_[d] = label((high[d] - low[d]) / spacing_) + 1;
    }
}

SurfaceLocator::Box SurfaceLocator::boxOf(const point& x) const
{
    Box box;
    for (label d = 0; d < 3; ++d)
    {
        // Far away is far away: no overflow of the label.
        constexpr scalar far = 1 << 24;
        const scalar s = std::floor((x[d] - lowest_[d]) / spacing_);
        box[d] = label(std::min(std::max(s, -far), far));
    }
    return box;
}

void SurfaceLocator::findBoxes()
{
    forAll(triangles_, trianglei)
    {
        first_[trianglei] = Box(0);
        last_[trianglei] = Box(-1);
        if (isFinite(trianglei))
        {
            const triFace& t = triangles_[trianglei];
            const point &a = points_[t[0]], &b = points_[t[1]], &c = points_[t[2]];
            first_[trianglei] = boxOf(min(a, min(b, c)));
            last_[trianglei] = boxOf(max(a, max(b, c)));
        }
    }
}

void SurfaceLocator::fillBoxes()
{
    const auto visitEntries = [&](auto&& visit)
    {
        forAll(triangles_, trianglei)
        {
            const Box &low = first_[trianglei], &high = last_[trianglei];
            for (label i = low[0]; i <= high[0]; ++i)
            {
                for (label j = low[1]; j <= high[1]; ++j)
                {
                    for (label k = low[2]; k <= high[2]; ++k)
                    {
                        visit(
                            (std::int64_t(i) * nBoxes_[1] + j) * nBoxes_[2] + k,
                            trianglei
                        );
                    }
                }
            }
        }
    };

    findBoxes();
    std::size_t nEntries = 0;
    visitEntries([&](std::int64_t, label) { ++nEntries; });

    std::size_t nSlots = 16;
    while (nSlots < 2 * nEntries)
    {
        nSlots *= 2;
    }
    keys_.assign(nSlots, -1);
    keyRows_.assign(nSlots, -1);
    label nRows = 0;
    visitEntries(
        [&](std::int64_t key, label)
        {
            const std::size_t slot = slotOf(key);
            if (keys_[slot] < 0)
            {
                keys_[slot] = key;
                keyRows_[slot] = nRows++;
            }
        }
    );
    rows_ = Rows(
        nRows,
        [&](auto&& add)
        {
            visitEntries([&](std::int64_t key, label trianglei)
                         { add(keyRows_[slotOf(key)], trianglei); });
        }
    );
}

// The slot that holds the key, or the free one where it belongs.
std::size_t SurfaceLocator::slotOf(std::int64_t key) const
{
    const std::size_t mask = keys_.size() - 1;
    std::uint64_t hash = std::uint64_t(key) * 0x9E3779B97F4A7C15ull;
    std::size_t slot = (hash ^ (hash >> 32)) & mask;
    while (keys_[slot] >= 0 && keys_[slot] != key)
    {
        slot = (slot + 1) & mask;
    }
    return slot;
}

const UList<label> SurfaceLocator::trianglesIn(label i, label j, label k) const
{
    const label row =
        keyRows_[slotOf((std::int64_t(i) * nBoxes_[1] + j) * nBoxes_[2] + k)];
    return row < 0 ? UList<label>(nullptr, 0) : rows_[row];
}

SurfacePoint SurfaceLocator::closestOn(label trianglei, const point& x) const
{
    const triFace& t = triangles_[trianglei];
    SurfacePoint result = closestPoint(x, points_[t[0]], points_[t[1]], points_[t[2]]);
    result.triangle = trianglei;
    return result;
}

SurfacePoint SurfaceLocator::closest(const point& x, scalar radius) const
{
    return closest(x, radius, [](label) { return true; });
}

void SurfaceLocator::candidates(
    const point& x, scalar radius, DynamicList<label>& result
) const
{
    result.clear();
    const vector halfWidth(radius, radius, radius);
    visitWithin(
        x - halfWidth, x + halfWidth, [&](label trianglei) { result.append(trianglei); }
    );
    std::sort(result.begin(), result.end());
}

} // namespace Foam::stability
