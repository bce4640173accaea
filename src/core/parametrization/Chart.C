// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/parametrization/Chart.H"

#include "core/base/Errors.H"
#include "core/parametrization/ChartDistortion.H"
#include "core/parametrization/seams/EdgePaths.H"
#include "core/parametrization/seams/SeamStraightening.H"
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

// The surface with straight seams, and the cut along them.
struct Candidate
{
    PlainSurface surface;
    DiskCut cut; // refers to the surface

    Candidate(const PlainSurface& given, const SeamLayout& layout)
        : surface(given), cut(surface, layout)
    {
        straightenSeams(surface, cut.seams());
    }

    Candidate(const Candidate&) = delete;
    void operator=(const Candidate&) = delete;
};

// Adopts the first chart, and later ones with less than half the areaRatio.
void adopt(
    Chart& best, scalar areaRatio, Trial&& trial, const List<CornerIndices>& corners,
    const pointField& points, const std::string& method
)
{
    if (!best.parameters.empty() && areaRatio >= 0.5 * best.areaRatio)
    {
        return;
    }
    best.parameters = std::move(trial.flat.parameters);
    best.points = points;
    best.corners = corners;
    best.areaRatio = areaRatio;
    best.method = method;
    best.residual = trial.flat.residual;
    best.iterations = trial.flat.iterations;
    best.stopped = trial.flat.cause;
}

// The chart on the present cut, where it is adopted.
void consider(
    Chart& best, const Candidate& candidate, const NamedFlattening& by,
    std::string& failure
)
{
    const PlainSurface disk = candidate.cut.disk();
    Trial trial = tryFlattening(*by.method, disk);
    if (trial.flat.parameters.empty())
    {
        failure = trial.failure;
        return;
    }
    const List<CornerIndices>& corners = candidate.cut.fans().corners;
    const scalar ratio = areaRatioOf(candidate.surface, corners, trial.flat.parameters);
    adopt(best, ratio, std::move(trial), corners, candidate.surface.points, by.name);
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
    adopt(best, ratio, std::move(trial), corners, surface.points, by.name);
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

bool isTolerable(const Chart& chart, scalar areaRatio)
{
    return !chart.parameters.empty() && chart.areaRatio <= areaRatio;
}

// Cuts ever further until the chart is tolerable.
void cutFurther(
    Chart& best, Candidate& candidate, const NamedFlattening& by, std::string& failure
)
{
    for (label further = 0; further < maxFurtherCuts; ++further)
    {
        const label inside = isTolerable(best, tolerableAreaRatio)
                                 ? -1
                                 : innermost(candidate.cut.disk());
        if (inside < 0)
        {
            return;
        }
        candidate.cut.extendTo(candidate.cut.fans().points[inside]);
        consider(best, candidate, by, failure);
    }
}

// The method on the shortest cut, and on longer ones where it is distorted: the longest
// that was tried is returned, or none.
std::unique_ptr<Candidate> cutLonger(
    Chart& best, const PlainSurface& surface, const Candidate& shortest,
    const NamedFlattening& by, std::string& failure
)
{
    consider(best, shortest, by, failure);
    if (isTolerable(best, fineAreaRatio) || by.method->wantsShortestCut())
    {
        return nullptr;
    }
    const SeamLayout throughPeaks(seamsThroughPeaks(surface));
    if (!throughPeaks.terminals.empty())
    {
        auto longer = std::make_unique<Candidate>(surface, throughPeaks);
        consider(best, *longer, by, failure);
        cutFurther(best, *longer, by, failure);
        return longer;
    }
    if (isTolerable(best, tolerableAreaRatio))
    {
        return nullptr;
    }
    auto longer = std::make_unique<Candidate>(surface, topologicalSeams(surface));
    cutFurther(best, *longer, by, failure);
    return longer;
}

// The methods in their order, until the chart will do.
void flattenCut(
    Chart& chart, const PlainSurface& surface,
    const std::vector<NamedFlattening>& methods
)
{
    const label nBranches = methods[0].method->wantsShortestCut() ? 0 : 2;
    const Candidate shortest(surface, topologicalSeams(surface, nBranches));
    std::string failures, failure;
    const std::unique_ptr<Candidate> longest(
        cutLonger(chart, surface, shortest, methods[0], failure)
    );
    for (std::size_t i = 1; !isTolerable(chart, absurdAreaRatio); ++i)
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
        consider(chart, shortest, methods[i], failure);
        if (longest)
        {
            consider(chart, *longest, methods[i], failure);
        }
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

Chart makeChart(
    const PlainSurface& surface, const std::vector<NamedFlattening>& methods
)
{
    Chart chart;
    chart.points = surface.points;
    try
    {
        if (!(surface.area() > 0))
        {
            throw NumericalFailure("it has no area");
        }
        if (!considerUncut(chart, surface, methods[0]))
        {
            flattenCut(chart, surface, methods);
        }
    }
    catch (const NumericalFailure& error)
    {
        chart.failure = methods[0].name + " failed (" + error.what() + ")";
    }
    chart.fallback = chart.method != methods[0].name;
    if (!chart.parameters.empty())
    {
        turnIntoSmallestBox(chart.parameters);
        giveAreaOf({chart.points, surface.triangles}, chart);
    }
    return chart;
}

} // namespace Foam::stability
