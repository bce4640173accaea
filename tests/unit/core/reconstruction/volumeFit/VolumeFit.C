// SPDX-License-Identifier: GPL-3.0-or-later

// Closed components with the volume of their alpha. The truth is the sum of alpha V of
// the shape by itself.

#include "core/reconstruction/Extraction.H"
#include "core/reconstruction/volumeFit/SurfaceComponents.H"
#include "core/base/Errors.H"
#include "shapes/ExactAlpha.H"
#include "shapes/PolyMeshes.H"
#include "shapes/SurfaceChecks.H"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace Foam;
using namespace Foam::stability;

namespace
{

using Complex = std::shared_ptr<const CellComplex>;

ReconstructionResult fitted(
    const FlowSnapshot& snapshot, VolumeFit fit = VolumeFit::component,
    Sharpening kind = Sharpening::automatic, label nThreads = 2
)
{
    ReconstructionOptions options;
    options.sharpening = kind;
    options.volumeFit = fit;
    options.nThreads = nThreads;
    ExtractedSurface extracted(extractSurface(
        *Reconstruction::New(options), options,
        std::make_shared<const FlowSnapshot>(snapshot), Run{SerialExchange(), nThreads}
    ));
    extracted.result.mesh = extracted.piece.mesh;
    return extracted.result;
}

// Hexahedra, perturbed, tetrahedra, 2:1.
std::vector<Complex> meshes(label n)
{
    const auto refine = [=](const point& x) { return x.x() > 0.5 * n; };
    return {
        shapes::box(shapes::boxOf(n)),
        shapes::complexOf(shapes::perturbedBox(shapes::boxOf(n))),
        shapes::complexOf(shapes::tetrahedralBox(shapes::boxOf(n))),
        shapes::complexOf(shapes::refinedBox(shapes::boxOf(n), refine))};
}

// Of the closed components, ascending; bubbles are negative [m3].
std::vector<scalar> closedVolumes(const InterfaceMesh& mesh)
{
    std::vector<scalar> volumes;
    for (const SurfaceComponent& component : SurfaceComponents(mesh).all)
    {
        if (component.closed)
        {
            volumes.push_back(component.volume);
        }
    }
    std::sort(volumes.begin(), volumes.end());
    return volumes;
}

// By area, in cells: of the points, and of the middles of the triangles.
struct Rms
{
    scalar points, middles;
};

Rms rmsOf(const InterfaceMesh& mesh, const shapes::Shape& shape)
{
    const scalarField areas(mesh.pointAreas());
    Rms rms{0, 0};
    forAll(areas, pointi)
    {
        rms.points +=
            areas[pointi] * sqr(shape(mesh.points[pointi]) / mesh.cellSizes[pointi]);
    }
    forAll(mesh.triangles, trianglei)
    {
        const scalar h = mesh.cellSizes[mesh.triangles[trianglei][0]];
        rms.middles +=
            mag(mesh.areaVector(trianglei)) * sqr(shape(mesh.centre(trianglei)) / h);
    }
    return {std::sqrt(rms.points / sum(areas)), std::sqrt(rms.middles / sum(areas))};
}

shapes::Shape torus(const point& centre, const vector& axis, scalar major, scalar minor)
{
    const vector a = axis / mag(axis);
    return [=](const point& x)
    {
        const vector d = x - centre;
        const scalar along = d & a;
        return std::hypot(mag(d - along * a) - major, along) - minor;
    };
}

// The surface is the unfitted one but for its places, and sound.
void expectSound(const InterfaceMesh& mesh, const InterfaceMesh& before)
{
    EXPECT_EQ(mesh.triangles, before.triangles);
    const shapes::SurfaceReport report = shapes::inspect(mesh);
    EXPECT_EQ(report.nCrowded + report.nRimInside + report.nMisoriented, 0);
    forAll(mesh.triangles, trianglei)
    {
        EXPECT_GT(mesh.areaVector(trianglei) & before.areaVector(trianglei), 0);
    }
}

const point offGrid(9.137, 8.732, 9.281);

} // namespace

