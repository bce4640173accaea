// SPDX-License-Identifier: GPL-3.0-or-later

#include "shapes/ExactAlpha.H"

#include <array>
#include <cmath>

namespace Foam::stability::shapes
{

namespace
{

struct Corner
{
    point x;
    scalar distance;
};
using Tet = std::array<Corner, 4>;

scalar volumeOf(const Tet& t)
{
    return mag((t[1].x - t[0].x) & ((t[2].x - t[0].x) ^ (t[3].x - t[0].x))) / 6;
}

// The point where the linear interpolant vanishes.
point root(const Corner& a, const Corner& b)
{
    return a.x + a.distance / (a.distance - b.distance) * (b.x - a.x);
}

class TetVolume
{
public:
    explicit TetVolume(const Shape& shape) : shape_(shape) {}

    Corner at(const point& x) const { return {x, shape_(x)}; }

    // [m3] inside.
    scalar inside(const Tet& t, label depth) const
    {
        const point middle = (t[0].x + t[1].x + t[2].x + t[3].x) / 4;
        scalar reach = 0;
        for (const Corner& c : t)
        {
            reach = max(reach, mag(c.x - middle));
        }
        const scalar distance = shape_(middle);
        if (mag(distance) > reach)
        {
            return distance < 0 ? volumeOf(t) : 0;
        }
        return depth > 0 ? divided(t, depth - 1) : leaf(t);
    }

private:
    scalar divided(const Tet& t, label depth) const
    {
        const auto mid = [&](label i, label j) { return at(0.5 * (t[i].x + t[j].x)); };
        const Corner m01 = mid(0, 1), m02 = mid(0, 2), m03 = mid(0, 3);
        const Corner m12 = mid(1, 2), m13 = mid(1, 3), m23 = mid(2, 3);
        const Tet parts[8] = {{t[0], m01, m02, m03}, {m01, t[1], m12, m13},
                              {m02, m12, t[2], m23}, {m03, m13, m23, t[3]},
                              {m01, m02, m03, m13},  {m01, m02, m12, m13},
                              {m02, m03, m13, m23},  {m02, m12, m13, m23}};
        scalar sum = 0;
        for (const Tet& part : parts)
        {
            sum += inside(part, depth);
        }
        return sum;
    }

    scalar leaf(const Tet& t) const
    {
        std::array<Corner, 4> in, out;
        label nIn = 0, nOut = 0;
        for (const Corner& c : t)
        {
            (c.distance < 0 ? in[nIn++] : out[nOut++]) = c;
        }
        if (nIn == 0 || nIn == 4)
        {
            return nIn ? volumeOf(t) : 0;
        }
        if (nIn == 2)
        {
            return wedge(in, out);
        }
        const Corner& lone = nIn == 1 ? in[0] : out[0];
        const auto& others = nIn == 1 ? out : in;
        const point a = root(lone, others[0]);
        const point b = root(lone, others[1]);
        const point c = root(lone, others[2]);
        const scalar tip = mag((a - lone.x) & ((b - lone.x) ^ (c - lone.x))) / 6;
        return (nIn == 1 ? tip : volumeOf(t) - tip) - beyond(a, b, c);
    }

    // Two corners inside: the prism between their two triangles.
    scalar
    wedge(const std::array<Corner, 4>& in, const std::array<Corner, 4>& out) const
    {
        const point a0 = root(in[0], out[0]), a1 = root(in[0], out[1]);
        const point b0 = root(in[1], out[0]), b1 = root(in[1], out[1]);
        const point& p = in[0].x;
        const point& q = in[1].x;
        const auto tet =
            [](const point& o, const point& x, const point& y, const point& z)
        { return mag((x - o) & ((y - o) ^ (z - o))) / 6; };
        return tet(p, a0, a1, q) + tet(q, a0, a1, b0) + tet(q, a1, b0, b1)
               - beyond(a0, a1, b1) - beyond(a0, b1, b0);
    }

    // [m3] between the triangle and the surface, positive where the surface runs on
    // the inner side: the distance integrated by the rule of the edge midpoints.
    scalar beyond(const point& a, const point& b, const point& c) const
    {
        const scalar mean =
            (shape_(0.5 * (a + b)) + shape_(0.5 * (b + c)) + shape_(0.5 * (c + a))) / 3;
        return mean * 0.5 * mag((b - a) ^ (c - a));
    }

