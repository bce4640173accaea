// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

#include "core/transfer/Transfer.H"

#include "core/transfer/SeamTreatment.H"

namespace Foam::stability
{

namespace
{

// The origin has no seams. What is attached starts here.
void carryOrigins(
    InterfaceMesh& mesh, const List<Match>& matches, const CarriedOrigins& origins,
    const SeamTreatment& treatment
)
{
    mesh.origins.setSize(mesh.points.size());
    forAll(mesh.points, pointi)
    {
        mesh.origins[pointi] =
            matches[pointi].stable
                ? origins.at(matches[pointi], treatment.source(pointi))
                : mesh.points[pointi];
    }
}

} // namespace

TransferResult transfer(
    InterfaceMesh& mesh, List<Match>& matches, const MatchTarget& target,
    const TransferOptions& options, const TransferSurroundings& around
)
{
    const CarriedOrigins origins(target, around.chart);
    SeamTreatment treatment(mesh, matches, target, origins, around, options);
    TransferResult result = treatment.run();
    carryOrigins(mesh, matches, origins, treatment);
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