TEST(VolumeFit, sphereOnAllCells)
{
    const shapes::Shape ball = shapes::sphere(offGrid, 4.8);
    for (const Complex& complex : meshes(18))
    {
        const FlowSnapshot snapshot = shapes::snapshotOf(complex, ball);
        const scalar truth = shapes::materialIn(*complex, snapshot.alphas[0]);
        const ReconstructionResult before = fitted(snapshot, VolumeFit::none);
        const ReconstructionResult after = fitted(snapshot);
        EXPECT_FALSE(before.volumeFit);
        ASSERT_TRUE(after.volumeFit);
        EXPECT_EQ(after.volumeFit->nClosed, 1);
        EXPECT_EQ(after.volumeFit->nStayed(), 0);
        EXPECT_LT(before.volumeError(), -0.003);
        EXPECT_NEAR(after.volumeError(), 0, 1e-8);
        EXPECT_NEAR(shapes::enclosedVolume(after.mesh) / truth, 1, 1e-8);
        expectSound(after.mesh, before.mesh);

        // The points leave the sphere by what the chords between them lack, on the mean
        // the missing volume over the area; the triangles come nearer.
        const scalar chord = -before.volumeError() * 4.8 / 3;
        const Rms rms = rmsOf(after.mesh, ball);
        EXPECT_GT(after.volumeFit->largestMove, 0.9 * chord);
        if (complex->nCells() == 18 * 18 * 18) // all of one size
        {
            EXPECT_LT(rms.points, chord + 0.002);
        }
        EXPECT_LT(rms.middles, 0.75 * rmsOf(before.mesh, ball).middles);
    }
}

TEST(VolumeFit, torusAndUnsharpenedSphere)
{
    const Complex complex = shapes::box(shapes::boxOf(26));
    const FlowSnapshot ring = shapes::snapshotOf(
        complex, torus(point(13.137, 12.732, 13.281), vector(1, 2, 3), 7, 3.3)
    );
    const ReconstructionResult fit = fitted(ring);
    EXPECT_NEAR(
        shapes::enclosedVolume(fit.mesh) / shapes::materialIn(*complex, ring.alphas[0]),
        1, 1e-8
    );
    expectSound(fit.mesh, fitted(ring, VolumeFit::none).mesh);

    const FlowSnapshot ball = shapes::snapshotOf(complex, shapes::sphere(offGrid, 4.8));
    const ReconstructionResult raw =
        fitted(ball, VolumeFit::component, Sharpening::none);
    EXPECT_NEAR(raw.volumeError(), 0, 1e-8);
    EXPECT_GT(raw.volumeFit->largestMove, 0.05); // alpha = 1/2 lacks 5 percent
}

// Each of both surfaces, not only what lies between them.
TEST(VolumeFit, bubbleInADrop)
{
    const point centre(7.137, 6.732, 7.281);
    for (const Complex& complex : meshes(14))
    {
        const scalarField outer =
            shapes::exactAlpha(*complex, shapes::sphere(centre, 5.3));
        const scalarField inner = shapes::exactAlpha(
            *complex, shapes::sphere(centre + vector(0.4, -0.3, 0.2), 2.3)
        );
        const ReconstructionResult fit =
            fitted(shapes::snapshotOf(complex, scalarField(outer - inner)));
        const std::vector<scalar> volumes = closedVolumes(fit.mesh);
        ASSERT_EQ(volumes.size(), 2u);
        EXPECT_EQ(fit.volumeFit->nStayed(), 0);
        EXPECT_NEAR(-volumes[0] / shapes::materialIn(*complex, inner), 1, 1e-8);
        EXPECT_NEAR(volumes[1] / shapes::materialIn(*complex, outer), 1, 1e-8);
    }
}

// A drop in a bubble in a drop.
TEST(VolumeFit, nestedThrice)
{
    const Complex complex = shapes::box(shapes::boxOf(26));
    const point centre(13.137, 12.732, 13.281);
    const auto alphaOf = [&](scalar radius)
    { return shapes::exactAlpha(*complex, shapes::sphere(centre, radius)); };
    const scalarField a = alphaOf(10.3), b = alphaOf(6.8), c = alphaOf(2.9);
    const ReconstructionResult fit =
        fitted(shapes::snapshotOf(complex, scalarField(a - b + c)));
    const std::vector<scalar> volumes = closedVolumes(fit.mesh);
    ASSERT_EQ(volumes.size(), 3u);
    EXPECT_NEAR(-volumes[0] / shapes::materialIn(*complex, b), 1, 1e-8);
    EXPECT_NEAR(volumes[1] / shapes::materialIn(*complex, c), 1, 1e-8);
    EXPECT_NEAR(volumes[2] / shapes::materialIn(*complex, a), 1, 1e-8);
}

