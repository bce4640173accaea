// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/parametrization/ChartPacking.H"
#include "core/parametrization/Parametrization.H"

#include "core/base/Errors.H"
#include "core/parametrization/SurfaceShape.H"
#include "shapes/ChartOverlap.H"
#include "shapes/RaggedSurface.H"
#include "shapes/Surfaces.H"
#include "shapes/OneRank.H"

#include <gtest/gtest.h>

#include <cfenv>
#include <vector>

using namespace Foam;
using namespace Foam::stability;
using namespace Foam::stability::shapes;

namespace
{

const boundBox unitBox(point(-1, -1, -1), point(1, 1, 1));
const label n = 20;
const scalar h = 2.0 / n;

scalar ball(const point& p, const point& centre, scalar radius)
{
    return mag(p - centre) - radius;
}

// A ragged cap on the floor, a drop, a torus above and a droplet of a few triangles.
InterfaceMesh raggedScene()
{
    return asInterface(
        marchingTetrahedra(
            [](const point& p)
            {
                const scalar ring = std::hypot(p.x() - 0.013, p.y() + 0.021) - 0.6;
                return min(
                    min(ball(p, point(-.213, .121, -1), 0.7),
                        std::hypot(ring, p.z() - 0.467) - 0.23),
                    min(ball(p, point(0.6123, 0.631, -0.537), 0.21),
                        ball(p, point(0.69, -0.58, -0.513), 0.06))
                );
            },
            unitBox, n
        ),
        h
    );
}

scalar parameterArea(const InterfaceMesh& mesh)
{
    scalar area = 0;
    for (const triFace& t : parameterTriangles(mesh))
    {
        const List<vector2D>& p = mesh.parameters;
        area += 0.5 * (p[t[1]] - p[t[0]]).perp(p[t[2]] - p[t[0]]);
    }
    return area;
}

void expectComplete(const ParametrizationResult& result)
{
    const InterfaceMesh& surface = result.surface.mesh;
    const label nPoints = surface.points.size();
    ASSERT_GT(nPoints, 0);
    ASSERT_EQ(surface.corners.size(), surface.triangles.size());
    ASSERT_EQ(surface.materials.size(), surface.triangles.size());
    ASSERT_EQ(surface.cells.size(), nPoints);
    ASSERT_EQ(surface.cellSizes.size(), nPoints);
    ASSERT_EQ(surface.boundaryFaces.size(), nPoints);
    EXPECT_EQ(surface.origins, surface.points);
    std::vector<bool> used(surface.parameters.size(), false);
    forAll(surface.triangles, trianglei)
    {
        ASSERT_TRUE(surface.parametrized(trianglei));
        for (label k = 0; k < 3; ++k)
        {
            ASSERT_LT(surface.corners[trianglei][k], surface.parameters.size());
            used[surface.corners[trianglei][k]] = true;
        }
    }
    for (const bool u : used)
    {
        EXPECT_TRUE(u);
    }
}

// In the square, clear of the swatch, one-to-one, at one scale.
void expectInjective(const ParametrizationResult& result)
{
    const InterfaceMesh& surface = result.surface.mesh;
    for (const vector2D& p : surface.parameters)
    {
        EXPECT_GE(min(p.x(), p.y()), 0);
        EXPECT_LE(max(p.x(), p.y()), 1);
        EXPECT_FALSE(p.x() > 1 - Swatches::size && p.y() < Swatches::size);
    }
    EXPECT_EQ(countFlips(surface.parameters, parameterTriangles(surface)), 0);
    EXPECT_EQ(countOverlaps(surface), 0);
    EXPECT_NEAR(parameterArea(surface) / surface.area() / sqr(result.scale), 1, 1e-8);
}

} // namespace

TEST(Parametrization, OfARaggedSceneIsInjective)
{
    const InterfaceMesh mesh = raggedScene();
    const ParametrizationResult result = parametrize(mesh, ParametrizationOptions());
    expectComplete(result);
    expectInjective(result);
    EXPECT_EQ(result.nCharts, 4);
    EXPECT_EQ(result.nFallbacks, 0);
    EXPECT_EQ(result.nKept, 1);
    EXPECT_GT(result.remeshingDistance, 0);
    EXPECT_LT(result.remeshingDistance, 0.25 * h);
    EXPECT_NEAR(result.surface.mesh.area() / mesh.area(), 1, 0.05);
    for (const scalar size : result.surface.mesh.cellSizes)
    {
        EXPECT_EQ(size, h);
    }
}

// Points on the boundary of the domain, and these alone, know a face of it.
TEST(Parametrization, KnowsTheBoundary)
{
    const ParametrizationResult result =
        parametrize(raggedScene(), ParametrizationOptions());
    label nOnBoundary = 0;
    forAll(result.surface.mesh.points, i)
    {
        const bool onFloor = result.surface.mesh.points[i].z() < -1 + 1e-9;
        EXPECT_EQ(result.surface.mesh.boundaryFaces[i], onFloor ? 7 : -1);
        nOnBoundary += onFloor;
    }
    EXPECT_GT(nOnBoundary, 40);
}

