// SPDX-License-Identifier: GPL-3.0-or-later

#include "shapes/OneRank.H"

#include "core/ranks/Exchange.H"

namespace Foam::stability
{

IntegrationCounts advance(
    UList<Pathline>& lines, const Velocity& velocity, const IntegrationOptions& options
)
{
    List<Pathline*> pointers(lines.size());
    forAll(lines, i)
    {
        pointers[i] = &lines[i];
    }
    return advance(pointers, velocity, options);
}

ParametrizationResult
parametrize(const InterfaceMesh& mesh, const ParametrizationOptions& options)
{
    return parametrize(wholeSurface(mesh), options, SerialExchange());
}

PackingResult packCharts(const List<List<vector2D>>& charts, scalar gutter)
{
    PackingResult result;
    result.charts.setSize(charts.size());
    List<vector2D> sizes(charts.size());
    forAll(charts, i)
    {
        result.charts[i] = upright(charts[i]);
        sizes[i] = boxSize(result.charts[i]);
    }
    const BoxPacking boxes(packBoxes(sizes, gutter));
    result.scale = boxes.scale;
    forAll(charts, i)
    {
        if (boxes.placed)
        {
            result.charts[i] = moved(
                result.charts[i], boxes.corners[i], vector2D(boxes.scale, boxes.scale)
            );
        }
    }
    return result;
}

SeamShape seamShape(const InterfaceMesh& mesh, const SurfaceTopology& topology)
{
    const List<bool> own(mesh.triangles.size(), true);
    return seamShape(wholeSurface(mesh), topology, own, SerialExchange());
}

StartChart startChart(const InterfaceMesh& surface)
{
    const SurfaceTopology topology(surface.points.size(), surface.triangles);
    return StartChart(
        surface, surface.meanCellSize(), seamShape(surface, topology).nodes
    );
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
