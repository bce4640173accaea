// SPDX-License-Identifier: GPL-3.0-or-later

// The whole method in two dimensions: a disc in solid rotation.

#include "core/StabilityTracker.H"
#include "core/surface/Ribbon.H"
#include "shapes/AnalyticFlows.H"
#include "shapes/ExactAlpha.H"
#include "shapes/SectionMesh.H"

#include <gtest/gtest.h>

#include <cmath>

using namespace Foam;
using namespace Foam::stability;

namespace
{

using Snapshot = std::shared_ptr<const FlowSnapshot>;

constexpr scalar turn = 0.3; // [rad] per interval
const point pivot(11.9, 12.1, 0);
const point start(14.6, 12.9, 0);

shapes::SectionOptions room(direction normal)
{
    shapes::SectionOptions options;
    options.max = point(24, 23, 0);
    options.nx = 24;
    options.ny = 23;
    options.normal = normal;
    options.middle = 0.2;
    options.kinds = BoundaryKind::open;
    return options;
}

vector across(const shapes::SectionOptions& options)
{
    return shapes::placed(options, point(0, 0, 1)) - shapes::placed(options, Zero);
}

point turned(const point& x, const point& centre, const vector& n, scalar angle)
{
    const vector d = x - centre;
    const vector axial = (d & n) * n;
    return centre + axial + std::cos(angle) * (d - axial) + std::sin(angle) * (n ^ d);
}

Snapshot rotating(
    std::shared_ptr<const CellComplex> complex, const shapes::SectionOptions& options,
    scalar time
)
{
    const vector n = across(options);
    const point centre = shapes::placed(options, pivot);
    const point middle = turned(shapes::placed(options, start), centre, n, turn * time);
    const shapes::Shape disc = [=](const point& x)
    {
        const vector d = x - middle;
        return mag(d - (d & n) * n) - 4.8;
    };
    FlowSnapshot snapshot(shapes::snapshotOf(complex, disc));
    const shapes::Flow flow = shapes::rotation(centre, turn * n);
    forAll(snapshot.U, celli)
    {
        snapshot.U[celli] = flow(complex->cellCentres()[celli], time);
    }
    forAll(snapshot.boundaryU, i)
    {
        snapshot.boundaryU[i] =
            flow(complex->faceCentres()[complex->nInternalFaces() + i], time);
    }
    snapshot.time = time;
    return std::make_shared<const FlowSnapshot>(std::move(snapshot));
}

} // namespace

TEST(TwoDimensions, discInRotation)
{
    const shapes::SectionOptions options(room(2));
    const auto complex = shapes::section(options);
    TrackerOptions tracking;
    tracking.matching.epsilon.value = 0.05;
    tracking.reconstruction.sharpening = Sharpening::automatic;
    const SerialExchange exchange;
    StabilityTracker tracker(tracking, exchange);
    tracker.start(rotating(complex, options, 0));
    const Classification& result = tracker.classify();
    const vector n = across(options);
    const point centre = shapes::placed(options, pivot);
    for (label i = 1; i <= 40; ++i)
    {
        tracker.advance(rotating(complex, options, i));
        tracker.classify();
        const Statistics& s = result.statistics;
        const InterfaceMesh& mesh = result.interface.mesh;
        scalar sum = 0, sumP = 0;
        forAll(mesh.points, pointi)
        {
            const point back = turned(mesh.points[pointi], centre, n, -turn * i);
            (void)sumP;
            sum += mag(mesh.origins[pointi] - back);
        }
        const labelList pairs(pairsAcross(mesh, *complex->whole().section));
        label nSingle = 0;
        forAll(pairs, p)
        {
            nSingle += pairs[p] == p;
        }
        std::cout << i << " points " << mesh.points.size() << " single " << nSingle
                  << " stable " << s.stableArea / s.area << " detached "
                  << s.detachedNearWall + s.detachedElsewhere << " param "
                  << s.parametrizedArea / s.area << " origin "
                  << sum / mesh.points.size() << " split " << result.transfer.nSplit
                  << " unresolved " << result.transfer.nUnresolved << " merged "
                  << result.transfer.nMerged << " drift " << s.displacement << " noise "
                  << s.noiseFloor << "\n";
    }
}

// A sphere on the axis of a wedge, drawn out along it.
TEST(TwoDimensions, sphereInStraining)
{
    constexpr scalar rate = 0.05, radius = 4.8;
    shapes::SectionOptions options;
    options.max = point(28, 8, 0);
    options.nx = 28;
    options.ny = 8;
    options.wedge = true;
    options.meshThickness = 0.08; // [rad], nearly
    options.kinds = BoundaryKind::open;
    options.kinds[2] = BoundaryKind::symmetry;
    const auto complex = shapes::section(options);
    const point centre(14.3, 0, 0);
    const auto ellipse = [=](scalar time)
    {
        return [=](const point& x)
        {
            const scalar a = std::exp(-rate * time) * (x.x() - centre.x());
            const scalar b = std::exp(0.5 * rate * time) * x.y();
            return std::hypot(a, b) - radius;
        };
    };
    const auto at = [&](scalar time)
    {
        FlowSnapshot snapshot(
            shapes::snapshotOf(complex, shapes::sectionAlpha(*complex, ellipse(time)))
        );
        const auto flow = [&](const point& x)
        { return rate * vector(x.x() - centre.x(), -0.5 * x.y(), 0); };
        forAll(snapshot.U, celli)
        {
            snapshot.U[celli] = flow(complex->cellCentres()[celli]);
        }
        forAll(snapshot.boundaryU, i)
        {
            snapshot.boundaryU[i] =
                flow(complex->faceCentres()[complex->nInternalFaces() + i]);
        }
        snapshot.time = time;
        return std::make_shared<const FlowSnapshot>(std::move(snapshot));
    };
    TrackerOptions tracking;
    tracking.matching.epsilon.value = 0.05;
    tracking.reconstruction.sharpening = Sharpening::automatic;
    const SerialExchange exchange;
    StabilityTracker tracker(tracking, exchange);
    tracker.start(at(0));
    const Classification& result = tracker.classify();
    for (label i = 1; i <= 8; ++i)
    {
        tracker.advance(at(i));
        tracker.classify();
        const Statistics& s = result.statistics;
        scalar largest = 0, largestM = 0;
        for (const point& x : result.timeSurface.mesh.points)
        {
            largest = std::max(largest, mag(ellipse(i)(x)));
        }
        for (const point& x : result.interface.mesh.points)
        {
            largestM = std::max(largestM, mag(ellipse(i)(x)));
        }
        std::cout << i << " area " << s.area << " stable " << s.stableArea / s.area
                  << " detached " << s.detachedNearWall + s.detachedElsewhere << " T "
                  << largest << " M " << largestM << " volume error " << s.volumeError
                  << " noise " << s.noiseFloor << "\n";
    }
}
