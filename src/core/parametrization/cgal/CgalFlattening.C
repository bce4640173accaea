// SPDX-License-Identifier: GPL-3.0-or-later

// CGAL comes before OpenFOAM's headers, which make sqrt(double) ambiguous.
#ifndef CGAL_EIGEN3_ENABLED
#define CGAL_EIGEN3_ENABLED 1
#endif
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh_parameterization/ARAP_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/Barycentric_mapping_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/Circular_border_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/LSCM_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/Two_vertices_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/parameterize.h>

#include "core/parametrization/cgal/CgalFlattening.H"
#include "core/parametrization/cgal/CgalScope.H"
#include "core/parametrization/cgal/SurfaceMesh.H"
#include "core/base/Errors.H"
#include "core/parametrization/DiskBoundary.H"

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
    const scalar unit = std::sqrt(surface.area() / surface.triangles.size());
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

// `start` is a point of the boundary. CGAL keeps the orientation of the triangles.
template<class Parameterizer>
FlatteningResult
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
    FlatteningResult result;
    result.parameters.setSize(mesh.number_of_vertices());
    for (const Vertex v : mesh.vertices())
    {
        result.parameters[static_cast<label>(v)] = vector2D(uv[v].x(), uv[v].y());
    }
    return result;
}

} // namespace

FlatteningResult LscmFlattening::flatten(const PlainSurface& surface) const
{
    using Pins = SMP::Two_vertices_parameterizer_3<Mesh>;
    return withCgal(
        [&]
        {
            const labelPair pins(farPair(surface, diskBoundary(surface)));
            Mesh mesh = unitMesh(surface);
            const SMP::LSCM_parameterizer_3<Mesh, Pins> method{
                Pins(Vertex(pins.first()), Vertex(pins.second()))};
            return parameterized(mesh, pins.first(), method);
        }
    );
}

FlatteningResult ArapFlattening::flatten(const PlainSurface& surface) const
{
    return withCgal(
        [&]
        {
            const label start = diskBoundary(surface)[0];
            Mesh mesh = unitMesh(surface);
            const SMP::ARAP_parameterizer_3<Mesh> method;
            return parameterized(mesh, start, method);
        }
    );
}

FlatteningResult TutteFlattening::flatten(const PlainSurface& surface) const
{
    return withCgal(
        [&]
        {
            const label start = diskBoundary(surface)[0];
            Mesh mesh = unitMesh(surface);
            const SMP::Barycentric_mapping_parameterizer_3<Mesh> method;
            return parameterized(mesh, start, method);
        }
    );
}

} // namespace Foam::stability
