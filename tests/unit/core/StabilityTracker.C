// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/StabilityTracker.H"
#include "core/base/Errors.H"
#include "shapes/BoxMesh.H"
#include "shapes/CutOut.H"
#include "shapes/ExactAlpha.H"

#include <gtest/gtest.h>

using namespace Foam;
using namespace Foam::stability;

namespace
{

using Snapshot = std::shared_ptr<const FlowSnapshot>;

const point centre(0.43, 0.47, 0.52);
constexpr scalar radius = 0.17;

Snapshot snapshot(
    std::shared_ptr<const CellComplex> complex, const shapes::Shape& shape,
    const vector& U, scalar time
)
{
    FlowSnapshot result(shapes::snapshotOf(complex, shape));
    result.U = U;
    result.boundaryU = U;
    result.time = time;
    return std::make_shared<const FlowSnapshot>(std::move(result));
}

const shapes::Shape nowhere = [](const point&) { return 1.0; };

TrackerOptions options(scalar epsilon = 0.5)
{
    TrackerOptions result;
    result.matching.epsilon.value = epsilon;
    return result;
}

// Open on all sides, so that a uniform flow is one.
std::shared_ptr<const CellComplex> openCube(label n)
{
    shapes::BoxOptions box;
    box.n = Vector<label>(n, n, n);
    box.kinds = FixedList<BoundaryKind, 6>(BoundaryKind::open);
    return shapes::box(box);
}

scalar particleWeight(const InstabilityParticles& particles)
{
    scalar sum = 0;
    for (const InstabilityParticle& particle : particles.here())
    {
        sum += particle.weight;
    }
    return sum;
}

} // namespace

TEST(StabilityTracker, theStartIsStableAndParametrized)
{
    const auto complex = openCube(20);
    const SerialExchange exchange;
    StabilityTracker tracker(options(), exchange);
    EXPECT_FALSE(tracker.started());
    tracker.start(snapshot(complex, shapes::sphere(centre, radius), Zero, 0.5));
    EXPECT_TRUE(tracker.started());
    const Classification& result = tracker.classify();
    EXPECT_EQ(result.index, 0);
    EXPECT_EQ(result.statistics.time, 0.5);
    EXPECT_EQ(result.statistics.interval, 0);
    EXPECT_NEAR(result.statistics.stableFraction(), 1, 1e-12);
    EXPECT_NEAR(result.statistics.coverage(), 1, 1e-12);
    EXPECT_EQ(result.statistics.nParticles, 0);
    ASSERT_TRUE(result.parametrization);
    EXPECT_EQ(result.parametrization->nCharts, 1);
    // T is the flattened copy: it was not there in the interface's triangles.
    EXPECT_NE(
        result.timeSurface.mesh.points.size(), result.interface.mesh.points.size()
    );
    EXPECT_NEAR(result.timeSurface.mesh.area(), 4 * 3.14159 * sqr(radius), 0.05);
}

// A sphere that moves with the flow by 1.3 cells of its own: stable, and the carried
// origins lag behind by just the displacement.
TEST(StabilityTracker, aSphereThatMovesWithTheFlowIsStable)
{
    const auto complex = openCube(20);
    const vector U(0.065, -0.02, 0.03);
    const SerialExchange exchange;
    StabilityTracker tracker(options(), exchange);
    tracker.start(snapshot(complex, shapes::sphere(centre, radius), U, 0));
    tracker.classify();
    const label nStart = 3;
    for (label step = 1; step <= nStart; ++step)
    {
        tracker.advance(snapshot(
            complex, shapes::sphere(centre + scalar(step) * U, radius), U, step
        ));
        const Statistics& statistics = tracker.classify().statistics;
        EXPECT_NEAR(statistics.stableFraction(), 1, 1e-12);
        EXPECT_EQ(statistics.detachedElsewhere + statistics.detachedNearWall, 0);
        EXPECT_NEAR(statistics.displacement, mag(U) * 20, 1e-6);
        EXPECT_NEAR(statistics.coverage(), 1, 1e-12);
        EXPECT_NEAR(statistics.epsilon, 0.5 / 20, 1e-12);
        EXPECT_NEAR(statistics.smallestVisibleDrift(), 0.5 / 20, 1e-12);
    }
}

