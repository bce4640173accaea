// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/reconstruction/sharpening/FitBlend.H"

#include <algorithm>
#include <cmath>
#include <vector>

namespace Foam::stability
{

FitBlend::FitBlend(const UList<InterfaceFit>& fits) : fits_(fits)
{
    DynamicList<boundBox> boxes;
    forAll(fits, i)
    {
        const InterfaceFit& fit = fits[i];
        if (fit.weight > 0)
        {
            const symmTensor& s = fit.frame.extents;
            const vector wide = fit.reach
                                * vector(
                                    mag(vector(s.xx(), s.xy(), s.xz())),
                                    mag(vector(s.xy(), s.yy(), s.yz())),
                                    mag(vector(s.xz(), s.yz(), s.zz()))
                                );
            used_.append(i);
            boxes.append(boundBox(fit.centre - wide, fit.centre + wide));
        }
    }
    reaches_ = BoxTree(boxes);
}

BlendedDistance
FitBlend::at(const point& x, const vector& normal, const CellFrame& frame) const
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
                std::max(magSqr(fit.frame.local(way)), 0.25 * magSqr(frame.local(way)))
            )
            / fit.reach;
        if (q >= 1 || fit.frame.alignment(fit.normal, normal) < smallestAlignment)
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
