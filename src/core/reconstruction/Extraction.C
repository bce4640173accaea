// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/reconstruction/Extraction.H"

#include "core/reconstruction/GivenInterface.H"
#include "core/surface/pieces/Redistribution.H"
#include "core/surface/pieces/SharedPoints.H"

namespace Foam::stability
{

namespace
{

// Each triangle goes to the rank of the cell of its first corner.
SurfacePiece
distributed(const InterfaceMesh& mesh, const WholeMesh& whole, const Exchange& exchange)
{
    SurfacePiece all;
    std::vector<DynamicList<label>> ofRanks(exchange.nRanks());
    runOnAllRanks(
        exchange,
        [&]
        {
            all = wholeSurface(mesh);
            forAll(mesh.triangles, trianglei)
            {
                const label celli = mesh.cells[mesh.triangles[trianglei][0]];
                ofRanks[whole.rankOf(celli)].append(trianglei);
                // Places are counted anew after splitting, on each rank alone.
                all.keys[trianglei] = {point(trianglei, 0, 0), 0};
            }
        }
    );
    return redistributed(all, ofRanks, exchange).piece;
}

// Keeps what is made in this rank's own cells. Returns the points that others have,
// too.
List<NamedPoint> extractOwn(
    const Reconstruction& method, const FlowSnapshot& snapshot,
    ExtractedSurface& surface
)
{
    ReconstructionResult& result = surface.result;
    result = method.extract(snapshot);
    const labelList kept(keepOwn(surface.piece, result.mesh, *snapshot.complex));
    surface.spread = result.sharpening ? scalarField(result.sharpening->spread, kept)
                                       : scalarField(kept.size(), 0);
    const List<NamedPoint> shared(sharedPoints(result.mesh, kept, *snapshot.complex));
    result.mesh = InterfaceMesh();
    return shared;
}

void sumVolumes(ReconstructionResult& result, const Exchange& exchange)
{
    List<ExactSum> volumes(2);
    volumes[0] = result.volume;
    volumes[1] = result.alphaVolume;
    sum(volumes, exchange);
    result.volume = volumes[0];
    result.alphaVolume = volumes[1];
    result.nFailed = exchange.total(result.nFailed);
}

} // namespace

ExtractedSurface extractSurface(
    const Reconstruction& method, const ReconstructionOptions& options,
    const std::shared_ptr<const FlowSnapshot>& snapshot, const Run& run
)
{
    const ReconstructionMethod& properties = reconstructionMethod(options.method);
    ExtractedSurface surface;
    surface.piece.sharesPoints = properties.sharesPoints;
    if (properties.readsFiles)
    {
        surface.result = placedSurface(*snapshot, run.ranks);
        surface.piece =
            distributed(surface.result.mesh, snapshot->complex->whole(), run.ranks);
        surface.spread = scalarField(surface.piece.mesh.points.size(), 0);
        surface.result.mesh = InterfaceMesh();
    }
    else
    {
        List<NamedPoint> shared;
        runOnAllRanks(
            run.ranks, [&] { shared = extractOwn(method, *snapshot, surface); }
        );
        agreeOnPoints(surface.piece, surface.spread, shared, run.ranks);
    }
    sumVolumes(surface.result, run.ranks);
    if (options.volumeFit != VolumeFit::none)
    {
        surface.result.volumeFit = fitVolumes(surface.piece, snapshot, run);
        surface.result.volume.add(surface.result.volumeFit->volume);
    }
    return surface;
}

} // namespace Foam::stability
