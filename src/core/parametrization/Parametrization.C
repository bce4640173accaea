// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

#include "core/parametrization/Parametrization.H"

#include "core/parametrization/Chart.H"
#include "core/parametrization/Patches.H"
#include "core/parametrization/Remeshing.H"

namespace Foam::stability
{

namespace
{

// A component of the result, before all are put together.
struct Piece
{
    RemeshingResult copy;
    Chart chart;
};

scalar meanCellSize(const InterfaceMesh& mesh, const Patch& patch)
{
    scalar sum = 0;
    for (const label pointi : patch.points)
    {
        sum += mesh.cellSizes[pointi];
    }
    return sum / patch.points.size();
}

void sizeLists(
    InterfaceMesh& surface, label nPoints, label nTriangles, label nParameters
)
{
    surface.points.setSize(nPoints);
    surface.cells.setSize(nPoints);
    surface.boundaryFaces.setSize(nPoints, -1);
    surface.cellSizes.setSize(nPoints);
    surface.triangles.setSize(nTriangles);
    surface.materials.setSize(nTriangles);
    surface.corners.setSize(nTriangles, CornerIndices(InterfaceMesh::noParameter));
    surface.parameters.setSize(nParameters);
}

// What the points of a copy have in common with the interface near them.
void addPoints(
    const InterfaceMesh& mesh, const Patch& patch, const RemeshingResult& copy,
    label start, InterfaceMesh& surface
)
{
    forAll(copy.surface.points, i)
    {
        const label original = patch.points[copy.nearest[i]];
        surface.points[start + i] = copy.surface.points[i];
        surface.cells[start + i] = mesh.cells[original];
        surface.cellSizes[start + i] = mesh.cellSizes[original];
    }
    for (const labelList& loop :
         boundaryLoops(copy.surface.points.size(), copy.surface.triangles))
    {
        for (const label i : loop)
        {
            surface.boundaryFaces[start + i] =
                mesh.boundaryFaces[patch.points[copy.nearest[i]]];
        }
    }
}

void addTriangles(
    const Patch& patch, const Piece& piece, label start, label startPoint,
    label startParameter, InterfaceMesh& surface
)
{
    forAll(piece.copy.surface.triangles, i)
    {
        for (label k = 0; k < 3; ++k)
        {
            surface.triangles[start + i][k] =
                startPoint + piece.copy.surface.triangles[i][k];
            if (!piece.chart.parameters.empty())
            {
                surface.corners[start + i][k] =
                    startParameter + piece.chart.corners[i][k];
            }
        }
        surface.materials[start + i] = patch.materials;
    }
}

InterfaceMesh join(
    const InterfaceMesh& mesh, const List<Patch>& patches, const List<Piece>& pieces,
    const List<List<vector2D>>& charts
)
{
    label nPoints = 0, nTriangles = 0, nParameters = 0;
    for (const Piece& piece : pieces)
    {
        nPoints += piece.copy.surface.points.size();
        nTriangles += piece.copy.surface.triangles.size();
        nParameters += piece.chart.parameters.size();
    }
    InterfaceMesh surface;
    sizeLists(surface, nPoints, nTriangles, nParameters);

    label startPoint = 0, startTriangle = 0, startParameter = 0;
    forAll(pieces, i)
    {
        const Piece& piece = pieces[i];
        addPoints(mesh, patches[i], piece.copy, startPoint, surface);
        addTriangles(
            patches[i], piece, startTriangle, startPoint, startParameter, surface
        );
        forAll(charts[i], vertex)
        {
            surface.parameters[startParameter + vertex] = charts[i][vertex];
        }
        startPoint += piece.copy.surface.points.size();
        startTriangle += piece.copy.surface.triangles.size();
        startParameter += piece.chart.parameters.size();
    }
    surface.origins = surface.points;
    return surface;
}

} // namespace

ParametrizationResult
parametrize(const InterfaceMesh& mesh, const ParametrizationOptions& options)
{
    const std::unique_ptr<Flattening> method = Flattening::New(options.flattening);
    const List<Patch> patches = patchesOf(mesh);
    List<Piece> pieces(patches.size());
    List<List<vector2D>> charts(patches.size());
    ParametrizationResult result;
    forAll(patches, i)
    {
        Piece& piece = pieces[i];
        piece.copy = remesh(
            patches[i].surface, options.edgeLength * meanCellSize(mesh, patches[i])
        );
        piece.chart = makeChart(piece.copy.surface, *method);
        piece.copy.surface.points = piece.chart.points;
        charts[i] = piece.chart.parameters;

        result.nCharts += !piece.chart.parameters.empty();
        result.nFallbacks += piece.chart.fallback;
        result.nKept += piece.copy.kept;
        result.remeshingDistance =
            max(result.remeshingDistance, piece.copy.largestDistance);
    }
    const PackingResult packing = packCharts(charts);
    result.scale = packing.scale;
    result.surface = join(mesh, patches, pieces, packing.charts);
    return result;
}

} // namespace Foam::stability
