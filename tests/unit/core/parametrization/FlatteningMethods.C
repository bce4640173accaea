// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/parametrization/FlatteningMethods.H"

#include "core/base/Errors.H"
#include "core/parametrization/ChartDistortion.H"
#include "core/parametrization/seams/DiskCut.H"
#include "shapes/ChartOverlap.H"
#include "shapes/RaggedSurface.H"
#include "shapes/Surfaces.H"

#include <gtest/gtest.h>

#include <algorithm>

#include <cfenv>
#include <limits>
#include <vector>

using namespace Foam;
using namespace Foam::stability;
using namespace Foam::stability::shapes;

namespace
{

template<class Vector>
scalar angleBetween(const Vector& a, const Vector& b)
{
    const scalar cosine = (a & b) / (mag(a) * mag(b));
    return std::acos(max(-1.0, min(1.0, cosine)));
}

// Largest difference of a corner's angle in the plane and on the surface [rad].
scalar angleError(const PlainSurface& surface, const List<vector2D>& chart)
{
    scalar largest = 0;
    for (const triFace& t : surface.triangles)
    {
        for (label k = 0; k < 3; ++k)
        {
            const label a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
            const scalar onSurface = angleBetween(
                surface.points[b] - surface.points[a],
                surface.points[c] - surface.points[a]
            );
            const scalar inPlane =
                angleBetween(chart[b] - chart[a], chart[c] - chart[a]);
            largest = max(largest, mag(onSurface - inPlane));
        }
    }
    return largest;
}

// Of a disk that is its own chart.
List<CornerIndices> cornersOf(const PlainSurface& surface)
{
    List<CornerIndices> corners(surface.triangles.size());
    forAll(corners, i)
    {
        const triFace& t = surface.triangles[i];
        corners[i] = CornerIndices{t[0], t[1], t[2]};
    }
    return corners;
}

} // namespace

// Developable surfaces flatten without any error: B8.
TEST(Flattening, IsExactForDevelopableSurfaces)
{
    for (const PlainSurface& surface :
         {openCylinder(0.031, 0.08, 270, 48, 24), openCone(1.3, 0.4, 2, 270, 48, 24)})
    {
        for (const char* name : {"abf", "linAbf", "lscm"})
        {
            SCOPED_TRACE(name);
            const FlatteningResult flat = Flattening::New(name)->flatten(surface);
            EXPECT_LT(angleError(surface, flat.parameters), 1e-8);
            EXPECT_LT(flat.residual, 1e-10);
            EXPECT_TRUE(flat.cause.empty());
            EXPECT_EQ(countFlips(flat.parameters, surface.triangles), 0);
            EXPECT_EQ(countOverlaps(flat.parameters, surface.triangles), 0);
            EXPECT_TRUE(isOneToOne(surface, flat.parameters));
        }
        // CGAL stops ARAP when its energy changes by less than 1e-6.
        EXPECT_LT(
            angleError(surface, Flattening::New("arap")->flatten(surface).parameters),
            1e-3
        );
    }
}

// The conformal map of a hemisphere to the plane magnifies areas at the rim 4 times
// as much as at the pole.
TEST(Flattening, LscmOfAHemisphereIsAlmostConformal)
{
    const PlainSurface surface = hemisphere(point(0.3, 0, 0), 1, 4);
    const List<vector2D> chart = Flattening::New("lscm")->flatten(surface).parameters;
    EXPECT_TRUE(isOneToOne(surface, chart));
    EXPECT_LT(angleError(surface, chart), 0.2);
    EXPECT_EQ(countOverlaps(chart, surface.triangles), 0);
}

// The conformal map of a hemisphere has an L2 stretch of sqrt(7/6) and magnifies areas
// at the rim 4 times as much as at the pole. LSCM, pinned at two points, does not.
TEST(Flattening, AngleBasedOfAHemisphereIsConformal)
{
    const PlainSurface surface = ringedHemisphere(point(0.3, 0, 0), 0.02, 58);
    ASSERT_GT(surface.points.size(), 10000);
    const List<CornerIndices> corners = cornersOf(surface);
    for (const char* name : {"abf", "linAbf", "lscm"})
    {
        SCOPED_TRACE(name);
        const FlatteningResult flat = Flattening::New(name)->flatten(surface);
        EXPECT_TRUE(isOneToOne(surface, flat.parameters));
        const scalar ratio = areaRatioOf(surface, corners, flat.parameters);
        if (name == std::string("lscm"))
        {
            EXPECT_GT(mag(ratio / 4 - 1), 0.03);
            continue;
        }
        const ChartDistortion d = distortionOf(surface, corners, flat.parameters);
        EXPECT_NEAR(d.stretchL2 / std::sqrt(7.0 / 6), 1, 0.005);
        EXPECT_NEAR(ratio / 4, 1, 0.03);
        EXPECT_EQ(flat.iterations == 1, name == std::string("linAbf"));
        EXPECT_EQ(flat.residual < 1e-9, name == std::string("abf"));
    }
}

