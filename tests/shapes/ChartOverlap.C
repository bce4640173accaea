// SPDX-License-Identifier: GPL-3.0-or-later

#include "shapes/ChartOverlap.H"

#include "DynamicList.H"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <vector>

namespace Foam::stability::shapes
{

namespace
{

using Corners = std::array<vector2D, 3>;

// Does an edge of `a` separate the two, up to the tolerance?
bool separates(const Corners& a, const Corners& b, scalar tolerance)
{
    const scalar turn = (a[1] - a[0]).perp(a[2] - a[0]) < 0 ? -1 : 1;
    for (label k = 0; k < 3; ++k)
    {
        const vector2D along = turn * (a[(k + 1) % 3] - a[k]);
        const scalar length = mag(along);
        if (length <= 0)
        {
            continue;
        }
        scalar deepest = -VGREAT;
        for (const vector2D& p : b)
        {
            deepest = std::max(deepest, along.perp(p - a[k]) / length);
        }
        if (deepest <= tolerance)
        {
            return true;
        }
    }
    return false;
}

scalar sizeOf(const Corners& c)
{
    return std::max({mag(c[1] - c[0]), mag(c[2] - c[1]), mag(c[0] - c[2])});
}

} // namespace

label countOverlaps(const List<vector2D>& points, const List<triFace>& triangles)
{
    if (triangles.empty())
    {
        return 0;
    }
    vector2D low(VGREAT, VGREAT), high(-VGREAT, -VGREAT);
    for (const vector2D& p : points)
    {
        low = min(low, p);
        high = max(high, p);
    }
    const label n = 1 + label(std::sqrt(scalar(triangles.size())));
    const auto cell = [&](scalar x, label axis)
    {
        const scalar span = std::max(high[axis] - low[axis], VSMALL);
        return std::min(n - 1, std::max(0, label(n * (x - low[axis]) / span)));
    };
    std::vector<std::vector<label>> bins(n * n);
    std::vector<Corners> shapes;
    for (const triFace& t : triangles)
    {
        const Corners c{points[t[0]], points[t[1]], points[t[2]]};
        const vector2D from = min(c[0], min(c[1], c[2]));
        const vector2D to = max(c[0], max(c[1], c[2]));
        for (label i = cell(from.x(), 0); i <= cell(to.x(), 0); ++i)
        {
            for (label j = cell(from.y(), 1); j <= cell(to.y(), 1); ++j)
            {
                bins[i + n * j].push_back(shapes.size());
            }
        }
        shapes.push_back(c);
    }
    std::set<std::pair<label, label>> overlaps;
    for (const std::vector<label>& bin : bins)
    {
        for (std::size_t i = 0; i < bin.size(); ++i)
        {
            for (std::size_t j = i + 1; j < bin.size(); ++j)
            {
                const Corners& a = shapes[bin[i]];
                const Corners& b = shapes[bin[j]];
                const scalar tolerance = 1e-9 * std::min(sizeOf(a), sizeOf(b));
                if (!separates(a, b, tolerance) && !separates(b, a, tolerance))
                {
                    overlaps.emplace(bin[i], bin[j]);
                }
            }
        }
    }
    return overlaps.size();
}

List<triFace> parameterTriangles(const InterfaceMesh& mesh)
{
    DynamicList<triFace> triangles;
    forAll(mesh.triangles, trianglei)
    {
        if (mesh.parametrized(trianglei))
        {
            const CornerIndices& c = mesh.corners[trianglei];
            triangles.append(triFace(c[0], c[1], c[2]));
        }
    }
    return List<triFace>(std::move(triangles));
}

label countOverlaps(const InterfaceMesh& mesh)
{
    return countOverlaps(mesh.parameters, parameterTriangles(mesh));
}

label countFlips(const List<vector2D>& points, const List<triFace>& triangles)
{
    label n = 0;
    for (const triFace& t : triangles)
    {
        n += !((points[t[1]] - points[t[0]]).perp(points[t[2]] - points[t[0]]) > 0);
    }
    return n;
}

} // namespace Foam::stability::shapes