// The interface of a fluid at rest grows by 0.6 cells in 0.5 s and shrinks again: on
// both surfaces it leaves the first fluid, inside, and comes back.
TEST(StabilityTracker, theDriftOfAGrowingSphereIsItsSpeed)
{
    const label n = 20;
    const auto complex = openCube(n);
    const scalar growth = 0.6 / n, interval = 0.5;
    const SerialExchange exchange;
    TrackerOptions sharp = options();
    sharp.reconstruction.sharpening = Sharpening::automatic;
    StabilityTracker tracker(sharp, exchange);
    for (const label step : {0, 1, 2})
    {
        const Snapshot next = snapshot(
            complex, shapes::sphere(centre, step == 1 ? radius + growth : radius), Zero,
            3 + step * interval
        );
        step ? tracker.advance(next) : tracker.start(next);
        const Classification& result = tracker.classify();
        const scalar expected = step == 0 ? 0 : step == 1 ? -growth : growth;
        const scalar noise = step == 0 ? 0 : 0.05 / n; // of the reconstruction
        for (const auto* surface : {&result.interface, &result.timeSurface})
        {
            ASSERT_EQ(surface->driftSpeed.size(), surface->mesh.points.size());
            for (const scalar speed : surface->driftSpeed)
            {
                EXPECT_NEAR(speed * interval, expected, noise) << step;
            }
        }
        const std::array<scalar, 3>& speeds = result.statistics.driftSpeeds;
        EXPECT_NEAR(speeds[0] * interval, mag(expected), 0.3 * noise) << step;
        EXPECT_GE(speeds[2], speeds[1]);
    }
}

// A ball, a droplet of 1.2 cells, a sheet of 1.2 cells from wall to wall and another
// ball on a wall, in cells of 1/24 m, rest and vanish. The last time surface was
// seeded from the interface, the first from the flattened one.
TEST(StabilityTracker, whatVanishesIsSplitByWallsThinAndResolved)
{
    const scalar h = 1.0 / 24;
    shapes::BoxOptions box;
    box.n = Vector<label>(16, 16, 20);
    box.max = point(16, 16, 20) * h;
    const auto complex = shapes::box(box);
    const point high = point(8.48, 7.28, 10.52) * h;
    const shapes::Shape sheet = [=](const point& x)
    { return mag(x.z() - 3.5 * h - 0.06 * x.x() * h) - 0.6 * h; };
    const point speck = point(2.56, 3.04, 15.92) * h;
    const point onWall = point(16, 11.2, 15.2) * h;
    const shapes::Shape water = shapes::unionOf(
        shapes::unionOf(sheet, shapes::sphere(high, 4.2 * h)),
        shapes::unionOf(shapes::sphere(speck, 1.2 * h), shapes::sphere(onWall, 3.3 * h))
    );
    const Snapshot wet = snapshot(complex, water, Zero, 0);
    const auto at = [&](scalar time)
    {
        FlowSnapshot later(*wet);
        later.time = time;
        return std::make_shared<const FlowSnapshot>(std::move(later));
    };
    for (const label nRests : {0, 1})
    {
        const SerialExchange exchange;
        TrackerOptions sharp = options();
        sharp.reconstruction.sharpening = Sharpening::automatic;
        StabilityTracker tracker(sharp, exchange);
        tracker.start(wet);
        for (label i = 0; i < nRests; ++i)
        {
            EXPECT_EQ(tracker.classify().droplets.size(), 1u);
            tracker.advance(at(i + 1));
        }
        const Classification& before = tracker.classify();
        ASSERT_EQ(before.droplets.size(), 1u);
        EXPECT_NEAR(before.droplets[0].radius, 1.2, 2e-3);
        EXPECT_LT(mag(before.droplets[0].centroid - speck), 0.02 * h);
        forAll(before.interface.mesh.points, pointi)
        {
            const scalar off = mag(before.interface.mesh.points[pointi] - speck);
            EXPECT_EQ(bool(before.interface.subGrid[pointi]), off < 2 * h);
        }

        tracker.advance(snapshot(complex, nowhere, Zero, nRests + 1));
        const Classification& after = tracker.classify();
        const Statistics& s = after.statistics;
        EXPECT_TRUE(after.droplets.empty());
        EXPECT_NEAR(
            s.detachedNearWall + s.detachedThin + s.detachedResolved,
            after.timeSurface.mesh.area(), 1e-12
        );
        EXPECT_GT(s.detachedNearWall, 0.1);
        // The free ball, and of the other what is a cell away from its wall.
        const scalar balls = 4 * M_PI * sqr(4.2 * h) + 2 * M_PI * 3.3 * 2.3 * sqr(h);
        EXPECT_NEAR(s.detachedResolved, balls, 0.1 * balls);
        const scalar thin = 2 * sqr(14 * h) + 4 * M_PI * sqr(1.2 * h);
        EXPECT_GT(s.detachedThin, 0.95 * thin);
        EXPECT_LT(s.detachedThin, 1.05 * thin);
    }
}

