// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/parametrization/Parametrization.H"

#include "core/parametrization/ChartPacking.H"
#include "core/parametrization/Patches.H"
#include "core/parametrization/RibbonChart.H"
#include "core/ranks/ExactSum.H"

#include <algorithm>

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

// A chart as it is sent to the master, and the place that the master returns.
struct ChartBox
{
    TriangleKey lowest;
    vector2D size; // [m]
};

struct ChartPlace
{
    label number;
    vector2D corner;
};

// The scales of both parameters, units per metre: one in two dimensions for the length
// and one for the way across, else the same; zero if there is nothing to scale.
vector2D packedBoxes(
    const List<vector2D>& sizes, const std::optional<PlaneSection>& section,
    List<vector2D>& corners
)
{
    if (!section)
    {
        const BoxPacking packing(packBoxes(sizes));
        corners = packing.corners;
        return packing.placed ? vector2D(packing.scale, packing.scale) : vector2D(0, 0);
    }
    scalarField lengths(sizes.size());
    forAll(sizes, i)
    {
        lengths[i] = sizes[i].x();
    }
    const RowPacking packing(packRows(lengths));
    corners = packing.corners;
    return vector2D(packing.scale, packing.height / section->thickness);
}

// Places the charts of all ranks, on the master; returns their common scales.
vector2D placeAll(
    const std::vector<List<ChartBox>>& boxes,
    const std::optional<PlaneSection>& section,
    std::vector<DynamicList<ChartPlace>>& places
)
{
    std::vector<labelPair> order; // the rank, the chart there
    for (std::size_t ranki = 0; ranki < boxes.size(); ++ranki)
    {
        forAll(boxes[ranki], i)
        {
            order.push_back(labelPair(ranki, i));
        }
        places[ranki].setSize(boxes[ranki].size());
    }
    const auto boxAt = [&](const labelPair& at) -> const ChartBox&
    { return boxes[at.first()][at.second()]; };
    std::stable_sort(
        order.begin(), order.end(),
        [&](const labelPair& a, const labelPair& b)
        { return boxAt(a).lowest < boxAt(b).lowest; }
    );
    List<vector2D> sizes(order.size());
    forAll(sizes, i)
    {
        sizes[i] = boxAt(order[i]).size;
    }
    List<vector2D> corners;
    const vector2D scales = packedBoxes(sizes, section, corners);
    forAll(sizes, i)
    {
        places[order[i].first()][order[i].second()] = {i, corners[i]};
    }
    return scales;
}

// Moves the charts to their places among those of all ranks. Returns the scale of the
// first parameter, 0 if there is nothing to scale.
scalar packFlats(
    const SurfacePiece& interface, const List<Patch>& patches, List<FlatPatch>& flats,
    const std::optional<PlaneSection>& section, const Exchange& exchange
)
{
    DynamicList<ChartBox> mine;
    forAll(flats, i)
    {
        mine.append(ChartBox{
            interface.keys[patches[i].lowestTriangle], boxSize(flats[i].parameters)});
    }
    const std::vector<List<ChartBox>> boxes(exchange.listsToMaster(mine));
    std::vector<DynamicList<ChartPlace>> places(exchange.nRanks());
    Packet packet;
    runOnAllRanks(
        exchange,
        [&] {
            packet.put(
                exchange.isMaster() ? placeAll(boxes, section, places) : vector2D(0, 0)
            );
        }
    );
    const List<ChartPlace> here(exchange.exchangeLists(places)[0]);
    const vector2D scales = exchange.fromMaster(packet).get<vector2D>();
    forAll(flats, i)
    {
        flats[i].number = here[i].number;
        if (scales.x() > 0)
        {
            flats[i].parameters = moved(flats[i].parameters, here[i].corner, scales);
        }
    }
    return scales.x();
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
