// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/transfer/DistributedChart.H"

#include "core/ranks/ExactSum.H"
#include "core/surface/pieces/PointNumbers.H"
#include "core/surface/pieces/Redistribution.H"
#include "core/surface/pieces/SurfaceHalo.H"

#include <algorithm>

namespace Foam::stability
{

namespace
{

// Each triangle to the rank of the cell that its first point lies in.
SurfacePiece
distribute(SurfacePiece piece, const WholeMesh& whole, const Exchange& exchange)
{
    // Until now every point is on one rank; seams have one on each side.
    const labelList numbers(pointNumbers(piece, exchange));
    piece.sharesPoints = true;
    forAll(piece.pointKeys, pointi)
    {
        piece.pointKeys[pointi] = {numbers[pointi], 0};
    }
    std::vector<DynamicList<label>> triangles(exchange.nRanks());
    forAll(piece.mesh.triangles, trianglei)
    {
        const label celli = piece.mesh.cells[piece.mesh.triangles[trianglei][0]];
        triangles[celli < 0 ? exchange.rank() : whole.rankOf(celli)].append(trianglei);
    }
    return redistributed(piece, triangles, exchange).piece;
}

} // namespace

DistributedChart::DistributedChart(
    const SurfacePiece& flattened, const WholeMesh& whole, const Exchange& exchange
)
    : empty_(false)
{
    const InterfaceMesh& mesh = flattened.mesh;
    List<ExactSum> sums(2);
    for (const scalar h : mesh.cellSizes)
    {
        sums[0].add(h);
        sums[1].add(1);
    }
    sum(sums, exchange);
    Packet box;
    box.put(boundBox(mesh.points, false));
    for (Packet& ofRank : exchange.toAll(box))
    {
        bounds_.add(ofRank.get<boundBox>());
    }
    meanCellSize_ = sums[0].value() / std::max(sums[1].value(), scalar(1));

    const SurfaceTopology topology(mesh.points.size(), mesh.triangles);
    const List<bool> own(mesh.triangles.size(), true);
    DynamicList<SeamNode> ends;
    for (const SeamNode& node : allSeamNodes(flattened, topology, own, exchange))
    {
        if (node.isEnd)
        {
            ends.append(node);
        }
    }
    Packet packet;
    packet.putList(ends);
    ends_ = exchange.fromMaster(packet).getList<SeamNode>();
    if (exchange.nRanks() == 1)
    {
        alone_ = StartChart(mesh, meanCellSize_, ends_);
    }
    else
    {
        owned_ = distribute(flattened, whole, exchange);
    }
}

StartChart DistributedChart::around(
    const InterfaceMesh& timeSurface, const pointField& unmatched,
    const Exchange& exchange
) const
{
    if (empty_ || exchange.nRanks() == 1)
    {
        return alone_;
    }
    // Interpolation leaves the triangles of T a little.
    const scalar reach = 3 * StartChart::reach * meanCellSize_;
    VoxelMask wanted(std::max(reach, scalar(VSMALL)));
    const vector wide(reach, reach, reach);
    const boundBox bounds(bounds_.min() - wide, bounds_.max() + wide);
    forAll(timeSurface.triangles, trianglei)
    {
        if (timeSurface.parametrized(trianglei))
        {
            wanted.add(
                timeSurface.origin(trianglei, 0), timeSurface.origin(trianglei, 1),
                timeSurface.origin(trianglei, 2), reach, bounds
            );
        }
    }
    for (const point& x : unmatched)
    {
        wanted.add(x, reach);
    }
    const SurfaceHalo halo(owned_, wanted, exchange);
    return StartChart(halo.mesh(), meanCellSize_, ends_);
}

} // namespace Foam::stability