// Both surfaces know how far their classes are from the noise.
TEST(StabilityTracker, noiseRatesTheClasses)
{
    const auto complex = openCube(20);
    const SerialExchange exchange;
    scalar floors[2];
    for (const label sharp : {0, 1})
    {
        TrackerOptions chosen = options();
        chosen.reconstruction.sharpening =
            sharp ? Sharpening::automatic : Sharpening::none;
        StabilityTracker tracker(chosen, exchange);
        tracker.start(snapshot(complex, shapes::sphere(centre, radius), Zero, 0));
        tracker.classify();
        tracker.advance(snapshot(complex, shapes::sphere(centre, radius), Zero, 1));
        const Classification& result = tracker.classify();
        floors[sharp] = result.statistics.noiseFloor;
        for (const auto* surface : {&result.interface, &result.timeSurface})
        {
            ASSERT_EQ(surface->confidence.size(), surface->mesh.points.size());
            forAll(surface->confidence, pointi)
            {
                const scalar off = 0.5 - surface->distance[pointi] * 20; // [cells]
                EXPECT_NEAR(
                    surface->confidence[pointi], min(off / floors[sharp], 1000.0), 1e-6
                );
            }
        }
    }
    EXPECT_GT(floors[0], 0.1);
    EXPECT_LT(floors[1], 0.02);
    EXPECT_GT(floors[1], 1e-4);
}

// A sphere at rest that grows by 0.2 cells at each time, within the band of 0.5 cells
// and beyond that of 0.05 that comes later, with seams that are no longer cut.
TEST(StabilityTracker, laterOptionsComeAtTheirTime)
{
    const label n = 20;
    const auto complex = openCube(n);
    TrackerOptions changing = options();
    changing.reconstruction.sharpening = Sharpening::automatic;
    ReconstructionFrom later{2, changing.reconstruction, {}, {}};
    later.matching.epsilon.value = 0.05;
    later.transfer.seamTreatment = false;
    changing.later = {later};
    const SerialExchange exchange;
    StabilityTracker tracker(changing, exchange);
    for (const label step : {0, 1, 2})
    {
        const shapes::Shape ball = shapes::sphere(centre, radius + step * 0.2 / n);
        const Snapshot next = snapshot(complex, ball, Zero, step);
        step ? tracker.advance(next) : tracker.start(next);
        const Classification& result = tracker.classify();
        const bool wide = step < 2;
        EXPECT_EQ(result.epsilon.value, wide ? 0.5 : 0.05);
        EXPECT_NEAR(result.statistics.epsilonCells, wide ? 0.5 : 0.05, 1e-12);
        EXPECT_NEAR(result.statistics.stableFraction(), wide ? 1 : 0, 1e-12);
        EXPECT_EQ(result.transfer.nSplit > 0, wide);
        const scalar off = mag(result.interface.distance[0] * n - (wide ? 0.5 : 0.05));
        EXPECT_NEAR(
            result.interface.confidence[0],
            min(off / result.statistics.noiseFloor, 1000.0), 1e-6
        );
    }
    changing.later = {later, later};
    EXPECT_THROW(StabilityTracker(changing, exchange), BadInput);
}

// Judged by the tangential part of origin, which has an exact truth.
TEST(StabilityTracker, originsLagByTheDisplacement)
{
    const auto complex = openCube(20);
    const vector U(0.065, -0.02, 0.03);
    const SerialExchange exchange;
    StabilityTracker tracker(options(), exchange);
    tracker.start(snapshot(complex, shapes::sphere(centre, radius), U, 0));
    tracker.classify();
    tracker.advance(snapshot(complex, shapes::sphere(centre + U, radius), U, 1));
    const InterfaceMesh mesh(tracker.classify().interface.mesh);
    scalar largest = 0;
    forAll(mesh.points, pointi)
    {
        const vector normal = mesh.points[pointi] - centre - U;
        const vector error = mesh.origins[pointi] + U - mesh.points[pointi];
        const vector along = normal / mag(normal);
        largest = max(largest, mag(error - (error & along) * along));
    }
    EXPECT_LT(largest * 20, 0.25);
    EXPECT_GT(largest * 20, 1e-3); // it is a measured error, not an array of copies
}

