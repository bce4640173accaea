// SPDX-License-Identifier: GPL-3.0-or-later

// The whole method in two dimensions and in a wedge, judged by exact solutions.

#include "core/StabilityTracker.H"
#include "core/surface/Ribbon.H"
#include "shapes/AnalyticFlows.H"
#include "shapes/ExactAlpha.H"
#include "shapes/MeshParts.H"
#include "shapes/SectionMesh.H"
#include "shapes/ThreadRanks.H"

#include <gtest/gtest.h>

#include <cmath>

namespace Foam::stability
{

namespace
{

using SectionFlow = std::function<vector(const point&)>; // [m/s]

constexpr scalar turn = 0.3; // [rad] per interval
const point pivot(11.9, 12.1, 0), firstCentre(14.6, 12.9, 0);

shapes::SectionOptions room(direction normal, scalar meshThickness = 1)
{
    shapes::SectionOptions options;
    options.max = point(24, 23, 0);
    options.nx = 24;
    options.ny = 23;
    options.normal = normal;
    options.middle = 0.2;
    options.meshThickness = meshThickness;
    options.kinds = BoundaryKind::open;
    return options;
}

FlowSnapshot snapshotWith(FlowSnapshot snapshot, const SectionFlow& flow, scalar time)
{
    const CellComplex& complex = *snapshot.complex;
    forAll(snapshot.U, celli)
    {
        snapshot.U[celli] = flow(complex.cellCentres()[celli]);
    }
    forAll(snapshot.boundaryU, i)
    {
        snapshot.boundaryU[i] =
            flow(complex.faceCentres()[complex.nInternalFaces() + i]);
    }
    snapshot.time = time;
    return snapshot;
}

// A disc that turns around the pivot.
class TurningDisc
{
public:
    // On another mesh than the section, if one is given.
    explicit TurningDisc(
        const shapes::SectionOptions& options,
        const std::shared_ptr<const CellComplex>& other = nullptr
    )
        : complex(other ? other : shapes::section(options)),
          section(*shapes::section(options)->whole().section),
          pivot_(shapes::placed(options, pivot)),
          first_(shapes::placed(options, firstCentre))
    {
    }

    point turned(const point& x, scalar angle) const
    {
        const vector d = x - pivot_, within = section.inPlane(d);
        return x - within + std::cos(angle) * within
               + std::sin(angle) * (section.normal ^ within);
    }

    // With a velocity that is too large by this share.
    FlowSnapshot at(scalar time, scalar tooFast = 0) const
    {
        const point centre = turned(first_, turn * time);
        const shapes::Shape disc = [=](const point& x)
        { return mag(section.inPlane(x - centre)) - 4.8; };
        const shapes::Flow flow =
            shapes::rotation(pivot_, (1 + tooFast) * turn * section.normal);
        return snapshotWith(
            shapes::snapshotOf(complex, disc),
            [&](const point& x) { return flow(x, time); }, time
        );
    }

    // Along the interface: the mean error of the origins [m], 40 transfers on or not.
    scalar originError(const InterfaceMesh& mesh, scalar time) const
    {
        scalar sum = 0;
        forAll(mesh.triangles, trianglei)
        {
            for (label k = 0; k < 3; ++k)
            {
                const point& x = mesh.points[mesh.triangles[trianglei][k]];
                const point back = turned(x, -turn * time);
                const vector error = section.inPlane(mesh.origin(trianglei, k) - back);
                const vector radial = section.inPlane(back - first_);
                sum += mag(error & (section.normal ^ radial)) / mag(radial);
            }
        }
        return sum / (3 * mesh.triangles.size());
    }

