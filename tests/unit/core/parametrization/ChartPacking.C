// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/parametrization/ChartPacking.H"
#include "shapes/OneRank.H"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace Foam;
using namespace Foam::stability;

namespace
{

struct Box
{
    vector2D low, high;
};

Box boxOf(const List<vector2D>& chart)
{
    Box box{chart[0], chart[0]};
    for (const vector2D& p : chart)
    {
        box.low = min(box.low, p);
        box.high = max(box.high, p);
    }
    return box;
}

// An L without symmetry: any mirroring or turning shows.
List<vector2D> chartOf(scalar width, scalar height)
{
    return List<vector2D>(
        {vector2D(3, 5), vector2D(3 + width, 5), vector2D(3 + width, 5 + 0.3 * height),
         vector2D(3 + 0.2 * width, 5 + 0.3 * height),
         vector2D(3 + 0.2 * width, 5 + height), vector2D(3, 5 + height)}
    );
}

scalar areaOf(const List<vector2D>& polygon)
{
    scalar area = 0;
    forAll(polygon, i)
    {
        area += 0.5 * polygon[i].perp(polygon[polygon.fcIndex(i)]);
    }
    return area;
}

// Deterministic, between 0 and 1.
scalar noise(label i)
{
    const scalar x = 43758.5453 * std::sin(12.9898 * i + 4.1);
    return x - std::floor(x);
}

List<List<vector2D>> mixedCharts(label n)
{
    List<List<vector2D>> charts(n);
    forAll(charts, i)
    {
        const scalar size = i == n / 2 ? 8 : 0.05 + noise(i);
        charts[i] = chartOf(size, size * (0.3 + 2 * noise(i + n)));
    }
    return charts;
}

// Gap between two boxes; negative where they overlap.
scalar gap(const Box& a, const Box& b)
{
    return std::max(
        std::max(a.low.x() - b.high.x(), b.low.x() - a.high.x()),
        std::max(a.low.y() - b.high.y(), b.low.y() - a.high.y())
    );
}

void expectLegal(
    const List<List<vector2D>>& charts, const PackingResult& packing, scalar gutter
)
{
    const scalar slack = 1e-12;
    const Box swatch{vector2D(1 - Swatches::size, 0), vector2D(1, Swatches::size)};
    ASSERT_EQ(packing.charts.size(), charts.size());
    std::vector<Box> boxes;
    forAll(charts, i)
    {
        ASSERT_EQ(packing.charts[i].size(), charts[i].size());
        const Box box = boxOf(packing.charts[i]);
        EXPECT_GE(std::min(box.low.x(), box.low.y()), gutter - slack);
        EXPECT_LE(std::max(box.high.x(), box.high.y()), 1 - gutter + slack);
        EXPECT_GE(gap(box, swatch), gutter - slack);
        boxes.push_back(box);

        // Same shape at the common scale, by a quarter turn or none, not mirrored.
        const vector2D a = charts[i][1] - charts[i][0];
        const vector2D b = packing.charts[i][1] - packing.charts[i][0];
        EXPECT_NEAR(mag(b) / mag(a) / packing.scale, 1, 1e-9);
        EXPECT_NEAR(
            areaOf(packing.charts[i]) / areaOf(charts[i]) / sqr(packing.scale), 1, 1e-9
        );
        EXPECT_LT(std::min(mag(b.x()), mag(b.y())), 1e-9 * mag(b));
    }
    std::sort(
        boxes.begin(), boxes.end(),
        [](const Box& a, const Box& b) { return a.low.x() < b.low.x(); }
    );
    for (std::size_t i = 0; i < boxes.size(); ++i)
    {
        for (std::size_t j = i + 1;
             j < boxes.size() && boxes[j].low.x() < boxes[i].high.x() + gutter; ++j)
        {
            EXPECT_GE(gap(boxes[i], boxes[j]), gutter - slack);
        }
    }
}

scalar usedArea(const PackingResult& packing)
{
    scalar area = 0;
    for (const List<vector2D>& chart : packing.charts)
    {
        const Box box = boxOf(chart);
        area += (box.high.x() - box.low.x()) * (box.high.y() - box.low.y());
    }
    return area;
}

} // namespace

TEST(ChartPacking, OneChartFillsTheSquare)
{
    const List<List<vector2D>> charts(1, chartOf(0.002, 0.002));
    const PackingResult packing = packCharts(charts);
    expectLegal(charts, packing, 1.0 / 256);
    EXPECT_GT(usedArea(packing), 0.9);
}

TEST(ChartPacking, LongChartsStandUpright)
{
    const List<List<vector2D>> charts(3, chartOf(9, 2));
    const PackingResult packing = packCharts(charts);
    expectLegal(charts, packing, 1.0 / 256);
    for (const List<vector2D>& chart : packing.charts)
    {
        const Box box = boxOf(chart);
        EXPECT_GT(box.high.y() - box.low.y(), box.high.x() - box.low.x());
    }
    EXPECT_GT(usedArea(packing), 0.6);
}

TEST(ChartPacking, SmallChartsGoBesideALargeOne)
{
    const List<List<vector2D>> charts = mixedCharts(40);
    const PackingResult packing = packCharts(charts);
    expectLegal(charts, packing, 1.0 / 256);
    EXPECT_GT(usedArea(packing), 0.7);
}

TEST(ChartPacking, ThousandsOfTinyCharts)
{
    List<List<vector2D>> charts = mixedCharts(3000);
    const PackingResult packing = packCharts(charts);
    expectLegal(charts, packing, 1.0 / 256);
    EXPECT_GT(usedArea(packing), 0.25);
}

// More charts than gutters fit: these shrink.
TEST(ChartPacking, GuttersMakeRoom)
{
    const label n = 20000;
    List<List<vector2D>> charts(n, chartOf(1, 1));
    const PackingResult packing = packCharts(charts);
    expectLegal(charts, packing, 0.25 / std::sqrt(scalar(n)));
    EXPECT_GT(usedArea(packing), 0.4);
}

TEST(ChartPacking, KeepsTheGutterAskedFor)
{
    const List<List<vector2D>> charts = mixedCharts(12);
    const PackingResult wide = packCharts(charts, 0.02);
    expectLegal(charts, wide, 0.02);
    EXPECT_LT(wide.scale, packCharts(charts).scale);
}

TEST(ChartPacking, NothingIsLegal)
{
    EXPECT_TRUE(packCharts(List<List<vector2D>>()).charts.empty());
    const List<List<vector2D>> charts(
        {List<vector2D>(), chartOf(1, 2), List<vector2D>()}
    );
    const PackingResult packing = packCharts(charts);
    EXPECT_TRUE(packing.charts[0].empty());
    EXPECT_EQ(packing.charts[1].size(), charts[1].size());
}