TEST(StabilityTracker, anInterfaceThatMovesWithoutTheFlowDetachesAndAttaches)
{
    const auto complex = openCube(20);
    const SerialExchange exchange;
    StabilityTracker tracker(options(), exchange);
    tracker.start(snapshot(complex, shapes::sphere(centre, radius), Zero, 0));
    tracker.classify();
    // So far that no point of one sphere is near the other.
    const point far = centre + vector(0.05, 0.42, 0);
    tracker.advance(snapshot(complex, shapes::sphere(far, 0.08), Zero, 0.1));
    const Classification& result = tracker.classify();
    EXPECT_EQ(result.statistics.stableArea, 0);
    EXPECT_EQ(result.statistics.coverage(), 0);
    EXPECT_NEAR(
        result.statistics.detachedElsewhere, result.timeSurface.mesh.area(), 1e-12
    );
    EXPECT_NEAR(
        particleWeight(tracker.particles()), result.timeSurface.mesh.area(), 1e-12
    );
    EXPECT_EQ(
        tracker.particles().here().size(),
        result.timeSurface.mesh.points.size() + result.timeSurface.mesh.triangles.size()
    );
    EXPECT_NEAR(result.statistics.detachedFraction[7], 1, 1e-12);

    // They drift on with the flow, none is seeded twice.
    const label n = tracker.particles().here().size();
    const point before = tracker.particles().here()[7].path.x;
    const vector U(0, 0, 0.2);
    tracker.advance(snapshot(complex, shapes::sphere(far + 0.05 * U, 0.08), U, 0.2));
    tracker.classify();
    EXPECT_EQ(tracker.particles().here().size(), n);
    // U grows linearly from 0 to U over 0.1 s
    EXPECT_LT(
        mag(tracker.particles().here()[7].path.x - before - 0.05 * U * 0.2 / 0.2), 1e-9
    );
    EXPECT_EQ(tracker.particles().here()[7].detachmentTime, 0.1);
}

TEST(StabilityTracker, anInterfaceThatAppearsLaterIsAttachedThenTracked)
{
    const auto complex = openCube(16);
    const SerialExchange exchange;
    StabilityTracker tracker(options(), exchange);
    tracker.start(snapshot(complex, nowhere, Zero, 0));
    const Classification& empty = tracker.classify();
    EXPECT_TRUE(empty.interface.mesh.empty());
    EXPECT_FALSE(empty.parametrization);

    tracker.advance(snapshot(complex, shapes::sphere(centre, radius), Zero, 1));
    const Classification& born = tracker.classify();
    EXPECT_EQ(born.statistics.stableArea, 0);
    EXPECT_GT(born.statistics.attachedArea, 0.3);
    EXPECT_TRUE(born.parametrization);
    EXPECT_EQ(tracker.particles().here().size(), 0);

    tracker.advance(snapshot(complex, shapes::sphere(centre, radius), Zero, 2));
    const Classification& later = tracker.classify();
    EXPECT_NEAR(later.statistics.stableFraction(), 1, 1e-12);
    EXPECT_NEAR(later.statistics.coverage(), 1, 1e-12);
}

TEST(StabilityTracker, anInterfaceThatVanishesDetachesOnce)
{
    const auto complex = openCube(16);
    const SerialExchange exchange;
    StabilityTracker tracker(options(), exchange);
    tracker.start(snapshot(complex, shapes::sphere(centre, radius), Zero, 0));
    tracker.classify();
    for (label step = 1; step < 4; ++step)
    {
        tracker.advance(snapshot(complex, nowhere, Zero, step));
        const Statistics& statistics = tracker.classify().statistics;
        EXPECT_EQ(statistics.detachedElsewhere > 0, step == 1);
        EXPECT_EQ(statistics.area, 0);
    }
    EXPECT_GT(tracker.particles().here().size(), 0);
}

