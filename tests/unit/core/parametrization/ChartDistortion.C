// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/parametrization/ChartDistortion.H"

#include "core/parametrization/ChartReport.H"
#include "core/parametrization/SurfaceShape.H"
#include "shapes/Surfaces.H"

#include <gtest/gtest.h>

#include <cmath>

using namespace Foam;
using namespace Foam::stability;
using namespace Foam::stability::shapes;

namespace
{

List<CornerIndices> cornersIn(const PlainSurface& surface)
{
    List<CornerIndices> corners(surface.triangles.size());
    forAll(corners, i)
    {
        const triFace& t = surface.triangles[i];
        corners[i] = CornerIndices{t[0], t[1], t[2]};
    }
    return corners;
}

// A plane in space, tilted, with the coordinates in it.
PlainSurface tilted(List<vector2D>& coordinates)
{
    PlainSurface surface =
        grid([](scalar u, scalar v) { return point(3 * u, v, 0); }, 3, 2);
    coordinates.setSize(surface.points.size());
    const vector a(normalised(vector(1, 2, 2))), b(normalised(vector(2, 1, -2)));
    forAll(coordinates, i)
    {
        const point& p = surface.points[i];
        coordinates[i] = vector2D(p.x(), p.y());
        surface.points[i] = point(5, 6, 7) + p.x() * a + p.y() * b;
    }
    return surface;
}

} // namespace

// Twice as wide as it was: lengths on the surface over those in the chart are 1/2 and
// 1, in a chart of the same area 1/sqrt(2) and sqrt(2).
TEST(ChartDistortion, OfAnAffineMapIsExact)
{
    List<vector2D> chart;
    const PlainSurface surface = tilted(chart);
    const List<CornerIndices> corners = cornersIn(surface);
    ChartDistortion d = distortionOf(surface, corners, chart);
    EXPECT_NEAR(d.largestAngle, 0, 1e-6);
    EXPECT_NEAR(d.stretchL2, 1, 1e-12);
    EXPECT_NEAR(d.stretchLinf, 1, 1e-12);
    EXPECT_NEAR(chartArea(corners, chart), 3, 1e-12);
    for (vector2D& p : chart)
    {
        p = 7
            * vector2D(
                2 * p.x() * std::cos(1.) - p.y() * std::sin(1.),
                2 * p.x() * std::sin(1.) + p.y() * std::cos(1.)
            );
    }
    d = distortionOf(surface, corners, chart);
    EXPECT_NEAR(d.stretchL2, std::sqrt(0.5 * (0.5 + 2)), 1e-12);
    EXPECT_NEAR(d.stretchLinf, std::sqrt(2.), 1e-12);
    EXPECT_NEAR(areaRatioOf(surface, corners, chart), 1, 1e-12);
    // Right triangles of 1 x 1/2 become ones of 2 x 1/2.
    const scalar before = std::atan2(0.5, 1), after = std::atan2(0.5, 2);
    EXPECT_NEAR(d.largestAngle, (before - after) * 180 / M_PI, 1e-9);
    EXPECT_NEAR(d.meanAngle, 2. / 3 * (before - after) * 180 / M_PI, 1e-9);
}

TEST(ChartDistortion, AreasCompareWhatIsAround)
{
    List<vector2D> chart;
    const PlainSurface surface = tilted(chart);
    for (vector2D& p : chart)
    {
        p.x() += 2 * max(0.0, p.x() - 1);
    }
    // Columns of width 1, 3 and 3: the last point sees 3 alone, the first 1 alone.
    EXPECT_NEAR(areaRatioOf(surface, cornersIn(surface), chart), 3, 1e-12);
}

// A flat triangle has no angles to compare.
TEST(ChartDistortion, LeavesOutWhatIsFlat)
{
    List<vector2D> chart;
    PlainSurface surface = tilted(chart);
    const triFace t = surface.triangles[3];
    surface.points[t[1]] = surface.points[t[0]];
    const ChartDistortion d = distortionOf(surface, cornersIn(surface), chart);
    EXPECT_TRUE(std::isfinite(d.stretchLinf));
    EXPECT_TRUE(std::isfinite(d.meanAngle));
}

// A tube cut along its height, of a known seam.
TEST(ChartReport, TellsSeamAndFill)
{
    const PlainSurface tube = grid(
        [](scalar u, scalar v)
        { return point(std::cos(2 * M_PI * u), std::sin(2 * M_PI * u), 3 * v); },
        24, 12, true
    );
    RemeshingResult copy;
    copy.surface = tube;
    const Chart chart = makeChart(tube, flatteningsFor("abf"));
    copy.surface.points = chart.points; // with the seam straightened
    List<vector2D> packed(chart.parameters);
    for (vector2D& p : packed)
    {
        p *= 0.1;
    }
    const ChartReport report = reportOf(tube, copy, chart, packed);
    // Around the chart the seam comes twice, and each rim once.
    List<triFace> triangles(chart.corners.size());
    forAll(triangles, i)
    {
        const CornerIndices& c = chart.corners[i];
        triangles[i] = triFace(c[0], c[1], c[2]);
    }
    const labelList loop = boundaryLoops(chart.parameters.size(), triangles)[0];
    scalar around = 0;
    forAll(loop, i)
    {
        around += mag(chart.parameters[loop[i]] - chart.parameters[loop.fcValue(i)]);
    }
    const scalar rims = 2 * 48 * std::sin(M_PI / 24);
    EXPECT_NEAR(report.seamLength / (0.5 * (around - rims)), 1, 0.01);
    EXPECT_GE(report.seamLength, 3 - 1e-9);
    EXPECT_NEAR(report.area, 3 * 48 * std::sin(M_PI / 24), 0.01);
    EXPECT_NEAR(report.fill, 0.01 * report.area, 1e-6);
    EXPECT_EQ(report.method, "abf");
    EXPECT_TRUE(report.fallback.empty());
    EXPECT_NEAR(report.areaRatio, 1, 0.1);
    EXPECT_NEAR(report.distortion.stretchLinf, 1, 0.1);
}
