// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

#include "core/tracking/ClassifiedSurface.H"

namespace Foam::stability
{

namespace
{

// [m/s], as the header defines it. Normals point from the first fluid to the second.
scalarField driftSpeeds(
    const InterfaceMesh& mesh, const UList<Match>& matches, bool onInterface,
    scalar interval
)
{
    scalarField speeds(mesh.points.size(), 0);
    if (interval <= 0)
    {
        return speeds;
    }
    const vectorField normals = mesh.pointNormals();
    forAll(speeds, i)
    {
        const SurfacePoint& nearest = matches[i].nearest;
        speeds[i] = nearest.distance / interval;
        if (nearest.triangle >= 0)
        {
            const vector toOther = nearest.position - mesh.points[i];
            const vector fromTtoM = onInterface ? -toOther : toOther;
            if ((fromTtoM & normals[i]) > 0)
            {
                speeds[i] = -speeds[i];
            }
        }
    }
    return speeds;
}

} // namespace

labelList pointComponents(const InterfaceMesh& mesh)
{
    const SurfaceTopology topology(mesh.points.size(), mesh.triangles);
    labelList result(mesh.points.size(), 0);
    forAll(mesh.triangles, trianglei)
    {
        for (const label pointi : mesh.triangles[trianglei])
        {
            result[pointi] = topology.components()[trianglei];
        }
    }
    return result;
}

ClassifiedSurface describe(
    const InterfaceMesh& mesh, const UList<Match>& matches, Stability unmatched,
    const CellComplex& complex, scalar interval
)
{
    const label n = mesh.points.size();
    ClassifiedSurface surface;
    surface.mesh = mesh;
    surface.stability.setSize(n);
    surface.distance.setSize(n);
    surface.preimages.setSize(n);
    surface.nearWall.setSize(n);
    surface.components = pointComponents(mesh);
    surface.driftSpeed =
        driftSpeeds(mesh, matches, unmatched == Stability::attached, interval);
    for (label i = 0; i < n; ++i)
    {
        surface.stability[i] = matches[i].stable ? Stability::stable : unmatched;
        surface.distance[i] = matches[i].nearest.distance;
        surface.preimages[i] = matches[i].nPreimages;
        surface.nearWall[i] = mesh.cells[i] >= 0 && complex.nearWall(mesh.cells[i]);
    }
    return surface;
}

scalarField
confidences(const ClassifiedSurface& surface, const Epsilon& epsilon, scalar noiseFloor)
{
    constexpr scalar largest = 1000;
    scalarField result(surface.distance.size(), largest);
    forAll(result, pointi)
    {
        const scalar h = surface.mesh.cellSizes[pointi];
        const scalar off = mag(surface.distance[pointi] - epsilon.at(h)); // [m]
        if (off < largest * noiseFloor * h)
        {
            result[pointi] = off / (noiseFloor * h);
        }
    }
    return result;
}

} // namespace Foam::stability
