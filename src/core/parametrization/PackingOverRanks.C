// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/parametrization/PackingOverRanks.H"

#include "core/parametrization/ChartPacking.H"
#include "core/parametrization/RibbonChart.H"
#include "core/parametrization/SmallestBox.H"

#include <algorithm>

namespace Foam::stability
{

namespace
{

// A chart as it is sent to the master, and the place that the master returns.
struct ChartBox
{
    TriangleKey lowest;
    vector2D size;     // [m], of its smallest box
    vector2D inSquare; // [m], the same turned into its smallest square
};

struct ChartPlace
{
    label number;
    vector2D corner;
    bool inSquare; // turned so
};

List<vector2D> turnedIntoSquare(List<vector2D> chart)
{
    if (!chart.empty())
    {
        turnIntoSmallestSquare(chart);
    }
    return chart;
}

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
    label largest = 0;
    forAll(sizes, i)
    {
        sizes[i] = boxAt(order[i]).size;
        const auto area = [&](label j) { return sizes[j].x() * sizes[j].y(); };
        largest = area(i) > area(largest) ? i : largest;
    }
    List<vector2D> corners;
    vector2D scales = packedBoxes(sizes, section, corners);
    bool inSquare = false; // the largest chart
    if (!section && !sizes.empty())
    {
        sizes[largest] = boxAt(order[largest]).inSquare;
        List<vector2D> others;
        const vector2D larger = packedBoxes(sizes, section, others);
        inSquare = larger.x() > scales.x();
        scales = inSquare ? larger : scales;
        corners = inSquare ? others : corners;
    }
    forAll(sizes, i)
    {
        places[order[i].first()][order[i].second()] = {
            i, corners[i], inSquare && i == largest};
    }
    return scales;
}

} // namespace

scalar packOverRanks(
    List<PackedChart>& charts, const std::optional<PlaneSection>& section,
    const Exchange& exchange
)
{
    DynamicList<ChartBox> mine;
    for (const PackedChart& chart : charts)
    {
        mine.append(ChartBox{
            chart.lowest, boxSize(chart.parameters),
            boxSize(turnedIntoSquare(chart.parameters))});
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
    forAll(charts, i)
    {
        charts[i].number = here[i].number;
        if (here[i].inSquare)
        {
            charts[i].parameters = turnedIntoSquare(charts[i].parameters);
        }
        if (scales.x() > 0)
        {
            charts[i].parameters = moved(charts[i].parameters, here[i].corner, scales);
        }
    }
    return scales.x();
}

} // namespace Foam::stability
