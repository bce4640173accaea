// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/transfer/SeamShape.H"

#include "core/ranks/ExactSum.H"
#include "core/transfer/SeamLines.H"
#include "boundBox.H"

#include <algorithm>
#include <cmath>

namespace Foam::stability
{

Across across(const InterfaceMesh& mesh, label trianglei, label k, label neighbouri)
{
    const label pointi = mesh.triangles[trianglei][k];
    const label i = mesh.corners[trianglei][k];
    const label j =
        mesh.corners[neighbouri][cornerOf(mesh.triangles[neighbouri], pointi)];
    if (i < 0 || j < 0)
    {
        return Across::none;
    }
    return i == j || mesh.parameters[i] == mesh.parameters[j] ? Across::same
                                                              : Across::differs;
}

labelList seamEdges(const InterfaceMesh& mesh, const SurfaceTopology& topology)
{
    DynamicList<label> seams;
    forAll(topology.edges(), edgei)
    {
        const SurfaceEdge& edge = topology.edges()[edgei];
        const label trianglei = edge.triangles[0], other = edge.triangles[1];
        if (edge.nTriangles != 2 || trianglei == other)
        {
            continue;
        }
        const triFace& t = mesh.triangles[trianglei];
        if (across(mesh, trianglei, cornerOf(t, edge.a), other) == Across::differs
            || across(mesh, trianglei, cornerOf(t, edge.b), other) == Across::differs)
        {
            seams.append(edgei);
        }
    }
    return labelList(std::move(seams));
}

namespace
{

// An end of an edge of a seam, for the rank that sees all seams.
struct SeamPoint
{
    TriangleKey key; // by the first triangle of the point: its place in the order
    SeamNode node;
    bool atBoundary; // of the surface

    bool operator<(const SeamPoint& p) const { return key < p.key; }
};

// Both ends of the own edges of seams, one after the other.
class OwnSeams
{
public:
    OwnSeams(
        const SurfacePiece& piece, const SurfaceTopology& topology,
        const UList<bool>& own
    )
        : piece_(piece), atBoundary_(piece.mesh.points.size(), false),
          pointTriangles_(
              trianglesAtPoints(piece.mesh.points.size(), piece.mesh.triangles)
          )
    {
        for (const SurfaceEdge& edge : topology.edges())
        {
            if (edge.nTriangles == 1)
            {
                atBoundary_[edge.a] = atBoundary_[edge.b] = true;
            }
        }
        for (const label edgei : seamEdges(piece.mesh, topology))
        {
            const SurfaceEdge& edge = topology.edges()[edgei];
            if (own[edge.triangles[0]])
            {
                ends_.append(seamPoint(edge.a));
                ends_.append(seamPoint(edge.b));
            }
        }
    }

    const DynamicList<SeamPoint>& ends() const { return ends_; }

private:
    SeamPoint seamPoint(label pointi) const
    {
        const InterfaceMesh& mesh = piece_.mesh;
        const UList<label> triangles = pointTriangles_[pointi];
        const label corner = cornerOf(mesh.triangles[triangles[0]], pointi);
        SeamPoint p;
        p.key = piece_.keys[triangles[0]];
        p.key.place = 3 * p.key.place + corner;
        p.node.x = mesh.points[pointi];
        p.node.cellSize = mesh.cellSizes[pointi];
        for (const label trianglei : triangles)
        {
            p.node.normal += mesh.areaVector(trianglei);
        }
        p.atBoundary = atBoundary_[pointi];
        return p;
    }