TEST(StabilityTracker, manyAdvancesAreOneInterval)
{
    const auto complex = openCube(16);
    const vector U(0.1, 0.03, -0.02);
    const SerialExchange exchange;
    StabilityTracker one(options(), exchange);
    StabilityTracker many(options(), exchange);
    const auto at = [&](scalar time)
    { return snapshot(complex, shapes::sphere(centre + time * U, radius), U, time); };
    one.start(at(0));
    one.classify();
    one.advance(at(0.8));
    many.start(at(0));
    many.classify();
    for (const scalar time : {0.1, 0.25, 0.7, 0.8})
    {
        many.advance(at(time));
    }
    const ClassifiedSurface a(one.classify().timeSurface);
    const ClassifiedSurface& b = many.classify().timeSurface;
    EXPECT_NEAR(one.classify().statistics.interval, 0, 1e-15);
    ASSERT_EQ(a.mesh.points.size(), b.mesh.points.size());
    forAll(a.mesh.points, i)
    {
        EXPECT_LT(mag(a.mesh.points[i] - b.mesh.points[i]), 1e-12);
    }
}

// A slab that the flow pushes out through the top.
TEST(StabilityTracker, whatLeavesIsNeitherStableNorDetached)
{
    shapes::BoxOptions box;
    box.n = Vector<label>(10, 10, 10);
    box.kinds[5] = BoundaryKind::open;
    box.kinds[4] = BoundaryKind::open;
    const auto complex = shapes::box(box);
    const vector U(0, 0, 0.2);
    const SerialExchange exchange;
    StabilityTracker tracker(options(), exchange);
    const auto at = [&](scalar z, scalar time)
    {
        return snapshot(
            complex, shapes::halfSpace(point(0, 0, z), vector(0, 0, 1)), U, time
        );
    };
    tracker.start(at(0.877, 0));
    const scalar area = tracker.classify().statistics.area;
    EXPECT_NEAR(area, 1, 0.02);
    tracker.advance(at(1.077, 1));
    const Statistics& statistics = tracker.classify().statistics;
    EXPECT_NEAR(statistics.leftArea, area, 1e-9);
    EXPECT_EQ(statistics.detachedElsewhere + statistics.detachedNearWall, 0);
    EXPECT_EQ(statistics.area, 0);
    EXPECT_EQ(tracker.particles().here().size(), 0);
}

// A level surface in a channel: as much comes in as leaves, whatever part of a cell,
// and nothing is attached or detached, in one advance or many. What came in stays
// known.
TEST(StabilityTracker, whatComesInIsNotAttached)
{
    shapes::BoxOptions box;
    box.n = Vector<label>(12, 5, 9);
    box.kinds[0] = box.kinds[1] = BoundaryKind::open;
    const auto complex = shapes::box(box);
    const scalar way = 0.1371; // [m], 1.6 cells
    const vector U(way, 0, 0);
    const shapes::Shape water =
        shapes::halfSpace(point(0, 0, 0.53), vector(0.07, 0.05, 1));
    for (const label nAdvances : {1, 9})
    {
        const SerialExchange exchange;
        TrackerOptions sharp = options();
        sharp.reconstruction.sharpening = Sharpening::automatic;
        StabilityTracker tracker(sharp, exchange);
        tracker.start(snapshot(complex, water, U, 0));
        tracker.classify();
        for (label step = 1; step <= 3; ++step)
        {
            for (label i = 1; i <= nAdvances; ++i)
            {
                const scalar time = step - 1 + scalar(i) / nAdvances;
                const shapes::Shape moved = [=](const point& x)
                { return water(x - time * U); };
                tracker.advance(snapshot(complex, moved, U, time));
            }
            const Classification& result = tracker.classify();
            const Statistics& s = result.statistics;
            const scalar slope = std::sqrt(1 + sqr(0.07) + sqr(0.05));
            EXPECT_NEAR(s.area, slope, 2e-3);
            EXPECT_NEAR(s.enteredArea, way * slope, 1e-3 * way);
            EXPECT_NEAR(s.leftArea, way * slope, 1e-3 * way);
            EXPECT_EQ(s.attachedArea, 0);
            EXPECT_EQ(s.detachedArea(), 0);
            EXPECT_NEAR(s.stableFraction(), 1, 1e-12);
            EXPECT_EQ(s.keptFraction(), 1);
            EXPECT_EQ(result.interface.stability.find(Stability::attached), -1);
            EXPECT_NE(result.interface.stability.find(Stability::entered), -1);
            // Nothing is black in a picture; what lost p is what came in.
            const ClassifiedSurface& m = result.interface;
            scalar without = 0;
            forAll(m.mesh.triangles, trianglei)
            {
                if (!m.mesh.parametrized(trianglei))
                {
                    const triFace& t = m.mesh.triangles[trianglei];
                    without += mag(m.mesh.areaVector(trianglei));
                    EXPECT_TRUE(
                        m.fromOutside[t[0]] || m.fromOutside[t[1]]
                        || m.fromOutside[t[2]]
                    );
                }
            }
            EXPECT_NEAR(without, step * way, step * 0.5 / box.n.x());
        }
    }
}

