// SPDX-License-Identifier: GPL-3.0-or-later

#include "shapes/PlaneVolume.H"

#include <algorithm>
#include <cmath>

namespace Foam::stability::shapes
{

scalar boxShareBehind(scalar level, const vector& rises)
{
    const vector widths = cmptMag(rises);
    const scalar whole = cmptSum(widths);
    if (mag(level) >= 0.5 * whole)
    {
        return level < 0 ? 1 : 0;
    }
    // The formula divides by each width: none that is next to nothing counts.
    const scalar least = 1e-9 * cmptMax(widths);
    scalar product = 1;
    label dimensions = 0;
    for (direction d = 0; d < 3; ++d)
    {
        product *= widths[d] > least ? widths[d] : 1;
        dimensions += widths[d] > least;
    }
    // The alternating sum over the corners of what the plane cuts off beyond each.
    scalar sum = 0;
    for (label corner = 0; corner < 8; ++corner)
    {
        scalar depth = 0.5 * whole - level;
        label sign = 1;
        for (direction d = 0; d < 3; ++d)
        {
            if (corner >> d & 1)
            {
                depth -= widths[d];
                sign = widths[d] > least ? -sign : 0;
            }
        }
        sum += depth > 0 ? sign * std::pow(depth, dimensions) : 0;
    }
    constexpr label factorial[] = {1, 1, 2, 6};
    return std::clamp(sum / (factorial[dimensions] * product), 0.0, 1.0);
}

} // namespace Foam::stability::shapes
