// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/comparison/ThinSheets.H"

#include "core/surface/SurfaceLocator.H"

namespace Foam::stability
{

namespace
{

// True if the segment from x - d to x + d meets the triangle (Moeller and Trumbore, J.
// Graphics Tools 2 (1997)). Edges belong to the triangle, with some margin, so that no
// segment slips between two triangles.
bool meets(
    const point& x, const vector& d, const point& a, const point& b, const point& c
)
{
    constexpr scalar margin = 1e-9;
    const vector ab = b - a, ac = c - a, ax = x - a;
    const vector p = d ^ ac;
    const scalar determinant = ab & p;
    if (mag(determinant) <= VSMALL)
    {
        return false;
    }
    const vector q = ax ^ ab;
    const scalar u = (ax & p) / determinant;
    const scalar v = (d & q) / determinant;
    const scalar t = (ac & q) / determinant;
    return u >= -margin && v >= -margin && u + v <= 1 + margin && mag(t) <= 1;
}

} // namespace

List<bool>
thinPoints(const InterfaceMesh& mesh, const scalarField& extents, label nThreads)
{
    List<bool> thin(mesh.points.size(), false);
    if (mesh.empty())
    {
        return thin;
    }
    const vectorField normals = mesh.pointNormals();
    const vectorField areas = mesh.areaVectors();
    const SurfaceLocator locator(mesh.points, mesh.triangles, mesh.meanCellSize());
#pragma omp parallel for schedule(dynamic, 64) num_threads(nThreads)
    for (label pointi = 0; pointi < mesh.points.size(); ++pointi)
    {
        const point& x = mesh.points[pointi];
        const vector& normal = normals[pointi];
        const vector arm = thinnestResolved * extents[pointi] * normal;
        const vector halfWidth = cmptMag(arm);
        bool found = false;
        locator.visitWithin(
            x - halfWidth, x + halfWidth,
            [&](label trianglei)
            {
                const triFace& t = mesh.triangles[trianglei];
                found = found
                        || ((areas[trianglei] & normal) < 0 && !t.found(pointi)
                            && meets(
                                x, arm, mesh.points[t[0]], mesh.points[t[1]],
                                mesh.points[t[2]]
                            ));
            }
        );
        thin[pointi] = found;
    }
    return thin;
}

} // namespace Foam::stability