    const SurfacePiece& piece_;
    List<bool> atBoundary_;
    Rows pointTriangles_;
    DynamicList<SeamPoint> ends_;
};

List<SeamNode> nodesOf(const DynamicList<SeamPoint>& ends)
{
    constexpr scalar straight = 0.05; // of a cell
    std::vector<SeamPoint> points(ends.begin(), ends.end());
    std::sort(points.begin(), points.end());
    points.erase(
        std::unique(
            points.begin(), points.end(),
            [](const SeamPoint& a, const SeamPoint& b) { return a.key == b.key; }
        ),
        points.end()
    );
    pointField x(points.size());
    scalarField tolerance(points.size());
    forAll(x, i)
    {
        x[i] = points[i].node.x;
        tolerance[i] = straight * points[i].node.cellSize;
    }
    const auto numberOf = [&](const SeamPoint& p) {
        return label(
            std::lower_bound(points.begin(), points.end(), p) - points.begin()
        );
    };
    std::vector<labelPair> edges;
    for (label i = 0; i < ends.size(); i += 2)
    {
        const label a = numberOf(ends[i]), b = numberOf(ends[i + 1]);
        edges.push_back(labelPair(std::min(a, b), std::max(a, b)));
    }
    std::sort(edges.begin(), edges.end()); // the order of a whole surface
    List<triFace> flat(edges.size());
    forAll(flat, i)
    {
        flat[i] = triFace(edges[i].first(), edges[i].second(), edges[i].second());
    }

    const SeamCorners corners = seamCorners(x, flat, tolerance);
    DynamicList<SeamNode> nodes;
    forAll(corners.points, i)
    {
        const SeamPoint& p = points[corners.points[i]];
        if (!p.atBoundary)
        {
            nodes.append(p.node);
            nodes.last().isEnd = corners.isNode[i];
        }
    }
    return List<SeamNode>(std::move(nodes));
}

scalar scaleOf(const InterfaceMesh& mesh, const UList<bool>& own, const Exchange& ranks)
{
    List<ExactSum> areas(2); // of p, and of the surface that has it
    forAll(mesh.triangles, i)
    {
        if (own[i] && mesh.parametrized(i))
        {
            const CornerIndices& c = mesh.corners[i];
            const List<vector2D>& p = mesh.parameters;
            areas[0].add(0.5 * mag((p[c[1]] - p[c[0]]).perp(p[c[2]] - p[c[0]])));
            areas[1].add(mag(mesh.areaVector(i)));
        }
    }
    sum(areas, ranks);
    const scalar area = areas[1].value();
    return area > 0 ? std::sqrt(areas[0].value() / area) : 0;
}

// To each rank those in the box of its piece.
List<SeamNode> distribute(
    const List<SeamNode>& all, const pointField& points, const Exchange& exchange
)
{
    if (exchange.nRanks() == 1)
    {
        return all;
    }
    Packet mine;
    mine.put(boundBox(points, false));
    std::vector<Packet> boxes = exchange.toMaster(std::move(mine));
    std::vector<DynamicList<SeamNode>> toRanks(exchange.nRanks());
    for (std::size_t ranki = 0; exchange.isMaster() && ranki < boxes.size(); ++ranki)
    {
        const boundBox box(boxes[ranki].get<boundBox>());
        for (const SeamNode& node : all)
        {
            if (box.contains(node.x))
            {
                toRanks[ranki].append(node);
            }
        }
    }
    return exchange.exchangeLists(toRanks)[0];
}

} // namespace

List<SeamNode> allSeamNodes(
    const SurfacePiece& piece, const SurfaceTopology& topology, const UList<bool>& own,
    const Exchange& exchange
)
{
    const DynamicList<SeamPoint> ends(
        exchange.joinedOnMaster(OwnSeams(piece, topology, own).ends())
    );
    List<SeamNode> nodes;
    runOnAllRanks(exchange, [&] { nodes = nodesOf(ends); });
    return nodes;
}

SeamShape seamShape(
    const SurfacePiece& piece, const SurfaceTopology& topology, const UList<bool>& own,
    const Exchange& exchange
)
{
    SeamShape shape;
    shape.scale = scaleOf(piece.mesh, own, exchange);
    shape.nodes = distribute(
        allSeamNodes(piece, topology, own, exchange), piece.mesh.points, exchange
    );
    return shape;
}

} // namespace Foam::stability
