// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/parametrization/ChartReport.H"

#include "core/parametrization/SurfaceShape.H"

#include <algorithm>

namespace Foam::stability
{

namespace
{

void put(const ChartReport& report, Packet& packet)
{
    packet.put(report.patch);
    packet.put(report.nTriangles);
    packet.put(report.centre);
    packet.put(report.area);
    packet.putString(report.method);
    packet.put(report.residual);
    packet.put(report.iterations);
    packet.put(report.distortion);
    packet.put(report.areaRatio);
    packet.put(report.seamLength);
    packet.put(report.fill);
    packet.putString(report.fallback);
    packet.putString(report.stopped);
}

ChartReport getReport(Packet& packet)
{
    ChartReport report;
    report.patch = packet.get<label>();
    report.nTriangles = packet.get<label>();
    report.centre = packet.get<point>();
    report.area = packet.get<scalar>();
    report.method = packet.getString();
    report.residual = packet.get<scalar>();
    report.iterations = packet.get<label>();
    report.distortion = packet.get<ChartDistortion>();
    report.areaRatio = packet.get<scalar>();
    report.seamLength = packet.get<scalar>();
    report.fill = packet.get<scalar>();
    report.fallback = packet.getString();
    report.stopped = packet.getString();
    return report;
}

// The length of the edges whose two triangles have different parameters.
scalar seamLengthOf(const PlainSurface& surface, const List<CornerIndices>& corners)
{
    scalar length = 0;
    const SurfaceTopology topology(surface.points.size(), surface.triangles);
    forAll(surface.triangles, trianglei)
    {
        for (label k = 0; k < 3; ++k)
        {
            const label other =
                coherentNeighbour(topology, surface.triangles, trianglei, k);
            if (other < trianglei) // each edge once
            {
                continue;
            }
            const triFace& t = surface.triangles[trianglei];
            const label a = t[k], b = t[(k + 1) % 3];
            const auto differ = [&](label pointi)
            {
                return corners[trianglei][t.which(pointi)]
                       != corners[other][surface.triangles[other].which(pointi)];
            };
            length +=
                differ(a) || differ(b) ? mag(surface.points[a] - surface.points[b]) : 0;
        }
    }
    return length;
}

// A few words on what failed for a patch; empty where nothing did.
std::string fallbackText(const RemeshingResult& copy, const Chart& chart)
{
    std::string text;
    if (!copy.failure.empty())
    {
        text = "remeshing failed (" + copy.failure + "), it stays as it is";
    }
    if (chart.fallback)
    {
        text += (text.empty() ? "" : "; ") + chart.failure + ", ";
        text += chart.parameters.empty() ? "it gets no parameters"
                                         : chart.method + " was taken";
    }
    return text;
}

std::string causeOf(const ChartReport& report)
{
    const std::string between =
        report.fallback.empty() || report.stopped.empty() ? "" : "; ";
    const std::string cause = report.fallback + between + report.stopped;
    return cause.empty() ? "-" : cause;
}

} // namespace

const TableLayout<ChartRow>& chartTable()
{
    using C = ChartRow;
    static const TableLayout<C> table{
        "charts.dat",
        "The charts of the first interface: angles in degrees, lengths in m, areas in "
        "m2",
        {
            {"Time", "s", "the time of the interface", &C::time},
            {"patch", "-", "its number, in the order of positions", &C::patch},
            {"triangles", "-", "triangles of the patch", &C::nTriangles},
            {"centreX", "m", "mean of its points",
             [](const C& c) { return c.centre.x(); }},
            {"centreY", "m", "mean of its points",
             [](const C& c) { return c.centre.y(); }},
            {"centreZ", "m", "mean of its points",
             [](const C& c) { return c.centre.z(); }},
            {"area", "m2", "area of the remeshed patch", &C::area},
            {"angleMean", "degrees",
             "difference of a corner's angle in the chart and on the surface, mean",
             [](const C& c) { return c.distortion.meanAngle; }},
            {"angleMax", "degrees", "the largest",
             [](const C& c) { return c.distortion.largestAngle; }},
            {"stretchL2", "-",
             "lengths on the surface over those in a chart of the same area, root mean "
             "square over all directions; 1: none",
             [](const C& c) { return c.distortion.stretchL2; }},
            {"stretchLinf", "-", "the largest of these",
             [](const C& c) { return c.distortion.stretchLinf; }},
            {"areaRatio", "-",
             "area around a point in the chart over that on the surface: the largest "
             "of "
             "these ratios over the smallest",
             &C::areaRatio},
            {"seamLength", "m", "length of the edges along which it was cut",
             &C::seamLength},
            {"fill", "-", "share of the parameter square that the chart covers",
             &C::fill},
            {"residual", "rad",
             "with abf and linAbf the largest violation of an equation of the angles",
             &C::residual},
            {"iterations", "-", "Newton steps of abf and linAbf", &C::iterations},
            {"method", "-", "the one that flattened it, or none", nullptr, &C::method},
            {"cause", "-",
             "why another method than the one asked for was taken, or iterations "
             "stopped early; else -",
             nullptr, causeOf},
        }};
    return table;
}

ChartReport reportOf(
    const PlainSurface& patch, const RemeshingResult& copy, const Chart& chart,
    const List<vector2D>& packed
)
{
    ChartReport report;
    report.nTriangles = patch.triangles.size();
    report.centre = average(patch.points);
    report.area = copy.surface.area();
    report.fallback = fallbackText(copy, chart);
    report.method = chart.parameters.empty() ? "none" : chart.method;
    report.residual = chart.residual;
    report.iterations = chart.iterations;
    report.stopped = chart.stopped;
    if (!chart.parameters.empty())
    {
        report.distortion = distortionOf(copy.surface, chart.corners, chart.parameters);
        report.areaRatio = areaRatioOf(copy.surface, chart.corners, chart.parameters);
        report.seamLength = seamLengthOf(copy.surface, chart.corners);
        report.fill = chartArea(chart.corners, packed);
    }
    return report;
}

std::vector<ChartReport>
gathered(const std::vector<ChartReport>& here, const Exchange& exchange)
{
    Packet mine;
    for (const ChartReport& report : here)
    {
        put(report, mine);
    }
    std::vector<ChartReport> all;
    for (Packet& packet : exchange.toMaster(std::move(mine)))
    {
        while (!packet.atEnd())
        {
            all.push_back(getReport(packet));
        }
    }
    std::sort(
        all.begin(), all.end(),
        [](const auto& a, const auto& b) { return a.patch < b.patch; }
    );
    return all;
}

} // namespace Foam::stability
