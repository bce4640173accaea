// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/transfer/CrossedEdges.H"

#include <algorithm>
#include <numeric>
#include <set>

namespace Foam::stability
{

CrossedEdges::CrossedEdges(
    const InterfaceMesh& mesh, const List<Match>& matches, const List<SeamNode>& nodes,
    const SeamBisection& bisection, const TransferOptions& options
)
    : bisection_(bisection), options_(options), vertices_(mesh.points.size()),
      triangles_(mesh.triangles.begin(), mesh.triangles.end()),
      parents_(mesh.triangles.size()), touched_(mesh.points.size(), 0),
      atEnd_(mesh.points.size(), 0), unresolved_(mesh.triangles.size(), 0)
{
    std::iota(parents_.begin(), parents_.end(), label(0));
    setVertices(mesh, matches);
    if (options.seamTreatment)
    {
        insertNodes(mesh, nodes);
        traceAll();
    }
}

void CrossedEdges::setVertices(const InterfaceMesh& mesh, const List<Match>& matches)
{
    const vectorField normals = mesh.pointNormals();
#pragma omp parallel for schedule(static) num_threads(options_.nThreads)
    for (label i = 0; i < mesh.points.size(); ++i)
    {
        vertices_[i].seen = {
            mesh.points[i], normals[i], mesh.cellSizes[i], matches[i],
            bisection_.parameter(matches[i])};
        vertices_[i].cell = mesh.cells[i];
        vertices_[i].boundaryFace = mesh.boundaryFaces[i];
    }
}

void CrossedEdges::insertNodes(const InterfaceMesh& mesh, const List<SeamNode>& nodes)
{
    if (nodes.empty() || mesh.empty())
    {
        return;
    }
    const SurfaceLocator locator(mesh.points, mesh.triangles, mesh.cellSizes[0]);
    std::map<label, labelList> parts;
    for (const SeamNode& node : nodes)
    {
        const auto facing = [&](label trianglei) {
            return !bisection_.normalGate()
                   || (mesh.areaVector(trianglei) & node.normal) > 0;
        };
        const SurfacePoint foot =
            locator.closest(node.x, bisection_.epsilon(node.cellSize), facing);
        if (foot.triangle >= 0)
        {
            labelList& own = parts[foot.triangle];
            if (own.empty())
            {
                own.append(foot.triangle);
            }
            insertNode(foot, node.isEnd, own);
        }
    }
}

// `parts`: what earlier nodes have left of the triangle.
void CrossedEdges::insertNode(const SurfacePoint& foot, bool isEnd, labelList& parts)
{
    label trianglei = -1;
    SurfacePoint at;
    for (const label i : parts)
    {
        const triFace& t = triangles_[i];
        const SurfacePoint p = closestPoint(
            foot.position, vertices_[t[0]].seen.x, vertices_[t[1]].seen.x,
            vertices_[t[2]].seen.x
        );
        if (p.distance < at.distance)
        {
            at = p;
            trianglei = i;
        }
    }
    const triFace t = triangles_[trianglei];
    const label nearest =
        std::max_element(at.weights.begin(), at.weights.end()) - at.weights.begin();
    // A turn is left out where a vertex of M, or a cut of its edge, does as well; an
    // end only where a vertex is at the place, or where the triangle has had its share.
    const scalar least = *std::min_element(at.weights.begin(), at.weights.end());
    const SheetPoint& corner = vertices_[t[nearest]].seen;
    constexpr scalar roomForTurn = 0.03, roomForEnd = 0.02;
    constexpr label mostParts = 5;
    const scalar room = isEnd ? roomForEnd : options_.narrowestSheet;
    const bool taken = at.weights[nearest] > 1 - options_.snap
                       || mag(corner.x - at.position) < room * corner.cellSize;
    if (taken || (!isEnd && least < roomForTurn) || parts.size() >= mostParts)
    {
        atEnd_[t[nearest]] = atEnd_[t[nearest]] || (isEnd && taken);
        return;
    }
    const label vertexi = insertVertex(at, t, t[nearest]);
    atEnd_[vertexi] = isEnd;
    triangles_[trianglei] = triFace(t[0], t[1], vertexi);
    for (label k = 1; k < 3; ++k)
    {
        parts.append(triangles_.size());
        triangles_.push_back(triFace(t[k], t[(k + 1) % 3], vertexi));
        parents_.push_back(parents_[trianglei]);
    }
}

// The vertex lies off the edges, but by less than Algorithm 1 resolves.
label CrossedEdges::insertVertex(
    const SurfacePoint& at, const triFace& t, label nearest
)
{
    const scalar margin = 0.25 * options_.delta;
    scalar sum = 0;
    point x(Zero);
    vector normal(Zero);
    for (label k = 0; k < 3; ++k)
    {
        const SheetPoint& end = vertices_[t[k]].seen;
        const scalar weight = std::max(at.weights[k], margin);
        sum += weight;
        x += weight * end.x;
        normal += weight * end.normal;
    }
    x /= sum;
    normal /= mag(normal) + VSMALL;
    return addVertex(
        bisection_.locate(x, normal, vertices_[nearest].seen.cellSize), nearest
    );
}

void CrossedEdges::traceAll()
{
    const UList<triFace> triangles(triangles_.data(), label(triangles_.size()));
    const SurfaceTopology topology(label(vertices_.size()), triangles);
    std::vector<Edge> edges;
    std::vector<char> boundary;
    for (const SurfaceEdge& edge : topology.edges())
    {
        edges.push_back({edge.a, edge.b});
        boundary.push_back(edge.nTriangles == 1);
    }
    trace(edges, boundary);
}

void CrossedEdges::trace(
    const std::vector<Edge>& edges, const std::vector<char>& boundary
)
{
    std::vector<std::vector<SeamEvent>> events(edges.size());
#pragma omp parallel for schedule(dynamic, 64) num_threads(options_.nThreads)
    for (std::size_t i = 0; i < edges.size(); ++i)
    {
        events[i] = bisection_.cuts(
            vertices_[edges[i].first].seen, vertices_[edges[i].second].seen
        );
    }
    for (std::size_t i = 0; i < edges.size(); ++i)
    {
        if (!events[i].empty())
        {
            touched_[edges[i].first] = touched_[edges[i].second] = 1;
            edges_[edges[i]] = {std::move(events[i]), bool(boundary[i])};
        }
    }
}

void CrossedEdges::separate()
{
    for (label depth = 0;; ++depth)
    {
        std::map<Edge, CrossedEdge> busy;
        for (const auto& [edge, crossed] : edges_)
        {
            if (crossed.events.size() > 1 || crossed.events.front().gap)
            {
                busy.insert({edge, crossed});
            }
        }
        if (busy.empty())
        {
            return;
        }
        std::map<Edge, label> newPoints;
        for (auto& [edge, crossed] : busy)
        {
            if (depth == options_.maxDepth)
            {
                giveUp(edge, crossed);
            }
            else
            {
                newPoints[edge] = divideEdge(edge, crossed);
            }
        }
        divideTriangles(newPoints);
    }
}

// All seams on the edge become one cut.
void CrossedEdges::giveUp(const Edge& edge, CrossedEdge& crossed)
{
    crossed.makeOne();
    if (crossed.events.empty())
    {
        edges_.erase(edge);
    }
    else
    {
        edges_[edge] = crossed;
    }
    for (std::size_t i = 0; i < triangles_.size(); ++i)
    {
        const triFace& t = triangles_[i];
        for (label k = 0; k < 3; ++k)
        {
            if (edgeOf(t[k], t[(k + 1) % 3]) == edge)
            {
                unresolved_[parents_[i]] = 1;
            }
        }
    }
}

// A new vertex between two cuts (a second seam, 7.2 "both"), or where there is no p
// (then the triangles around it count as attached).
label CrossedEdges::divideEdge(const Edge& edge, const CrossedEdge& crossed)
{
    const std::vector<SeamEvent>& events = crossed.events;
    std::vector<std::size_t> gaps;
    for (std::size_t i = 0; i < events.size(); ++i)
    {
        if (events[i].gap)
        {
            gaps.push_back(i);
        }
    }
    const bool atGap = !gaps.empty();
    const std::size_t left = atGap ? gaps[gaps.size() / 2] : events.size() / 2;
    const std::size_t right = atGap ? left + 1 : left;
    const scalar at =
        atGap ? events[left].at : 0.5 * (events[left - 1].at + events[left].at);
    const SheetPoint v =
        atGap ? events[left].before
              : bisection_.between(
                  vertices_[edge.first].seen, vertices_[edge.second].seen, at
              );
    const label vertexi = addVertex(v, edge, at, crossed.boundary);

    CrossedEdge before{{}, crossed.boundary}, after{{}, crossed.boundary};
    for (std::size_t i = 0; i < left; ++i)
    {
        before.events.push_back(events[i]);
        before.events.back().at /= at;
    }
    // The new vertex has the highest number: its edges start at the old ones.
    for (std::size_t i = events.size(); i > right; --i)
    {
        SeamEvent event = events[i - 1];
        event.at = (1 - event.at) / (1 - at);
        std::swap(event.before, event.after);
        after.events.push_back(event);
    }
    edges_.erase(edge);
    if (!before.events.empty())
    {
        edges_[{edge.first, vertexi}] = before;
    }
    if (!after.events.empty())
    {
        edges_[{edge.second, vertexi}] = after;
    }
    touched_[vertexi] = 1;
    return vertexi;
}

void CrossedEdges::divideTriangles(const std::map<Edge, label>& newPoints)
{
    const auto position = [&](label i) -> const point& { return vertices_[i].seen.x; };
    std::set<Edge> newEdges;
    const std::size_t nOld = triangles_.size();
    for (std::size_t i = 0; i < nOld; ++i)
    {
        const triFace t = triangles_[i];
        FixedList<label, 3> points(-1);
        std::set<Edge> outline;
        for (label k = 0; k < 3; ++k)
        {
            const label a = t[k], b = t[(k + 1) % 3];
            const auto found = touched_[a] && touched_[b] ? newPoints.find(edgeOf(a, b))
                                                          : newPoints.end();
            if (found != newPoints.end())
            {
                points[k] = found->second;
                outline.insert({edgeOf(a, points[k]), edgeOf(b, points[k])});
            }
            outline.insert(edgeOf(a, b));
        }
        if (points[0] < 0 && points[1] < 0 && points[2] < 0)
        {
            continue;
        }
        const std::vector<triFace> parts = divide(t, points, position);
        triangles_[i] = parts[0];
        triangles_.insert(triangles_.end(), parts.begin() + 1, parts.end());
        parents_.insert(parents_.end(), parts.size() - 1, parents_[i]);
        for (const triFace& part : parts)
        {
            for (label k = 0; k < 3; ++k)
            {
                const Edge edge = edgeOf(part[k], part[(k + 1) % 3]);
                if (!outline.count(edge))
                {
                    newEdges.insert(edge);
                }
            }
        }
    }
    const std::vector<Edge> inner(newEdges.begin(), newEdges.end());
    trace(inner, std::vector<char>(inner.size(), 0));
}

label CrossedEdges::addVertex(
    const SheetPoint& v, const Edge& edge, scalar share, bool boundary
)
{
    const label nearer = share < 0.5 ? edge.first : edge.second;
    const bool onBoundary = boundary && vertices_[edge.first].boundaryFace >= 0
                            && vertices_[edge.second].boundaryFace >= 0;
    const label vertexi = addVertex(v, nearer);
    if (onBoundary)
    {
        vertices_[vertexi].boundaryFace = vertices_[nearer].boundaryFace;
    }
    return vertexi;
}

} // namespace Foam::stability