// Where no cell is cut by both, each has its own; else what is in such cells is divided
// by what each surface has there, and only the sum is known.
TEST(VolumeFit, twoBallsCloseToEachOther)
{
    const vector directions[] = {
        {1, 0, 0}, {1, 0.31, 0.17}, {0.5, 0.9, -0.35}, {0.6, -0.55, 0.58}};
    const scalar tolerances[] = {1e-8, 1e-8, 3e-5, 3e-5};
    constexpr scalar large = 4.8, small = 3.7, gap = 0.9;
    const Complex complex = shapes::box(shapes::boxOf(24));
    for (label i = 0; i < 4; ++i)
    {
        const vector n = directions[i] / mag(directions[i]);
        const point a = point(12.137, 11.732, 12.281) - 0.5 * (small + gap) * n;
        const point b = a + (large + gap + small) * n;
        const scalarField first =
            shapes::exactAlpha(*complex, shapes::sphere(a, large));
        const scalarField second =
            shapes::exactAlpha(*complex, shapes::sphere(b, small));
        const ReconstructionResult fit =
            fitted(shapes::snapshotOf(complex, scalarField(first + second)));
        const std::vector<scalar> volumes = closedVolumes(fit.mesh);
        ASSERT_EQ(volumes.size(), 2u);
        EXPECT_EQ(fit.volumeFit->nStayed(), 0);
        EXPECT_NEAR(fit.volumeError(), 0, 1e-8);
        EXPECT_NEAR(
            volumes[0] / shapes::materialIn(*complex, second), 1, tolerances[i]
        );
        EXPECT_NEAR(volumes[1] / shapes::materialIn(*complex, first), 1, tolerances[i]);
    }
}

// Nothing of the wall is the ball's, but a third of a cell is left between them.
TEST(VolumeFit, ballNearAWall)
{
    const Complex complex = shapes::box(shapes::boxOf(18));
    const shapes::Shape ball = shapes::sphere(point(9.137, 8.732, 5.13), 4.8);
    const FlowSnapshot snapshot = shapes::snapshotOf(complex, ball);
    const ReconstructionResult fit = fitted(snapshot);
    EXPECT_EQ(fit.volumeFit->nClosed, 1);
    EXPECT_EQ(fit.volumeFit->nStayed(), 0);
    EXPECT_NEAR(
        shapes::enclosedVolume(fit.mesh)
            / shapes::materialIn(*complex, snapshot.alphas[0]),
        1, 1e-8
    );
    for (const point& x : fit.mesh.points)
    {
        EXPECT_GT(x.z(), 0.2);
    }
}

// It ends at walls and is not touched; a ball that shares cells with it stays and is
// counted, one farther away is fitted.
TEST(VolumeFit, filmThroughWallsAndBalls)
{
    const Complex complex = shapes::box(shapes::boxOf(18));
    const vector n(0.05, 0.02, 1);
    const scalarField film =
        shapes::exactAlpha(*complex, shapes::halfSpace(point(0, 0, 4.7), n))
        - shapes::exactAlpha(*complex, shapes::halfSpace(point(0, 0, 2.2), n));
    for (const scalar height : {9.4, 12.6})
    {
        const scalarField ball =
            shapes::exactAlpha(*complex, shapes::sphere(point(8.1, 8.7, height), 3.6));
        const FlowSnapshot snapshot =
            shapes::snapshotOf(complex, scalarField(film + ball));
        const ReconstructionResult before = fitted(snapshot, VolumeFit::none);
        const ReconstructionResult after = fitted(snapshot);
        const bool near = height < 10;
        EXPECT_EQ(after.volumeFit->nClosed, 1);
        EXPECT_EQ(after.volumeFit->nOpen, near);
        EXPECT_EQ(after.volumeFit->nStayed(), near);
        label nMoved = 0;
        forAll(before.mesh.points, pointi)
        {
            const bool moved = before.mesh.points[pointi] != after.mesh.points[pointi];
            nMoved += moved;
            EXPECT_FALSE(moved && before.mesh.points[pointi].z() < 7);
        }
        EXPECT_EQ(nMoved > 0, !near);
        const std::vector<scalar> volumes = closedVolumes(after.mesh);
        ASSERT_EQ(volumes.size(), 1u);
        if (!near)
        {
            EXPECT_NEAR(volumes[0] / shapes::materialIn(*complex, ball), 1, 1e-8);
        }
    }
}

