// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/transfer/Transfer.H"

#include "core/surface/Ribbon.H"
#include "core/transfer/SeamCutting.H"

namespace Foam::stability
{

TransferResult transfer(
    InterfaceMesh& mesh, List<Match>& matches, const MatchTarget& target,
    const TransferOptions& options, const TransferSurroundings& around
)
{
    const CarriedOrigins origins(target, around.chart);
    SeamCutting treatment(mesh, matches, target, origins, around, options);
    TransferResult result = treatment.run();
    treatment.carryOrigins();
    if (around.section)
    {
        alignAcross(mesh, *around.section);
    }
    around.chart.readOff(mesh);
    return result;
}

} // namespace Foam::stability
