// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/parametrization/Chart.H"

#include "core/base/Errors.H"
#include "core/parametrization/ChartDistortion.H"
#include "core/parametrization/EdgePaths.H"
#include "core/parametrization/SeamStraightening.H"
#include "core/parametrization/SmallestBox.H"
#include "DynamicList.H"

#include <cmath>

namespace Foam::stability
{

namespace
{

// A chart with more than this is cut further: its smallest features would get less
// than a tenth of the resolution of the largest.
constexpr scalar tolerableAreaRatio = 100;

// With less than this, no other way is tried.
constexpr scalar fineAreaRatio = 4;

constexpr label maxFurtherCuts = 4;

// A chart that is worse than this, further cuts and all, is no better than Tutte's.
constexpr scalar absurdAreaRatio = 1e4;

// What became of one method on one cut.
struct Trial
{
    FlatteningResult flat; // without parameters where it failed
    std::string failure;   // why
};

Trial tryFlattening(const Flattening& method, const PlainSurface& disk)
{
    Trial trial;
    try
    {
        trial.flat = method.flatten(disk);
        if (isOneToOne(disk, trial.flat.parameters))
        {
            return trial;
        }
        trial.failure = "its triangles overlap in the plane";
    }
    catch (const NumericalFailure& error)
    {
        trial.failure =
            error.what(); // as good as an overlap: the caller has other ways
    }
    trial.flat.parameters.clear();
    return trial;
}

// Adopts the first chart, and later ones with less than half the areaRatio.
void adopt(
    Chart& best, scalar areaRatio, Trial&& trial, const List<CornerIndices>& corners,
    const std::string& method
)
{
    if (!best.parameters.empty() && areaRatio >= 0.5 * best.areaRatio)
    {
        return;
    }
    best.parameters = std::move(trial.flat.parameters);
    best.corners = corners;
    best.areaRatio = areaRatio;
    best.method = method;
    best.residual = trial.flat.residual;
    best.iterations = trial.flat.iterations;
    best.stopped = trial.flat.cause;
}

// The chart on the present cut, where it is adopted.
void consider(
    Chart& best, const DiskCut& cut, const PlainSurface& disk,
    const NamedFlattening& by, std::string& failure
)
{
    Trial trial = tryFlattening(*by.method, disk);
    if (trial.flat.parameters.empty())
    {
        failure = trial.failure;
        return;
    }
    const List<CornerIndices>& corners = cut.fans().corners;
    const scalar ratio = areaRatioOf(disk, corners, trial.flat.parameters);
    adopt(best, ratio, std::move(trial), corners, by.name);
}

// The surface, each hole closed by a fan of triangles around its middle; the longest
// loop stays as the boundary. Points and triangles of the surface come first.
PlainSurface filled(const PlainSurface& surface, const List<labelList>& loops)
{
    const auto lengthOf = [&](const labelList& loop)
    {
        scalar length = 0;
        forAll(loop, i)
        {
            length += mag(surface.points[loop[i]] - surface.points[loop.fcValue(i)]);
        }
        return length;
    };
    label outer = 0;
    forAll(loops, i)
    {
        outer = lengthOf(loops[i]) > lengthOf(loops[outer]) ? i : outer;
    }
    DynamicList<point> points(surface.points);
    DynamicList<triFace> triangles(surface.triangles);
    forAll(loops, loopi)
    {
        if (loopi == outer)
        {
            continue;
        }
        const labelList& loop = loops[loopi];
        const label middle = points.size();
        points.append(average(pointField(surface.points, loop)));
        forAll(loop, i)
        {
            triangles.append(triFace(loop.fcValue(i), loop[i], middle));
        }
    }
    return {pointField(points), List<triFace>(std::move(triangles))};
}

// A surface of genus 0 with holes may do without a cut: an almost flat one, opened
// along a cut, would touch or overlap itself there. True where it is fine without.
bool considerUncut(Chart& best, const PlainSurface& surface, const NamedFlattening& by)
{
    const label nPoints = surface.points.size();
    const SurfaceShape shape = shapeOf(nPoints, surface.triangles);
    if (!shape.manifold || shape.nLoops < 2 || shape.euler != 2 - shape.nLoops)
    {
        return false;
    }
    Trial trial = tryFlattening(
        *by.method, filled(surface, boundaryLoops(nPoints, surface.triangles))
    );
    if (trial.flat.parameters.empty())
    {
        return false;
    }
    trial.flat.parameters.setSize(nPoints);
    List<CornerIndices> corners(surface.triangles.size());
    forAll(corners, trianglei)
    {
        const triFace& t = surface.triangles[trianglei];
        corners[trianglei] = CornerIndices{t[0], t[1], t[2]};
    }
    const scalar ratio = areaRatioOf(surface, corners, trial.flat.parameters);
    adopt(best, ratio, std::move(trial), corners, by.name);
    return ratio <= fineAreaRatio;
}

// The vertex farthest from the present boundary, to which the next cut leads.
label innermost(const PlainSurface& disk)
{
    const label nPoints = disk.points.size();
    const SurfaceTopology topology(nPoints, disk.triangles);
    const List<labelList> loops = boundaryLoops(nPoints, disk.triangles);
    return EdgePaths(disk.points, topology, loops[0]).farthest();
}

// Scales the chart to the area of the surface.
void giveAreaOf(const PlainSurface& surface, Chart& chart)
{
    const scalar factor =
        std::sqrt(surface.area() / chartArea(chart.corners, chart.parameters));
    for (vector2D& p : chart.parameters)
    {
        p *= factor;
    }
}

// The method on the shortest cut, then on longer ones until the chart is good. Returns
// the last cut.
DiskCut cutFurther(
    Chart& best, const DiskCut& shortest, const NamedFlattening& by,
    std::string& failure
)
{
    DiskCut cut(shortest);
    for (label further = 0;; ++further)
    {
        const PlainSurface disk = cut.disk();
        consider(best, cut, disk, by, failure);
        const bool good =
            !best.parameters.empty() && best.areaRatio <= tolerableAreaRatio;
        const label inside =
            good || by.method->wantsShortestCut() ? -1 : innermost(disk);
        if (inside < 0 || further == maxFurtherCuts)
        {
            return cut;
        }
        cut.extendTo(cut.fans().points[inside]);
    }
}

// The methods in their order, until the chart will do.
void flattenCut(
    Chart& chart, const DiskCut& shortest, const std::vector<NamedFlattening>& methods
)
{
    std::string failures, failure;
    const DiskCut extended(cutFurther(chart, shortest, methods[0], failure));
    for (std::size_t i = 1;
         chart.parameters.empty() || chart.areaRatio > absurdAreaRatio; ++i)
    {
        if (!chart.parameters.empty())
        {
            failure = "its areas shrink to less than 1/10000 of others";
        }
        failures += (failures.empty() ? "" : "; ") + methods[i - 1].name + " failed ("
                    + failure + ")";
        if (i == methods.size())
        {
            break;
        }
        consider(chart, shortest, shortest.disk(), methods[i], failure);
        consider(chart, extended, extended.disk(), methods[i], failure);
    }
    chart.failure = failures;
}

} // namespace

std::vector<NamedFlattening> flatteningsFor(const std::string& method)
{
    std::vector<NamedFlattening> methods{{method, Flattening::New(method)}};
    for (const std::string& name : Flattening::fallbacksOf(method))
    {
        methods.push_back({name, Flattening::New(name)});
    }
    return methods;
}

Chart makeChart(const PlainSurface& given, const std::vector<NamedFlattening>& methods)
{
    Chart chart;
    PlainSurface surface(given);
    try
    {
        if (!(surface.area() > 0))
        {
            throw NumericalFailure("it has no area");
        }
        const label nBranches = methods[0].method->wantsShortestCut() ? 0 : 2;
        const DiskCut shortest(surface, nBranches);
        if (!considerUncut(chart, surface, methods[0]))
        {
            straightenSeams(surface, shortest.seams());
            flattenCut(chart, shortest, methods);
        }
    }
    catch (const NumericalFailure& error)
    {
        chart.failure = methods[0].name + " failed (" + error.what() + ")";
    }
    chart.fallback = chart.method != methods[0].name;
    chart.points = surface.points;
    if (!chart.parameters.empty())
    {
        turnIntoSmallestBox(chart.parameters);
        giveAreaOf(surface, chart);
    }
    return chart;
}

} // namespace Foam::stability
