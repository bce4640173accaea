// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/transfer/Retriangulation.H"

#include <algorithm>

namespace Foam::stability
{

namespace
{

// A corner of a part of the triangle. Where a cut passes through a corner of the
// triangle, the corner itself counts, not the end of the cut.
struct Vertex
{
    label point;
    label index;
    bool own;
};

using Polygon = std::vector<Vertex>;

Polygon withoutRepetition(const Polygon& polygon)
{
    Polygon result;
    for (const Vertex& v : polygon)
    {
        if (result.empty() || result.back().point != v.point)
        {
            result.push_back(v);
        }
        else if (v.own)
        {
            result.back() = v;
        }
    }
    if (result.size() > 1 && result.front().point == result.back().point)
    {
        if (result.back().own)
        {
            result.front() = result.back();
        }
        result.pop_back();
    }
    return result;
}

scalar areaOf(label a, label b, label c, const Positions& x)
{
    return 0.5 * mag((x(b) - x(a)) ^ (x(c) - x(a)));
}

// The shorter diagonal, unless one of its triangles has no area (its three points
// lie on one edge).
bool fromFirstCorner(label a, label b, label c, label d, const Positions& x)
{
    constexpr scalar flat = 1e-9;
    const scalar ac = std::min(areaOf(a, b, c, x), areaOf(a, c, d, x));
    const scalar bd = std::min(areaOf(a, b, d, x), areaOf(b, c, d, x));
    if (ac <= flat * bd || bd <= flat * ac)
    {
        return ac > bd;
    }
    return magSqr(x(c) - x(a)) <= magSqr(x(d) - x(b));
}

void append(
    const Vertex& a, const Vertex& b, const Vertex& c, std::vector<CutTriangle>& result
)
{
    CutTriangle t;
    t.points = triFace(a.point, b.point, c.point);
    t.corners = CornerIndices{a.index, b.index, c.index};
    result.push_back(t);
}

void append(const Polygon& given, const Positions& x, std::vector<CutTriangle>& result)
{
    const Polygon p = withoutRepetition(given);
    if (p.size() == 3)
    {
        append(p[0], p[1], p[2], result);
    }
    else if (p.size() == 4)
    {
        const bool first =
            fromFirstCorner(p[0].point, p[1].point, p[2].point, p[3].point, x);
        const label i = first ? 0 : 1;
        append(p[i], p[i + 1], p[i + 2], result);
        append(p[i], p[i + 2], p[(i + 3) % 4], result);
    }
}

void markUnknown(std::vector<CutTriangle>& result, std::size_t from)
{
    for (std::size_t i = from; i < result.size(); ++i)
    {
        result[i].extrapolated = result[i].corners.find(InterfaceMesh::noParameter);
    }
}

// Appends the triangle that three cuts leave between the corners.
void appendMiddle(
    const triFace& triangle, const CornerIndices& own,
    const FixedList<EdgeCut, 3>& cuts, label middle, const Positions& positions,
    std::vector<CutTriangle>& result
)
{
    // Both ends of an edge may be cut by the other two edges: nothing is left then
    // but its own cut, which goes into the part of the corner opposite.
    for (label k = 0; k < 3; ++k)
    {
        const label next = (k + 1) % 3, o = (k + 2) % 3;
        const label a = triangle[k], b = triangle[next];
        if (cuts[o].point == a && cuts[next].point == b && cuts[k].point != a
            && cuts[k].point != b)
        {
            result.clear();
            append(
                {Vertex{triangle[o], own[o], true}, Vertex{a, cuts[o].before, false},
                 Vertex{cuts[k].point, InterfaceMesh::noParameter, false},
                 Vertex{b, cuts[next].after, false}},
                positions, result
            );
            markUnknown(result, 0);
            return;
        }
    }
    const label opposite = (middle + 1) % 3, last = (middle + 2) % 3;
    const auto nBefore = result.size();
    append(
        {Vertex{cuts[middle].point, cuts[middle].before, false},
         Vertex{cuts[opposite].point, InterfaceMesh::noParameter, false},
         Vertex{cuts[last].point, cuts[last].after, false}},
        positions, result
    );
    markUnknown(result, nBefore);
}

} // namespace

std::vector<CutTriangle> retriangulate(
    const triFace& triangle, const CornerIndices& own,
    const FixedList<EdgeCut, 3>& cuts, label middle, const Positions& positions
)
{
    const auto corner = [&](label k) { return Vertex{triangle[k], own[k], true}; };
    const auto before = [&](label k) {
        return Vertex{cuts[k].point, cuts[k].before, false};
    };
    const auto after = [&](label k) {
        return Vertex{cuts[k].point, cuts[k].after, false};
    };

    std::vector<CutTriangle> result;
    label nCuts = 0, cut = 0, uncut = 0;
    for (label k = 0; k < 3; ++k)
    {
        nCuts += cuts[k].exists();
        (cuts[k].exists() ? cut : uncut) = k;
    }
    if (nCuts == 0)
    {
        append({corner(0), corner(1), corner(2)}, positions, result);
    }
    else if (nCuts == 1)
    {
        // The seam ends at the opposite corner, which both parts share.
        const label a = cut, b = (cut + 1) % 3, o = (cut + 2) % 3;
        if (cuts[cut].point == triangle[a] || cuts[cut].point == triangle[b])
        {
            append({corner(0), corner(1), corner(2)}, positions, result);
            return result;
        }
        append({corner(a), before(cut), corner(o)}, positions, result);
        append({after(cut), corner(b), corner(o)}, positions, result);
    }
    else if (nCuts == 2)
    {
        const label a = uncut, b = (uncut + 1) % 3, apex = (uncut + 2) % 3;
        append({corner(apex), before(apex), after(b)}, positions, result);
        append({after(apex), corner(a), corner(b), before(b)}, positions, result);
    }
    else
    {
        for (label k = 0; k < 3; ++k)
        {
            append({corner(k), before(k), after((k + 2) % 3)}, positions, result);
        }
        appendMiddle(triangle, own, cuts, middle, positions, result);
    }
    return result;
}

std::vector<triFace> divide(
    const triFace& triangle, const FixedList<label, 3>& newPoints,
    const Positions& positions
)
{
    label nNew = 0, with = 0, without = 0;
    for (label k = 0; k < 3; ++k)
    {
        nNew += newPoints[k] >= 0;
        (newPoints[k] >= 0 ? with : without) = k;
    }
    if (nNew == 0)
    {
        return {triangle};
    }
    if (nNew == 1)
    {
        const label a = triangle[with], b = triangle[(with + 1) % 3],
                    c = triangle[(with + 2) % 3], s = newPoints[with];
        return {triFace(a, s, c), triFace(s, b, c)};
    }
    if (nNew == 2)
    {
        const label c = triangle[without], a = triangle[(without + 1) % 3],
                    b = triangle[(without + 2) % 3];
        const label s = newPoints[(without + 1) % 3], r = newPoints[(without + 2) % 3];
        // Edges: c to a whole, a to b at s, b to c at r.
        if (fromFirstCorner(a, s, r, c, positions))
        {
            return {triFace(s, b, r), triFace(a, s, r), triFace(a, r, c)};
        }
        return {triFace(s, b, r), triFace(a, s, c), triFace(s, r, c)};
    }
    return {
        triFace(triangle[0], newPoints[0], newPoints[2]),
        triFace(newPoints[0], triangle[1], newPoints[1]),
        triFace(newPoints[2], newPoints[1], triangle[2]),
        triFace(newPoints[0], newPoints[1], newPoints[2])};
}

vector2D similarCorner(
    const point& a, const point& b, const point& c, const vector2D& pa,
    const vector2D& pb, scalar orientation
)
{
    const vector ab = b - a, ac = c - a;
    const scalar length2 = magSqr(ab);
    if (length2 <= VSMALL)
    {
        return pa;
    }
    const scalar along = (ab & ac) / length2;
    const scalar across = (orientation < 0 ? -1 : 1) * mag(ab ^ ac) / length2;
    const vector2D u = pb - pa;
    return pa + along * u + across * vector2D(-u.y(), u.x());
}

} // namespace Foam::stability
