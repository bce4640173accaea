// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

#include "core/tracking/Transfer.H"

#include "core/tracking/SeamTreatment.H"

namespace Foam::stability
{

namespace
{

// The origin has no seams: plain interpolation. What is attached starts here.
void carryOrigins(
    InterfaceMesh& mesh, const List<Match>& matches, const InterfaceMesh& source
)
{
    mesh.origins.setSize(mesh.points.size());
    forAll(mesh.points, pointi)
    {
        mesh.origins[pointi] = mesh.points[pointi];
        if (matches[pointi].stable)
        {
            const SurfacePoint& x = matches[pointi].nearest;
            const triFace& t = source.triangles[x.triangle];
            mesh.origins[pointi] = x.weights[0] * source.origins[t[0]]
                                   + x.weights[1] * source.origins[t[1]]
                                   + x.weights[2] * source.origins[t[2]];
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
