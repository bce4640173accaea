// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/parametrization/Chart.H"

#include "core/base/Errors.H"
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

scalar signedArea(const List<vector2D>& p, const triFace& t)
{
    return 0.5 * (p[t[1]] - p[t[0]]).perp(p[t[2]] - p[t[0]]);
}

// Largest over smallest ratio of areas in the chart and on the surface, of the
// triangles around each vertex; vertices of practically no area do not count.
scalar areaRatioOf(const PlainSurface& disk, const List<vector2D>& parameters)
{
    scalarField inChart(disk.points.size(), 0);
    scalarField onSurface(disk.points.size(), 0);
    scalar total = 0;
    for (const triFace& t : disk.triangles)
    {
        const scalar area = t.mag(disk.points);
        total += area;
        for (const label vertex : t)
        {
            inChart[vertex] += signedArea(parameters, t);
            onSurface[vertex] += area;
        }
    }
    scalar largest = 0;
    scalar smallest = VGREAT;
    forAll(inChart, vertex)
    {
        if (onSurface[vertex] > 1e-12 * total)
        {
            const scalar scale = inChart[vertex] * (total / onSurface[vertex]);
            largest = max(largest, scale);
            smallest = min(smallest, scale);
        }
    }
    return largest / smallest;
}

// Empty where it fails; `failure` then says why.
List<vector2D>
tryFlattening(const Flattening& method, const PlainSurface& disk, std::string& failure)
{
    try
    {
        List<vector2D> parameters = method.flatten(disk);
        if (isOneToOne(disk, parameters))
        {
            return parameters;
        }
        failure = "its triangles overlap in the plane";
    }
    catch (const NumericalFailure& error)
    {
        failure = error.what(); // as good as an overlap: the caller has other ways
    }
    return List<vector2D>();
}

// Adopts the first chart, and later ones with less than half the areaRatio.
bool adopt(
    Chart& best, scalar areaRatio, List<vector2D>&& parameters,
    const List<CornerIndices>& corners
)
{
    if (!best.parameters.empty() && areaRatio >= 0.5 * best.areaRatio)
    {
        return false;
    }
    best.parameters = std::move(parameters);
    best.corners = corners;
    best.areaRatio = areaRatio;
    return true;
}

// The chart on the present cut; false where it was not adopted.
bool consider(
    Chart& best, const DiskCut& cut, const PlainSurface& disk, const Flattening& method
)
{
    List<vector2D> parameters = tryFlattening(method, disk, best.failure);
    if (parameters.empty())
    {
        return false;
    }
    const scalar ratio = areaRatioOf(disk, parameters);
    return adopt(best, ratio, std::move(parameters), cut.fans().corners);
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
// along a cut, would touch or overlap itself there.
bool considerUncut(Chart& best, const PlainSurface& surface, const Flattening& method)
{
    const label nPoints = surface.points.size();
    const SurfaceShape shape = shapeOf(nPoints, surface.triangles);
    if (!shape.manifold || shape.nLoops < 2 || shape.euler != 2 - shape.nLoops)
    {
        return false;
    }
    List<vector2D> parameters = tryFlattening(
        method, filled(surface, boundaryLoops(nPoints, surface.triangles)), best.failure
    );
    if (parameters.empty())
    {
        return false;
    }
    parameters.setSize(nPoints);
    List<CornerIndices> corners(surface.triangles.size());
    forAll(corners, trianglei)
    {
        const triFace& t = surface.triangles[trianglei];
        corners[trianglei] = CornerIndices{t[0], t[1], t[2]};
    }
    const scalar ratio = areaRatioOf(surface, parameters);
    return adopt(best, ratio, std::move(parameters), corners);
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
    scalar onSurface = 0;
    scalar inChart = 0;
    forAll(surface.triangles, trianglei)
    {
        const CornerIndices& c = chart.corners[trianglei];
        onSurface += surface.triangles[trianglei].mag(surface.points);
        inChart += signedArea(chart.parameters, triFace(c[0], c[1], c[2]));
    }
    const scalar factor = std::sqrt(onSurface / inChart);
    for (vector2D& p : chart.parameters)
    {
        p *= factor;
    }
}

// Tutte's method on both cuts; `chart.failure` stays that of the method asked for.
void fallBack(Chart& chart, const DiskCut& shortest, const DiskCut& extended)
{
    std::string failure(chart.failure);
    if (!chart.parameters.empty())
    {
        failure = "its areas shrink to less than 1/10000 of others";
    }
    const std::unique_ptr<Flattening> tutte = Flattening::New("tutte");
    chart.fallback = consider(chart, shortest, shortest.disk(), *tutte);
    chart.fallback |= consider(chart, extended, extended.disk(), *tutte);
    if (chart.parameters.empty())
    {
        chart.fallback = true;
        failure += "; nor did Tutte's: " + chart.failure;
    }
    chart.failure = failure;
}

} // namespace

Chart makeChart(const PlainSurface& given, const Flattening& method)
{
    Chart chart;
    PlainSurface surface(given);
    try
    {
        const DiskCut shortest(surface);
        const bool uncut =
            considerUncut(chart, surface, method) && chart.areaRatio <= fineAreaRatio;
        if (!uncut)
        {
            straightenSeams(surface, shortest.seams());
        }
        DiskCut cut(shortest);
        for (label further = 0; !uncut; ++further)
        {
            const PlainSurface disk = cut.disk();
            consider(chart, cut, disk, method);
            const bool good =
                !chart.parameters.empty() && chart.areaRatio <= tolerableAreaRatio;
            const label inside = good ? -1 : innermost(disk);
            if (inside < 0 || further == maxFurtherCuts)
            {
                break;
            }
            cut.extendTo(cut.fans().points[inside]);
        }
        if (chart.parameters.empty() || chart.areaRatio > absurdAreaRatio)
        {
            fallBack(chart, shortest, cut);
        }
    }
    catch (const NumericalFailure& error)
    {
        chart.fallback = true;
        chart.failure = error.what();
    }
    if (!chart.fallback)
    {
        chart.failure.clear(); // of trials
    }
    chart.points = surface.points;
    if (!chart.parameters.empty())
    {
        turnIntoSmallestBox(chart.parameters);
        giveAreaOf(surface, chart);
    }
    return chart;
}

} // namespace Foam::stability
