// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/reconstruction/sharpening/FitBlend.H"

#include "core/cells/ThinWalls.H"

#include <algorithm>
#include <cmath>

namespace Foam::stability
{

namespace
{

std::int64_t boxOf(scalar x, scalar width)
{
    return std::int64_t(std::floor(x / width));
}

// 21 bits each: what wraps around shares a box with what is far away, and is told
// apart by its distance.
std::uint64_t keyOf(std::int64_t i, std::int64_t j, std::int64_t k)
{
    constexpr std::uint64_t mask = (1u << 21) - 1;
    return (std::uint64_t(i) & mask) << 42 | (std::uint64_t(j) & mask) << 21
           | (std::uint64_t(k) & mask);
}

} // namespace

FitBlend::FitBlend(const CellComplex& complex, const UList<InterfaceFit>& fits)
    : complex_(complex), fits_(fits)
{
    scalar smallest = GREAT;
    for (const InterfaceFit& fit : fits)
    {
        smallest = fit.weight > 0 ? std::min(smallest, fit.reach) : smallest;
    }
    const auto levelOf = [&](const InterfaceFit& fit)
    { return std::size_t(std::ilogb(fit.reach / smallest)); };
    for (const InterfaceFit& fit : fits)
    {
        if (fit.weight > 0)
        {
            levels_.resize(std::max(levels_.size(), levelOf(fit) + 1));
            scalar& width = levels_[levelOf(fit)].width;
            width = std::max(width, fit.reach);
        }
    }
    forAll(fits, i)
    {
        if (fits[i].weight > 0)
        {
            Level& level = levels_[levelOf(fits[i])];
            const point& x = fits[i].centre;
            level
                .boxes[keyOf(
                    boxOf(x.x(), level.width), boxOf(x.y(), level.width),
                    boxOf(x.z(), level.width)
                )]
                .push_back({x, fits[i].reach, i});
        }
    }
}

// Ascending: the sums of a blend must not depend on the boxes.
void FitBlend::near(const point& x, std::vector<label>& found) const
{
    found.clear();
    for (const Level& level : levels_)
    {
        if (level.boxes.empty())
        {
            continue;
        }
        FixedList<std::int64_t, 3> low, high;
        for (label d = 0; d < 3; ++d)
        {
            low[d] = boxOf(x[d] - level.width, level.width);
            high[d] = boxOf(x[d] + level.width, level.width);
        }
        for (std::int64_t i = low[0]; i <= high[0]; ++i)
        {
            for (std::int64_t j = low[1]; j <= high[1]; ++j)
            {
                for (std::int64_t k = low[2]; k <= high[2]; ++k)
                {
                    const auto box = level.boxes.find(keyOf(i, j, k));
                    if (box != level.boxes.end())
                    {
                        for (const Entry& entry : box->second)
                        {
                            if (magSqr(x - entry.centre) < sqr(entry.reach))
                            {
                                found.push_back(entry.fit);
                            }
                        }
                    }
                }
            }
        }
    }
    std::sort(found.begin(), found.end());
}

// Behind a thin wall, seen from the centre of the other cell.
bool FitBlend::hidden(label from, label celli) const
{
    const ThinWalls* walls = complex_.whole().thinWalls.get();
    const pointField& centres = complex_.cellCentres();
    return walls && walls->part(centres[from], centres[celli]);
}

BlendedDistance FitBlend::at(const point& x, const vector& normal, label celli) const
{
    BlendedDistance result;
    scalar sum = 0, squares = 0, weights = 0;
    vector gradients(Zero);
    const auto blend = [&](const InterfaceFit& fit)
    {
        const scalar q = mag(x - fit.centre) / fit.reach;
        if (q >= 1 || (fit.normal & normal) < smallestAlignment
            || hidden(celli, fit.cell))
        {
            return;
        }
        // Wendland's C2 function.
        const scalar weight = fit.weight * sqr(sqr(1 - q)) * (4 * q + 1);
        const SignedDistance d = fit.distance(x);
        sum += weight * d.value;
        squares += weight * sqr(d.value);
        gradients += weight * d.gradient;
        weights += weight;
    };
    static thread_local std::vector<label> found;
    near(x, found);
    for (const label i : found)
    {
        blend(fits_[i]);
    }
    constexpr scalar least = 1e-9;
    if (weights > least)
    {
        result.known = true;
        result.value = sum / weights;
        result.gradient = gradients / weights;
        result.spread =
            std::sqrt(std::max(scalar(0), squares / weights - sqr(result.value)));
    }
    return result;
}

} // namespace Foam::stability