    const Shape& shape_;
};

// Volume inside and volume of one cell, as the sum of its tetrahedra.
scalar
fraction(const CellComplex& complex, label celli, const Shape& shape, label depth)
{
    const TetVolume volume(shape);
    const Corner centre = volume.at(complex.cellCentres()[celli]);
    scalar reach = 0;
    for (const label facei : complex.cellFaces()[celli])
    {
        for (const label pointi : complex.faces()[facei])
        {
            reach = max(reach, mag(complex.points()[pointi] - centre.x));
        }
    }
    if (mag(centre.distance) > reach)
    {
        return centre.distance < 0 ? 1 : 0;
    }
    scalar inside = 0;
    scalar whole = 0;
    for (const label facei : complex.cellFaces()[celli])
    {
        const Corner middle = volume.at(complex.faceCentres()[facei]);
        const face& f = complex.faces()[facei];
        forAll(f, k)
        {
            const Tet tet{
                centre, middle, volume.at(complex.points()[f[k]]),
                volume.at(complex.points()[f.nextLabel(k)])};
            inside += volume.inside(tet, depth);
            whole += volumeOf(tet);
        }
    }
    return min(max(inside / whole, scalar(0)), scalar(1));
}

} // namespace

Shape sphere(const point& centre, scalar radius)
{
    return [=](const point& x) { return mag(x - centre) - radius; };
}

Shape halfSpace(const point& origin, const vector& normal)
{
    const vector n = normal / mag(normal);
    return [=](const point& x) { return (x - origin) & n; };
}

Shape torus(const point& centre, const vector& axis, scalar major, scalar minor)
{
    const vector a = axis / mag(axis);
    return [=](const point& x)
    {
        const vector d = x - centre;
        const scalar along = d & a;
        return std::hypot(mag(d - along * a) - major, along) - minor;
    };
}

Shape block(const point& min, const point& max)
{
    const point centre = 0.5 * (min + max);
    const vector half = 0.5 * (max - min);
    return [=](const point& x)
    {
        vector beyond = x - centre;
        scalar deepest = -GREAT;
        scalar outside = 0;
        for (direction d = 0; d < 3; ++d)
        {
            const scalar q = mag(beyond[d]) - half[d];
            deepest = Foam::max(deepest, q);
            outside += sqr(Foam::max(q, scalar(0)));
        }
        return outside > 0 ? sqrt(outside) : deepest;
    };
}

Shape unionOf(const Shape& a, const Shape& b)
{
    return [=](const point& x) { return Foam::min(a(x), b(x)); };
}

scalarField exactAlpha(const CellComplex& complex, const Shape& shape, label depth)
{
    scalarField alpha(complex.nCells());
    forAll(alpha, celli)
    {
        alpha[celli] = fraction(complex, celli, shape, depth);
    }
    return alpha;
}

FlowSnapshot
snapshotOf(std::shared_ptr<const CellComplex> complex, const scalarField& alpha)
{
    FlowSnapshot snapshot;
    snapshot.complex = complex;
    snapshot.alphas = List<scalarField>(1, alpha);
    scalarField boundary(complex->nBoundaryFaces());
    forAll(boundary, i)
    {
        boundary[i] = alpha[complex->owner()[complex->nInternalFaces() + i]];
    }
    snapshot.boundaryAlphas = List<scalarField>(1, boundary);
    snapshot.U.setSize(complex->nCells(), Zero);
    snapshot.boundaryU.setSize(complex->nBoundaryFaces(), Zero);
    return snapshot;
}

FlowSnapshot snapshotOf(std::shared_ptr<const CellComplex> complex, const Shape& shape)
{
    return snapshotOf(complex, exactAlpha(*complex, shape));
}

scalar materialIn(const CellComplex& complex, const scalarField& alpha)
{
    scalar sum = 0;
    forAll(alpha, celli)
    {
        sum += alpha[celli] * complex.cellVolumes()[celli];
    }
    return sum;
}

} // namespace Foam::stability::shapes
