// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/parametrization/RibbonChart.H"
#include "core/parametrization/ChartPacking.H"

#include <gtest/gtest.h>

#include <cmath>

namespace Foam::stability
{

namespace
{

PlaneSection sectionAcrossX()
{
    PlaneSection section;
    section.normal = vector(1, 0, 0);
    section.middle = 3;
    section.thickness = 0.5;
    return section;
}

// Along a part of a circle, with strips of uneven length.
PlainSurface
ribbonOnCircle(scalar radius, label n, scalar angle, bool closed, scalar start = 0.2)
{
    const PlaneSection section(sectionAcrossX());
    PlainSurface ribbon;
    for (label i = 0; i < n; ++i)
    {
        const scalar phi = start + angle * (i + 0.2 * std::sin(3.0 * i)) / n;
        const point x(3, radius * std::cos(phi), radius * std::sin(phi));
        ribbon.points.append(section.inHigh(x));
        ribbon.points.append(section.inLow(x));
    }
    for (label i = 0; i < (closed ? n : n - 1); ++i)
    {
        const label a = 2 * i + 1, b = 2 * ((i + 1) % n) + 1;
        ribbon.triangles.append(triFace(a, b, b - 1));
        ribbon.triangles.append(triFace(a, b - 1, a - 1));
    }
    return ribbon;
}

scalar signedArea(const vector2D& a, const vector2D& b, const vector2D& c)
{
    return 0.5 * ((b - a).x() * (c - a).y() - (b - a).y() * (c - a).x());
}

// Every strip is a rectangle of its own length; returns the length of all.
scalar expectUnrolled(const PlainSurface& ribbon, const Chart& chart)
{
    EXPECT_EQ(chart.corners.size(), ribbon.triangles.size());
    scalar area = 0;
    forAll(chart.corners, i)
    {
        const CornerIndices& c = chart.corners[i];
        const List<vector2D>& p = chart.parameters;
        const scalar mapped = signedArea(p[c[0]], p[c[1]], p[c[2]]);
        EXPECT_NEAR(mapped, ribbon.triangles[i].mag(ribbon.points), 1e-12);
        area += mapped;
    }
    return area / sectionAcrossX().thickness;
}

} // namespace

TEST(RibbonChart, lengthsAreKeptAndOneSeamOpensAClosedCurve)
{
    for (const bool closed : {false, true})
    {
        const PlainSurface ribbon(ribbonOnCircle(2, 40, 2 * M_PI, closed));
        const Chart chart(ribbonChart(ribbon, sectionAcrossX()));
        const scalar length = expectUnrolled(ribbon, chart);
        EXPECT_NEAR(boxSize(chart.parameters).x(), length, 1e-12);
        EXPECT_EQ(chart.parameters.size(), ribbon.points.size() + (closed ? 2 : 0));
    }
    // Half a strip is none.
    PlainSurface half(ribbonOnCircle(2, 2, 3, false));
    half.triangles.setSize(1);
    EXPECT_TRUE(ribbonChart(half, sectionAcrossX()).parameters.empty());
}

TEST(RibbonChart, theRefinedCurveFollowsItsArc)
{
    const PlaneSection section(sectionAcrossX());
    for (const bool closed : {false, true})
    {
        const PlainSurface ribbon(ribbonOnCircle(2, 30, closed ? 2 * M_PI : 5, closed));
        const RemeshingResult fine(refinedRibbon(ribbon, section, 0.1));
        EXPECT_GT(fine.surface.points.size(), 2 * ribbon.points.size());
        for (const point& x : fine.surface.points)
        {
            const vector d = section.inPlane(x);
            EXPECT_NEAR(mag(d), 2, 3e-4); // chords are .01 off
        }
        const Chart chart(ribbonChart(fine.surface, section));
        EXPECT_NEAR(
            expectUnrolled(fine.surface, chart), closed ? 4 * M_PI : 9.7,
            closed ? 0.01 : 0.3
        );
        EXPECT_GT(fine.largestDistance, 0.005);
    }
    // A square has no arcs.
    const PlainSurface square(ribbonOnCircle(2, 4, 2 * M_PI, true));
    EXPECT_LT(refinedRibbon(square, section, 0.1).largestDistance, 1e-12);
}

TEST(RibbonChart, rowsDoNotOverlap)
{
    for (const label n : {1, 2, 7, 300})
    {
        scalarField lengths(n);
        forAll(lengths, i)
        {
            lengths[i] = 0.5 + std::pow(std::sin(1.0 + i), 4);
        }
        const RowPacking rows(packRows(lengths));
        EXPECT_GT(rows.height, 0.04);
        const scalar longest = max(lengths) * rows.scale;
        EXPECT_GT(longest, n < 10 ? 0.9 : 0.02);
        forAll(lengths, i)
        {
            const vector2D size(rows.scale * lengths[i], rows.height);
            const vector2D low = rows.corners[i], high = low + size;
            EXPECT_GT(low.x(), 0);
            EXPECT_GT(low.y(), Swatches::size);
            EXPECT_LT(high.x(), 1);
            EXPECT_LT(high.y(), 1);
            for (label j = 0; j < i; ++j)
            {
                const vector2D a = rows.corners[j];
                const vector2D b = a + vector2D(rows.scale * lengths[j], rows.height);
                EXPECT_TRUE(
                    b.x() < low.x() || a.x() > high.x() || b.y() < low.y()
                    || a.y() > high.y()
                );
            }
        }
    }
}

} // namespace Foam::stability
