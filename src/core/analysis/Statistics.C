// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

#include "core/analysis/Statistics.H"

#include <algorithm>
#include <sstream>

namespace Foam::stability
{

std::vector<std::string> Statistics::columns()
{
    return {
        "Time",
        "vertices",
        "triangles",
        "area",
        "stableArea",
        "attachedArea",
        "detachedNearWalls",
        "detachedElsewhere",
        "leftArea",
        "stableFraction",
        "coverage",
        "particles",
        "mergedTriangles",
        "splitTriangles",
        "volumeError",
        "epsilon",
        "displacement",
        "epsilonPerInterval",
        "driftSpeed50",
        "driftSpeed90",
        "driftSpeed99",
        "noiseFloor",
        "detachedThin",
        "detachedResolved",
    };
}

std::vector<scalar> Statistics::values() const
{
    return {
        time,
        scalar(nVertices),
        scalar(nTriangles),
        area,
        stableArea,
        attachedArea,
        detachedNearWall,
        detachedElsewhere,
        leftArea,
        stableFraction(),
        coverage(),
        scalar(nParticles),
        scalar(nMerged),
        scalar(nSplit),
        volumeError,
        epsilon,
        displacement,
        drift(),
        driftSpeeds[0],
        driftSpeeds[1],
        driftSpeeds[2],
        noiseFloor,
        detachedThin,
        detachedResolved,
    };
}

std::vector<std::string> Statistics::survivalColumns()
{
    std::vector<std::string> names{"Time"};
    for (const std::string side : {"detached", "attached"})
    {
        for (const scalar distance : survivalDistances)
        {
            std::ostringstream name;
            name << side << "(" << distance << ")";
            names.push_back(name.str());
        }
    }
    return names;
}

std::vector<scalar> Statistics::survivalValues() const
{
    std::vector<scalar> result{time};
    result.insert(result.end(), detachedFraction.begin(), detachedFraction.end());
    result.insert(result.end(), attachedFraction.begin(), attachedFraction.end());
    return result;
}

namespace
{

// Fractions of the area of the points farther than each distance, in cells.
void fillSurvival(
    std::array<scalar, 8>& fractions, const ClassifiedSurface& surface,
    const scalarField& areas, scalar total
)
{
    fractions.fill(0);
    forAll(areas, pointi)
    {
        const scalar cells =
            surface.distance[pointi] / max(surface.mesh.cellSizes[pointi], VSMALL);
        for (size_t i = 0; i < fractions.size(); ++i)
        {
            // A distance that was cut off at so many cells counts, round-off or not.
            const scalar limit = Statistics::survivalDistances[i] * (1 - 1e-12);
            if (cells >= limit && total > 0)
            {
                fractions[i] += areas[pointi] / total;
            }
        }
    }
}

void addDetached(
    Statistics& statistics, const ClassifiedSurface& surface, label pointi, scalar area
)
{
    if (surface.nearWall[pointi])
    {
        statistics.detachedNearWall += area;
        return;
    }
    statistics.detachedElsewhere += area;
    const bool small = surface.thin[pointi] || surface.subGrid[pointi];
    (small ? statistics.detachedThin : statistics.detachedResolved) += area;
}

// For each fraction (rising) of the area the least speed that it does not exceed.
void fillDriftSpeeds(
    std::array<scalar, 3>& speeds, const scalarField& driftSpeed,
    const scalarField& areas
)
{
    labelList order(identity(areas.size()));
    std::stable_sort(
        order.begin(), order.end(),
        [&](label a, label b) { return mag(driftSpeed[a]) < mag(driftSpeed[b]); }
    );
    speeds.fill(0);
    const scalar total = sum(areas);
    scalar reached = 0;
    size_t next = 0;
    for (const label pointi : order)
    {
        reached += areas[pointi];
        while (next < speeds.size() && areas[pointi] > 0
               && reached >= Statistics::driftFractions[next] * total)
        {
            speeds[next++] = mag(driftSpeed[pointi]);
        }
    }
}

} // namespace

void survey(
    Statistics& statistics, const ClassifiedSurface& interface,
    const ClassifiedSurface& timeSurface, const Epsilon& epsilon
)
{
    const InterfaceMesh& mesh = interface.mesh;
    const scalarField areas(mesh.pointAreas());
    statistics.nVertices = mesh.points.size();
    statistics.nTriangles = mesh.triangles.size();
    statistics.area = mesh.area();
    scalar epsilonArea = 0, cellsArea = 0;
    forAll(areas, pointi)
    {
        const bool stable = interface.stability[pointi] == Stability::stable;
        (stable ? statistics.stableArea : statistics.attachedArea) += areas[pointi];
        const scalar h = mesh.cellSizes[pointi];
        epsilonArea += epsilon.at(h) * areas[pointi];
        cellsArea += epsilon.at(h) / max(h, VSMALL) * areas[pointi];
    }
    if (statistics.area > 0)
    {
        statistics.epsilon = epsilonArea / statistics.area;
        statistics.epsilonCells = cellsArea / statistics.area;
    }
    forAll(mesh.triangles, trianglei)
    {
        if (mesh.parametrized(trianglei))
        {
            statistics.parametrizedArea += mag(mesh.areaVector(trianglei));
        }
    }
    fillSurvival(statistics.attachedFraction, interface, areas, statistics.area);

    scalarField timeAreas(timeSurface.mesh.pointAreas());
    forAll(timeAreas, pointi)
    {
        scalar& area = timeAreas[pointi];
        if (timeSurface.stability[pointi] == Stability::left)
        {
            statistics.leftArea += area;
            area = 0;
        }
        statistics.timeSurfaceArea += area;
        if (timeSurface.stability[pointi] == Stability::detached)
        {
            addDetached(statistics, timeSurface, pointi, area);
        }
    }
    fillSurvival(
        statistics.detachedFraction, timeSurface, timeAreas, statistics.timeSurfaceArea
    );
    fillDriftSpeeds(statistics.driftSpeeds, timeSurface.driftSpeed, timeAreas);
}

void surveyDisplacement(
    Statistics& statistics, const InterfaceMesh& timeSurface, const pointField& seeds
)
{
    const scalarField areas(timeSurface.pointAreas());
    scalar squares = 0;
    scalar total = 0;
    forAll(areas, pointi)
    {
        const scalar cells = mag(timeSurface.points[pointi] - seeds[pointi])
                             / max(timeSurface.cellSizes[pointi], VSMALL);
        squares += areas[pointi] * sqr(cells);
        total += areas[pointi];
        statistics.largestDisplacement = max(statistics.largestDisplacement, cells);
    }
    statistics.displacement = total > 0 ? std::sqrt(squares / total) : 0;
}

} // namespace Foam::stability
