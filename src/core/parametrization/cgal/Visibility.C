// SPDX-License-Identifier: GPL-3.0-or-later

// CGAL comes before OpenFOAM's headers, which make sqrt(double) ambiguous.
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include "core/parametrization/cgal/CgalScope.H"
#include "core/parametrization/seams/Visibility.H"

#include <cmath>
#include <vector>

namespace Foam::stability
{

namespace
{

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

constexpr label nDirections = 32;

// Rays start this far outside of the surface, in mean lengths of its triangles: what is
// nearer does not count as in the way.
constexpr scalar clearance = 0.5;

// Directions less than 15 degrees above the surface see its own unevenness.
constexpr scalar lowest = 0.26;

// Fibonacci's lattice on the sphere.
vector direction(label i)
{
    const scalar z = 1 - (2 * i + 1.0) / nDirections;
    const scalar phi = i * M_PI * (3 - std::sqrt(5.0)), r = std::sqrt(1 - z * z);
    return vector(r * std::cos(phi), r * std::sin(phi), z);
}

vectorField normalsOf(const PlainSurface& surface)
{
    vectorField normals(surface.points.size(), Zero);
    for (const triFace& t : surface.triangles)
    {
        for (const label pointi : t)
        {
            normals[pointi] += t.areaNormal(surface.points);
        }
    }
    for (vector& n : normals)
    {
        n /= mag(n) + VSMALL;
    }
    return normals;
}

Kernel::Point_3 place(const point& x)
{
    return Kernel::Point_3(x.x(), x.y(), x.z());
}

} // namespace

scalarField visibility(const PlainSurface& surface)
{
    return withCgal(
        [&]
        {
            Triangles triangles;
            for (const triFace& t : surface.triangles)
            {
                const Kernel::Triangle_3 triangle(
                    place(surface.points[t[0]]), place(surface.points[t[1]]),
                    place(surface.points[t[2]])
                );
                if (!triangle.is_degenerate())
                {
                    triangles.push_back(triangle);
                }
            }
            const Tree tree(triangles.begin(), triangles.end());
            const scalar step =
                clearance * std::sqrt(surface.area() / surface.triangles.size());
            const vectorField normals(normalsOf(surface));
            scalarField result(surface.points.size(), 1);
            forAll(result, pointi)
            {
                label nOutside = 0, nFree = 0;
                for (label i = 0; i < nDirections; ++i)
                {
                    const vector d = direction(i);
                    if ((d & normals[pointi]) > lowest)
                    {
                        const Kernel::Ray_3 ray(
                            place(surface.points[pointi] + step * normals[pointi]),
                            Kernel::Vector_3(d.x(), d.y(), d.z())
                        );
                        ++nOutside;
                        nFree += !tree.do_intersect(ray);
                    }
                }
                result[pointi] = nOutside > 0 ? scalar(nFree) / nOutside : 1;
            }
            return result;
        }
    );
}

} // namespace Foam::stability