// A profile over three cells: its tails are the ball's, too.
TEST(VolumeFit, smearedSphere)
{
    const Complex complex = shapes::box(shapes::boxOf(24));
    const point centre(12.137, 11.732, 12.281);
    scalarField alpha(complex->nCells());
    forAll(alpha, celli)
    {
        const scalar d = mag(complex->cellCentres()[celli] - centre) - 4.8;
        alpha[celli] = 1 / (1 + std::exp(3 * d));
    }
    const FlowSnapshot snapshot = shapes::snapshotOf(complex, alpha);
    for (const Sharpening kind : {Sharpening::automatic, Sharpening::profile})
    {
        const ReconstructionResult fit = fitted(snapshot, VolumeFit::component, kind);
        EXPECT_EQ(fit.volumeFit->nStayed(), 0);
        EXPECT_NEAR(
            shapes::enclosedVolume(fit.mesh) / shapes::materialIn(*complex, alpha), 1,
            1e-6
        );
    }
}

// What would have to move far stays as it is.
TEST(VolumeFit, crumbsStay)
{
    const Complex complex = shapes::box(shapes::boxOf(8));
    const FlowSnapshot snapshot =
        shapes::snapshotOf(complex, shapes::sphere(point(4.13, 3.73, 4.28), 0.85));
    const ReconstructionResult before = fitted(snapshot, VolumeFit::none);
    const ReconstructionResult after = fitted(snapshot);
    ASSERT_FALSE(after.mesh.empty());
    EXPECT_EQ(after.volumeFit->nTooFar, 1);
    EXPECT_EQ(after.volumeFit->largestMove, 0);
    EXPECT_EQ(after.mesh.points, before.mesh.points);
    EXPECT_EQ(after.volume, before.volume);
}

TEST(VolumeFit, threadsDoNotMatter)
{
    const Complex complex = shapes::complexOf(shapes::perturbedBox(shapes::boxOf(18)));
    const FlowSnapshot snapshot = shapes::snapshotOf(
        complex, shapes::unionOf(
                     shapes::sphere(point(5.1, 5.9, 7.2), 3.6),
                     shapes::sphere(point(12.4, 10.1, 9.1), 4.3)
                 )
    );
    const auto extracted = [&](label nThreads)
    { return fitted(snapshot, VolumeFit::component, Sharpening::automatic, nThreads); };
    const ReconstructionResult one = extracted(1);
    EXPECT_EQ(one.volumeFit->nClosed, 2);
    EXPECT_EQ(one.volumeFit->nStayed(), 0);
    for (const label nThreads : {2, 4})
    {
        EXPECT_EQ(one.mesh.points, extracted(nThreads).mesh.points);
    }
}

TEST(VolumeFit, nothingToFit)
{
    const Complex complex = shapes::box(shapes::boxOf(6));
    const ReconstructionResult fit =
        fitted(shapes::snapshotOf(complex, scalarField(complex->nCells(), 0)));
    ASSERT_TRUE(fit.volumeFit);
    EXPECT_EQ(fit.volumeFit->nClosed, 0);
    EXPECT_EQ(fit.volume, 0);
}

TEST(VolumeFit, otherReconstructionsHaveNone)
{
    ReconstructionOptions options;
    options.volumeFit = VolumeFit::component;
    for (const char* method : {"bonnell", "plic", "fromFiles"})
    {
        options.method = method;
        EXPECT_THROW(Reconstruction::New(options), BadInput);
    }
}
