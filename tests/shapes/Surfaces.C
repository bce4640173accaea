// SPDX-License-Identifier: GPL-3.0-or-later

#include "shapes/Surfaces.H"

#include "core/parametrization/SurfaceShape.H"
#include "shapes/Welder.H"
#include "DynamicList.H"
#include "mathematicalConstants.H"

#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace Foam::stability::shapes
{

namespace
{

constexpr scalar twoPi = 2 * M_PI;

} // namespace

PlainSurface grid(
    const std::function<point(scalar u, scalar v)>& position, label nu, label nv,
    bool closedU, bool closedV
)
{
    PlainSurface surface;
    Welder<labelPair> welder;
    const auto corner = [&](label i, label j)
    {
        i = closedU ? i % nu : i;
        j = closedV ? j % nv : j;
        return welder(labelPair(i, j), position(scalar(i) / nu, scalar(j) / nv));
    };
    DynamicList<triFace> triangles;
    for (label j = 0; j < nv; ++j)
    {
        for (label i = 0; i < nu; ++i)
        {
            const label a = corner(i, j), b = corner(i + 1, j);
            const label c = corner(i + 1, j + 1), d = corner(i, j + 1);
            triangles.append(triFace(a, b, c));
            triangles.append(triFace(a, c, d));
        }
    }
    surface.points = welder.points();
    surface.triangles = std::move(triangles);
    return surface;
}

PlainSurface
openCylinder(scalar radius, scalar height, scalar angle, label nu, label nv)
{
    return openCone(radius, radius, height, angle, nu, nv);
}

PlainSurface
openCone(scalar bottom, scalar top, scalar height, scalar angle, label nu, label nv)
{
    return grid(
        [=](scalar u, scalar v)
        {
            const scalar r = bottom + v * (top - bottom);
            const scalar phi = u * angle / 360 * twoPi;
            return point(r * std::cos(phi), r * std::sin(phi), v * height);
        },
        nu, nv
    );
}

PlainSurface annulus(scalar inner, scalar outer, label nAround, label nAcross)
{
    return grid(
        [=](scalar u, scalar v)
        {
            const scalar r = outer + v * (inner - outer);
            return point(r * std::cos(twoPi * u), r * std::sin(twoPi * u), 0);
        },
        nAround, nAcross, true
    );
}

PlainSurface torus(scalar major, scalar minor, label nAround, label nAcross)
{
    return grid(
        [=](scalar u, scalar v)
        {
            const scalar r = major + minor * std::cos(twoPi * v);
            return point(
                r * std::cos(twoPi * u), r * std::sin(twoPi * u),
                minor * std::sin(twoPi * v)
            );
        },
        nAround, nAcross, true, true
    );
}

PlainSurface sphere(const point& centre, scalar radius, label levels)
{
    const scalar g = 0.5 * (1 + std::sqrt(5.0));
    PlainSurface surface;
    surface.points = pointField(
        {point(-1, g, 0), point(1, g, 0), point(-1, -g, 0), point(1, -g, 0),
         point(0, -1, g), point(0, 1, g), point(0, -1, -g), point(0, 1, -g),
         point(g, 0, -1), point(g, 0, 1), point(-g, 0, -1), point(-g, 0, 1)}
    );
    surface.triangles = List<triFace>(
        {triFace(0, 11, 5),  triFace(0, 5, 1),  triFace(0, 1, 7),  triFace(0, 7, 10),
         triFace(0, 10, 11), triFace(1, 5, 9),  triFace(5, 11, 4), triFace(11, 10, 2),
         triFace(10, 7, 6),  triFace(7, 1, 8),  triFace(3, 9, 4),  triFace(3, 4, 2),
         triFace(3, 2, 6),   triFace(3, 6, 8),  triFace(3, 8, 9),  triFace(4, 9, 5),
         triFace(2, 4, 11),  triFace(6, 2, 10), triFace(8, 6, 7),  triFace(9, 8, 1)}
    );
    for (label level = 0; level < levels; ++level)
    {
        DynamicList<point> points(surface.points);
        std::map<std::pair<label, label>, label> middles;
        const auto middle = [&](label a, label b)
        {
            const auto [entry, fresh] =
                middles.emplace(std::minmax(a, b), points.size());
            if (fresh)
            {
                points.append(0.5 * (points[a] + points[b]));
            }
            return entry->second;
        };
        DynamicList<triFace> triangles;
        for (const triFace& t : surface.triangles)
        {
            const label a = middle(t[0], t[1]), b = middle(t[1], t[2]);
            const label c = middle(t[2], t[0]);
            triangles.append(triFace(t[0], a, c));
            triangles.append(triFace(a, t[1], b));
            triangles.append(triFace(c, b, t[2]));
            triangles.append(triFace(a, b, c));
        }
        surface.points = pointField(points);
        surface.triangles = std::move(triangles);
    }
    for (point& p : surface.points)
    {
        p = centre + radius * p / mag(p);
    }
    return surface;
}

PlainSurface hemisphere(const point& centre, scalar radius, label levels)
{
    const PlainSurface whole = sphere(centre, radius, levels);
    Welder<label> welder;
    DynamicList<triFace> triangles;
    for (const triFace& t : whole.triangles)
    {
        if (t.centre(whole.points).z() > centre.z())
        {
            triFace kept;
            for (label k = 0; k < 3; ++k)
            {
                kept[k] = welder(t[k], whole.points[t[k]]);
            }
            triangles.append(kept);
        }
    }
    return {welder.points(), List<triFace>(std::move(triangles))};
}

PlainSurface ringedHemisphere(const point& centre, scalar radius, label nRings)
{
    PlainSurface surface;
    DynamicList<point> points;
    DynamicList<triFace> triangles;
    // The point with this number of a ring, which is closed.
    const auto onRing = [](label ring, label i)
    { return ring == 0 ? 0 : 3 * ring * (ring - 1) + 1 + i % (6 * ring); };
    for (label ring = 0; ring <= nRings; ++ring)
    {
        const scalar polar = 0.25 * twoPi * ring / nRings;
        for (label i = 0; i < max(1, 6 * ring); ++i)
        {
            const scalar phi = ring == 0 ? 0 : twoPi * i / (6 * ring);
            points.append(
                centre
                + radius
                      * vector(
                          std::sin(polar) * std::cos(phi),
                          std::sin(polar) * std::sin(phi), std::cos(polar)
                      )
            );
        }
        for (label sector = 0; sector < 6 && ring > 0; ++sector)
        {
            for (label i = 0; i < ring; ++i)
            {
                const label inner = (ring - 1) * sector + i, outer = ring * sector + i;
                triangles.append(triFace(
                    onRing(ring - 1, inner), onRing(ring, outer),
                    onRing(ring, outer + 1)
                ));
                if (i < ring - 1)
                {
                    triangles.append(triFace(
                        onRing(ring - 1, inner), onRing(ring, outer + 1),
                        onRing(ring - 1, inner + 1)
                    ));
                }
            }
        }
    }
    surface.points = points;
    surface.triangles = triangles;
    return surface;
}

PlainSurface columns(const std::vector<std::string>& plan)
{
    using Node = std::array<label, 3>;
    Welder<Node> welder;
    DynamicList<triFace> triangles;
    const auto filled = [&](label i, label j, label k)
    {
        return k == 0 && j >= 0 && j < label(plan.size()) && i >= 0
               && i < label(plan[j].size()) && plan[j][i] == 'X';
    };
    const auto face = [&](const Node& base, label axis, bool up)
    {
        // Corners around the face of the cube at `base`, outward on the upper side.
        std::array<label, 4> c;
        for (label n = 0; n < 4; ++n)
        {
            Node node = base;
            node[axis] += up;
            node[(axis + 1) % 3] += n == 1 || n == 2;
            node[(axis + 2) % 3] += n == 2 || n == 3;
            c[n] = welder(node, point(node[0], node[1], node[2]));
        }
        if (!up)
        {
            std::swap(c[1], c[3]);
        }
        triangles.append(triFace(c[0], c[1], c[2]));
        triangles.append(triFace(c[0], c[2], c[3]));
    };
    for (label j = 0; j < label(plan.size()); ++j)
    {
        for (label i = 0; i < label(plan[j].size()); ++i)
        {
            for (label axis = 0; filled(i, j, 0) && axis < 3; ++axis)
            {
                for (const bool up : {false, true})
                {
                    Node next{i, j, 0};
                    next[axis] += up ? 1 : -1;
                    if (!filled(next[0], next[1], next[2]))
                    {
                        face({i, j, 0}, axis, up);
                    }
                }
            }
        }
    }
    return {welder.points(), List<triFace>(std::move(triangles))};
}

InterfaceMesh asInterface(const PlainSurface& surface, scalar cellSize)
{
    InterfaceMesh mesh;
    mesh.points = surface.points;
    mesh.triangles = surface.triangles;
    mesh.clearParametrization();
    mesh.cells = labelList(mesh.points.size(), 0);
    mesh.cellSizes = scalarField(mesh.points.size(), cellSize);
    mesh.boundaryFaces = labelList(mesh.points.size(), -1);
    for (const labelList& loop : boundaryLoops(mesh.points.size(), mesh.triangles))
    {
        for (const label pointi : loop)
        {
            mesh.boundaryFaces[pointi] = 7;
        }
    }
    return mesh;
}

PlainSurface inOneScene(const std::vector<PlainSurface>& surfaces)
{
    label nPoints = 0, nTriangles = 0;
    for (const PlainSurface& surface : surfaces)
    {
        nPoints += surface.points.size();
        nTriangles += surface.triangles.size();
    }
    PlainSurface all{pointField(nPoints), List<triFace>(nTriangles)};
    nPoints = nTriangles = 0;
    for (const PlainSurface& surface : surfaces)
    {
        for (const triFace& t : surface.triangles)
        {
            all.triangles[nTriangles++] =
                triFace(nPoints + t[0], nPoints + t[1], nPoints + t[2]);
        }
        for (const point& p : surface.points)
        {
            all.points[nPoints++] = p;
        }
    }
    return all;
}

} // namespace Foam::stability::shapes
