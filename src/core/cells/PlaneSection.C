// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/cells/PlaneSection.H"

#include <algorithm>

namespace Foam::stability
{

bool PlaneSection::isEnd(const face& f, const pointField& points) const
{
    const bool low = isLow(points[f[0]]);
    return std::all_of(
        f.begin(), f.end(), [&](label pointi) { return isLow(points[pointi]) == low; }
    );
}

labelPair PlaneSection::edgeOf(const face& f, const pointField& points) const
{
    label k = 0;
    while (!(isLow(points[f[k]]) && isLow(points[f.nextLabel(k)])))
    {
        ++k;
    }
    return labelPair(f[k], f.nextLabel(k));
}

} // namespace Foam::stability
