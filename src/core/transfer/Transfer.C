// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/transfer/Transfer.H"

#include "core/transfer/SeamTreatment.H"

namespace Foam::stability
{

TransferResult transfer(
    InterfaceMesh& mesh, List<Match>& matches, const MatchTarget& target,
    const TransferOptions& options, const TransferSurroundings& around
)
{
    const CarriedOrigins origins(target, around.chart);
    SeamTreatment treatment(mesh, matches, target, origins, around, options);
    const TransferResult result = treatment.run();
    treatment.carryOrigins();
    around.chart.readOff(mesh);
    return result;
}

TransferResult transfer(
    InterfaceMesh& mesh, List<Match>& matches, const MatchTarget& target,
    const TransferOptions& options, const StartChart& chart
)
{
    return transfer(
        mesh, matches, target, options,
        TransferSurroundings{
            chart, seamShape(target.mesh(), target.topology()),
            List<bool>(mesh.triangles.size(), true)}
    );
}

} // namespace Foam::stability
