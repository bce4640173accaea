// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/reconstruction/sharpening/FitBlend.H"

#include "core/cells/ThinWalls.H"

#include <algorithm>
#include <cmath>
#include <vector>

namespace Foam::stability
{

FitBlend::FitBlend(const CellComplex& complex, const UList<InterfaceFit>& fits)
    : complex_(complex), fits_(fits)
{
    DynamicList<boundBox> boxes;
    forAll(fits, i)
    {
        const InterfaceFit& fit = fits[i];
        if (fit.weight > 0)
        {
            const vector wide = fit.reach * fit.metric.halfWidths();
            used_.append(i);
            boxes.append(boundBox(fit.centre - wide, fit.centre + wide));
        }
    }
    reaches_ = BoxTree(boxes);
}

// Behind a thin wall, seen from the centre of the other cell.
bool FitBlend::hidden(label from, label celli) const
{
    const ThinWalls* walls = complex_.whole().thinWalls.get();
    const pointField& centres = complex_.cellCentres();
    return walls && walls->part(centres[from], centres[celli]);
}

BlendedDistance FitBlend::at(
    const point& x, const vector& normal, label celli, const CellFrame& frame
) const
{
    static thread_local std::vector<label> found;
    found.clear();
    reaches_.meets(
        boundBox(x, x),
        [&](label i)
        {
            found.push_back(used_[i]);
            return false;
        }
    );
    // Ascending: the sums must not depend on the tree.
    std::sort(found.begin(), found.end());

    BlendedDistance result;
    scalar sum = 0, squares = 0, weights = 0;
    vector gradients(Zero);
    for (const label i : found)
    {
        const InterfaceFit& fit = fits_[i];
        const vector way = x - fit.centre;
        const scalar q =
            std::sqrt(
                std::max(magSqr(fit.metric.local(way)), 0.25 * magSqr(frame.local(way)))
            )
            / fit.reach;
        if (q >= 1 || fit.frame.alignment(fit.normal, normal) < smallestAlignment
            || hidden(celli, fit.cell))
        {
            continue;
        }
        // Wendland's C2 function.
        const scalar weight = fit.weight * sqr(sqr(1 - q)) * (4 * q + 1);
        const SignedDistance d = fit.distance(x);
        sum += weight * d.value;
        squares += weight * sqr(d.value);
        gradients += weight * d.gradient;
        weights += weight;
    }
    constexpr scalar least = 1e-9;
    if (weights > least)
    {
        result.known = true;
        result.value = sum / weights;
        result.gradient = gradients / weights;
        result.size = frame.along(gradients) / (mag(gradients) + VSMALL);
        result.spread =
            std::sqrt(std::max(scalar(0), squares / weights - sqr(result.value)));
    }
    return result;
}

} // namespace Foam::stability
