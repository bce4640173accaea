// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/reconstruction/PlicPolygons.H"
#include "core/base/Errors.H"
#include "core/surface/SurfaceTopology.H"
#include "shapes/ExactAlpha.H"
#include "shapes/PolyMeshes.H"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

using namespace Foam;
using namespace Foam::stability;

namespace
{

const point centreOfBall(0.61, 0.47, 0.53);

shapes::BoxOptions meshBox(label n)
{
    shapes::BoxOptions options;
    options.max = point(1.2, 1, 1.1);
    options.n = Vector<label>(n, n - 1, n + 1);
    return options;
}

List<CellComplexInput> allMeshes(label n)
{
    return {
        shapes::boxInput(meshBox(n)), shapes::perturbedBox(meshBox(n)),
        shapes::tetrahedralBox(meshBox(n)),
        shapes::refinedBox(meshBox(n), [](const point& x) { return x.x() > 0.6; })};
}

ReconstructionResult extract(const FlowSnapshot& snapshot, label nThreads = 1)
{
    ReconstructionOptions options;
    options.method = "plic";
    options.nThreads = nThreads;
    return Reconstruction::New(options)->extract(snapshot);
}

// Each component is the polygon of one cell.
Rows trianglesOfPolygons(const InterfaceMesh& mesh)
{
    const SurfaceTopology topology(mesh.points.size(), mesh.triangles);
    return Rows(
        topology.nComponents(),
        [&](auto&& add)
        {
            forAll(mesh.triangles, trianglei)
            {
                add(topology.components()[trianglei], trianglei);
            }
        }
    );
}

} // namespace

// Measured by another program: what lies behind the polygon of a cell is its alpha.
TEST(PlicPolygons, eachPolygonCutsItsCellAtAlpha)
{
    for (const CellComplexInput& input : allMeshes(6))
    {
        const auto complex = shapes::complexOf(input);
        const FlowSnapshot snapshot =
            shapes::snapshotOf(complex, shapes::sphere(centreOfBall, 0.35));
        const InterfaceMesh mesh = extract(snapshot).mesh;
        const Rows polygons = trianglesOfPolygons(mesh);
        List<bool> seen(complex->nCells(), false);
        label nRight = 0;
        for (label i = 0; i < polygons.size(); ++i)
        {
            vector area(Zero);
            for (const label trianglei : polygons[i])
            {
                area += mesh.areaVector(trianglei);
            }
            const label first = polygons[i][0];
            const label celli = mesh.cells[mesh.triangles[first][0]];
            EXPECT_FALSE(seen[celli]);
            seen[celli] = true;
            const shapes::Shape behind =
                shapes::halfSpace(mesh.centre(first), area / mag(area));
            const scalar alpha = shapes::exactAlpha(*complex, behind)[celli];
            EXPECT_NEAR(alpha, snapshot.alphas[0][celli], 1e-6);
            ++nRight;
        }
        EXPECT_GT(nRight, 50);
    }
}

TEST(PlicPolygons, aBallIsCoveredAndFacesOutwards)
{
    const scalar radius = 0.37;
    for (const CellComplexInput& input : allMeshes(14))
    {
        const auto complex = shapes::complexOf(input);
        const auto result =
            extract(shapes::snapshotOf(complex, shapes::sphere(centreOfBall, radius)));
        const InterfaceMesh& mesh = result.mesh;
        EXPECT_NEAR(mesh.area() / (4 * M_PI * sqr(radius)), 1, 0.03);
        scalar outwards = 0;
        forAll(mesh.triangles, trianglei)
        {
            const vector arm = mesh.centre(trianglei) - centreOfBall;
            outwards += (arm & mesh.areaVector(trianglei)) / mag(arm);
        }
        EXPECT_GT(outwards / mesh.area(), 0.98);
        EXPECT_EQ(result.nFailed, 0);
        EXPECT_EQ(result.volumeError(), 0);
        EXPECT_GT(result.volume, 0.2);
        EXPECT_EQ(mesh.corners.size(), mesh.triangles.size());
        EXPECT_EQ(mesh.origins.size(), mesh.points.size());
        EXPECT_EQ(mesh.materials, List<labelPair>(mesh.triangles.size(), {0, 1}));
    }
}

TEST(PlicPolygons, cornersOnWallsKnowTheirFace)
{
    for (const CellComplexInput& input : allMeshes(8))
    {
        const auto complex = shapes::complexOf(input);
        const boundBox& bounds = complex->bounds();
        const InterfaceMesh mesh =
            extract(shapes::snapshotOf(
                        complex, shapes::halfSpace(centreOfBall, vector(1, 0.7, -0.4))
                    ))
                .mesh;
        label nOnWalls = 0;
        forAll(mesh.points, pointi)
        {
            const point& x = mesh.points[pointi];
            const scalar h = complex->cellSizes()[mesh.cells[pointi]];
            EXPECT_EQ(mesh.cellSizes[pointi], h);
            scalar toWall = GREAT;
            for (direction d = 0; d < 3; ++d)
            {
                toWall = min(toWall, x[d] - bounds.min()[d]);
                toWall = min(toWall, bounds.max()[d] - x[d]);
            }
            const label facei = mesh.boundaryFaces[pointi];
            EXPECT_EQ(facei >= 0, toWall < 1e-10 * h);
            if (facei >= 0)
            {
                const label i = complex->nInternalFaces() + facei;
                const vector arm = x - complex->faceCentres()[i];
                EXPECT_NEAR(arm & complex->faceAreas()[i], 0, 1e-12);
                EXPECT_LT(mag(arm), 2 * h);
                ++nOnWalls;
            }
        }
        EXPECT_GT(nOnWalls, 20);
        EXPECT_LT(nOnWalls, mesh.points.size() / 2);
    }
}