// A ball that goes out through the outlet: what leaves at each time adds up to all of
// it.
TEST(StabilityTracker, whatLeavesAddsUpToAllOfIt)
{
    shapes::BoxOptions box;
    box.n = Vector<label>(20, 16, 16);
    box.max = point(1.25, 1, 1);
    box.kinds[0] = box.kinds[1] = BoundaryKind::open;
    const auto complex = shapes::box(box);
    const vector U(0.11, 0, 0);
    const SerialExchange exchange;
    TrackerOptions sharp = options();
    sharp.reconstruction.sharpening = Sharpening::automatic;
    StabilityTracker tracker(sharp, exchange);
    scalar left = 0, area = 0;
    for (label step = 0; step <= 6; ++step)
    {
        const Snapshot next = snapshot(
            complex, shapes::sphere(point(0.97, 0.52, 0.47) + step * U, 0.24), U, step
        );
        step ? tracker.advance(next) : tracker.start(next);
        const Statistics& s = tracker.classify().statistics;
        area = step ? area : s.area;
        left += s.leftArea;
        EXPECT_LT(s.detachedArea(), 1e-3 * area) << step;
        EXPECT_EQ(s.enteredArea, 0);
    }
    EXPECT_NEAR(left, area, 0.02 * area);
    EXPECT_EQ(tracker.particles().here().size(), 0);
}

// A pathline of one step gets stuck a quarter of the way: no interface tore off there.
TEST(StabilityTracker, whatGetsStuckIsNotDetached)
{
    const auto complex = openCube(20);
    const vector U(0.25, 0, 0);
    TrackerOptions oneStep(options());
    oneStep.integration.maxSteps = 1;
    const SerialExchange exchange;
    StabilityTracker tracker(oneStep, exchange);
    tracker.start(snapshot(complex, shapes::sphere(centre, radius), U, 0));
    tracker.classify();
    tracker.advance(snapshot(complex, shapes::sphere(centre + U, radius), U, 1));
    const Classification& result = tracker.classify();
    EXPECT_EQ(result.timeSurfaceCounts.nStuck, result.timeSurface.mesh.points.size());
    const Statistics& statistics = result.statistics;
    // Some of it lies within epsilon of the sphere by chance.
    EXPECT_GT(statistics.untrackedArea, 0.5 * result.timeSurface.mesh.area());
    EXPECT_NEAR(
        statistics.untrackedArea + statistics.timeSurfaceArea,
        result.timeSurface.mesh.area(), 1e-9
    );
    EXPECT_EQ(statistics.detachedElsewhere + statistics.detachedNearWall, 0);
    EXPECT_EQ(tracker.particles().nSeeded(), 0);
}

// Two levels that change places: near the wall each lies where the other was.
TEST(StabilityTracker, noMatchPassesThroughAThinWall)
{
    const auto complex = shapes::withThinWalls(shapes::cutOut(
        shapes::boxInput(shapes::BoxOptions()), [](const point&) { return false; },
        [](const point& x) { return mag(x.x() - 0.5) < 0.05; }
    ));
    const auto at = [&](scalar left, scalar right, scalar time)
    {
        const shapes::Shape water = [=](const point& x)
        { return x.z() - (x.x() < 0.5 ? left : right); };
        return snapshot(complex, water, Zero, time);
    };
    const SerialExchange exchange;
    StabilityTracker tracker(options(), exchange);
    tracker.start(at(0.55, 0.67, 0));
    const Classification& start = tracker.classify();
    EXPECT_EQ(max(start.interface.components), 1);
    EXPECT_EQ(start.statistics.stableFraction(), 1);

    tracker.advance(at(0.67, 0.55, 1));
    const Statistics& swapped = tracker.classify().statistics;
    EXPECT_EQ(swapped.stableArea, 0);
    EXPECT_NEAR(
        swapped.detachedNearWall + swapped.detachedElsewhere, swapped.timeSurfaceArea,
        1e-12
    );

    // At one level both sides are there, but nothing merges.
    StabilityTracker level(options(), exchange);
    level.start(at(0.55, 0.55, 0));
    level.classify();
    level.advance(at(0.55, 0.55, 1));
    const Classification& same = level.classify();
    EXPECT_EQ(same.statistics.nMerged, 0);
    EXPECT_EQ(same.statistics.stableFraction(), 1);
    EXPECT_EQ(max(same.interface.components), 1);
}