// On even triangles no other method keeps angles better, and a few iterations do.
TEST(Flattening, AngleBasedKeepsAnglesBest)
{
    PlainSurface ellipsoid = sphere(point(0, 0, 0), 1, 4);
    for (point& p : ellipsoid.points)
    {
        p = point(1.7 * p.x(), 0.8 * p.y(), p.z());
    }
    // CGAL's ARAP cannot solve its equations on the torus.
    const std::vector<std::pair<PlainSurface, std::vector<std::string>>> cases{
        {torus(1, 0.4, 72, 32), {"lscm"}}, {ellipsoid, {"lscm", "arap"}}};
    for (const auto& [whole, others] : cases)
    {
        const PlainSurface surface = DiskCut(whole).disk();
        const List<CornerIndices> corners = cornersOf(surface);
        const FlatteningResult flat = Flattening::New("abf")->flatten(surface);
        EXPECT_LE(flat.iterations, 4);
        EXPECT_LT(flat.residual, 1e-9);
        EXPECT_EQ(countFlips(flat.parameters, surface.triangles), 0);
        const scalar best = distortionOf(surface, corners, flat.parameters).meanAngle;
        EXPECT_GT(best, 0.1); // [degrees]: something to keep
        for (const std::string& name : others)
        {
            const List<vector2D> other =
                Flattening::New(name)->flatten(surface).parameters;
            EXPECT_LT(best, distortionOf(surface, corners, other).meanAngle) << name;
        }
    }
}

// The same bits again, at any place and scale about the same.
TEST(Flattening, AngleBasedIsRepeatable)
{
    PlainSurface surface = ringedHemisphere(point(0.3, 0, 0), 1, 8);
    const List<vector2D> once = Flattening::New("abf")->flatten(surface).parameters;
    EXPECT_EQ(once, Flattening::New("abf")->flatten(surface).parameters);
    for (point& p : surface.points)
    {
        p = 1e-6 * p + point(7, 8, 9);
    }
    const List<vector2D> there = Flattening::New("abf")->flatten(surface).parameters;
    forAll(once, i)
    {
        EXPECT_LT(mag(there[i] - once[i]), 1e-6);
    }
}

// LSCM flips triangles of a raw interface, angle based flattening does not.
TEST(Flattening, AngleBasedTakesRaggedSurfaces)
{
    const boundBox box(point(-1, -1, -.5), point(1, 1, 1));
    const PlainSurface cap = marchingTetrahedra(
        [](const point& p) { return mag(p - point(.013, .021, .007)) - .8; }, box, 16
    );
    for (const char* name : {"abf", "linAbf", "lscm"})
    {
        const FlatteningResult flat = Flattening::New(name)->flatten(cap);
        EXPECT_EQ(
            countFlips(flat.parameters, cap.triangles) == 0, name != std::string("lscm")
        ) << name;
        EXPECT_EQ(flat.residual > 1e-9, name == std::string("linAbf")) << name;
        EXPECT_LE(flat.iterations, 12) << name;
    }
}

// Tutte's map is one-to-one whatever the surface, here one on which LSCM flips.
TEST(Flattening, TutteIsOneToOneOnRaggedSurfaces)
{
    const boundBox box(point(-1, -1, -1), point(1, 1, 1));
    const PlainSurface ball = marchingTetrahedra(
        [](const point& p) { return mag(p - point(.013, .021, .007)) - .6; }, box, 20
    );
    const DiskCut cut(ball);
    const PlainSurface disk = cut.disk();
    const List<vector2D> chart = Flattening::New("tutte")->flatten(disk).parameters;
    EXPECT_TRUE(isOneToOne(disk, chart));
    EXPECT_EQ(countFlips(chart, disk.triangles), 0);
    EXPECT_EQ(countOverlaps(chart, disk.triangles), 0);

    const List<vector2D> conformal = Flattening::New("lscm")->flatten(disk).parameters;
    EXPECT_GT(countFlips(conformal, disk.triangles), 0);
    EXPECT_FALSE(isOneToOne(disk, conformal));
}

// The boundary of Tutte's map lies on a circle, each inner point in the middle of
// its neighbours.
TEST(Flattening, TutteIsBarycentric)
{
    const PlainSurface surface = hemisphere(point(0, 0, 0), 2, 3);
    const List<vector2D> chart = Flattening::New("tutte")->flatten(surface).parameters;
    const label nPoints = surface.points.size();
    const labelList loop = boundaryLoops(nPoints, surface.triangles)[0];
    std::vector<bool> onBoundary(nPoints, false);
    vector2D centre(0, 0);
    for (const label i : loop)
    {
        onBoundary[i] = true;
        centre += chart[i] / loop.size();
    }
    const scalar radius = mag(chart[loop[0]] - centre);
    List<vector2D> sums(nPoints, vector2D(0, 0));
    labelList counts(nPoints, 0);
    const SurfaceTopology topology(nPoints, surface.triangles);
    for (const SurfaceEdge& e : topology.edges())
    {
        sums[e.a] += chart[e.b] - chart[e.a];
        sums[e.b] += chart[e.a] - chart[e.b];
    }
    label nInner = 0;
    forAll(chart, i)
    {
        nInner += !onBoundary[i];
        const scalar error =
            onBoundary[i] ? mag(chart[i] - centre) / radius - 1 : mag(sums[i]) / radius;
        EXPECT_NEAR(error, 0, onBoundary[i] ? 0.02 : 1e-9);
    }
    EXPECT_GT(nInner, 100);
}