// A start from setFields: the faces between full and empty cells, their areas exact.
TEST(PlicPolygons, aSharpStartIsMadeOfFaces)
{
    const auto complex = shapes::complexOf(shapes::boxInput(meshBox(10)));
    scalarField alpha(complex->nCells());
    forAll(alpha, celli)
    {
        const point& x = complex->cellCentres()[celli];
        alpha[celli] = x.x() < 0.6 && x.z() < 0.55;
    }
    const auto result = extract(shapes::snapshotOf(complex, alpha));
    vector total(Zero);
    forAll(result.mesh.triangles, trianglei)
    {
        total += result.mesh.areaVector(trianglei);
    }
    const scalar height = result.alphaVolume / 0.6;
    EXPECT_NEAR(total.x(), height, 1e-12); // on the side of the second material
    EXPECT_NEAR(total.y(), 0, 1e-12);
    EXPECT_NEAR(total.z(), 0.6, 1e-12);
    EXPECT_NEAR(result.mesh.area(), height + 0.6, 1e-12);
    EXPECT_GT(height, 0.4);
}

// A column of setFields a little later: what the flow carried over its faces is a
// trace, and the planes of these cells are slivers. Whatever they hide, the column is
// covered, and not twice.
TEST(PlicPolygons, aStartThatLeaksIsCovered)
{
    const auto complex = shapes::complexOf(shapes::boxInput(meshBox(20)));
    std::mt19937 random(5);
    for (const scalar leak : {1e-5, 1e-3, 0.03})
    {
        scalarField alpha(complex->nCells());
        forAll(alpha, celli)
        {
            const point& x = complex->cellCentres()[celli];
            const bool water = x.x() < 0.6 && x.z() < 0.55;
            const scalar lost = leak * (random() % 1000) / 1000;
            alpha[celli] = water ? 1 : lost * (x.x() < 0.66 && x.z() < 0.6);
        }
        const InterfaceMesh mesh = extract(shapes::snapshotOf(complex, alpha)).mesh;
        const scalar height = 11 * 1.1 / 21;
        const scalar truth = height + 0.6;
        EXPECT_GT(mesh.area(), 0.93 * truth) << leak;
        EXPECT_LT(mesh.area(), 1.05 * truth) << leak;
    }
}

// A plane that runs along faces, crosses them at a small angle and has nearly full
// cells next to nearly empty ones: its polygons cover it, and no face does.
TEST(PlicPolygons, anObliquePlaneIsNotCoveredTwice)
{
    for (const CellComplexInput& input : allMeshes(12))
    {
        const auto complex = shapes::complexOf(input);
        for (const vector& normal :
             {vector(0.02, 0.05, 1), vector(-0.11, 0.07, 1), vector(0.3, 0.2, 1)})
        {
            const FlowSnapshot snapshot =
                shapes::snapshotOf(complex, shapes::halfSpace(centreOfBall, normal));
            const scalarField& alpha = snapshot.alphas[0];
            label nJumps = 0;
            for (label facei = 0; facei < complex->nInternalFaces(); ++facei)
            {
                const scalar a = alpha[complex->owner()[facei]];
                const scalar b = alpha[complex->neighbour()[facei]];
                nJumps += max(a, b) > 0.9 && min(a, b) < 0.1;
            }
            EXPECT_GT(nJumps, 3) << normal.x();
            const InterfaceMesh mesh = extract(snapshot).mesh;
            EXPECT_NEAR(mesh.area() / (1.2 * mag(normal)), 1, 0.02) << normal.x();
            const Rows polygons = trianglesOfPolygons(mesh);
            std::set<label> cells;
            for (label i = 0; i < polygons.size(); ++i)
            {
                cells.insert(mesh.cells[mesh.triangles[polygons[i][0]][0]]);
            }
            EXPECT_EQ(label(cells.size()), polygons.size()) << normal.x();
        }
    }
}

// A droplet in one cell whose neighbours do not tell where it faces.
TEST(PlicPolygons, cellsWithoutAPlaneAreCounted)
{
    const auto complex = shapes::unitCube(5);
    scalarField alpha(complex->nCells(), 0);
    alpha[complex->findCell(point(0.5, 0.5, 0.5))] = 0.4;
    const auto result = extract(shapes::snapshotOf(complex, alpha));
    EXPECT_EQ(result.nFailed, 1);
    EXPECT_TRUE(result.mesh.empty());
    EXPECT_NEAR(result.volume, 0.4 / 125, 1e-15);
}

TEST(PlicPolygons, threadsDoNotMatter)
{
    const auto complex = shapes::complexOf(shapes::perturbedBox(meshBox(10)));
    const FlowSnapshot snapshot =
        shapes::snapshotOf(complex, shapes::sphere(centreOfBall, 0.35));
    const InterfaceMesh one = extract(snapshot).mesh;
    const InterfaceMesh three = extract(snapshot, 3).mesh;
    EXPECT_GT(one.points.size(), 500);
    EXPECT_EQ(one.points, three.points);
    EXPECT_EQ(one.triangles, three.triangles);
    EXPECT_EQ(one.boundaryFaces, three.boundaryFaces);
}

TEST(PlicPolygons, isNeitherSmoothedNorSharpened)
{
    ReconstructionOptions options;
    options.method = "plic";
    options.smooth = 1;
    EXPECT_THROW(Reconstruction::New(options), BadInput);
    options.smooth = 0;
    options.sharpening = Sharpening::plic;
    EXPECT_THROW(Reconstruction::New(options), BadInput);
}
