// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/reconstruction/volumeFit/CellSolid.H"

#include <algorithm>

namespace Foam::stability
{

namespace
{

using Tet = std::array<point, 4>;

// The half space of positive depth.
struct HalfSpace
{
    point on;
    vector outwards;

    scalar depth(const point& x) const { return (on - x) & outwards; }
};

// Six times the volume.
scalar sixfold(const Tet& t)
{
    return (t[1] - t[0]) & ((t[2] - t[0]) ^ (t[3] - t[0]));
}

// The corners of a tetrahedron on both sides of a plane.
struct Sides
{
    std::array<point, 4> in, out;
    std::array<scalar, 4> inDepth{}, outDepth{};
    label nIn = 0, nOut = 0;

    Sides(const Tet& t, const HalfSpace& half)
    {
        for (const point& x : t)
        {
            const scalar depth = half.depth(x);
            label& n = depth > 0 ? nIn : nOut;
            (depth > 0 ? in : out)[n] = x;
            (depth > 0 ? inDepth : outDepth)[n] = depth;
            ++n;
        }
    }

    // The point at which the edge between an inner and an outer corner meets the plane.
    point cut(label i, label o) const
    {
        return in[i] + inDepth[i] / (inDepth[i] - outDepth[o]) * (out[o] - in[i]);
    }
};

// Sixfold volume of the part of a tetrahedron in all half spaces from `first` on.
scalar clipped(const Tet& t, const HalfSpace* first, const HalfSpace* last)
{
    if (first == last)
    {
        return mag(sixfold(t));
    }
    const Sides s(t, *first);
    const auto rest = [&](const Tet& part) { return clipped(part, first + 1, last); };
    if (s.nIn == 0 || s.nIn == 4)
    {
        return s.nIn == 0 ? 0 : rest(t);
    }
    if (s.nIn == 1)
    {
        return rest({s.in[0], s.cut(0, 0), s.cut(0, 1), s.cut(0, 2)});
    }
    const point &p = s.in[0], &q = s.in[1];
    if (s.nIn == 2)
    {
        const point p0 = s.cut(0, 0), p1 = s.cut(0, 1);
        const point q0 = s.cut(1, 0), q1 = s.cut(1, 1);
        return rest({p, p0, p1, q}) + rest({q, p0, p1, q0}) + rest({q, p1, q0, q1});
    }
    const point p0 = s.cut(0, 0), q0 = s.cut(1, 0), r0 = s.cut(2, 0);
    return rest({p, q, s.in[2], p0}) + rest({q, s.in[2], p0, q0})
           + rest({s.in[2], p0, q0, r0});
}

// The column below an upward triangle, seen from above counter-clockwise.
std::array<HalfSpace, 4> columnBelow(const Corners& t)
{
    std::array<HalfSpace, 4> column;
    for (label k = 0; k < 3; ++k)
    {
        const vector side = t[(k + 1) % 3] - t[k];
        column[k] = {t[k], vector(side.y(), -side.x(), 0)};
    }
    column[3] = {t[0], (t[1] - t[0]) ^ (t[2] - t[0])};
    return column;
}

// Twice the area of the part of a triangle in a tetrahedron whose volume has this sign.
scalar areaIn(const Tet& t, const Corners& triangle, scalar sign)
{
    static constexpr label faces[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
    std::array<point, 8> polygon, kept;
    label n = 3;
    std::copy(triangle.begin(), triangle.end(), polygon.begin());
    for (const auto& f : faces)
    {
        const HalfSpace side{
            t[f[0]], sign * ((t[f[1]] - t[f[0]]) ^ (t[f[2]] - t[f[0]]))};
        label nKept = 0;
        for (label k = 0; k < n; ++k)
        {
            const point &p = polygon[k], &q = polygon[(k + 1) % n];
            const scalar dp = side.depth(p), dq = side.depth(q);
            if (dp > 0)
            {
                kept[nKept++] = p;
            }
            if ((dp > 0) != (dq > 0))
            {
                kept[nKept++] = p + dp / (dp - dq) * (q - p);
            }
        }
        polygon = kept;
        n = nKept;
    }
    vector area(Zero);
    for (label k = 1; k + 1 < n; ++k)
    {
        area += (polygon[k] - polygon[0]) ^ (polygon[k + 1] - polygon[0]);
    }
    return mag(area);
}

} // namespace

boundBox boundsOf(const CellComplex& complex, label celli)
{
    boundBox bounds;
    for (const label facei : complex.cellFaces()[celli])
    {
        for (const label pointi : complex.faces()[facei])
        {
            bounds.add(complex.points()[pointi]);
        }
    }
    return bounds;
}

CellSolid::CellSolid(const CellComplex& complex, label celli)
    : origin_(complex.cellCentres()[celli]), bounds_(boundsOf(complex, celli))
{
    for (const label facei : complex.cellFaces()[celli])
    {
        const face& f = complex.faces()[facei];
        const bool outwards = complex.owner()[facei] == celli;
        const auto at = [&](label k) { return complex.points()[f[k]] - origin_; };
        if (f.size() == 3)
        {
            add(at(0), at(outwards ? 1 : 2), at(outwards ? 2 : 1));
            continue;
        }
        const point centre = complex.faceCentres()[facei] - origin_;
        forAll(f, k)
        {
            const point a = at(k), b = at(f.fcIndex(k));
            add(centre, outwards ? a : b, outwards ? b : a);
        }
    }
}

void CellSolid::add(const point& a, const point& b, const point& c)
{
    const Tet tet{point(Zero), a, b, c};
    const scalar volume = sixfold(tet) / 6;
    volume_ += volume;
    tets_.push_back(
        {tet, min(min(a, b), min(c, point(Zero))), max(max(a, b), max(c, point(Zero))),
         volume < 0 ? -1.0 : 1.0}
    );
}

scalar CellSolid::areaWithin(const Corners& triangle) const
{
    const Corners t{
        triangle[0] - origin_, triangle[1] - origin_, triangle[2] - origin_};
    const point low = min(t[0], min(t[1], t[2])), high = max(t[0], max(t[1], t[2]));
    scalar sum = 0;
    for (const SignedTet& tet : tets_)
    {
        if (cmptMin(high - tet.low) > 0 && cmptMin(tet.high - low) > 0)
        {
            sum += tet.sign * areaIn(tet.corners, t, tet.sign);
        }
    }
    return 0.5 * sum;
}

scalar CellSolid::volumeBelow(const Corners& triangle) const
{
    constexpr scalar upright = 1e-12;
    Corners t{triangle[0] - origin_, triangle[1] - origin_, triangle[2] - origin_};
    const vector normal = (t[1] - t[0]) ^ (t[2] - t[0]);
    if (mag(normal.z()) <= upright * mag(normal))
    {
        return 0;
    }
    if (normal.z() < 0)
    {
        std::swap(t[1], t[2]);
    }
    const std::array<HalfSpace, 4> column = columnBelow(t);
    point low = min(t[0], min(t[1], t[2]));
    const point high = max(t[0], max(t[1], t[2]));
    low.z() = -GREAT;
    scalar sum = 0;
    for (const SignedTet& tet : tets_)
    {
        if (cmptMin(high - tet.low) > 0 && cmptMin(tet.high - low) > 0)
        {
            sum += tet.sign
                   * clipped(tet.corners, column.data(), column.data() + column.size());
        }
    }
    return (normal.z() > 0 ? 1 : -1) * sum / 6;
}

} // namespace Foam::stability
