// SPDX-License-Identifier: GPL-3.0-or-later

// Points of alpha = 1/2 moved onto what exact fractions describe (algorithms 1.4).

#include "core/reconstruction/Reconstruction.H"
#include "core/base/Errors.H"
#include "shapes/DualMesh.H"
#include "shapes/ExactAlpha.H"
#include "shapes/PolyMeshes.H"
#include "shapes/SurfaceChecks.H"
#include "shapes/SurfaceErrors.H"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace Foam;
using namespace Foam::stability;

namespace
{

ReconstructionResult
sharpened(const FlowSnapshot& snapshot, Sharpening kind, label nThreads = 2)
{
    ReconstructionOptions options;
    options.sharpening = kind;
    options.nThreads = nThreads;
    return Reconstruction::New(options)->extract(snapshot);
}

// Of an interface whose signed distance is known, by area, in cells and degrees.
struct Errors
{
    scalar rms = 0, largest = 0, normals = 0;
    scalar slivers = 0; // share of triangles with an angle below 5 degrees
    label nFlipped = 0;
};

scalar smallestAngle(const InterfaceMesh& mesh, const triFace& t)
{
    scalar largestCosine = -1;
    for (label k = 0; k < 3; ++k)
    {
        const vector a = mesh.points[t[(k + 1) % 3]] - mesh.points[t[k]];
        const vector b = mesh.points[t[(k + 2) % 3]] - mesh.points[t[k]];
        largestCosine = std::max(largestCosine, (a & b) / (mag(a) * mag(b) + VSMALL));
    }
    return std::acos(std::min(largestCosine, scalar(1))) * 180 / M_PI;
}

Errors errorsOf(const InterfaceMesh& mesh, const shapes::Shape& shape)
{
    Errors e;
    const scalarField areas(mesh.pointAreas());
    forAll(mesh.points, pointi)
    {
        const scalar d = shape(mesh.points[pointi]) / mesh.cellSizes[pointi];
        e.rms += areas[pointi] * sqr(d);
        e.largest = std::max(e.largest, std::abs(d));
    }
    e.rms = std::sqrt(e.rms / sum(areas));
    scalar area = 0;
    forAll(mesh.triangles, trianglei)
    {
        const triFace& t = mesh.triangles[trianglei];
        const vector S = mesh.areaVector(trianglei);
        const vector g =
            shapes::gradient(shape, mesh.centre(trianglei), mesh.cellSizes[t[0]]);
        const scalar cosine = (S & g) / (mag(S) * mag(g) + VSMALL);
        e.nFlipped += cosine <= 0;
        e.normals += mag(S) * sqr(std::acos(std::min(cosine, scalar(1))) * 180 / M_PI);
        area += mag(S);
        e.slivers += smallestAngle(mesh, t) < 5;
    }
    e.normals = std::sqrt(e.normals / area);
    e.slivers /= std::max(mesh.triangles.size(), 1);
    return e;
}

shapes::Shape sheet(const point& origin, const vector& normal, scalar thickness)
{
    const vector n = normal / mag(normal);
    return [=](const point& x) { return std::abs((x - origin) & n) - 0.5 * thickness; };
}

void expectClosed(const InterfaceMesh& mesh)
{
    const shapes::SurfaceReport report = shapes::inspect(mesh);
    EXPECT_EQ(report.nCrowded, 0);
    EXPECT_EQ(report.nRimInside, 0);
    EXPECT_EQ(report.nMisoriented, 0);
}

const point offGrid(9.137, 8.732, 9.281);

} // namespace

TEST(Sharpening, sphereOnHexahedra)
{
    const auto complex = shapes::box(shapes::boxOf(18));
    const shapes::Shape ball = shapes::sphere(offGrid, 4.8);
    const FlowSnapshot snapshot = shapes::snapshotOf(complex, ball);
    const ReconstructionResult result = sharpened(snapshot, Sharpening::automatic);
    expectClosed(result.mesh);
    const Errors e = errorsOf(result.mesh, ball);
    EXPECT_LT(e.rms, 0.002);
    EXPECT_LT(e.largest, 0.01);
    EXPECT_LT(e.normals, 1.6);
    EXPECT_LT(e.slivers, 0.003);
    EXPECT_EQ(e.nFlipped, 0);
    EXPECT_NEAR(result.volumeError(), 0, 0.008);
    EXPECT_NEAR(result.mesh.area() / (4 * M_PI * sqr(4.8)), 1, 0.005);
    EXPECT_NEAR(shapes::enclosedVolume(result.mesh), result.volume, 1e-9);
    EXPECT_EQ(result.sharpening->nRejected, 0);
    EXPECT_EQ(result.sharpening->profileShare, 0); // exact fractions are sharp

    // What the spread of the fits says is about what the points are off.
    scalarField spread(result.sharpening->spread);
    std::sort(spread.begin(), spread.end());
    const scalar noise = spread[label(0.999 * spread.size())];
    EXPECT_GT(noise, e.largest / 3);
    EXPECT_LT(noise, e.largest * 3);
}

