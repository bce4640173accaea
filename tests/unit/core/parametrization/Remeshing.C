// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/parametrization/Remeshing.H"

#include "core/parametrization/SurfaceShape.H"
#include "shapes/RaggedSurface.H"
#include "shapes/Surfaces.H"

#include <gtest/gtest.h>

using namespace Foam;
using namespace Foam::stability;
using namespace Foam::stability::shapes;

namespace
{

const label nLattice = 20;
const scalar latticeSize = 2.0 / nLattice;

PlainSurface raggedCap()
{
    const boundBox box(point(-1, -1, -1), point(1, 1, 1));
    return marchingTetrahedra(
        [](const point& p) { return mag(p - point(.013, .021, -1)) - .9; }, box,
        nLattice
    );
}

scalar smallestAngle(const PlainSurface& surface)
{
    scalar smallest = M_PI;
    for (const triFace& t : surface.triangles)
    {
        for (label k = 0; k < 3; ++k)
        {
            const vector a = surface.points[t[(k + 1) % 3]] - surface.points[t[k]];
            const vector b = surface.points[t[(k + 2) % 3]] - surface.points[t[k]];
            smallest = min(smallest, std::atan2(mag(a ^ b), a & b));
        }
    }
    return smallest;
}

} // namespace

// Even triangles of the size asked for, near the original, of the same topology.
TEST(Remeshing, MakesEvenTriangles)
{
    const PlainSurface ragged = raggedCap();
    ASSERT_LT(smallestAngle(ragged), 0.02);
    const RemeshingResult result = remesh(ragged, 0.5 * latticeSize);
    ASSERT_FALSE(result.kept);
    EXPECT_GT(smallestAngle(result.surface), 0.1);
    EXPECT_GT(result.largestDistance, 0);
    EXPECT_LT(result.largestDistance, 0.25 * latticeSize);

    const SurfaceShape shape =
        shapeOf(result.surface.points.size(), result.surface.triangles);
    EXPECT_TRUE(shape.isDisk());

    scalar length = 0;
    const SurfaceTopology topology(
        result.surface.points.size(), result.surface.triangles
    );
    for (const SurfaceEdge& e : topology.edges())
    {
        length += mag(result.surface.points[e.a] - result.surface.points[e.b]);
    }
    length /= topology.edges().size();
    EXPECT_NEAR(length / (0.5 * latticeSize), 1, 0.2);
}

TEST(Remeshing, KeepsTheBoundary)
{
    const PlainSurface ragged = raggedCap();
    const RemeshingResult result = remesh(ragged, 0.5 * latticeSize);
    const labelList loop =
        boundaryLoops(result.surface.points.size(), result.surface.triangles)[0];
    scalar length = 0;
    forAll(loop, i)
    {
        const point& p = result.surface.points[loop[i]];
        EXPECT_NEAR(p.z(), -1, 1e-12);
        length += mag(p - result.surface.points[loop[loop.fcIndex(i)]]);
    }
    EXPECT_NEAR(length / (2 * M_PI * 0.9), 1, 0.03);

    // Points of the boundary take after points of the boundary.
    for (const label i : loop)
    {
        EXPECT_NEAR(ragged.points[result.nearest[i]].z(), -1, 1e-12);
    }
}

// Rows of long triangles, every other one shifted: the middle of an edge of the
// boundary is nearer to a point inside than to its ends.
TEST(Remeshing, TakesAfterTheBoundaryOnTheBoundary)
{
    const label nu = 8, nv = 40;
    const PlainSurface rows = grid(
        [&](scalar u, scalar v)
        {
            const bool odd = label(std::round(v * nv)) % 2 == 1;
            return point(2 * u + (odd ? -1.0 / nu : 0), v, 0);
        },
        nu, nv
    );
    const RemeshingResult result = remesh(rows, 0.06);
    ASSERT_FALSE(result.kept);
    label nBetween = 0;
    forAll(result.surface.points, i)
    {
        const point& p = result.surface.points[i];
        if (p.y() < 1e-12 && mag(p.x() - 1) < 0.7) // away from the sides
        {
            EXPECT_LT(rows.points[result.nearest[i]].y(), 1e-12);
            nBetween += mag(p.x() * nu / 2 - std::round(p.x() * nu / 2)) > 0.3;
        }
    }
    EXPECT_GT(nBetween, 4);
}

