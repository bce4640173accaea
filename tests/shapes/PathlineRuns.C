// SPDX-License-Identifier: GPL-3.0-or-later

#include "shapes/PathlineRuns.H"
#include "shapes/OneRank.H"

#include <cmath>
#include <random>

namespace Foam::stability::shapes
{

List<Pathline> linesAt(const List<point>& points, scalar time)
{
    List<Pathline> lines(points.size());
    forAll(lines, i)
    {
        lines[i].id = i;
        lines[i].x = points[i];
        lines[i].time = time;
    }
    return lines;
}

List<point> inSphere(label n)
{
    std::mt19937 engine(5);
    std::uniform_real_distribution<scalar> random(-1, 1);
    List<point> points(n);
    for (point& x : points)
    {
        do
        {
            x = point(random(engine), random(engine), random(engine));
        } while (mag(x) > 1);
        x = point(0.35, 0.35, 0.35) + 0.15 * x;
    }
    return points;
}

scalar rmsDistance(const List<Pathline>& lines, const List<point>& wanted)
{
    scalar sum = 0;
    forAll(lines, i)
    {
        sum += magSqr(lines[i].x - wanted[i]);
    }
    return std::sqrt(sum / lines.size());
}

IntegrationOptions tolerance(scalar value)
{
    IntegrationOptions options;
    options.tolerance = value;
    return options;
}

List<point> positions(const List<Pathline>& lines)
{
    List<point> points(lines.size());
    forAll(points, i)
    {
        points[i] = lines[i].x;
    }
    return points;
}

IntegrationCounts throughSnapshots(
    List<Pathline>& lines, const Snapshots& at, scalar start, scalar end,
    label nIntervals, const IntegrationOptions& options
)
{
    IntegrationCounts counts;
    auto earlier = at(start);
    for (label i = 1; i <= nIntervals; ++i)
    {
        const auto later = at(start + (end - start) * i / nIntervals);
        const IntegrationCounts some =
            advance(lines, VelocityInterval(earlier, later), options);
        counts.nSteps += some.nSteps;
        counts.nRejected += some.nRejected;
        counts.nLeft += some.nLeft;
        counts.nStuck += some.nStuck;
        counts.nLost += some.nLost;
        earlier = later;
    }
    return counts;
}

IntegrationCounts throughSnapshots(
    List<Pathline>& lines, const std::shared_ptr<const CellComplex>& complex,
    const Flow& flow, scalar start, scalar end, label nIntervals,
    const IntegrationOptions& options, WallVelocity wall
)
{
    const auto at = [&](scalar time)
    { return sampledVelocity(complex, flow, time, wall); };
    return throughSnapshots(lines, at, start, end, nIntervals, options);
}

BoxOptions channel(label n, BoundaryKind sides)
{
    BoxOptions options;
    options.n = Vector<label>(2 * n, n, n);
    options.max = point(2, 1, 1);
    options.kinds = FixedList<BoundaryKind, 6>(sides);
    options.kinds[0] = BoundaryKind::open;
    options.kinds[1] = BoundaryKind::open;
    return options;
}

} // namespace Foam::stability::shapes
