// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

#include "core/tracking/Transfer.H"

#include "core/tracking/SeamTreatment.H"

namespace Foam::stability
{

namespace
{

// The origin has no seams. What is attached starts here.
void carryOrigins(
    InterfaceMesh& mesh, const List<Match>& matches, const InterfaceMesh& source
)
{
    const SurfaceInterpolation<vector> interpolation(
        source, source.origins,
        [&](label trianglei, label k) { return source.triangles[trianglei][k]; }
    );
    mesh.origins.setSize(mesh.points.size());
    forAll(mesh.points, pointi)
    {
        mesh.origins[pointi] = mesh.points[pointi];
        if (matches[pointi].stable)
        {
            const SurfacePoint& x = matches[pointi].nearest;
            const triFace& t = source.triangles[x.triangle];
            mesh.origins[pointi] = interpolation.at(
                x.triangle, CornerIndices{t[0], t[1], t[2]}, x.weights
            );
        }
    }
}

} // namespace

TransferResult transfer(
    InterfaceMesh& mesh, List<Match>& matches, const MatchTarget& target,
    const TransferOptions& options
)
{
    const TransferResult result = SeamTreatment(mesh, matches, target, options).run();
    carryOrigins(mesh, matches, target.mesh());
    return result;
}

} // namespace Foam::stability