// A point has several parameters on the seams of the drop and the torus, and one
// everywhere else; the surface itself has no more boundary than before.
TEST(Parametrization, HasSeamsWhereTopologyNeedsThem)
{
    const ParametrizationResult result =
        parametrize(raggedScene(), ParametrizationOptions());
    const InterfaceMesh& surface = result.surface.mesh;
    const SurfaceTopology topology(surface.points.size(), surface.triangles);
    EXPECT_EQ(topology.nNonManifoldEdges(), 0);
    EXPECT_EQ(boundaryLoops(surface.points.size(), surface.triangles).size(), 1);

    label nSeams = 0;
    forAll(surface.triangles, trianglei)
    {
        for (label k = 0; k < 3; ++k)
        {
            const label other = topology.neighbour(trianglei, k);
            if (other < 0)
            {
                continue;
            }
            const label pointi = surface.triangles[trianglei][k];
            const label there = surface.triangles[other].which(pointi);
            const bool seam =
                surface.corners[trianglei][k] != surface.corners[other][there];
            const bool cap =
                surface.points[pointi].z() < -0.1 && surface.points[pointi].x() < 0.4;
            EXPECT_FALSE(seam && cap);
            nSeams += seam;
        }
    }
    EXPECT_GT(nSeams, 40);
}

TEST(Parametrization, OfManyDropletsIsInjective)
{
    std::vector<PlainSurface> drops;
    for (label i = 0; i < 1500; ++i)
    {
        const point centre(3 * (i % 40), 3 * (i / 40), 0.1 * (i % 7));
        drops.push_back(sphere(centre, 0.3 + 0.01 * (i % 13), i % 11 == 0 ? 2 : 0));
    }
    const ParametrizationResult result =
        parametrize(asInterface(inOneScene(drops), 1), ParametrizationOptions());
    EXPECT_EQ(result.nCharts, 1500);
    expectComplete(result);
    expectInjective(result);
}

// OpenFOAM's programs trap floating point exceptions.
TEST(Parametrization, RunsUnderTraps)
{
    const int before = feenableexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW);
    const ParametrizationResult result =
        parametrize(raggedScene(), ParametrizationOptions());
    const int during = fegetexcept();
    fedisableexcept(FE_ALL_EXCEPT);
    feenableexcept(before);
    EXPECT_EQ(
        during & (FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW),
        FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW
    );
    EXPECT_EQ(result.nCharts, 4);
}

TEST(Parametrization, IsRepeatable)
{
    const InterfaceMesh mesh = raggedScene();
    const ParametrizationResult a = parametrize(mesh, ParametrizationOptions());
    const ParametrizationResult b = parametrize(mesh, ParametrizationOptions());
    EXPECT_EQ(a.surface.mesh.points, b.surface.mesh.points);
    EXPECT_EQ(a.surface.mesh.triangles, b.surface.mesh.triangles);
    EXPECT_EQ(a.surface.mesh.parameters, b.surface.mesh.parameters);
    EXPECT_EQ(a.surface.mesh.corners, b.surface.mesh.corners);
    EXPECT_EQ(a.scale, b.scale);
}

TEST(Parametrization, TakesTheMethodAsked)
{
    ParametrizationOptions options;
    options.flattening = "tutte";
    const ParametrizationResult result = parametrize(raggedScene(), options);
    expectInjective(result);
    EXPECT_EQ(result.nFallbacks, 0);
    options.flattening = "orthographic";
    EXPECT_THROW(parametrize(raggedScene(), options), BadInput);
}

// A strip lies along the diagonal, where the square is longest.
TEST(Parametrization, OneChartMakesTheMostOfTheSquare)
{
    const PlainSurface strip =
        grid([](scalar u, scalar v) { return point(5 * u, v, 0.3); }, 50, 10);
    const ParametrizationResult result =
        parametrize(asInterface(strip, 0.2), ParametrizationOptions());
    expectInjective(result);
    EXPECT_NEAR(result.scale, 0.99 * std::sqrt(2.0) / 6, 0.01);
    ASSERT_EQ(result.charts.size(), 1u);
    EXPECT_NEAR(result.charts[0].fill, 5 * sqr(result.scale), 1e-6);
}

TEST(Parametrization, OfNothingIsNothing)
{
    const ParametrizationResult result =
        parametrize(InterfaceMesh(), ParametrizationOptions());
    EXPECT_TRUE(result.surface.mesh.empty());
    EXPECT_EQ(result.nCharts, 0);
    EXPECT_EQ(result.nFallbacks, 0);
}

// A component of no area has no chart; the others do not mind.
TEST(Parametrization, LeavesOutWhatCannotBeFlattened)
{
    PlainSurface flat = openCylinder(1, 1, 90, 4, 2);
    for (point& p : flat.points)
    {
        p = point(1, 2, 3);
    }
    const PlainSurface cap = hemisphere(point(0, 0, 0), 1, 3);
    const ParametrizationResult result = parametrize(
        asInterface(inOneScene({flat, cap}), 0.2), ParametrizationOptions()
    );
    EXPECT_EQ(result.nCharts, 1);
    EXPECT_EQ(result.nFallbacks, 1);
    EXPECT_FALSE(result.surface.mesh.parametrized(0));
    EXPECT_TRUE(
        result.surface.mesh.parametrized(result.surface.mesh.triangles.size() - 1)
    );
    expectInjective(result);
}
