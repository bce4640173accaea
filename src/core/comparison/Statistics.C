// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/comparison/Statistics.H"

#include "core/ranks/Quantiles.H"
#include "core/ranks/ExactSum.H"
#include "core/surface/Ribbon.H"

#include <algorithm>

namespace Foam::stability
{

namespace
{

// Sums over the points and triangles of all ranks.
class Sums
{
public:
    // Adds to what `target` will be.
    void add(scalar& target, scalar value) { partOf(target).add(value); }

    // Collective: all ranks have added to the same targets, in the same order.
    void finish(const Exchange& exchange)
    {
        sum(sums_, exchange);
        forAll(sums_, i)
        {
            *targets_[i] = sums_[i].value();
        }
    }

    // Declares a target, so that it is there on every rank.
    void declare(scalar& target)
    {
        targets_.push_back(&target);
        sums_.append(ExactSum());
    }

private:
    ExactSum& partOf(scalar& target)
    {
        const auto at = std::find(targets_.begin(), targets_.end(), &target);
        return sums_[label(at - targets_.begin())];
    }

    std::vector<scalar*> targets_;
    DynamicList<ExactSum> sums_;
};

// The areas of primary points; zero for the others.
scalarField countedAreas(const ClassifiedSurface& surface)
{
    scalarField areas(surface.areas);
    forAll(areas, pointi)
    {
        areas[pointi] = surface.isPrimary[pointi] ? areas[pointi] : 0;
    }
    return areas;
}

// Fractions of the area of the points farther than each distance, in cells.
void fillSurvival(
    std::array<scalar, 8>& fractions, const ClassifiedSurface& surface,
    const scalarField& areas, scalar total, const Exchange& exchange
)
{
    List<ExactSum> sums(label(fractions.size()));
    forAll(areas, pointi)
    {
        const scalar cells =
            surface.distance[pointi] / max(surface.mesh.cellSizes[pointi], VSMALL);
        for (size_t i = 0; i < fractions.size(); ++i)
        {
            // A distance that was cut off at so many cells counts, round-off or not.
            const scalar limit = Statistics::survivalDistances[i] * (1 - 1e-12);
            if (cells >= limit && areas[pointi] > 0)
            {
                sums[i].add(areas[pointi]);
            }
        }
    }
    sum(sums, exchange);
    for (size_t i = 0; i < fractions.size(); ++i)
    {
        fractions[i] = total > 0 ? sums[i].value() / total : 0;
    }
}

void addInterface(
    Statistics& statistics, const ClassifiedSurface& interface, const Epsilon& epsilon,
    const scalarField& areas, const Exchange& exchange,
    const std::optional<PlaneSection>& section
)
{
    const InterfaceMesh& mesh = interface.mesh;
    scalar nVertices = 0, nTriangles = 0, epsilonArea = 0, cellsArea = 0;
    Sums sums;
    for (scalar* target :
         {&statistics.area, &statistics.stableArea, &statistics.attachedArea,
          &statistics.parametrizedArea, &nVertices, &nTriangles, &epsilonArea,
          &cellsArea})
    {
        sums.declare(*target);
    }
    forAll(areas, pointi)
    {
        const bool stable = interface.stability[pointi] == Stability::stable;
        sums.add(
            stable ? statistics.stableArea : statistics.attachedArea, areas[pointi]
        );
        const scalar h = mesh.cellSizes[pointi];
        sums.add(epsilonArea, epsilon.at(h) * areas[pointi]);
        sums.add(cellsArea, epsilon.at(h) / max(h, VSMALL) * areas[pointi]);
        sums.add(nVertices, interface.isPrimary[pointi] ? 1 : 0);
    }
    forAll(mesh.triangles, trianglei)
    {
        const scalar area = areaInMesh(mesh, trianglei, section);
        sums.add(statistics.area, area);
        sums.add(statistics.parametrizedArea, mesh.parametrized(trianglei) ? area : 0);
        sums.add(nTriangles, 1);
    }
    sums.finish(exchange);
    statistics.nVertices = label(nVertices);
    statistics.nTriangles = label(nTriangles);
    if (statistics.area > 0)
    {
        statistics.epsilon = epsilonArea / statistics.area;
        statistics.epsilonCells = cellsArea / statistics.area;
    }
}

// `areas`: what left is zero there on return.
void addTimeSurface(
    Statistics& statistics, const ClassifiedSurface& surface, scalarField& areas,
    const Exchange& exchange
)
{
    Sums sums;
    for (scalar* target :
         {&statistics.timeSurfaceArea, &statistics.leftArea,
          &statistics.detachedNearWall, &statistics.detachedElsewhere,
          &statistics.detachedThin, &statistics.detachedResolved})
    {
        sums.declare(*target);
    }
    forAll(areas, pointi)
    {
        scalar& area = areas[pointi];
        if (surface.stability[pointi] == Stability::left)
        {
            sums.add(statistics.leftArea, area);
            area = 0;
        }
        sums.add(statistics.timeSurfaceArea, area);
        if (surface.stability[pointi] != Stability::detached)
        {
            continue;
        }
        if (surface.nearWall[pointi])
        {
            sums.add(statistics.detachedNearWall, area);
            continue;
        }
        sums.add(statistics.detachedElsewhere, area);
        const bool small = surface.thin[pointi] || surface.subGrid[pointi];
        sums.add(small ? statistics.detachedThin : statistics.detachedResolved, area);
    }
    sums.finish(exchange);
}

// For each fraction (rising) of the area the least speed that it does not exceed.
void fillDriftSpeeds(
    std::array<scalar, 3>& speeds, const scalarField& driftSpeed,
    const scalarField& areas, const Exchange& exchange
)
{
    const auto found = weightedQuantiles(
        mag(driftSpeed), areas,
        {Statistics::driftFractions.begin(), Statistics::driftFractions.end()}, exchange
    );
    std::copy(found.begin(), found.end(), speeds.begin());
}

} // namespace

void addSurfaceStatistics(
    Statistics& statistics, const ClassifiedSurface& interface,
    const ClassifiedSurface& timeSurface, const Epsilon& epsilon,
    const Exchange& exchange, const std::optional<PlaneSection>& section
)
{
    const scalarField areas(countedAreas(interface));
    addInterface(statistics, interface, epsilon, areas, exchange, section);
    fillSurvival(
        statistics.attachedFraction, interface, areas, statistics.area, exchange
    );
    scalarField timeAreas(countedAreas(timeSurface));
    addTimeSurface(statistics, timeSurface, timeAreas, exchange);
    fillSurvival(
        statistics.detachedFraction, timeSurface, timeAreas, statistics.timeSurfaceArea,
        exchange
    );
    fillDriftSpeeds(
        statistics.driftSpeeds, timeSurface.driftSpeed, timeAreas, exchange
    );
}

void addDisplacement(
    Statistics& statistics, const ClassifiedSurface& timeSurface,
    const pointField& startPositions, const Exchange& exchange
)
{
    const InterfaceMesh& mesh = timeSurface.mesh;
    const scalarField areas(countedAreas(timeSurface));
    scalar squares = 0, total = 0, farthest = 0;
    Sums sums;
    sums.declare(squares);
    sums.declare(total);
    forAll(areas, pointi)
    {
        const scalar cells = mag(mesh.points[pointi] - startPositions[pointi])
                             / max(mesh.cellSizes[pointi], VSMALL);
        sums.add(squares, areas[pointi] * sqr(cells));
        sums.add(total, areas[pointi]);
        farthest = max(farthest, cells);
    }
    sums.finish(exchange);
    statistics.largestDisplacement = largest(farthest, exchange);
    statistics.displacement = total > 0 ? std::sqrt(squares / total) : 0;
}

} // namespace Foam::stability
