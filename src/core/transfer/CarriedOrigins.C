// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/transfer/CarriedOrigins.H"

namespace Foam::stability
{

CarriedOrigins::CarriedOrigins(const MatchTarget& target, const StartChart& chart)
    : target_(target), timeSurface_(target.mesh()), chart_(chart),
      interpolation_(
          timeSurface_, timeSurface_.origins,
          [&](label trianglei, label k)
          { return timeSurface_.originCorners[trianglei][k]; }
      )
{
}

point CarriedOrigins::at(const Match& match, label source) const
{
    const SurfacePoint& x = match.nearest;
    const bool elsewhere = source >= 0 && !timeSurface_.parametrized(x.triangle);
    return elsewhere ? extrapolated(source, x.position)
                     : onTriangle(x.triangle, x.weights);
}

// The origin has no seams, only mergers: there the sides of a cut have origins that are
// farther apart than interpolation brings them.
void CarriedOrigins::give(
    InterfaceMesh& mesh, const List<Match>& matches, const labelList& sources,
    const std::map<label, SheetPoint>& sides, const SeamBisection& bisection
) const
{
    constexpr scalar smallestJump = 0.5; // [cells]
    pointField origins(mesh.points);
    forAll(origins, pointi)
    {
        if (matches[pointi].stable)
        {
            origins[pointi] = at(matches[pointi], sources[pointi]);
        }
    }
    mesh.setOrigins(origins);
    DynamicList<point> elsewhere;
    std::map<label, label> indices; // per index of p that of the origin
    forAll(mesh.triangles, trianglei)
    {
        for (label k = 0; k < 3; ++k)
        {
            const auto side = sides.find(mesh.corners[trianglei][k]);
            if (side == sides.end())
            {
                continue;
            }
            const label pointi = mesh.triangles[trianglei][k];
            const auto known = indices.insert({side->first, pointi});
            if (known.second)
            {
                const point there =
                    onSide(mesh.points[pointi], side->second, bisection);
                if (mag(there - origins[pointi])
                    > smallestJump * mesh.cellSizes[pointi])
                {
                    known.first->second = origins.size() + elsewhere.size();
                    elsewhere.append(there);
                }
            }
            mesh.originCorners[trianglei][k] = known.first->second;
        }
    }
    mesh.origins.append(elsewhere);
}

point CarriedOrigins::onSide(
    const point& x, const SheetPoint& side, const SeamBisection& bisection
) const
{
    const SurfacePoint foot = bisection.footOnSide(x, side);
    return foot.triangle >= 0 ? onTriangle(foot.triangle, foot.weights)
                              : extrapolated(side.sheet.anchor, x);
}

point CarriedOrigins::onTriangle(label trianglei, const FixedList<scalar, 3>& weights)
    const
{
    return interpolation_.at(trianglei, timeSurface_.originCorners[trianglei], weights);
}

point CarriedOrigins::extrapolated(label trianglei, const point& x) const
{
    const triFace& t = timeSurface_.triangles[trianglei];
    const pointField& y = timeSurface_.points;
    const SurfacePoint foot = closestPoint(x, y[t[0]], y[t[1]], y[t[2]]);
    const point known = onTriangle(trianglei, foot.weights);
    return shortened(
        onTriangle(trianglei, planeWeights(x, y[t[0]], y[t[1]], y[t[2]])), known,
        foot.distance, 1
    );
}

// The place [m] to which T has carried this origin: on the triangle within the radius
// whose origins come closest to it.
point CarriedOrigins::placeOf(const point& origin, const point& near, scalar radius)
    const
{
    DynamicList<label> triangles;
    target_.locator().candidates(near, radius, triangles);
    SurfacePoint best;
    point place(near);
    for (const label trianglei : triangles)
    {
        const triFace& t = timeSurface_.triangles[trianglei];
        const pointField& x = timeSurface_.points;
        const SurfacePoint foot = closestPoint(
            origin, timeSurface_.origin(trianglei, 0),
            timeSurface_.origin(trianglei, 1), timeSurface_.origin(trianglei, 2)
        );
        if (foot.distance < best.distance)
        {
            best = foot;
            place = foot.weights[0] * x[t[0]] + foot.weights[1] * x[t[1]]
                    + foot.weights[2] * x[t[2]];
        }
    }
    return place;
}

List<SeamNode> CarriedOrigins::settled(const List<SeamNode>& nodes) const
{
    constexpr scalar reach = 0.3; // in cells
    List<SeamNode> result(nodes);
    for (SeamNode& node : result)
    {
        if (!node.isEnd || chart_.empty())
        {
            continue;
        }
        const scalar radius = reach * node.cellSize;
        Match match;
        match.nearest = target_.locator().closest(node.x, radius);
        const SeamNode* end =
            match.nearest.triangle >= 0
                ? chart_.seamEndNear(at(match, match.nearest.triangle), radius)
                : nullptr;
        if (end)
        {
            node.x = placeOf(end->x, node.x, 2 * radius);
        }
    }
    return result;
}

scalar CarriedOrigins::seamShare(
    const SheetPoint& a, const SheetPoint& b, const SeamEvent& event,
    const SeamBisection& bisection
) const
{
    constexpr scalar reach = 0.1;  // in cells: a seam moves by less in one transfer
    constexpr scalar delta = 1e-3; // in cells
    const scalar length = mag(b.x - a.x);
    if (chart_.empty() || event.gap || !(length > 0))
    {
        return event.at;
    }
    const auto isBefore = [&](scalar share)
    {
        const SheetPoint v = bisection.between(a, b, share);
        return v.match.stable && v.sheet.valid()
               && chart_.isNearer(
                   at(v.match, v.sheet.anchor),
                   bisection.parameterOnSide(v.x, event.before),
                   bisection.parameterOnSide(v.x, event.after)
               );
    };
    const scalar most = reach * a.cellSize / length;
    scalar low = max(event.at - most, scalar(0)),
           high = min(event.at + most, scalar(1));
    if (!isBefore(low) || isBefore(high))
    {
        return event.at;
    }
    while ((high - low) * length > delta * a.cellSize)
    {
        const scalar middle = 0.5 * (low + high);
        (isBefore(middle) ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

} // namespace Foam::stability
