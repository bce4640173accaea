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

// The unit directions of the curve at its points, in their order: those of the arcs
// through three points each.
vectorField directionsAlong(const pointField& x, bool closed)
{
    const label n = x.size();
    const auto chord = [&](label i)
    {
        const vector d = x[(i + 1) % n] - x[i];
        return d / std::max(mag(d), scalar(VSMALL));
    };
    vectorField directions(n);
    for (label i = 0; i < n; ++i)
    {
        if (closed || (i > 0 && i + 1 < n))
        {
            const point &before = x[(i + n - 1) % n], &after = x[(i + 1) % n];
            const vector sum = mag(after - x[i]) * chord((i + n - 1) % n)
                               + mag(x[i] - before) * chord(i);
            directions[i] = sum / std::max(mag(sum), scalar(VSMALL));
        }
    }
    const auto mirrored = [](const vector& d, const vector& c)
    { return 2 * (d & c) * c - d; };
    if (!closed)
    {
        directions[0] = n > 2 ? mirrored(directions[1], chord(0)) : chord(0);
        directions[n - 1] =
            n > 2 ? mirrored(directions[n - 2], chord(n - 2)) : chord(0);
    }
    return directions;
}

// The place at a share of the way from x to y on the cubic with these directions, or on
// the chord where they differ much from it.
point onArc(
    const point& x, const vector& d, const point& y, const vector& e, scalar share
)
{
    constexpr scalar sharp = 0.955; // cosine of 17 degrees
    const vector c = y - x;
    const scalar length = mag(c), s = share;
    if ((c & d) < sharp * length || (c & e) < sharp * length)
    {
        return x + s * c;
    }
    return x + s * s * (3 - 2 * s) * c + length * s * (1 - s) * ((1 - s) * d - s * e);
}

} // namespace

RemeshingResult
refinedRibbon(const PlainSurface& ribbon, const PlaneSection& section, scalar length)
{
    RemeshingResult copy;
    copy.surface = ribbon;
    copy.nearest = identity(ribbon.points.size());
    const RibbonCurve curve(ribbon, section);
    const DynamicList<label> order(curve.inOrder(ribbon));
    if (order.size() < 2)
    {
        return copy;
    }
    const bool closed = curve.next[order.last()] == order[0];
    const label n = order.size(), nStrips = closed ? n : n - 1;
    pointField x(n);
    forAll(x, i)
    {
        x[i] = section.inMiddle(ribbon.points[order[i]]);
    }
    const vectorField directions(directionsAlong(x, closed));
    DynamicList<point> points(ribbon.points);
    DynamicList<label> nearest(copy.nearest);
    DynamicList<triFace> triangles;
    for (label i = 0; i < nStrips; ++i)
    {
        const label j = (i + 1) % n;
        const label nParts = std::max(std::ceil(mag(x[j] - x[i]) / length), scalar(1));
        const label inner = closed || i > 0 ? order[i] : order[j]; // not at an end
        label a = order[i], above = curve.above[a];
        for (label k = 1; k <= nParts; ++k)
        {
            label b = order[j], aboveB = curve.above[b];
            if (k < nParts)
            {
                const scalar share = scalar(k) / nParts;
                const point y = onArc(x[i], directions[i], x[j], directions[j], share);
                b = points.size();
                aboveB = b + 1;
                points.append(section.inLow(y));
                points.append(section.inHigh(y));
                nearest.append(inner);
                nearest.append(curve.above[inner]);
                copy.largestDistance = std::max(
                    copy.largestDistance, mag(y - x[i] - share * (x[j] - x[i]))
                );
            }
            triangles.append(triFace(a, b, aboveB));
            triangles.append(triFace(a, aboveB, above));
            a = b;
            above = aboveB;
        }
    }
    copy.surface.points = points;
    copy.surface.triangles = triangles;
    copy.nearest = nearest;
    return copy;
}

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
