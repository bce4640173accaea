// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

#include "core/results/MethodScore.H"

#include <algorithm>
#include <cmath>

namespace Foam::stability
{

void MethodScore::add(const Statistics& s)
{
    if (s.interval <= 0 || s.area <= 0)
    {
        return;
    }
    ++nTimes_;
    stableFraction_ += s.stableFraction();
    coverage_ += s.coverage();
    area_ += s.area;
    volumeError_ += std::abs(s.volumeError);
    for (std::size_t i = 0; i < detached_.size(); ++i)
    {
        detached_[i] += s.detachedFraction[i];
        attached_[i] += s.attachedFraction[i];
    }
}

scalar MethodScore::meanDistance() const
{
    scalar area = 0, x = 0, y = 1;
    for (std::size_t i = 0; i < detached_.size(); ++i)
    {
        const scalar nextX = Statistics::survivalDistances[i];
        const scalar nextY = 0.5 * mean(detached_[i] + attached_[i]);
        area += 0.5 * (nextX - x) * (y + nextY);
        x = nextX;
        y = nextY;
    }
    return area;
}

std::vector<std::string> MethodScore::columns()
{
    std::vector<std::string> names{"times",    "meanDistance", "stableFraction",
                                   "coverage", "area",         "volumeError"};
    const std::vector<std::string> survival(Statistics::survivalColumns());
    names.insert(names.end(), survival.begin() + 1, survival.end()); // without the time
    return names;
}

std::vector<scalar> MethodScore::values() const
{
    std::vector<scalar> all{scalar(nTimes_), meanDistance(), mean(stableFraction_),
                            mean(coverage_), mean(area_),    mean(volumeError_)};
    for (const auto* fractions : {&detached_, &attached_})
    {
        for (const scalar sum : *fractions)
        {
            all.push_back(mean(sum));
        }
    }
    return all;
}

std::size_t mostConsistent(const std::vector<MethodScore>& scores)
{
    const auto best = std::min_element(
        scores.begin(), scores.end(),
        [](const MethodScore& a, const MethodScore& b)
        { return a.meanDistance() < b.meanDistance(); }
    );
    return best - scores.begin();
}

} // namespace Foam::stability