TEST(Sharpening, convergesFasterThanTheMesh)
{
    scalar metres[2];
    for (label i = 0; i < 2; ++i)
    {
        const label n = 16 << i;
        shapes::BoxOptions options = shapes::boxOf(n);
        options.max = point(1, 1, 1);
        const shapes::Shape ball = shapes::sphere(point(0.512, 0.487, 0.531), 0.3);
        const ReconstructionResult result = sharpened(
            shapes::snapshotOf(shapes::box(options), ball), Sharpening::automatic
        );
        const Errors e = errorsOf(result.mesh, ball);
        metres[i] = e.rms / n;
        EXPECT_LT(e.rms, i == 0 ? 0.002 : 0.0005);
        EXPECT_LT(e.largest, i == 0 ? 0.01 : 0.002);
        const scalar allowed = i == 0 ? 0.008 : 0.002;
        EXPECT_NEAR(result.volumeError(), 0, allowed);
        EXPECT_NEAR(result.mesh.area() / (4 * M_PI * sqr(0.3)), 1, allowed);
    }
    EXPECT_GT(std::log2(metres[0] / metres[1]), 2.5);
}

TEST(Sharpening, torusAndThinSheets)
{
    const auto complex = shapes::box(shapes::boxOf(34));
    const shapes::Shape ring =
        shapes::torus(point(17.137, 16.732, 17.281), vector(1, 2, 3), 9, 4.8);
    EXPECT_LT(
        errorsOf(
            sharpened(shapes::snapshotOf(complex, ring), Sharpening::automatic).mesh,
            ring
        )
            .rms,
        0.003
    );

    const auto cube = shapes::box(shapes::boxOf(20));
    const vector normals[] = {{1, 0.31, 0.17}, {0.5, 0.9, -0.35}, {0.6, -0.55, 0.58}};
    for (const vector& n : normals)
    {
        const shapes::Shape thin = sheet(point(10.13, 9.83, 10.21), n, 1.5);
        const InterfaceMesh mesh =
            sharpened(shapes::snapshotOf(cube, thin), Sharpening::automatic).mesh;
        // Away from walls, where the sheet is cut off; the area with a weight that goes
        // to zero there, whose integral over a plane is known.
        const point middle(10, 10, 10);
        constexpr scalar reach = 8;
        scalar weighted = 0, exact = 0;
        forAll(mesh.triangles, trianglei)
        {
            const scalar r2 = magSqr(mesh.centre(trianglei) - middle) / sqr(reach);
            weighted += r2 < 1 ? sqr(1 - r2) * mag(mesh.areaVector(trianglei)) : 0;
        }
        for (const scalar side : {-0.75, 0.75})
        {
            const scalar d = ((middle - point(10.13, 9.83, 10.21)) & n) / mag(n) - side;
            exact += M_PI / 3 * sqr(reach) * pow3(1 - sqr(d / reach));
        }
        EXPECT_NEAR(weighted / exact, 1, 0.01) << n.x();
        scalar squares = 0, areas = 0;
        const scalarField area(mesh.pointAreas());
        forAll(mesh.points, pointi)
        {
            if (mag(mesh.points[pointi] - point(10, 10, 10)) < 7)
            {
                squares += area[pointi] * sqr(thin(mesh.points[pointi]));
                areas += area[pointi];
            }
        }
        EXPECT_LT(std::sqrt(squares / areas), 0.005) << n.x();
    }
}

TEST(Sharpening, sphereOnOtherCells)
{
    const auto refine = [](const point& x) { return x.x() > 9; };
    for (const CellComplexInput& input :
         {shapes::perturbedBox(shapes::boxOf(18)),
          shapes::tetrahedralBox(shapes::boxOf(18)),
          shapes::refinedBox(shapes::boxOf(18), refine),
          shapes::dualBox(shapes::boxOf(18))})
    {
        const auto complex = shapes::complexOf(input);
        const shapes::Shape ball = shapes::sphere(offGrid, 4.8);
        const FlowSnapshot snapshot = shapes::snapshotOf(complex, ball);
        for (const Sharpening kind : {Sharpening::automatic, Sharpening::profile})
        {
            const ReconstructionResult result = sharpened(snapshot, kind);
            expectClosed(result.mesh);
            const Errors e = errorsOf(result.mesh, ball);
            EXPECT_LT(e.rms, kind == Sharpening::automatic ? 0.01 : 0.03);
            EXPECT_EQ(e.nFlipped, 0);
        }
    }
}

