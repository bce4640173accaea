// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/transfer/SeamCutting.H"

#include <algorithm>

namespace Foam::stability
{

SeamCutting::SeamCutting(
    InterfaceMesh& mesh, List<Match>& matches, const MatchTarget& target,
    const CarriedOrigins& origins, const TransferSurroundings& around,
    const TransferOptions& options
)
    : mesh_(mesh), matches_(matches), origins_(origins), around_(around),
      options_(options), sheets_(target, around.seams),
      bisection_(target, sheets_, options),
      cuts_(mesh, matches, origins.settled(sheets_.nodes()), bisection_, options)
{
}

TransferResult SeamCutting::run()
{
    countTriangles();
    cuts_.separate();
    giveOwnParameters();
    placeCuts();
    splitTriangles();
    writeBack();
    return result_;
}

const SheetPoint& SeamCutting::seen(label vertexi) const
{
    return cuts_.vertices()[vertexi].seen;
}

void SeamCutting::countTriangles()
{
    forAll(mesh_.triangles, trianglei)
    {
        if (!around_.own[trianglei])
        {
            continue;
        }
        const triFace& t = mesh_.triangles[trianglei];
        bool complete = true, crossed = false, merged = false;
        for (label k = 0; k < 3; ++k)
        {
            complete = complete && seen(t[k]).sheet.valid();
            crossed = crossed || cuts_.isCrossed(t[k], t[(k + 1) % 3]);
            merged = merged || matches_[t[k]].nPreimages > 1;
        }
        result_.nCrossing += complete && crossed;
        result_.nMerged += merged;
    }
}

void SeamCutting::giveOwnParameters()
{
    for (const SeamVertex& v : cuts_.vertices())
    {
        ownParameters_.push_back(InterfaceMesh::noParameter);
        if (v.seen.sheet.valid())
        {
            ownParameters_.back() = parameters_.size();
            parameters_.push_back(v.seen.sheet.p);
        }
    }
}

// Points that cuts add have no p of their own, only one on each side.
label SeamCutting::ownParameter(label vertexi) const
{
    return vertexi < label(ownParameters_.size()) ? ownParameters_[vertexi]
                                                  : InterfaceMesh::noParameter;
}

// One index for all that agree at a vertex: a seam of the new mesh is exactly where
// the indices on both sides of an edge differ.
label SeamCutting::parameterIndex(
    label vertexi, const vector2D& p, const SheetPoint& side
)
{
    constexpr scalar same = 1e-3; // of what counts as a jump
    const scalar tolerance = same * bisection_.smallestJump(seen(vertexi).cellSize);
    const label own = ownParameter(vertexi);
    if (own >= 0 && mag(parameters_[own] - p) <= tolerance)
    {
        return own;
    }
    std::vector<label>& others = otherParameters_[vertexi];
    for (const label i : others)
    {
        if (mag(parameters_[i] - p) <= tolerance)
        {
            return i;
        }
    }
    parameters_.push_back(p);
    others.push_back(parameters_.size() - 1);
    sides_[others.back()] = side;
    return others.back();
}

void SeamCutting::placeCuts()
{
    for (const auto& [edge, crossed] : cuts_.edges())
    {
        const SeamEvent& event = crossed.events.front();
        const scalar share =
            origins_.seamShare(seen(edge.first), seen(edge.second), event, bisection_);
        Cut& cut = placed_[edge];
        if (share < options_.snap)
        {
            cut.point = edge.first;
        }
        else if (share > 1 - options_.snap)
        {
            cut.point = edge.second;
        }
        else
        {
            cut.point = cuts_.addVertex(
                bisection_.between(seen(edge.first), seen(edge.second), share), edge,
                share, crossed.boundary
            );
        }
        const point x = seen(cut.point).x;
        cut.lower = parameterIndex(
            cut.point, bisection_.parameterOnSide(x, event.before), event.before
        );
        cut.higher = parameterIndex(
            cut.point, bisection_.parameterOnSide(x, event.after), event.after
        );
    }
}

void SeamCutting::splitTriangles()
{
    triangles_ = cuts_.triangles();
    parents_ = cuts_.parents();
    corners_.resize(triangles_.size());
    const label nUncut = triangles_.size();
    for (label i = 0; i < nUncut; ++i)
    {
        const triFace t = triangles_[i];
        bool isCut = false;
        FixedList<EdgeCut, 3> cuts;
        for (label k = 0; k < 3; ++k)
        {
            const label a = t[k], b = t[(k + 1) % 3];
            corners_[i][k] = ownParameter(a);
            if (cuts_.isCrossed(a, b))
            {
                const Cut& cut = placed_.at(CrossedEdges::edgeOf(a, b));
                cuts[k] = a < b ? EdgeCut{cut.point, cut.lower, cut.higher}
                                : EdgeCut{cut.point, cut.higher, cut.lower};
                isCut = true;
            }
        }
        if (isCut)
        {
            endAtCorner(t, cuts);
            split(i, cuts);
        }
    }
}

// The only cut of a triangle may lie on an edge to the very point where the seam ends:
// it runs there along the edge, and the triangle is on one side.
void SeamCutting::endAtCorner(const triFace& t, FixedList<EdgeCut, 3>& cuts) const
{
    label nCuts = 0, k = 0;
    for (label i = 0; i < 3; ++i)
    {
        nCuts += cuts[i].exists();
        k = cuts[i].exists() ? i : k;
    }
    if (nCuts == 1 && cuts_.isAtEnd(t[(k + 1) % 3]))
    {
        cuts[k].after = cuts[k].before;
    }
    else if (nCuts == 1 && cuts_.isAtEnd(t[k]))
    {
        cuts[k].before = cuts[k].after;
    }
}

void SeamCutting::replace(label trianglei, const std::vector<CutTriangle>& parts)
{
    for (std::size_t j = 0; j < parts.size(); ++j)
    {
        if (j == 0)
        {
            triangles_[trianglei] = parts[j].points;
            corners_[trianglei] = parts[j].corners;
        }
        else
        {
            triangles_.push_back(parts[j].points);
            corners_.push_back(parts[j].corners);
            parents_.push_back(parents_[trianglei]);
        }
    }
}

void SeamCutting::split(label trianglei, const FixedList<EdgeCut, 3>& cuts)
{
    const triFace t = triangles_[trianglei];
    const label middle = middleCorner(t, cuts);
    const auto position = [&](label vertexi) -> const point&
    { return seen(vertexi).x; };
    std::vector<CutTriangle> parts =
        retriangulate(t, corners_[trianglei], cuts, middle, position);
    std::map<label, label> extrapolated;
    for (CutTriangle& part : parts)
    {
        const label c = part.extrapolated, a = (c + 1) % 3, b = (c + 2) % 3;
        if (c >= 0 && !extrapolated.count(part.points[c]))
        {
            const point &xa = position(part.points[a]), &xc = position(part.points[c]);
            const vector2D pa = parameters_[part.corners[a]];
            const vector2D similar = similarCorner(
                xa, position(part.points[b]), xc, pa, parameters_[part.corners[b]],
                sheets_.orientation(seen(t[middle]).sheet.anchor)
            );
            const vector2D p = sheets_.limited(similar, pa, mag(xc - xa));
            extrapolated[part.points[c]] =
                parameterIndex(part.points[c], p, seen(t[middle]));
        }
        if (c >= 0)
        {
            part.corners[c] = extrapolated[part.points[c]];
        }
    }
    replace(trianglei, parts);
}

// The corner to whose sheet the triangle in the middle of three cuts belongs: the sheet
// of its centre, if the two of its points that lie on that sheet are far enough apart
// to extrapolate p to the third.
label SeamCutting::middleCorner(const triFace& t, const FixedList<EdgeCut, 3>& cuts)
    const
{
    if (!cuts[0].exists() || !cuts[1].exists() || !cuts[2].exists())
    {
        return 0;
    }
    FixedList<scalar, 3> known; // length of the side that corner k knows p of
    label longest = 0;
    for (label k = 0; k < 3; ++k)
    {
        known[k] = mag(seen(cuts[k].point).x - seen(cuts[(k + 2) % 3].point).x);
        longest = known[k] > known[longest] ? k : longest;
    }
    const point &a = seen(cuts[0].point).x, &b = seen(cuts[1].point).x,
                &c = seen(cuts[2].point).x;
    const vector normal = (b - a) ^ (c - a);
    const SheetPoint centre = bisection_.locate(
        (a + b + c) / 3, normal / (mag(normal) + VSMALL), seen(t[0]).cellSize
    );
    constexpr scalar enough = 0.5;
    for (label k = 0; k < 3 && centre.sheet.valid(); ++k)
    {
        if (known[k] > enough * known[longest] && seen(t[k]).sheet.valid()
            && bisection_.joined(seen(t[k]), centre, 0))
        {
            return k;
        }
    }
    return longest;
}

void SeamCutting::carryOrigins()
{
    labelList anchors(mesh_.points.size());
    forAll(anchors, pointi)
    {
        anchors[pointi] = seen(pointi).sheet.anchor;
    }
    origins_.give(mesh_, matches_, anchors, sides_, bisection_);
}

void SeamCutting::countParts()
{
    std::vector<label> nParts(mesh_.triangles.size(), 0);
    for (const label parent : parents_)
    {
        ++nParts[parent];
    }
    for (std::size_t i = 0; i < nParts.size(); ++i)
    {
        result_.nSplit += around_.own[i] && nParts[i] > 1;
    }
    result_.nUnresolved = cuts_.nUnresolved(around_.own);
    result_.parents = UList<label>(parents_.data(), label(parents_.size()));
}

void SeamCutting::writeBack()
{
    countParts();
    const label nOldPoints = mesh_.points.size(), nPoints = cuts_.vertices().size();
    mesh_.points.setSize(nPoints);
    mesh_.cells.setSize(nPoints);
    mesh_.boundaryFaces.setSize(nPoints);
    mesh_.cellSizes.setSize(nPoints);
    matches_.setSize(nPoints);
    for (label i = nOldPoints; i < nPoints; ++i)
    {
        mesh_.points[i] = seen(i).x;
        mesh_.cells[i] = cuts_.vertices()[i].cell;
        mesh_.boundaryFaces[i] = cuts_.vertices()[i].boundaryFace;
        mesh_.cellSizes[i] = seen(i).cellSize;
        matches_[i] = seen(i).match;
    }

    const label nTriangles = triangles_.size();
    mesh_.triangles.setSize(nTriangles);
    mesh_.materials.setSize(nTriangles);
    mesh_.corners.setSize(nTriangles);
    for (label i = 0; i < nTriangles; ++i)
    {
        mesh_.triangles[i] = triangles_[i];
        mesh_.materials[i] = mesh_.materials[parents_[i]];
        mesh_.corners[i] = corners_[i];
    }
    mesh_.parameters.setSize(parameters_.size());
    std::copy(parameters_.begin(), parameters_.end(), mesh_.parameters.begin());
}

} // namespace Foam::stability
