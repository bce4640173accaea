// SPDX-License-Identifier: GPL-3.0-or-later

// CGAL comes before OpenFOAM's headers, which make sqrt(double) ambiguous.
#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/version.h>
#if CGAL_VERSION_NR < CGAL_VERSION_NUMBER(6, 0, 0)
#include <CGAL/AABB_traits.h>
#else
#include <CGAL/AABB_traits_3.h>
#endif

#include "core/parametrization/cgal/CgalScope.H"
#include "core/parametrization/cgal/SurfaceMesh.H"
#include "core/parametrization/Remeshing.H"
#include "core/parametrization/SurfaceShape.H"

#include <cmath>

namespace Foam::stability
{

namespace
{

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Vertex = Mesh::Vertex_index;
using Face = Mesh::Face_index;
using Halfedge = Mesh::Halfedge_index;

namespace PMP = CGAL::Polygon_mesh_processing;

constexpr unsigned nIterations = 4;

// A component that would keep fewer triangles than this is left as it is.
constexpr label fewestTriangles = 20;

PlainSurface fromCgal(Mesh& mesh, const point& centre, scalar unit)
{
    mesh.collect_garbage();
    PlainSurface surface;
    surface.points.setSize(mesh.number_of_vertices());
    surface.triangles.setSize(mesh.number_of_faces());
    for (const Vertex v : mesh.vertices())
    {
        const Kernel::Point_3& x = mesh.point(v);
        surface.points[static_cast<label>(v)] =
            centre + unit * point(x.x(), x.y(), x.z());
    }
    for (const Face f : mesh.faces())
    {
        triFace& t = surface.triangles[static_cast<label>(f)];
        label k = 0;
        for (const Vertex v : mesh.vertices_around_face(mesh.halfedge(f)))
        {
            t[k++] = static_cast<label>(v);
        }
    }
    return surface;
}

// Points where the boundary turns by more than 60 degrees, as in an edge of the
// domain: collapsing one of them would cut the corner.
std::vector<bool> boundaryCorners(const Mesh& mesh)
{
    std::vector<bool> corners(mesh.number_of_vertices(), false);
    for (const Halfedge h : mesh.halfedges())
    {
        if (mesh.is_border(h))
        {
            const Kernel::Point_3& x = mesh.point(mesh.target(h));
            const Kernel::Vector_3 in = x - mesh.point(mesh.source(h));
            const Kernel::Vector_3 out = mesh.point(mesh.target(mesh.next(h))) - x;
            const double lengths =
                std::sqrt(in.squared_length() * out.squared_length());
            corners[mesh.target(h)] = in * out < 0.5 * lengths;
        }
    }
    return corners;
}

void remeshIsotropically(Mesh& mesh)
{
    auto fixed = mesh.add_property_map<Vertex, bool>("v:fixed", false).first;
    const std::vector<bool> corners = boundaryCorners(mesh);
    for (const Vertex v : mesh.vertices())
    {
        fixed[v] = corners[v];
    }
    PMP::isotropic_remeshing(
        mesh.faces(), 1.0, mesh,
        CGAL::parameters::number_of_iterations(nIterations)
            .vertex_is_constrained_map(fixed)
    );
}

// Finite, without degenerate triangles, and of the topology of the original.
bool isSound(const PlainSurface& copy, const SurfaceShape& original)
{
    for (const point& p : copy.points)
    {
        if (!std::isfinite(p.x()) || !std::isfinite(p.y()) || !std::isfinite(p.z()))
        {
            return false;
        }
    }
    for (const triFace& t : copy.triangles)
    {
        const scalar longest =
            max(mag(copy.points[t[1]] - copy.points[t[0]]),
                max(mag(copy.points[t[2]] - copy.points[t[1]]),
                    mag(copy.points[t[0]] - copy.points[t[2]])));
        if (!(t.mag(copy.points) > 1e-6 * longest * longest))
        {
            return false;
        }
    }
    const SurfaceShape shape = shapeOf(copy.points.size(), copy.triangles);
    return shape.manifold && shape.euler == original.euler
           && shape.nLoops == original.nLoops;
}

// The corner of a triangle of the original nearest to x; if asked for, one on the
// boundary where the triangle has any.
Vertex nearestCorner(
    const Mesh& original, Face face, const Kernel::Point_3& x, bool ofBoundary
)
{
    Vertex nearest = Mesh::null_vertex();
    double least = HUGE_VAL;
    for (const Vertex corner : original.vertices_around_face(original.halfedge(face)))
    {
        // Anything inside counts as farther than all of the boundary.
        const double handicap = ofBoundary && !original.is_border(corner) ? 1e30 : 0;
        const double d = CGAL::squared_distance(x, original.point(corner)) + handicap;
        if (d < least)
        {
            least = d;
            nearest = corner;
        }
    }
    return nearest;
}

using Primitive = CGAL::AABB_face_graph_triangle_primitive<Mesh>;
#if CGAL_VERSION_NR < CGAL_VERSION_NUMBER(6, 0, 0)
using TreeTraits = CGAL::AABB_traits<Kernel, Primitive>;
#else
using TreeTraits = CGAL::AABB_traits_3<Kernel, Primitive>;
#endif
using Tree = CGAL::AABB_tree<TreeTraits>;

scalar largestSquaredDistance(const Mesh& from, const Tree& to)
{
    double largest = 0;
    for (const Vertex v : from.vertices())
    {
        largest = std::max(largest, to.squared_distance(from.point(v)));
    }
    return largest;
}

// Fills largestDistance and nearest.
void compare(
    const Mesh& original, const Mesh& copy, scalar unit, RemeshingResult& result
)
{
    const Tree onOriginal(faces(original).first, faces(original).second, original);
    const Tree onCopy(faces(copy).first, faces(copy).second, copy);
    const scalar squared =
        max(largestSquaredDistance(copy, onOriginal),
            largestSquaredDistance(original, onCopy));
    result.largestDistance = unit * std::sqrt(squared);
    result.nearest.setSize(copy.number_of_vertices());
    for (const Vertex v : copy.vertices())
    {
        const Kernel::Point_3& x = copy.point(v);
        const Face face = onOriginal.closest_point_and_primitive(x).second;
        result.nearest[static_cast<label>(v)] =
            static_cast<label>(nearestCorner(original, face, x, copy.is_border(v)));
    }
}

RemeshingResult keep(const PlainSurface& surface, const std::string& failure = "")
{
    RemeshingResult result;
    result.surface = surface;
    result.nearest = identity(surface.points.size());
    result.kept = true;
    result.failure = failure;
    return result;
}

RemeshingResult remeshed(const PlainSurface& surface, scalar edgeLength)
{
    const point centre = average(surface.points);
    const Mesh original = surfaceMesh<Kernel::Point_3>(surface, centre, edgeLength);
    if (original.number_of_faces() == 0)
    {
        throw NumericalFailure("it is not manifold");
    }
    Mesh mesh = original;
    remeshIsotropically(mesh);

    RemeshingResult result;
    result.surface = fromCgal(mesh, centre, edgeLength);
    if (result.surface.triangles.size() < fewestTriangles)
    {
        return keep(surface);
    }
    if (!isSound(result.surface, shapeOf(surface.points.size(), surface.triangles)))
    {
        throw NumericalFailure("the copy has another topology or flat triangles");
    }
    compare(original, mesh, edgeLength, result);
    return result;
}

} // namespace

RemeshingResult remesh(const PlainSurface& surface, scalar edgeLength)
{
    const scalar triangleArea = 0.25 * std::sqrt(3.0) * edgeLength * edgeLength;
    if (surface.triangles.size() < fewestTriangles || !(edgeLength > 0)
        || !(surface.area() > fewestTriangles * triangleArea))
    {
        return keep(surface);
    }
    try
    {
        return withCgal([&] { return remeshed(surface, edgeLength); });
    }
    catch (const NumericalFailure& failure)
    {
        return keep(surface, failure.what());
    }
}

} // namespace Foam::stability