TEST(Sharpening, sphereThatTouchesWalls)
{
    const auto complex = shapes::box(shapes::boxOf(18));
    const shapes::Shape ball = shapes::sphere(point(9.137, 8.732, 1.281), 4.8);
    const ReconstructionResult result =
        sharpened(shapes::snapshotOf(complex, ball), Sharpening::automatic);
    expectClosed(result.mesh);
    const Errors e = errorsOf(result.mesh, ball);
    EXPECT_LT(e.rms, 0.01);
    EXPECT_EQ(e.nFlipped, 0);
    forAll(result.mesh.points, pointi)
    {
        if (result.mesh.boundaryFaces[pointi] >= 0)
        {
            EXPECT_NEAR(result.mesh.points[pointi].z(), 0, 1e-9);
        }
    }
}

// Fractions of 0 and 1 alone: the interface lies in the faces.
TEST(Sharpening, boxOfSetFields)
{
    const auto complex = shapes::box(shapes::boxOf(12));
    const shapes::Shape water = shapes::block(point(-1, -1, -1), point(5, 13, 7));
    const ReconstructionResult result =
        sharpened(shapes::snapshotOf(complex, water), Sharpening::automatic);
    expectClosed(result.mesh);
    label nOnFaces = 0, nAwayFromEdges = 0;
    forAll(result.mesh.points, pointi)
    {
        const point& x = result.mesh.points[pointi];
        if (x.x() < 3.5 || x.z() < 5.5) // not at the edge between the two sides
        {
            ++nAwayFromEdges;
            nOnFaces += std::min(mag(x.x() - 5), mag(x.z() - 7)) < 0.02;
        }
    }
    EXPECT_GT(nAwayFromEdges, 100);
    EXPECT_EQ(nOnFaces, nAwayFromEdges);
}

TEST(Sharpening, smearedPlane)
{
    const auto complex = shapes::box(shapes::boxOf(16));
    const vector n = vector(1, 0.4, 0.7) / mag(vector(1, 0.4, 0.7));
    const point origin(8.13, 7.87, 8.21);
    scalarField alpha(complex->nCells());
    forAll(alpha, celli)
    {
        const scalar z = (complex->cellCentres()[celli] - origin) & n;
        alpha[celli] = 1 / (1 + std::exp(3 * z)); // about four cells wide
    }
    const shapes::Shape plane = shapes::halfSpace(origin, n);
    const FlowSnapshot snapshot = shapes::snapshotOf(complex, alpha);
    const ReconstructionResult result = sharpened(snapshot, Sharpening::automatic);
    EXPECT_GT(result.sharpening->profileShare, 0.5);
    scalar largest[2] = {0, 0};
    for (label i = 0; i < 2; ++i)
    {
        const InterfaceMesh mesh =
            sharpened(snapshot, i ? Sharpening::profile : Sharpening::none).mesh;
        forAll(mesh.points, pointi)
        {
            const point& x = mesh.points[pointi];
            if (cmptMin(x) > 3 && cmptMax(x) < 13)
            {
                largest[i] = std::max(largest[i], mag(plane(x)));
            }
        }
    }
    EXPECT_LT(largest[1], 0.01);
    EXPECT_GT(largest[0], 2 * largest[1]);
}

TEST(Sharpening, threadsDoNotMatter)
{
    const auto complex = shapes::complexOf(shapes::perturbedBox(shapes::boxOf(14)));
    const FlowSnapshot snapshot =
        shapes::snapshotOf(complex, shapes::sphere(point(7.1, 6.9, 7.2), 4.1));
    for (const Sharpening kind : {Sharpening::plic, Sharpening::profile})
    {
        const InterfaceMesh one = sharpened(snapshot, kind, 1).mesh;
        const InterfaceMesh four = sharpened(snapshot, kind, 4).mesh;
        EXPECT_EQ(one.points, four.points);
    }
}

TEST(Sharpening, nothingToSharpen)
{
    const auto complex = shapes::box(shapes::boxOf(6));
    const FlowSnapshot empty =
        shapes::snapshotOf(complex, scalarField(complex->nCells(), 0));
    EXPECT_TRUE(sharpened(empty, Sharpening::automatic).mesh.empty());
    // A speck of less than a cell has no surface alpha = 1/2, and a crumb hardly one.
    for (const scalar radius : {0.3, 0.8})
    {
        const FlowSnapshot speck =
            shapes::snapshotOf(complex, shapes::sphere(point(3.2, 2.9, 3.1), radius));
        expectClosed(sharpened(speck, Sharpening::automatic).mesh);
    }
}

TEST(Sharpening, bonnellHasNone)
{
    ReconstructionOptions options;
    options.method = "bonnell";
    options.sharpening = Sharpening::automatic;
    EXPECT_THROW(Reconstruction::New(options), BadInput);
}
