// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/transfer/ParameterSheets.H"

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

// Each coordinate of p, held in [0, 1] if those from `low` to `high` lie there.
vector2D withinSquare(vector2D p, const vector2D& low, const vector2D& high)
{
    for (direction d = 0; d < 2; ++d)
    {
        if (low[d] >= 0 && high[d] <= 1)
        {
            p[d] = std::min(std::max(p[d], scalar(0)), scalar(1));
        }
    }
    return p;
}

} // namespace

ParameterSheets::ParameterSheets(const MatchTarget& target, const SeamShape& shape)
    : target_(target), mesh_(target.mesh()), shape_(shape),
      pointTriangles_(trianglesAtPoints(mesh_.points.size(), mesh_.triangles)),
      passages_(findPassages()), seams_(findSeams()),
      seamLocator_(mesh_.points, seams_, 0.5 * mesh_.meanCellSize()),
      interpolation_(
          mesh_, mesh_.parameters,
          [&](label trianglei, label k) { return mesh_.corners[trianglei][k]; }
      )
{
}

List<FixedList<label, 3>> ParameterSheets::findPassages() const
{
    List<FixedList<label, 3>> passages(mesh_.triangles.size(), FixedList<label, 3>(-1));
    forAll(passages, trianglei)
    {
        for (label k = 0; k < 3; ++k)
        {
            const label other = target_.topology().neighbour(trianglei, k);
            if (other >= 0 && across(mesh_, trianglei, k, other) == Across::same
                && across(mesh_, trianglei, (k + 1) % 3, other) == Across::same)
            {
                passages[trianglei][k] = other;
            }
        }
    }
    return passages;
}

List<triFace> ParameterSheets::findSeams() const
{
    const labelList edges(seamEdges(mesh_, target_.topology()));
    List<triFace> seams(edges.size());
    forAll(edges, i)
    {
        const SurfaceEdge& edge = target_.topology().edges()[edges[i]];
        seams[i] = triFace(edge.a, edge.b, edge.b);
    }
    return seams;
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
    return withinSquare(shortened(p, known, distance, shape_.scale), known, known);
}

vector2D
ParameterSheets::interpolate(label trianglei, const FixedList<scalar, 3>& weights) const
{
    const CornerIndices& c = mesh_.corners[trianglei];
    const vector2D &a = mesh_.parameters[c[0]], &b = mesh_.parameters[c[1]],
                   &last = mesh_.parameters[c[2]];
    // Of second order, it reaches beyond its corners a little.
    return withinSquare(
        interpolation_.at(trianglei, c, weights), min(min(a, b), last),
        max(max(a, b), last)
    );
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
