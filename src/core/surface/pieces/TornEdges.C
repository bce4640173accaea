// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/surface/pieces/TornEdges.H"

#include "core/surface/SurfaceTopology.H"

namespace Foam::stability
{

label tornEdges(const SurfaceHalo& halo, const Exchange& exchange)
{
    label n = 0;
    runOnAllRanks(
        exchange,
        [&]
        {
            const InterfaceMesh& mesh = halo.mesh();
            const SurfaceTopology topology(mesh.points.size(), mesh.triangles);
            for (const SurfaceEdge& edge : topology.edges())
            {
                n += edge.nTriangles == 1 && halo.isOwn(edge.triangles[0])
                     && (mesh.boundaryFaces[edge.a] < 0
                         || mesh.boundaryFaces[edge.b] < 0);
            }
        }
    );
    return exchange.total(n);
}

} // namespace Foam::stability
