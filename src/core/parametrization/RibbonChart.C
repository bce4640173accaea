// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/parametrization/RibbonChart.H"

#include "core/cells/CanonicalOrder.H"
#include "core/parametrization/ChartPacking.H"

#include <algorithm>
#include <numeric>

namespace Foam::stability
{

namespace
{

// The curve of a ribbon in the lower plane, and the points above it.
struct RibbonCurve
{
    labelList next;  // point of the lower plane -> the next one; -1: none
    labelList above; // and the point across; -1: none
    labelList starts;

    RibbonCurve(const PlainSurface& ribbon, const PlaneSection& section)
        : next(ribbon.points.size(), -1), above(ribbon.points.size(), -1),
          starts(ribbon.triangles.size(), -1)
    {
        const auto isLow = [&](label pointi)
        { return section.isLow(ribbon.points[pointi]); };
        forAll(ribbon.triangles, trianglei)
        {
            const triFace& t = ribbon.triangles[trianglei];
            for (label k = 0; k < 3; ++k)
            {
                const label a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
                if (isLow(a) && isLow(b) && !isLow(c))
                {
                    next[a] = b;
                    above[b] = c;
                    starts[trianglei] = a;
                }
                else if (isLow(a) && !isLow(b) && !isLow(c))
                {
                    above[a] = c;
                    starts[trianglei] = a;
                }
            }
        }
    }

    // The points of the lower plane in their order along the curve; empty where they
    // are not one curve with a point above each.
    DynamicList<label> inOrder(const PlainSurface& ribbon) const
    {
        List<bool> follows(next.size(), false);
        label nLow = 0;
        forAll(next, a)
        {
            nLow += above[a] >= 0;
            if (next[a] >= 0)
            {
                follows[next[a]] = true;
            }
        }
        label first = -1;
        forAll(next, a)
        {
            const bool better =
                first < 0 || follows[a] < follows[first]
                || (follows[a] == follows[first]
                    && beforeByPosition(ribbon.points[a], ribbon.points[first]));
            if (above[a] >= 0 && better)
            {
                first = a;
            }
        }
        DynamicList<label> order;
        for (label a = first; a >= 0 && order.size() <= nLow; a = next[a])
        {
            order.append(a);
            if (next[a] == first)
            {
                break;
            }
        }
        if (order.size() != nLow || starts.found(-1)
            || 2 * nLow != ribbon.points.size())
        {
            order.clear();
        }
        return order;
    }
};

} // namespace

Chart ribbonChart(const PlainSurface& ribbon, const PlaneSection& section)
{
    Chart chart;
    chart.points = ribbon.points;
    const RibbonCurve curve(ribbon, section);
    const DynamicList<label> order(curve.inOrder(ribbon));
    if (order.size() < 2)
    {
        return chart;
    }
    const label first = order[0], last = order[order.size() - 1];
    labelList vertices(ribbon.points.size(), -1);
    DynamicList<vector2D> parameters;
    const auto add = [&](label a, scalar length)
    {
        vertices[a] = parameters.size();
        vertices[curve.above[a]] = parameters.size() + 1;
        parameters.append(vector2D(length, 0));
        parameters.append(vector2D(length, section.thickness));
    };
    scalar length = 0;
    forAll(order, i)
    {
        length +=
            i > 0 ? mag(ribbon.points[order[i]] - ribbon.points[order[i - 1]]) : 0;
        add(order[i], length);
    }
    chart.corners.setSize(ribbon.triangles.size());
    const auto setCorners = [&](bool ofLastStrip)
    {
        forAll(ribbon.triangles, i)
        {
            for (label k = 0; k < 3 && (curve.starts[i] == last) == ofLastStrip; ++k)
            {
                chart.corners[i][k] = vertices[ribbon.triangles[i][k]];
            }
        }
    };
    setCorners(false);
    if (curve.next[last] == first)
    {
        add(first, length + mag(ribbon.points[first] - ribbon.points[last]));
        setCorners(true);
    }
    chart.parameters = parameters;
    chart.areaRatio = 1;
    return chart;
}

namespace
{

// Fills rows from left to right, the longest charts first, each in the first row that
// has room. Returns the number of rows; `rows` and `starts` are one per chart.
label fillRows(
    const UList<scalar>& lengths, const labelList& order, scalar scale, scalar gutter,
    labelList& rows, scalarField& starts
)
{
    std::vector<scalar> ends;
    for (const label i : order)
    {
        const scalar width = scale * lengths[i] + gutter;
        const auto row = std::find_if(
            ends.begin(), ends.end(),
            [&](scalar end) { return end + width <= 1 + 1e-12; }
        );
        rows[i] = row - ends.begin();
        if (row == ends.end())
        {
            ends.push_back(gutter);
        }
        starts[i] = ends[rows[i]];
        ends[rows[i]] += width;
    }
    return ends.size();
}

} // namespace

RowPacking packRows(const UList<scalar>& lengths, scalar gutter)
{
    constexpr label mostRows = 16;
    RowPacking packing;
    const label n = lengths.size();
    if (n == 0)
    {
        return packing;
    }
    gutter = std::min(gutter, 0.25 / n);
    labelList order(n), rows(n);
    std::iota(order.begin(), order.end(), label(0));
    std::stable_sort(
        order.begin(), order.end(),
        [&](label i, label j) { return lengths[i] > lengths[j]; }
    );
    scalarField starts(n);
    packing.scale = (1 - 2 * gutter) / lengths[order[0]];
    label nRows = fillRows(lengths, order, packing.scale, gutter, rows, starts);
    while (nRows > mostRows)
    {
        packing.scale /= 2;
        nRows = fillRows(lengths, order, packing.scale, gutter, rows, starts);
    }
    const scalar free = 1 - Swatches::size - gutter;
    packing.height = free / nRows - gutter;
    packing.corners.setSize(n);
    for (label i = 0; i < n; ++i)
    {
        packing.corners[i] = vector2D(
            starts[i], Swatches::size + gutter + rows[i] * (packing.height + gutter)
        );
    }
    return packing;
}

} // namespace Foam::stability
