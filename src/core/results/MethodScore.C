// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/results/MethodScore.H"

#include "core/comparison/StabilityTables.H"

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

namespace
{

std::vector<TableColumn<MethodScore>> methodColumns()
{
    using M = MethodScore;
    std::vector<TableColumn<M>> columns{
        {"method", "-", "name of the method", {}, &M::name},
        {"times", "-",
         "classified times that count: all with an interface but the first",
         &M::nTimes},
        {"meanDistance", "cells",
         "distance between M and T: the area under the curves of survival, where what "
         "is farther than 3 cells counts as 3",
         &M::meanDistance},
        {"stableFraction", "-", "fraction of the area of M that is stable, mean",
         &M::stableFraction},
        {"coverage", "-", "fraction of the area of M with parameters, mean",
         &M::coverage},
        {"area", "m2", "area of M, mean", &M::area},
        {"volumeError", "-", "size of the relative volume error, mean",
         &M::volumeError},
    };
    const std::size_t n = Statistics::survivalDistances.size();
    for (std::size_t i = 0; i < n; ++i)
    {
        columns.push_back(
            {survivalColumn("detached", i), "-",
             "fraction of T farther than so many cells from M, mean",
             [i](const M& m) { return m.detachedFraction(i); }}
        );
    }
    for (std::size_t i = 0; i < n; ++i)
    {
        columns.push_back(
            {survivalColumn("attached", i), "-",
             "fraction of M farther than so many cells from T, mean",
             [i](const M& m) { return m.attachedFraction(i); }}
        );
    }
    return columns;
}

} // namespace

const TableLayout<MethodScore>& methodTable()
{
    static const TableLayout<MethodScore> table{
        "methods.dat",
        "Means over the classified times; meanDistance in cells, area in m2",
        methodColumns()};
    return table;
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
