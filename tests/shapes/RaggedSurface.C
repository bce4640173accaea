// SPDX-License-Identifier: GPL-3.0-or-later

#include "shapes/RaggedSurface.H"

#include "shapes/Welder.H"

#include <array>
#include <utility>

namespace Foam::stability::shapes
{

namespace
{

// Cuts one tetrahedron of grid nodes; `crossing(a, b)` is the point on an edge.
template<class Crossing>
void cutTetrahedron(
    const std::array<label, 4>& nodes, const scalarField& values,
    const pointField& positions, const Crossing& crossing,
    DynamicList<triFace>& triangles, const Welder<labelPair>& points
)
{
    DynamicList<label> inside, outside;
    for (const label node : nodes)
    {
        (values[node] < 0 ? inside : outside).append(node);
    }
    if (inside.empty() || outside.empty())
    {
        return;
    }
    DynamicList<triFace> cuts;
    if (inside.size() == 2)
    {
        const label a = crossing(inside[0], outside[0]);
        const label b = crossing(inside[0], outside[1]);
        const label c = crossing(inside[1], outside[1]);
        const label d = crossing(inside[1], outside[0]);
        cuts.append(triFace(a, b, c));
        cuts.append(triFace(a, c, d));
    }
    else
    {
        const bool one = inside.size() == 1;
        const label tip = one ? inside[0] : outside[0];
        const labelUList& base = one ? outside : inside;
        cuts.append(triFace(
            crossing(tip, base[0]), crossing(tip, base[1]), crossing(tip, base[2])
        ));
    }
    const vector outwards = positions[outside[0]] - positions[inside[0]];
    for (triFace t : cuts)
    {
        const vector normal =
            (points[t[1]] - points[t[0]]) ^ (points[t[2]] - points[t[0]]);
        triangles.append((normal & outwards) < 0 ? triFace(t[0], t[2], t[1]) : t);
    }
}

} // namespace

PlainSurface marchingTetrahedra(
    const std::function<scalar(const point&)>& level, const boundBox& box, label n
)
{
    const label m = n + 1;
    pointField positions(m * m * m);
    scalarField values(m * m * m);
    forAll(positions, i)
    {
        const vector fraction(i % m, (i / m) % m, i / (m * m));
        positions[i] = box.min() + cmptMultiply(fraction / n, box.span());
        values[i] = level(positions[i]);
    }
    Welder<labelPair> welder;
    const auto crossing = [&](label a, label b)
    {
        if (a > b)
        {
            std::swap(a, b);
        }
        // Kept off the nodes, as the reconstruction does.
        const scalar t = max(1e-3, min(1 - 1e-3, values[a] / (values[a] - values[b])));
        return welder(
            labelPair(a, b), positions[a] + t * (positions[b] - positions[a])
        );
    };
    // Kuhn's six tetrahedra: the paths along the axes from corner 0 to corner 7.
    const label steps[3] = {1, m, m * m};
    const label orders[6][2] = {{0, 1}, {0, 2}, {1, 0}, {1, 2}, {2, 0}, {2, 1}};
    DynamicList<triFace> triangles;
    for (label cube = 0; cube < n * n * n; ++cube)
    {
        const label start = cube % n + m * ((cube / n) % n) + m * m * (cube / (n * n));
        for (const auto& order : orders)
        {
            const label second = start + steps[order[0]];
            cutTetrahedron(
                {start, second, second + steps[order[1]], start + 1 + m + m * m},
                values, positions, crossing, triangles, welder
            );
        }
    }
    return {welder.points(), List<triFace>(std::move(triangles))};
}

} // namespace Foam::stability::shapes
