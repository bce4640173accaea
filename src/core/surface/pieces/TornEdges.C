// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/surface/pieces/TornEdges.H"

#include "core/surface/SurfaceTopology.H"

namespace Foam::stability
{

label tornEdges(
    const SurfaceHalo& halo, const std::optional<PlaneSection>& section,
    const Exchange& exchange
)
{
    label n = 0;
    runOnAllRanks(
        exchange,
        [&]
        {
            const InterfaceMesh& mesh = halo.mesh();
            const SurfaceTopology topology(mesh.points.size(), mesh.triangles);
            const auto isRim = [&](const SurfaceEdge& edge)
            {
                return section
                       && section->isLow(mesh.points[edge.a])
                              == section->isLow(mesh.points[edge.b]);
            };
            for (const SurfaceEdge& edge : topology.edges())
            {
                n += edge.nTriangles == 1 && halo.isOwn(edge.triangles[0])
                     && (mesh.boundaryFaces[edge.a] < 0
                         || mesh.boundaryFaces[edge.b] < 0)
                     && !isRim(edge);
            }
        }
    );
    return exchange.total(n);
}

} // namespace Foam::stability