// The remeshed copy lies farther off than this band, which must not matter, whenever
// the interface appears.
TEST(StabilityTracker, anInterfaceAtRestKeepsAllOfItsParameters)
{
    const auto complex = openCube(20);
    const shapes::Shape ball = shapes::sphere(centre, radius);
    for (const label appears : {0, 1})
    {
        const SerialExchange exchange;
        StabilityTracker tracker(options(0.01), exchange);
        for (label step = 0; step < 4; ++step)
        {
            const Snapshot next =
                snapshot(complex, step < appears ? nowhere : ball, Zero, step);
            step ? tracker.advance(next) : tracker.start(next);
            const Classification& result = tracker.classify();
            const Statistics& s = result.statistics;
            const bool appeared = appears == 1 && step == 1;
            if (result.parametrization)
            {
                EXPECT_GT(result.parametrization->remeshingDistance * 20, 0.011);
            }
            if (step >= appears)
            {
                EXPECT_NEAR(s.attachedArea, appeared ? s.area : 0, 1e-12);
                EXPECT_NEAR(s.coverage(), appeared ? 0 : 1, 1e-12);
                EXPECT_EQ(s.detachedArea(), 0);
                EXPECT_EQ(s.keptFraction(), 1);
            }
        }
    }
}

// The first velocity is nought. A ball with speed that gains from zero went half as far
// in the first interval as one that had the speed at once; both are stable.
TEST(StabilityTracker, theInterfaceTellsHowARunStarted)
{
    const auto complex = openCube(20);
    const vector U(0.07, -0.02, 0.03); // 1.6 cells a second
    for (const bool impulsive : {false, true})
    {
        for (const label nAdvances : {1, 3})
        {
            const SerialExchange exchange;
            TrackerOptions sharp = options(0.3);
            sharp.reconstruction.sharpening = Sharpening::automatic;
            StabilityTracker tracker(sharp, exchange);
            tracker.start(snapshot(complex, shapes::sphere(centre, radius), Zero, 0));
            tracker.classify();
            for (label step = 1; step <= 2 * nAdvances; ++step)
            {
                const scalar time = scalar(step) / nAdvances, first = 1.0 / nAdvances;
                const point there =
                    centre + (impulsive ? time : time - 0.5 * first) * U;
                tracker.advance(
                    snapshot(complex, shapes::sphere(there, radius), U, time)
                );
                if (step % nAdvances == 0)
                {
                    const Classification& result = tracker.classify();
                    EXPECT_EQ(result.impulsiveStart, impulsive && step == nAdvances);
                    EXPECT_NEAR(result.statistics.stableFraction(), 1, 1e-12);
                    EXPECT_EQ(result.statistics.keptFraction(), 1);
                    EXPECT_EQ(result.statistics.enteredArea, 0);
                }
            }
        }
    }
}

TEST(StabilityTracker, refusesTimeThatGoesBackAndUnknownMethods)
{
    const auto complex = openCube(4);
    const SerialExchange exchange;
    StabilityTracker tracker(options(), exchange);
    tracker.start(snapshot(complex, nowhere, Zero, 1));
    EXPECT_THROW(tracker.advance(snapshot(complex, nowhere, Zero, 1)), BadInput);
    TrackerOptions unknown;
    unknown.reconstruction.method = "magic";
    EXPECT_THROW(StabilityTracker(unknown, exchange), BadInput);
    unknown = TrackerOptions();
    unknown.parametrization.flattening = "iron";
    EXPECT_THROW(StabilityTracker(unknown, exchange), BadInput);
}

