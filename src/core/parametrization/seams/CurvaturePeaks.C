// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/parametrization/seams/CurvaturePeaks.H"

#include "core/surface/SurfaceTopology.H"
#include "core/surface/TaubinSmoothing.H"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace Foam::stability
{

namespace
{

constexpr label nRings = 6; // of points, the centre being one
constexpr label nPairs = 5;
constexpr scalar strong = 0.7;       // [rad]
constexpr scalar aboveOthers = 2;    // medians
constexpr scalar distanceApart = 10; // mean edges
constexpr label mostPeaks = 30;

scalar meanEdge(const pointField& points, const SurfaceTopology& topology)
{
    scalar sum = 0;
    for (const SurfaceEdge& e : topology.edges())
    {
        sum += mag(points[e.b] - points[e.a]);
    }
    return sum / max(1, topology.edges().size());
}

// Points on the boundary stay.
pointField smoothed(const PlainSurface& surface, const SurfaceTopology& topology)
{
    InterfaceMesh mesh;
    mesh.points = surface.points;
    mesh.triangles = surface.triangles;
    mesh.cellSizes.setSize(
        surface.points.size(), 2 * meanEdge(surface.points, topology)
    );
    mesh.boundaryFaces.setSize(surface.points.size(), -1);
    TaubinOptions options;
    options.pairs = nPairs;
    pointField points(surface.points);
    points += taubinDisplacements(mesh, vectorField(), options);
    return points;
}

scalar angleBetween(const vector& a, const vector& b)
{
    return std::atan2(mag(a ^ b), a & b);
}

// The points around a point, ring by ring. One object serves all.
class Rings
{
public:
    Rings(
        const pointField& points, const List<triFace>& triangles,
        const SurfaceTopology& topology
    )
        : triangles_(triangles), around_(trianglesAtPoints(points.size(), triangles)),
          missing_(points.size(), 2 * M_PI), onBoundary_(points.size(), false),
          marks_(points.size(), -1)
    {
        for (const triFace& t : triangles)
        {
            for (label k = 0; k < 3; ++k)
            {
                const point& x = points[t[k]];
                missing_[t[k]] -= angleBetween(
                    points[t[(k + 1) % 3]] - x, points[t[(k + 2) % 3]] - x
                );
            }
        }
        for (const SurfaceEdge& e : topology.edges())
        {
            if (e.nTriangles != 2)
            {
                onBoundary_[e.a] = onBoundary_[e.b] = true;
            }
        }
        forAll(onBoundary_, pointi)
        {
            onBoundary_[pointi] = onBoundary_[pointi] || around_[pointi].empty();
        }
    }

    // Zero where the disk of triangles meets the boundary, or there is none.
    scalar curvature(label centre)
    {
        scalar sum = 0, sizes = 0;
        std::vector<label> front(1, centre);
        marks_[centre] = centre;
        for (label ring = 0; ring < nRings; ++ring)
        {
            for (const label pointi : front)
            {
                if (onBoundary_[pointi])
                {
                    return 0;
                }
                sum += missing_[pointi];
            }
            sizes += ring > 0 ? mag(sum) : 0;
            front = next(centre, front);
        }
        return sizes / (nRings - 1);
    }

private:
    std::vector<label> next(label centre, const std::vector<label>& front)
    {
        std::vector<label> result;
        for (const label pointi : front)
        {
            for (const label trianglei : around_[pointi])
            {
                for (const label other : triangles_[trianglei])
                {
                    if (marks_[other] != centre)
                    {
                        marks_[other] = centre;
                        result.push_back(other);
                    }
                }
            }
        }
        return result;
    }

    const List<triFace>& triangles_;
    Rows around_;
    scalarField missing_; // 2 pi less the angles of the triangles at a point
    List<bool> onBoundary_;
    labelList marks_; // the centre that came last
};

scalar median(const scalarField& values)
{
    std::vector<scalar> positive;
    for (const scalar value : values)
    {
        if (value > 0)
        {
            positive.push_back(value);
        }
    }
    if (positive.empty())
    {
        return 0;
    }
    const auto middle = positive.begin() + positive.size() / 2;
    std::nth_element(positive.begin(), middle, positive.end());
    return *middle;
}

} // namespace

scalarField regionalCurvature(const PlainSurface& surface)
{
    const SurfaceTopology topology(surface.points.size(), surface.triangles);
    const pointField points(smoothed(surface, topology));
    Rings rings(points, surface.triangles, topology);
    scalarField curvatures(points.size());
    forAll(curvatures, pointi)
    {
        curvatures[pointi] = rings.curvature(pointi);
    }
    return curvatures;
}

labelList curvaturePeaks(const PlainSurface& surface)
{
    const SurfaceTopology topology(surface.points.size(), surface.triangles);
    const scalarField curvatures(regionalCurvature(surface));
    const scalar least = max(strong, aboveOthers * median(curvatures));
    const scalar apart = distanceApart * meanEdge(surface.points, topology);
    labelList order(curvatures.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(
        order.begin(), order.end(),
        [&](label i, label j) { return curvatures[i] > curvatures[j]; }
    );
    DynamicList<label> peaks;
    for (const label pointi : order)
    {
        if (curvatures[pointi] < least || peaks.size() == mostPeaks)
        {
            break;
        }
        const auto isNear = [&](label peak)
        { return mag(surface.points[peak] - surface.points[pointi]) < apart; };
        if (std::none_of(peaks.begin(), peaks.end(), isNear))
        {
            peaks.append(pointi);
        }
    }
    return labelList(std::move(peaks));
}

} // namespace Foam::stability
