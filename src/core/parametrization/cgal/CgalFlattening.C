// SPDX-License-Identifier: GPL-3.0-or-later

// CGAL comes before OpenFOAM's headers, which make sqrt(double) ambiguous.
#ifndef CGAL_EIGEN3_ENABLED
#define CGAL_EIGEN3_ENABLED 1
#endif
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh_parameterization/Barycentric_mapping_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/Circular_border_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/LSCM_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/Two_vertices_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/parameterize.h>

#include "core/parametrization/cgal/CgalFlattening.H"
#include "core/parametrization/cgal/CgalScope.H"
#include "core/parametrization/cgal/SurfaceMesh.H"
#include "core/base/Errors.H"
#include "core/parametrization/EdgePaths.H"
#include "core/parametrization/SurfaceShape.H"

#include <cmath>

namespace Foam::stability
{

namespace
{

using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Vertex = Mesh::Vertex_index;
using Halfedge = Mesh::Halfedge_index;

namespace SMP = CGAL::Surface_mesh_parameterization;

// Centred and of edges about 1: CGAL's solvers then never meet tiny numbers.
Mesh unitMesh(const PlainSurface& surface)
{
    const point centre = average(surface.points);
    scalar area = 0;
    for (const triFace& t : surface.triangles)
    {
        area += t.mag(surface.points);
    }
    const scalar unit = std::sqrt(area / surface.triangles.size());
    if (!(unit > 0))
    {
        throw NumericalFailure("it has no area");
    }
    Mesh mesh = surfaceMesh<Kernel::Point_3>(surface, centre, unit);
    if (mesh.number_of_faces() == 0)
    {
        throw NumericalFailure("it is not manifold");
    }
    return mesh;
}

// The one boundary loop of a disk.
labelList boundaryOf(const PlainSurface& surface)
{
    List<labelList> loops = boundaryLoops(surface.points.size(), surface.triangles);
    if (loops.size() != 1)
    {
        throw NumericalFailure("it is not a disk");
    }
    return loops[0];
}

// Two points of the boundary far apart, along edges.
std::pair<label, label> farPair(const PlainSurface& surface, const labelList& loop)
{
    const SurfaceTopology topology(surface.points.size(), surface.triangles);
    label from = loop[0];
    label to = from;
    for (label sweep = 0; sweep < 2; ++sweep)
    {
        const scalarField distances =
            EdgePaths(surface.points, topology, labelList(1, to)).distances();
        from = to;
        for (const label pointi : loop)
        {
            to = distances[pointi] > distances[to] ? pointi : to;
        }
    }
    return {from, to};
}

// `start` is a point of the boundary. CGAL keeps the orientation of the triangles.
template<class Parameterizer>
List<vector2D>
parameterized(Mesh& mesh, label start, const Parameterizer& parameterizer)
{
    const Halfedge border = mesh.halfedge(Vertex(start));
    if (!mesh.is_border(border))
    {
        throw NumericalFailure("it is not manifold");
    }
    auto uv = mesh.add_property_map<Vertex, Kernel::Point_2>("v:uv").first;
    const SMP::Error_code code = SMP::parameterize(mesh, parameterizer, border, uv);
    if (code != SMP::OK)
    {
        throw NumericalFailure(SMP::get_error_message(code));
    }
    List<vector2D> result(mesh.number_of_vertices());
    for (const Vertex v : mesh.vertices())
    {
        result[static_cast<label>(v)] = vector2D(uv[v].x(), uv[v].y());
    }
    return result;
}

} // namespace

List<vector2D> LscmFlattening::flatten(const PlainSurface& surface) const
{
    using Pins = SMP::Two_vertices_parameterizer_3<Mesh>;
    return withCgal(
        [&]
        {
            const labelList loop = boundaryOf(surface);
            Mesh mesh = unitMesh(surface);
            const auto [a, b] = farPair(surface, loop);
            const SMP::LSCM_parameterizer_3<Mesh, Pins> method{
                Pins(Vertex(a), Vertex(b))};
            return parameterized(mesh, a, method);
        }
    );
}

List<vector2D> TutteFlattening::flatten(const PlainSurface& surface) const
{
    return withCgal(
        [&]
        {
            const label start = boundaryOf(surface)[0];
            Mesh mesh = unitMesh(surface);
            const SMP::Barycentric_mapping_parameterizer_3<Mesh> method;
            return parameterized(mesh, start, method);
        }
    );
}

} // namespace Foam::stability