TEST(StabilityTracker, threadsChangeNothing)
{
    const auto complex = openCube(16);
    const vector U(0.1, 0.03, -0.02);
    const SerialExchange exchange;
    InterfaceMesh meshes[2];
    scalarField distances[2];
    for (const label run : {0, 1})
    {
        TrackerOptions threaded(options(0.1));
        threaded.nThreads = run ? 4 : 1;
        StabilityTracker tracker(threaded, exchange);
        for (label step = 0; step < 3; ++step)
        {
            const Snapshot next = snapshot(
                complex, shapes::sphere(centre + 0.7 * step * U, radius), U, step
            );
            step ? tracker.advance(next) : tracker.start(next);
            tracker.classify();
        }
        tracker.advance(snapshot(complex, shapes::sphere(centre + 2 * U, radius), U, 3)
        );
        const Classification& result = tracker.classify();
        meshes[run] = result.interface.mesh;
        distances[run] = result.interface.distance;
        EXPECT_GT(tracker.particles().here().size(), 0);
    }
    EXPECT_EQ(meshes[0].points, meshes[1].points);
    EXPECT_EQ(meshes[0].origins, meshes[1].origins);
    EXPECT_EQ(meshes[0].parameters, meshes[1].parameters);
    EXPECT_EQ(distances[0], distances[1]);
}

// A static oblique plane and a flow that leaves it, on both sides of a band of a tenth
// of a cell: not to be had without sharp interfaces (B16).
TEST(StabilityTracker, theDriftOfAnObliquePlane)
{
    const label n = 16;
    const auto complex = openCube(n);
    const vector normal = vector(0.31, 0.47, 1) / mag(vector(0.31, 0.47, 1));
    const shapes::Shape plane = shapes::halfSpace(point(0.5, 0.5, 0.4737), normal);
    const scalar epsilon = 0.1;
    for (const scalar share : {0.95, 1.05})
    {
        TrackerOptions sharp = options(epsilon);
        sharp.reconstruction.sharpening = Sharpening::automatic;
        const SerialExchange exchange;
        StabilityTracker tracker(sharp, exchange);
        const vector U = share * epsilon / n * normal;
        tracker.start(snapshot(complex, plane, U, 0));
        tracker.classify();
        tracker.advance(snapshot(complex, plane, U, 1));
        const ClassifiedSurface& surface = tracker.classify().timeSurface;
        label nInside = 0;
        forAll(surface.stability, pointi)
        {
            const point& x = surface.mesh.points[pointi];
            if (cmptMin(x) > 2.0 / n && cmptMax(x) < 1 - 2.0 / n)
            {
                ++nInside;
                EXPECT_EQ(
                    surface.stability[pointi],
                    share < 1 ? Stability::stable : Stability::detached
                );
            }
        }
        EXPECT_GT(nInside, 100);
    }
}

TEST(StabilityTracker, theDisplacementSoFarIsThatOfTheStatistics)
{
    const auto complex = openCube(20);
    const SerialExchange exchange;
    StabilityTracker tracker(options(), exchange);
    const vector U(0.3, 0.1, -0.2); // [m/s]
    tracker.start(snapshot(complex, shapes::sphere(centre, radius), U, 0));
    tracker.classify();
    EXPECT_EQ(tracker.displacement(), 0);
    for (const scalar time : {0.05, 0.1})
    {
        const point moved(centre + time * U);
        tracker.advance(snapshot(complex, shapes::sphere(moved, radius), U, time));
        EXPECT_NEAR(tracker.displacement(), time * mag(U) / 0.05, 1e-6); // cells
    }
    const scalar before = tracker.displacement();
    EXPECT_EQ(tracker.classify().statistics.displacement, before);
    EXPECT_EQ(tracker.displacement(), 0);
}

TEST(StabilityTracker, tellsThePhasesInTheirOrderAndStopsInThem)
{
    const auto complex = openCube(12);
    const SerialExchange exchange;
    std::vector<Phase> phases;
    TrackerOptions observed(options());
    observed.entering = [&](Phase phase)
    {
        phases.push_back(phase);
        if (phases.size() == 9)
        {
            throw NumericalFailure("as asked");
        }
    };
    StabilityTracker tracker(observed, exchange);
    tracker.start(snapshot(complex, shapes::sphere(centre, radius), Zero, 0));
    tracker.classify();
    tracker.advance(snapshot(complex, shapes::sphere(centre, radius), Zero, 1));
    EXPECT_THROW(tracker.classify(), NumericalFailure);
    const std::vector<Phase> expected{
        Phase::reconstruction, Phase::parametrization, Phase::matching,
        Phase::transfer,       Phase::statistics,      Phase::advection,
        Phase::particles,      Phase::reconstruction,  Phase::matching};
    EXPECT_EQ(phases, expected);
}
