// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

#include "core/tracking/ParameterSheets.H"

#include "core/tracking/SeamLines.H"

#include <algorithm>
#include <vector>

namespace Foam::stability
{

namespace
{

scalar signedArea(const vector2D& a, const vector2D& b, const vector2D& c)
{
    return 0.5 * (b - a).perp(c - a);
}

label cornerOf(const triFace& t, label pointi)
{
    return t[0] == pointi ? 0 : t[1] == pointi ? 1 : 2;
}

// Marks that are forgotten at once: the visited triangles of one walk.
class Marks
{
public:
    void start(label n)
    {
        if (label(marks_.size()) < n)
        {
            marks_.resize(n, 0);
        }
        ++present_;
    }

    // True when the mark is new.
    bool set(label i)
    {
        const bool isNew = marks_[i] != present_;
        marks_[i] = present_;
        return isNew;
    }

private:
    std::vector<std::uint64_t> marks_;
    std::uint64_t present_ = 0;
};

} // namespace

ParameterSheets::ParameterSheets(const MatchTarget& target)
    : target_(target), mesh_(target.mesh()),
      pointTriangles_(trianglesAtPoints(mesh_.points.size(), mesh_.triangles)),
      passages_(findPassages()), seams_(findSeams()),
      seamLocator_(mesh_.points, seams_, 0.5 * mesh_.meanCellSize()),
      nodes_(findNodes()), scale_(meanScale()),
      interpolation_(
          mesh_, mesh_.parameters,
          [&](label trianglei, label k) { return mesh_.corners[trianglei][k]; }
      )
{
}

// p at corner k of the triangle and at the same point in its neighbour.
ParameterSheets::Across
ParameterSheets::across(label trianglei, label k, label neighbouri) const
{
    const label pointi = mesh_.triangles[trianglei][k];
    const label i = mesh_.corners[trianglei][k];
    const label j =
        mesh_.corners[neighbouri][cornerOf(mesh_.triangles[neighbouri], pointi)];
    if (i < 0 || j < 0)
    {
        return Across::none;
    }
    return i == j || mesh_.parameters[i] == mesh_.parameters[j] ? Across::same
                                                                : Across::differs;
}

List<FixedList<label, 3>> ParameterSheets::findPassages() const
{
    List<FixedList<label, 3>> passages(mesh_.triangles.size(), FixedList<label, 3>(-1));
    forAll(passages, trianglei)
    {
        for (label k = 0; k < 3; ++k)
        {
            const label other = target_.topology().neighbour(trianglei, k);
            if (other >= 0 && across(trianglei, k, other) == Across::same
                && across(trianglei, (k + 1) % 3, other) == Across::same)
            {
                passages[trianglei][k] = other;
            }
        }
    }
    return passages;
}

List<triFace> ParameterSheets::findSeams() const
{
    DynamicList<triFace> seams;
    for (const SurfaceEdge& edge : target_.topology().edges())
    {
        const label trianglei = edge.triangles[0], other = edge.triangles[1];
        if (edge.nTriangles != 2 || trianglei == other)
        {
            continue;
        }
        const triFace& t = mesh_.triangles[trianglei];
        if (across(trianglei, cornerOf(t, edge.a), other) == Across::differs
            || across(trianglei, cornerOf(t, edge.b), other) == Across::differs)
        {
            seams.append(triFace(edge.a, edge.b, edge.b));
        }
    }
    return List<triFace>(std::move(seams));
}

List<SeamNode> ParameterSheets::findNodes() const
{
    constexpr scalar straight = 0.05; // of a cell
    const SeamCorners corners =
        seamCorners(mesh_.points, seams_, straight * mesh_.cellSizes);
    std::vector<char> atBoundary(mesh_.points.size(), 0);
    for (const SurfaceEdge& edge : target_.topology().edges())
    {
        if (edge.nTriangles == 1)
        {
            atBoundary[edge.a] = atBoundary[edge.b] = 1;
        }
    }

    DynamicList<SeamNode> nodes;
    forAll(corners.points, i)
    {
        const label pointi = corners.points[i];
        if (!atBoundary[pointi])
        {
            SeamNode node{
                mesh_.points[pointi], Zero, mesh_.cellSizes[pointi], corners.isNode[i]};
            for (const label trianglei : pointTriangles_[pointi])
            {
                node.normal += mesh_.areaVector(trianglei);
            }
            nodes.append(node);
        }
    }
    return List<SeamNode>(std::move(nodes));
}

scalar ParameterSheets::meanScale() const
{
    scalar parameterArea = 0, area = 0;
    forAll(mesh_.triangles, trianglei)
    {
        if (mesh_.parametrized(trianglei))
        {
            parameterArea += mag(orientation(trianglei));
            area += mag(mesh_.areaVector(trianglei));
        }
    }
    return area > 0 ? std::sqrt(parameterArea / area) : 0;
}

scalar ParameterSheets::orientation(label trianglei) const
{
    const CornerIndices& c = mesh_.corners[trianglei];
    const List<vector2D>& p = mesh_.parameters;
    return mesh_.parametrized(trianglei) ? signedArea(p[c[0]], p[c[1]], p[c[2]]) : 0;
}

vector2D ParameterSheets::limited(
    const vector2D& p, const vector2D& known, scalar distance
) const
{
    constexpr scalar stretch = 4;
    const scalar reach = stretch * scale_ * distance;
    const scalar length = mag(p - known);
    vector2D result = length > reach ? known + reach / length * (p - known) : p;
    for (direction d = 0; d < 2; ++d)
    {
        if (known[d] >= 0 && known[d] <= 1)
        {
            result[d] = std::min(std::max(result[d], scalar(0)), scalar(1));
        }
    }
    return result;
}

vector2D
ParameterSheets::interpolate(label trianglei, const FixedList<scalar, 3>& weights) const
{
    return interpolation_.at(trianglei, mesh_.corners[trianglei], weights);
}

SheetParameter ParameterSheets::at(const SurfacePoint& x) const
{
    if (x.triangle < 0)
    {
        return SheetParameter();
    }
    if (mesh_.parametrized(x.triangle))
    {
        return {x.triangle, interpolate(x.triangle, x.weights)};
    }
    const label corner =
        std::max_element(x.weights.begin(), x.weights.end()) - x.weights.begin();
    return mesh_.corners[x.triangle][corner] < 0 ? SheetParameter()
                                                 : extrapolate(x, corner);
}

SheetParameter ParameterSheets::extrapolate(const SurfacePoint& x, label corner) const
{
    const label pointi = mesh_.triangles[x.triangle][corner];
    const label parameteri = mesh_.corners[x.triangle][corner];
    SurfacePoint nearest;
    for (const label trianglei : pointTriangles_[pointi])
    {
        const label k = cornerOf(mesh_.triangles[trianglei], pointi);
        if (mesh_.parametrized(trianglei) && mesh_.corners[trianglei][k] == parameteri)
        {
            const SurfacePoint foot =
                target_.locator().closestOn(trianglei, x.position);
            nearest = foot.distance < nearest.distance ? foot : nearest;
        }
    }
    if (nearest.triangle < 0)
    {
        return {x.triangle, mesh_.parameters[parameteri]};
    }
    const triFace& t = mesh_.triangles[nearest.triangle];
    const FixedList<scalar, 3> weights = planeWeights(
        x.position, mesh_.points[t[0]], mesh_.points[t[1]], mesh_.points[t[2]]
    );

    return {
        nearest.triangle,
        limited(
            interpolate(nearest.triangle, weights), mesh_.parameters[parameteri],
            mag(x.position - mesh_.points[pointi])
        )};
}

bool ParameterSheets::seamWithin(const point& x, scalar radius) const
{
    return seamLocator_.closest(x, radius).triangle >= 0;
}

template<class Visit>
bool ParameterSheets::walk(
    label from, const point& centre, scalar radius, const Visit& visit
) const
{
    static thread_local Marks marks;
    static thread_local std::vector<label> queue;
    marks.start(mesh_.triangles.size());
    queue.assign(1, from);
    marks.set(from);
    for (std::size_t i = 0; i < queue.size(); ++i)
    {
        const label trianglei = queue[i];
        if (visit(trianglei))
        {
            return true;
        }
        for (const label other : passages_[trianglei])
        {
            if (other >= 0 && marks.set(other)
                && target_.locator().closestOn(other, centre).distance <= radius)
            {
                queue.push_back(other);
            }
        }
    }
    return false;
}

bool ParameterSheets::connected(
    label from, label to, const point& centre, scalar radius
) const
{
    return walk(from, centre, radius, [=](label trianglei) { return trianglei == to; });
}

SurfacePoint
ParameterSheets::closestConnected(label anchor, const point& x, scalar radius) const
{
    SurfacePoint best;
    walk(
        anchor, x, radius,
        [&](label trianglei)
        {
            const SurfacePoint foot = target_.locator().closestOn(trianglei, x);
            if (mesh_.parametrized(trianglei)
                && (foot.distance < best.distance
                    || (foot.distance == best.distance && trianglei < best.triangle)))
            {
                best = foot;
            }
            return false;
        }
    );
    return best;
}

} // namespace Foam::stability