    std::shared_ptr<const CellComplex> complex;
    PlaneSection section;

private:
    point pivot_, first_;
};

TrackerOptions sharp(scalar epsilon)
{
    TrackerOptions options;
    options.matching.epsilon.value = epsilon;
    options.reconstruction.sharpening = Sharpening::automatic;
    return options;
}

std::shared_ptr<const FlowSnapshot> shared(FlowSnapshot snapshot)
{
    return std::make_shared<const FlowSnapshot>(std::move(snapshot));
}

scalar detachedArea(const Statistics& s)
{
    return s.detachedNearWall + s.detachedElsewhere;
}

// Both points of each pair have one class, one origin within the section and one u, and
// v from one end to the other. Returns the number of points without a partner.
label expectConstantAcross(
    const ClassifiedSurface& surface, const PlaneSection& section
)
{
    const InterfaceMesh& mesh = surface.mesh;
    const labelList pairs(pairsAcross(mesh, section));
    label nSingle = 0;
    forAll(pairs, pointi)
    {
        nSingle += pairs[pointi] == pointi;
        EXPECT_EQ(surface.stability[pointi], surface.stability[pairs[pointi]]);
        EXPECT_NEAR(surface.distance[pointi], surface.distance[pairs[pointi]], 1e-12);
    }
    forAll(mesh.triangles, trianglei)
    {
        const triFace& t = mesh.triangles[trianglei];
        for (label k = 0; k < 3; ++k)
        {
            const label l = (k + 1) % 3;
            if (pairs[t[k]] == t[l] && mesh.parametrized(trianglei))
            {
                const vector2D& p = mesh.parameters[mesh.corners[trianglei][k]];
                const vector2D& q = mesh.parameters[mesh.corners[trianglei][l]];
                EXPECT_NEAR(p.x(), q.x(), 1e-9);
                EXPECT_GT(mag(p.y() - q.y()), 0.9);
                EXPECT_LT(
                    mag(section.inPlane(
                        mesh.origin(trianglei, k) - mesh.origin(trianglei, l)
                    )),
                    1e-9
                );
            }
        }
    }
    return nSingle;
}

} // namespace

TEST(TwoDimensions, aDiscInRotationStaysWhole)
{
    const TurningDisc disc(room(1));
    const SerialExchange exchange;
    StabilityTracker tracker(sharp(0.05), exchange);
    tracker.start(shared(disc.at(0)));
    tracker.classify();
    constexpr label nTransfers = 40;
    for (label i = 1; i <= nTransfers; ++i)
    {
        tracker.advance(shared(disc.at(i)));
        const Classification& result = tracker.classify();
        EXPECT_EQ(result.nTornEdges, 0);
        const Statistics& s = result.statistics;
        EXPECT_EQ(detachedArea(s), 0);
        EXPECT_NEAR(s.stableArea / s.area, 1, 1e-12);
        EXPECT_NEAR(s.coverage(), 1, 1e-12);
        EXPECT_NEAR(s.area, 2 * M_PI * 4.8, 0.1);
        EXPECT_EQ(result.transfer.nUnresolved, 0);
        // The seam alone divides a strip: two points in the planes, one on the
        // diagonal.
        EXPECT_LE(expectConstantAcross(result.interface, disc.section), 3);
        if (i == nTransfers)
        {
            EXPECT_LT(disc.originError(result.interface.mesh, i), 0.002);
        }
    }
    EXPECT_EQ(tracker.particles().nSeeded(), 0);
}

// The fluid is too fast by a seventh: it leaves the disc behind.
TEST(TwoDimensions, theThicknessDoesNotCount)
{
    std::vector<ClassifiedSurface> interfaces, timeSurfaces;
    std::vector<Statistics> statistics;
    scalarField weights(3, 0);
    const scalar thicknesses[3] = {1, 1e-3, 1e3};
    for (label i = 0; i < 3; ++i)
    {
        const TurningDisc disc(room(2, thicknesses[i]));
        const SerialExchange exchange;
        StabilityTracker tracker(sharp(0.1), exchange);
        tracker.start(shared(disc.at(0, 0.14)));
        tracker.classify();
        tracker.advance(shared(disc.at(1, 0.14)));
        const Classification& result = tracker.classify();
        EXPECT_EQ(result.nTornEdges, 0);
        interfaces.push_back(result.interface);
        timeSurfaces.push_back(result.timeSurface);
        statistics.push_back(result.statistics);
        for (const InstabilityParticle& particle : tracker.particles().here())
        {
            EXPECT_EQ(particle.path.x & disc.section.normal, disc.section.middle);
            weights[i] += particle.weight;
        }
        EXPECT_GT(detachedArea(result.statistics), 0.2 * result.statistics.area);
        // As many as points and strips that detached, not twice as many.
        const InterfaceMesh& T = result.timeSurface.mesh;
        EXPECT_LT(tracker.particles().nSeeded(), T.points.size());
    }
    for (label i = 1; i < 3; ++i)
    {
        EXPECT_EQ(interfaces[i].stability, interfaces[0].stability);
        EXPECT_EQ(timeSurfaces[i].stability, timeSurfaces[0].stability);
        EXPECT_EQ(timeSurfaces[i].distance, timeSurfaces[0].distance);
        EXPECT_EQ(interfaces[i].mesh.parameters, interfaces[0].mesh.parameters);
        EXPECT_EQ(statistics[i].noiseFloor, statistics[0].noiseFloor);
        const scalar factor = thicknesses[i];
        EXPECT_NEAR(statistics[i].area / statistics[0].area, factor, 1e-9 * factor);
        EXPECT_NEAR(
            detachedArea(statistics[i]) / detachedArea(statistics[0]), factor,
            1e-9 * factor
        );
        EXPECT_NEAR(weights[i] / weights[0], factor, 1e-9 * factor);
    }
    // Half of the particles' area lies at points, half in strips, some of which are
    // detached at one end only.
    EXPECT_NEAR(weights[0] / detachedArea(statistics[0]), 1, 0.07);
}

TEST(TwoDimensions, theSameOnSeveralRanks)
{
    const TurningDisc disc(room(2));
    std::vector<ClassifiedSurface> interfaces, timeSurfaces;
    std::vector<Statistics> statistics;
    for (const label nRanks : {1, 2, 3})
    {
        const shapes::MeshParts parts(
            disc.complex, shapes::irregularParts(*disc.complex, nRanks)
        );
        shapes::onRanks(
            nRanks,
            [&](const Exchange& exchange)
            {
                const auto complex = parts.part(exchange, 9);
                StabilityTracker tracker(sharp(0.1), exchange);
                tracker.start(parts.part(complex, disc.at(0, 0.14)));
                tracker.classify();
                for (const label i : {1, 2})
                {
                    tracker.advance(parts.part(complex, disc.at(i, 0.14)));
                    tracker.classify();
                }
                tracker.advance(parts.part(complex, disc.at(3, 0.14)));
                const Classification& result = tracker.classify();
                EXPECT_EQ(result.nTornEdges, 0);
                const ClassifiedSurface interface =
                    gathered(result.interface, exchange);
                const ClassifiedSurface timeSurface =
                    gathered(result.timeSurface, exchange);
                if (exchange.isMaster())
                {
                    interfaces.push_back(interface);
                    timeSurfaces.push_back(timeSurface);
                    statistics.push_back(result.statistics);
                }
            }
        );
    }
    for (label i = 1; i < 3; ++i)
    {
        EXPECT_EQ(interfaces[i].mesh.points, interfaces[0].mesh.points);
        EXPECT_EQ(interfaces[i].mesh.triangles, interfaces[0].mesh.triangles);
        EXPECT_EQ(interfaces[i].mesh.parameters, interfaces[0].mesh.parameters);
        EXPECT_EQ(interfaces[i].stability, interfaces[0].stability);
        EXPECT_EQ(timeSurfaces[i].stability, timeSurfaces[0].stability);
        EXPECT_EQ(statistics[i].nVertices, statistics[0].nVertices);
        EXPECT_EQ(statistics[i].area, statistics[0].area);
        EXPECT_EQ(detachedArea(statistics[i]), detachedArea(statistics[0]));
        EXPECT_EQ(statistics[i].nParticles, statistics[0].nParticles);
    }
}

// Eight layers of cells in three dimensions between symmetry planes, with a surface
// that is remeshed and triangles of their own.
TEST(TwoDimensions, asManyLayersBetweenSymmetryPlanes)
{
    const shapes::SectionOptions options(room(2));
    shapes::BoxOptions layers;
    layers.min = options.min + vector(0, 0, options.middle - 4);
    layers.max = options.max + vector(0, 0, options.middle + 4);
    layers.n = Vector<label>(options.nx, options.ny, 8);
    layers.kinds = BoundaryKind::open;
    layers.kinds[4] = layers.kinds[5] = BoundaryKind::symmetry;
    const TurningDisc discs[2] = {
        TurningDisc(options), TurningDisc(options, shapes::box(layers))};
    constexpr scalar epsilon = 0.1, facets = 0.025; // [cells]
    ClassifiedSurface T[2];
    scalar shares[2] = {0, 0};
    for (label i = 0; i < 2; ++i)
    {
        const SerialExchange exchange;
        StabilityTracker tracker(sharp(epsilon), exchange);
        tracker.start(shared(discs[i].at(0, 0.14)));
        tracker.classify();
        tracker.advance(shared(discs[i].at(1, 0.14)));
        const Classification& result = tracker.classify();
        EXPECT_EQ(result.nTornEdges, 0);
        T[i] = result.timeSurface;
        shares[i] = detachedArea(result.statistics) / result.statistics.area;
    }
    EXPECT_NEAR(shares[1] / shares[0], 1, 0.02);
    const SurfaceLocator locator(T[0].mesh.points, T[0].mesh.triangles, 1);
    label nCompared = 0;
    forAll(T[1].mesh.points, pointi)
    {
        const SurfacePoint x =
            locator.closest(discs[0].section.inMiddle(T[1].mesh.points[pointi]), 1);
        ASSERT_GE(x.triangle, 0);
        scalar distance = 0;
        for (label k = 0; k < 3; ++k)
        {
            distance +=
                x.weights[k] * T[0].distance[T[0].mesh.triangles[x.triangle][k]];
        }
        EXPECT_NEAR(T[1].distance[pointi], distance, facets);
        if (mag(distance - epsilon) > facets)
        {
            ++nCompared;
            EXPECT_EQ(
                T[1].stability[pointi] == Stability::detached, distance > epsilon
            );
        }
    }
    EXPECT_GT(nCompared, 0.4 * T[1].mesh.points.size());
}

// Nothing is thin or sub-grid only because there is one layer of cells: a film is, and
// a small disc, whose area decides.
TEST(TwoDimensions, filmsAreThinAndDropletsAreDiscs)
{
    shapes::SectionOptions options(room(2, 0.01));
    for (const bool wedge : {false, true})
    {
        options.wedge = wedge;
        options.kinds[2] = wedge ? BoundaryKind::symmetry : BoundaryKind::open;
        const auto complex = shapes::section(options);
        const PlaneSection& section = *complex->whole().section;
        const point large(8.1, 14.7, 0), small(18.3, 4.2, 0);
        const auto shape = [&](const point& x)
        {
            const scalar film = mag(x.x() - 22.4) - 0.6;
            return std::min(
                film, std::min(
                          mag(section.inPlane(x - large)) - 4.8,
                          mag(section.inPlane(x - small)) - 1.2
                      )
            );
        };
        const SerialExchange exchange;
        StabilityTracker tracker(sharp(0.05), exchange);
        tracker.start(
            shared(shapes::snapshotOf(complex, shapes::sectionAlpha(*complex, shape)))
        );
        const Classification& result = tracker.classify();
        EXPECT_EQ(result.nTornEdges, 0);
        ASSERT_EQ(result.droplets.size(), 1u);
        const Droplet& droplet = result.droplets[0];
        EXPECT_NEAR(droplet.radius, 1.2, 0.02);
        const scalar volume = M_PI * sqr(1.2) * 0.01 * (wedge ? small.y() : 1);
        EXPECT_NEAR(droplet.volume / volume, 1, 0.005);
        EXPECT_LT(mag(section.inPlane(droplet.centroid - small)), wedge ? 0.1 : 0.03);
        EXPECT_TRUE(droplet.fromAlpha);
        const ClassifiedSurface& interface = result.interface;
        forAll(interface.mesh.points, pointi)
        {
            const point& x = interface.mesh.points[pointi];
            const bool isSmall = mag(section.inPlane(x - small)) < 2;
            const bool isFilm = x.x() > 20.5;
            EXPECT_EQ(interface.subGrid[pointi], isSmall);
            EXPECT_TRUE(isSmall || interface.thin[pointi] == isFilm);
        }
    }
}

// A sphere on the axis of a wedge, drawn out along it: an ellipsoid, known exactly.
TEST(TwoDimensions, aSphereInAWedgeIsDrawnOut)
{
    constexpr scalar rate = 0.04, radius = 4.8, angle = 0.08;
    shapes::SectionOptions options;
    options.max = point(28, 8, 0);
    options.nx = 28;
    options.ny = 8;
    options.wedge = true;
    options.meshThickness = angle; // [m] per metre from the axis
    options.kinds = BoundaryKind::open;
    options.kinds[2] = BoundaryKind::symmetry;
    const auto complex = shapes::section(options);
    const auto ellipse = [](scalar time, const point& x)
    {
        return std::hypot(
                   std::exp(-rate * time) * (x.x() - 14.3),
                   std::exp(0.5 * rate * time) * x.y()
               )
               - radius;
    };
    const auto at = [&](scalar time)
    {
        const auto shape = [&](const point& x) { return ellipse(time, x); };
        return shared(snapshotWith(
            shapes::snapshotOf(complex, shapes::sectionAlpha(*complex, shape)),
            [&](const point& x)
            { return rate * vector(x.x() - 14.3, -0.5 * x.y(), 0); },
            time
        ));
    };
    const SerialExchange exchange;
    StabilityTracker tracker(sharp(0.05), exchange);
    tracker.start(at(0));
    tracker.classify();
    for (label i = 1; i <= 6; ++i)
    {
        tracker.advance(at(i));
        const Classification& result = tracker.classify();
        EXPECT_EQ(result.nTornEdges, 0);
        const Statistics& s = result.statistics;
        EXPECT_EQ(detachedArea(s), 0);
        EXPECT_NEAR(s.volumeError, 0, 0.004);
        const InterfaceMesh& T = result.timeSurface.mesh;
        const scalarField areas(T.pointAreas());
        scalar squares = 0;
        forAll(areas, pointi)
        {
            squares += areas[pointi] * sqr(ellipse(i, T.points[pointi]));
        }
        // Later the tips are sharp: their radius falls to 3 cells.
        EXPECT_LT(std::sqrt(squares / sum(areas)), i <= 4 ? 1e-3 : 3e-3);
        if (i == 1)
        {
            // The area of the sphere, as the wedge has it.
            EXPECT_NEAR(s.area, 2 * angle * sqr(radius), 0.01);
        }
    }
}

} // namespace Foam::stability
