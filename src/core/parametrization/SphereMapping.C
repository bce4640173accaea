// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/parametrization/SphereMapping.H"

#include "core/base/Errors.H"
#include "core/parametrization/DiskBoundary.H"
#include "core/surface/SurfaceTopology.H"
#include "DynamicList.H"

#include <cmath>

namespace Foam::stability
{

namespace
{

point middleOf(const PlainSurface& surface)
{
    point sum(Zero);
    scalar area = 0;
    for (const triFace& t : surface.triangles)
    {
        sum += t.mag(surface.points) * t.centre(surface.points);
        area += t.mag(surface.points);
    }
    if (!(area > 0))
    {
        throw NumericalFailure("it has no area");
    }
    return sum / area;
}

// Directions from the centre, in a frame with the poles on its third axis.
List<vector> directions(const PlainSurface& surface, const labelPair& poles)
{
    const point& south = surface.points[poles.first()];
    const vector line = surface.points[poles.second()] - south;
    const scalar length = mag(line);
    if (!(length > 0))
    {
        throw NumericalFailure("it has no two points apart");
    }
    const vector axis = line / length;
    const scalar along = (middleOf(surface) - south) & axis;
    const point centre = south + min(0.9 * length, max(0.1 * length, along)) * axis;
    vector first(Zero);
    const vector shares(cmptMag(axis));
    label across = 0; // the axis of space to which this one is least parallel
    for (label k = 1; k < 3; ++k)
    {
        across = shares[k] < shares[across] ? k : across;
    }
    first[across] = 1;
    first = normalised(first - (first & axis) * axis);
    const vector second = axis ^ first;
    List<vector> result(surface.points.size());
    forAll(result, i)
    {
        const vector d = surface.points[i] - centre;
        result[i] = vector(first & d, second & d, axis & d);
    }
    return result;
}

// The angle from a to b around the axis, in [-pi, pi].
scalar turn(const vector& a, const vector& b)
{
    return std::atan2(a.x() * b.y() - a.y() * b.x(), a.x() * b.x() + a.y() * b.y());
}

// Longitudes run westwards where the surface faces the centre, as bubbles do.
void orient(const PlainSurface& surface, List<vector2D>& parameters)
{
    scalar area = 0;
    for (const triFace& t : surface.triangles)
    {
        area += (parameters[t[1]] - parameters[t[0]])
                    .perp(parameters[t[2]] - parameters[t[0]]);
    }
    for (vector2D& p : parameters)
    {
        p.x() = area < 0 ? -p.x() : p.x();
    }
}

} // namespace

// Longitudes go on from triangle to triangle; a pole takes the mean of those beside it.
FlatteningResult SphereMapping::flatten(const PlainSurface& surface) const
{
    const labelPair poles(farPair(surface, diskBoundary(surface)));
    const List<vector> d(directions(surface, poles));
    const label nPoints = surface.points.size();
    FlatteningResult result;
    result.parameters.setSize(nPoints);
    List<bool> reached(nPoints, false);
    reached[poles.first()] = reached[poles.second()] = true;
    const SurfaceTopology topology(nPoints, surface.triangles);
    const Rows neighbours(
        nPoints,
        [&](auto add)
        {
            for (const SurfaceEdge& e : topology.edges())
            {
                add(e.a, e.b);
                add(e.b, e.a);
            }
        }
    );
    DynamicList<label> front;
    const label start = neighbours[poles.first()][0];
    reached[start] = true;
    front.append(start);
    for (label next = 0; next < front.size(); ++next)
    {
        const label from = front[next];
        for (const label to : neighbours[from])
        {
            if (!reached[to])
            {
                result.parameters[to].x() =
                    result.parameters[from].x() + turn(d[from], d[to]);
                reached[to] = true;
                front.append(to);
            }
        }
    }
    for (const label pole : {poles.first(), poles.second()})
    {
        scalar sum = 0;
        for (const label beside : neighbours[pole])
        {
            sum += result.parameters[beside].x();
        }
        result.parameters[pole].x() = sum / neighbours[pole].size();
    }
    forAll(d, i)
    {
        result.parameters[i].y() = std::atan2(d[i].z(), std::hypot(d[i].x(), d[i].y()));
    }
    orient(surface, result.parameters);
    return result;
}

} // namespace Foam::stability
