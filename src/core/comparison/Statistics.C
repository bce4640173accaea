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

bool isSmall(const PointMarks& marks, label pointi)
{
    return marks.thin[pointi] || marks.subGrid[pointi];
}

// Areas by class; what entered has no area at the points.
void addClasses(
    Sums& sums, Statistics& statistics, const ClassifiedSurface& interface,
    const scalarField& areas
)
{
    forAll(areas, pointi)
    {
        const Stability stability = interface.stability[pointi];
        if (stability == Stability::stable)
        {
            sums.add(statistics.stableArea, areas[pointi]);
        }
        else if (stability == Stability::attached)
        {
            sums.add(statistics.attachedArea, areas[pointi]);
            sums.add(
                interface.nearWall[pointi]   ? statistics.attachedNearWall
                : isSmall(interface, pointi) ? statistics.attachedThin
                                             : statistics.attachedResolved,
                areas[pointi]
            );
        }
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
          &statistics.attachedNearWall, &statistics.attachedThin,
          &statistics.attachedResolved, &statistics.enteredArea,
          &statistics.parametrizedArea, &nVertices, &nTriangles, &epsilonArea,
          &cellsArea})
    {
        sums.declare(*target);
    }
    addClasses(sums, statistics, interface, areas);
    for (const bool isPrimary : interface.isPrimary)
    {
        sums.add(nVertices, isPrimary ? 1 : 0);
    }
    forAll(mesh.triangles, trianglei)
    {
        const triFace& triangle = mesh.triangles[trianglei];
        const scalar area = areaInMesh(mesh, trianglei, section);
        const scalar entered = crossedShare(triangle, interface.crossings);
        sums.add(statistics.area, area);
        sums.add(statistics.enteredArea, entered * area);
        sums.add(statistics.parametrizedArea, mesh.parametrized(trianglei) ? area : 0);
        sums.add(nTriangles, 1);
        for (const label pointi : triangle)
        {
            const scalar h = mesh.cellSizes[pointi];
            sums.add(epsilonArea, epsilon.at(h) * area / 3);
            sums.add(cellsArea, epsilon.at(h) / max(h, VSMALL) * area / 3);
        }
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

// `areas`: what left or is untracked is zero there on return.
void addTimeSurface(
    Statistics& statistics, const ClassifiedSurface& surface, scalarField& areas,
    const Exchange& exchange
)
{
    Sums sums;
    for (scalar* target :
         {&statistics.timeSurfaceArea, &statistics.keptArea, &statistics.untrackedArea,
          &statistics.detachedNearWall, &statistics.detachedElsewhere,
          &statistics.detachedThin, &statistics.detachedResolved})
    {
        sums.declare(*target);
    }
    forAll(areas, pointi)
    {
        scalar& area = areas[pointi];
        const Stability stability = surface.stability[pointi];
        sums.add(
            statistics.untrackedArea, stability == Stability::untracked ? area : 0
        );
        if (stability == Stability::left || stability == Stability::untracked)
        {
            area = 0;
        }
        sums.add(statistics.timeSurfaceArea, area);
        sums.add(statistics.keptArea, stability == Stability::stable ? area : 0);
        if (stability != Stability::detached)
        {
            continue;
        }
        if (surface.nearWall[pointi])
        {
            sums.add(statistics.detachedNearWall, area);
            continue;
        }
        sums.add(statistics.detachedElsewhere, area);
        sums.add(
            isSmall(surface, pointi) ? statistics.detachedThin
                                     : statistics.detachedResolved,
            area
        );
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
        statistics.attachedFraction, interface, areas,
        statistics.area - statistics.enteredArea, exchange
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

void addMotion(
    Statistics& statistics, const ClassifiedSurface& timeSurface,
    const pointField& startPositions, const Exchange& exchange,
    const std::optional<PlaneSection>& section
)
{
    const InterfaceMesh& mesh = timeSurface.mesh;
    const scalarField areas(countedAreas(timeSurface));
    scalar squares = 0, total = 0, farthest = 0;
    Sums sums;
    for (scalar* target : {&squares, &total, &statistics.leftArea})
    {
        sums.declare(*target);
    }
    InterfaceMesh before;
    before.points = startPositions;
    before.triangles = mesh.triangles;
    forAll(before.triangles, trianglei)
    {
        const scalar left =
            crossedShare(before.triangles[trianglei], timeSurface.crossings);
        sums.add(statistics.leftArea, left * areaInMesh(before, trianglei, section));
    }
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