// Each point of the copy is next to the one it is said to take after.
TEST(Remeshing, KnowsTheNearestPoints)
{
    const PlainSurface ragged = raggedCap();
    const RemeshingResult result = remesh(ragged, 0.5 * latticeSize);
    ASSERT_EQ(result.nearest.size(), result.surface.points.size());
    forAll(result.nearest, i)
    {
        const scalar d =
            mag(result.surface.points[i] - ragged.points[result.nearest[i]]);
        EXPECT_LT(d, latticeSize);
    }
}

// A boundary that turns sharply, as in an edge of the domain, keeps its corners.
TEST(Remeshing, KeepsCornersOfTheBoundary)
{
    const PlainSurface square = grid(
        [](scalar u, scalar v)
        { return point(u, v + 0.1 * std::sin(3 * u), 0.3 * u * v); },
        40, 40
    );
    const RemeshingResult result = remesh(square, 0.1);
    ASSERT_FALSE(result.kept);
    for (const point& corner :
         {point(0, 0, 0), point(1, 0.1 * std::sin(3.0), 0), point(0, 1, 0),
          point(1, 1 + 0.1 * std::sin(3.0), 0.3)})
    {
        scalar nearest = GREAT;
        for (const point& p : result.surface.points)
        {
            nearest = min(nearest, mag(p - corner));
        }
        EXPECT_LT(nearest, 1e-12);
    }
}

TEST(Remeshing, DoesNotDependOnUnits)
{
    PlainSurface small = raggedCap();
    for (point& p : small.points)
    {
        p = 1e-6 * p + vector(3, 0, 0);
    }
    const RemeshingResult result = remesh(small, 1e-6 * 0.5 * latticeSize);
    EXPECT_FALSE(result.kept);
    EXPECT_LT(result.largestDistance, 1e-6 * 0.25 * latticeSize);
}

TEST(Remeshing, KeepsWhatIsTooSmall)
{
    for (const label levels : {0, 2})
    {
        const PlainSurface drop = sphere(point(1, 2, 3), 0.1, levels);
        const RemeshingResult result = remesh(drop, 0.5);
        EXPECT_TRUE(result.kept);
        EXPECT_EQ(result.largestDistance, 0);
        EXPECT_EQ(result.surface.triangles, drop.triangles);
        EXPECT_EQ(result.nearest, identity(drop.points.size()));
    }
}

// Three triangles at an edge cannot be remeshed.
TEST(Remeshing, KeepsWhatIsNotManifold)
{
    PlainSurface surface = raggedCap();
    const triFace t = surface.triangles[7];
    surface.points.append(surface.points[t[0]] + vector(0, 0, 0.3));
    surface.triangles.append(triFace(t[0], t[1], surface.points.size() - 1));
    const RemeshingResult result = remesh(surface, 0.5 * latticeSize);
    EXPECT_TRUE(result.kept);
    EXPECT_EQ(result.failure, "it is not manifold");
}

// Points where there is no number, without an end of the run.
TEST(Remeshing, KeepsWhatIsNotFinite)
{
    PlainSurface surface = raggedCap();
    surface.points[surface.triangles[7][0]].x() = std::nan("");
    const RemeshingResult result = remesh(surface, 0.5 * latticeSize);
    EXPECT_TRUE(result.kept);
    EXPECT_EQ(result.surface.triangles, surface.triangles);
}

// What is too small is kept as it should be.
TEST(Remeshing, SaysNothingWhereNothingFailed)
{
    EXPECT_EQ(remesh(raggedCap(), 0.5 * latticeSize).failure, "");
    const RemeshingResult small = remesh(sphere(point(1, 2, 3), 0.1, 2), 0.5);
    EXPECT_TRUE(small.kept);
    EXPECT_EQ(small.failure, "");
}

TEST(Remeshing, IsRepeatable)
{
    const PlainSurface ragged = raggedCap();
    const RemeshingResult a = remesh(ragged, 0.5 * latticeSize);
    const RemeshingResult b = remesh(ragged, 0.5 * latticeSize);
    EXPECT_EQ(a.surface.triangles, b.surface.triangles);
    EXPECT_EQ(a.surface.points, b.surface.points);
}
