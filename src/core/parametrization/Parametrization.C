// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/parametrization/Parametrization.H"

#include "core/parametrization/ChartPacking.H"
#include "core/parametrization/PackingOverRanks.H"
#include "core/parametrization/Patches.H"
#include "core/parametrization/RibbonChart.H"
#include "core/ranks/ExactSum.H"

namespace Foam::stability
{

namespace
{

// A patch of the result, before all are put together.
struct FlatPatch
{
    RemeshingResult copy;
    Chart chart;
    List<vector2D> parameters;
    label number = 0; // in the order of all ranks' patches
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

// Copies cells, cell sizes and boundary faces from the interface to the points of a
// copy.
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
    const Patch& patch, const FlatPatch& flat, label start, label startPoint,
    label startParameter, InterfaceMesh& surface
)
{
    forAll(flat.copy.surface.triangles, i)
    {
        for (label k = 0; k < 3; ++k)
        {
            surface.triangles[start + i][k] =
                startPoint + flat.copy.surface.triangles[i][k];
            if (!flat.chart.parameters.empty())
            {
                surface.corners[start + i][k] =
                    startParameter + flat.chart.corners[i][k];
            }
        }
        surface.materials[start + i] = patch.materials;
    }
}

SurfacePiece joined(
    const InterfaceMesh& mesh, const List<Patch>& patches, const List<FlatPatch>& flats
)
{
    label nPoints = 0, nTriangles = 0, nParameters = 0;
    for (const FlatPatch& flat : flats)
    {
        nPoints += flat.copy.surface.points.size();
        nTriangles += flat.copy.surface.triangles.size();
        nParameters += flat.chart.parameters.size();
    }
    SurfacePiece result;
    result.sharesPoints = false;
    InterfaceMesh& surface = result.mesh;
    sizeLists(surface, nPoints, nTriangles, nParameters);
    result.keys.setSize(nTriangles);

    label startPoint = 0, startTriangle = 0, startParameter = 0;
    forAll(flats, i)
    {
        const FlatPatch& flat = flats[i];
        addPoints(mesh, patches[i], flat.copy, startPoint, surface);
        addTriangles(
            patches[i], flat, startTriangle, startPoint, startParameter, surface
        );
        forAll(flat.parameters, vertex)
        {
            surface.parameters[startParameter + vertex] = flat.parameters[vertex];
        }
        forAll(flat.copy.surface.triangles, j)
        {
            result.keys[startTriangle + j] = {point(flat.number, 0, 0), j};
        }
        startPoint += flat.copy.surface.points.size();
        startTriangle += flat.copy.surface.triangles.size();
        startParameter += flat.chart.parameters.size();
    }
    surface.setOrigins(surface.points);
    result.startPositions = surface.points;
    result.pointKeys.setSize(nPoints);
    forAll(result.pointKeys, i)
    {
        result.pointKeys[i].number = i; // no rank shares them
    }
    return result;
}

// In two dimensions.
FlatPatch
unrolled(const InterfaceMesh& mesh, const Patch& patch, const PlaneSection& section)
{
    constexpr scalar stripLength = 0.2; // in mean cell sizes of the patch
    FlatPatch flat;
    flat.copy =
        refinedRibbon(patch.surface, section, stripLength * meanCellSize(mesh, patch));
    flat.chart = ribbonChart(flat.copy.surface, section);
    flat.parameters = flat.chart.parameters;
    flat.chart.method = flat.parameters.empty() ? "" : "arcLength";
    flat.chart.fallback = flat.parameters.empty();
    flat.chart.failure = "it is not one curve";
    flat.chart.points = flat.copy.surface.points;
    return flat;
}

FlatPatch flattened(
    const InterfaceMesh& mesh, const Patch& patch,
    const std::vector<NamedFlattening>& methods, scalar edgeLength
)
{
    FlatPatch flat;
    flat.copy = remesh(patch.surface, edgeLength * meanCellSize(mesh, patch));
    flat.chart = makeChart(flat.copy.surface, methods);
    flat.copy.surface.points = flat.chart.points;
    flat.parameters = upright(flat.chart.parameters);
    return flat;
}

// Moves the charts to their places among those of all ranks. Returns the scale of the
// first parameter, 0 if there is nothing to scale.
scalar packFlats(
    const SurfacePiece& interface, const List<Patch>& patches, List<FlatPatch>& flats,
    const std::optional<PlaneSection>& section, const Exchange& exchange
)
{
    List<PackedChart> charts(flats.size());
    forAll(flats, i)
    {
        charts[i].lowest = interface.keys[patches[i].lowestTriangle];
        charts[i].parameters.swap(flats[i].parameters);
    }
    const scalar scale = packOverRanks(charts, section, exchange);
    forAll(flats, i)
    {
        flats[i].number = charts[i].number;
        flats[i].parameters.swap(charts[i].parameters);
    }
    return scale;
}

std::vector<ChartReport>
reportsOf(const List<Patch>& patches, const List<FlatPatch>& flats)
{
    std::vector<ChartReport> here;
    forAll(flats, i)
    {
        const FlatPatch& flat = flats[i];
        here.push_back(
            reportOf(patches[i].surface, flat.copy, flat.chart, flat.parameters)
        );
        here.back().patch = flat.number + 1;
    }
    return here;
}

} // namespace

ParametrizationResult parametrize(
    const SurfacePiece& interface, const ParametrizationOptions& options,
    const Exchange& exchange, const std::optional<PlaneSection>& section
)
{
    // An unknown method fails on all ranks, also on those without components.
    const std::vector<NamedFlattening> methods(flatteningsFor(options.flattening));
    ParametrizationResult result;
    List<Patch> patches;
    List<FlatPatch> flats;
    runOnAllRanks(
        exchange,
        [&]
        {
            patches = patchesOf(interface.mesh);
            flats.setSize(patches.size());
            forAll(patches, i)
            {
                FlatPatch& flat = flats[i];
                flat = section
                           ? unrolled(interface.mesh, patches[i], *section)
                           : flattened(
                               interface.mesh, patches[i], methods, options.edgeLength
                           );
                result.nCharts += !flat.chart.parameters.empty();
                result.nFallbacks += flat.chart.fallback;
                result.nKept += flat.copy.kept;
                result.remeshingDistance =
                    max(result.remeshingDistance, flat.copy.largestDistance);
            }
        }
    );
    result.nCharts = exchange.total(result.nCharts);
    result.nFallbacks = exchange.total(result.nFallbacks);
    result.nKept = exchange.total(result.nKept);
    result.nPatches = exchange.total(flats.size());
    result.remeshingDistance = largest(result.remeshingDistance, exchange);
    const scalar scale = packFlats(interface, patches, flats, section, exchange);
    result.scale = scale > 0 ? scale : 1;
    runOnAllRanks(
        exchange, [&] { result.surface = joined(interface.mesh, patches, flats); }
    );
    result.charts = gathered(reportsOf(patches, flats), exchange);
    return result;
}

} // namespace Foam::stability
