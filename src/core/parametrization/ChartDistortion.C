// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/parametrization/ChartDistortion.H"

#include <cmath>

namespace Foam::stability
{

namespace
{

constexpr scalar practicallyNothing = 1e-12; // of the whole

scalar signedArea(const CornerIndices& c, const List<vector2D>& p)
{
    return 0.5 * (p[c[1]] - p[c[0]]).perp(p[c[2]] - p[c[0]]);
}

// The derivatives of the position by the parameters, over a triangle.
struct Tangents
{
    vector u, v;

    scalar meanSquare() const { return 0.5 * (magSqr(u) + magSqr(v)); }

    scalar largest() const
    {
        const scalar a = magSqr(u), b = u & v, c = magSqr(v);
        return std::sqrt(0.5 * (a + c + std::hypot(a - c, 2 * b)));
    }
};

Tangents tangentsOf(const FixedList<point, 3>& x, const FixedList<vector2D, 3>& p)
{
    const vector2D along = p[1] - p[0], across = p[2] - p[0];
    const vector first = x[1] - x[0], second = x[2] - x[0];
    const scalar area = along.perp(across);
    return {
        (across.y() * first - along.y() * second) / area,
        (along.x() * second - across.x() * first) / area};
}

template<class Vector, class Outer>
scalar angleAt(const Vector& b, const Vector& c, const Outer& outer)
{
    return std::atan2(outer(b, c), b & c);
}

// Sums over the triangles of a chart.
class Sums
{
public:
    void add(const FixedList<point, 3>& x, const FixedList<vector2D, 3>& p, scalar area)
    {
        for (label k = 0; k < 3; ++k)
        {
            const label l = (k + 1) % 3, m = (k + 2) % 3;
            const scalar onSurface = angleAt(
                x[l] - x[k], x[m] - x[k],
                [](const vector& b, const vector& c) { return mag(b ^ c); }
            );
            const scalar inChart = angleAt(
                p[l] - p[k], p[m] - p[k],
                [](const vector2D& b, const vector2D& c) { return b.perp(c); }
            );
            const scalar difference = mag(onSurface - inChart);
            angles_ += difference;
            largestAngle_ = max(largestAngle_, difference);
        }
        const Tangents tangents(tangentsOf(x, p));
        squares_ += tangents.meanSquare() * area;
        largest_ = max(largest_, tangents.largest());
        ++nTriangles_;
    }

    ChartDistortion result(scalar onSurface, scalar inChart) const
    {
        ChartDistortion distortion;
        if (nTriangles_ > 0)
        {
            constexpr scalar degree = M_PI / 180;
            const scalar scale = std::sqrt(inChart / onSurface);
            distortion.meanAngle = angles_ / (3 * nTriangles_) / degree;
            distortion.largestAngle = largestAngle_ / degree;
            distortion.stretchL2 = scale * std::sqrt(squares_ / onSurface);
            distortion.stretchLinf = scale * largest_;
        }
        return distortion;
    }

private:
    scalar angles_ = 0, largestAngle_ = 0, squares_ = 0, largest_ = 0;
    label nTriangles_ = 0;
};

} // namespace

scalar chartArea(const List<CornerIndices>& corners, const List<vector2D>& parameters)
{
    scalar area = 0;
    for (const CornerIndices& c : corners)
    {
        area += signedArea(c, parameters);
    }
    return area;
}

ChartDistortion distortionOf(
    const PlainSurface& surface, const List<CornerIndices>& corners,
    const List<vector2D>& parameters
)
{
    const scalar onSurface = surface.area();
    const scalar inChart = chartArea(corners, parameters);
    Sums sums;
    forAll(corners, i)
    {
        const triFace& t = surface.triangles[i];
        const CornerIndices& c = corners[i];
        const scalar area = t.mag(surface.points);
        if (area > practicallyNothing * onSurface
            && signedArea(c, parameters) > practicallyNothing * inChart)
        {
            sums.add(
                {surface.points[t[0]], surface.points[t[1]], surface.points[t[2]]},
                {parameters[c[0]], parameters[c[1]], parameters[c[2]]}, area
            );
        }
    }
    return sums.result(onSurface, inChart);
}

scalar areaRatioOf(
    const PlainSurface& surface, const List<CornerIndices>& corners,
    const List<vector2D>& parameters
)
{
    scalarField inChart(parameters.size(), 0);
    scalarField onSurface(parameters.size(), 0);
    forAll(corners, i)
    {
        const scalar area = surface.triangles[i].mag(surface.points);
        for (const label parameteri : corners[i])
        {
            inChart[parameteri] += signedArea(corners[i], parameters);
            onSurface[parameteri] += area;
        }
    }
    const scalar total = surface.area();
    scalar largest = 0;
    scalar smallest = VGREAT;
    forAll(inChart, parameteri)
    {
        if (onSurface[parameteri] > practicallyNothing * total)
        {
            const scalar scale = inChart[parameteri] * (total / onSurface[parameteri]);
            largest = max(largest, scale);
            smallest = min(smallest, scale);
        }
    }
    return largest / smallest;
}

} // namespace Foam::stability