// Outward triangles have positive area in the plane, whichever way the surface
// faces.
TEST(Flattening, KeepsOrientation)
{
    PlainSurface surface = openCone(1.3, 0.4, 2, 270, 24, 12);
    for (label turn = 0; turn < 2; ++turn)
    {
        for (const std::string& name : Flattening::names())
        {
            const List<vector2D> chart =
                Flattening::New(name)->flatten(surface).parameters;
            EXPECT_EQ(countFlips(chart, surface.triangles), 0) << name << turn;
        }
        for (triFace& t : surface.triangles)
        {
            t.flip();
        }
    }
}

TEST(Flattening, NamesWhatIsKnown)
{
    try
    {
        Flattening::New("mercator");
        FAIL() << "unknown name accepted";
    }
    catch (const BadInput& error)
    {
        const std::string message = error.what();
        EXPECT_NE(message.find("mercator"), std::string::npos);
        for (const std::string& name : Flattening::names())
        {
            EXPECT_NE(message.find(name), std::string::npos);
        }
    }
}

// Whatever is asked for, Tutte's method stands at the end, and no method twice.
TEST(Flattening, HasFallbacks)
{
    for (const std::string& name : Flattening::names())
    {
        const std::vector<std::string> others = Flattening::fallbacksOf(name);
        EXPECT_EQ(std::count(others.begin(), others.end(), name), 0);
        EXPECT_EQ(others.back(), name == "tutte" ? "lscm" : "tutte");
    }
    const std::vector<std::string> expected{"linAbf", "lscm", "tutte"};
    EXPECT_EQ(Flattening::fallbacksOf("abf"), expected);
}

TEST(Flattening, RefusesWhatIsNoDisk)
{
    for (const std::string& name : Flattening::names())
    {
        const auto method = Flattening::New(name);
        EXPECT_THROW(method->flatten(sphere(point(0, 0, 0), 1, 1)), NumericalFailure);
        PlainSurface flat = annulus(1, 1, 8, 1);
        EXPECT_THROW(method->flatten(flat), NumericalFailure);
    }
}

TEST(OneToOne, SeesAPlantedFlip)
{
    const PlainSurface surface = openCylinder(1, 2, 270, 12, 6);
    List<vector2D> chart = Flattening::New("lscm")->flatten(surface).parameters;
    ASSERT_TRUE(isOneToOne(surface, chart));
    label inner = -1;
    forAll(surface.points, i)
    {
        const point& p = surface.points[i];
        inner = p.z() > 0.9 && p.z() < 1.1 && p.x() < -0.9 ? i : inner;
    }
    ASSERT_GE(inner, 0);
    chart[inner] += vector2D(1, 1) * mag(chart[0] - chart[1]) * 3;
    EXPECT_GT(countFlips(chart, surface.triangles), 0);
    EXPECT_FALSE(isOneToOne(surface, chart));
}

// A strip that winds around by more than a full turn: every triangle is positive,
// only the boundary tells.
TEST(OneToOne, SeesAPlantedOverlap)
{
    const PlainSurface strip =
        grid([](scalar u, scalar v) { return point(7 * u, -v, 0); }, 60, 2);
    for (const scalar turns : {0.9, 1.2})
    {
        List<vector2D> chart(strip.points.size());
        forAll(chart, i)
        {
            const scalar phi = 2 * M_PI * turns * strip.points[i].x() / 7;
            const scalar r = 2 + strip.points[i].y();
            chart[i] = vector2D(-r * std::cos(phi), r * std::sin(phi));
        }
        List<triFace> triangles(strip.triangles);
        PlainSurface surface = strip;
        if (countFlips(chart, triangles) > 0)
        {
            for (triFace& t : surface.triangles)
            {
                t.flip();
            }
        }
        ASSERT_EQ(countFlips(chart, surface.triangles), 0);
        EXPECT_EQ(isOneToOne(surface, chart), turns < 1);
        EXPECT_EQ(countOverlaps(chart, surface.triangles) == 0, turns < 1);
    }
}

// Also where floating point exceptions are trapped, as in OpenFOAM's programs.
TEST(OneToOne, RefusesNonsense)
{
    const PlainSurface surface = openCylinder(1, 2, 270, 6, 3);
    const List<vector2D> chart = Flattening::New("lscm")->flatten(surface).parameters;
    List<vector2D> broken = chart;
    feenableexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW);
    broken[5].x() = std::nan("");
    EXPECT_FALSE(isOneToOne(surface, broken));
    broken[5].x() = std::numeric_limits<scalar>::infinity();
    EXPECT_FALSE(isOneToOne(surface, broken));
    EXPECT_FALSE(isOneToOne(surface, List<vector2D>()));
    EXPECT_FALSE(isOneToOne(surface, List<vector2D>(chart.size(), vector2D(1, 2))));
    fedisableexcept(FE_ALL_EXCEPT);
}
