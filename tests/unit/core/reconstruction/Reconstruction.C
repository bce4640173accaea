// SPDX-License-Identifier: GPL-3.0-or-later

// What every method owes on every mesh. Accuracy is tested method by method.

#include "core/reconstruction/Reconstruction.H"
#include "core/base/Errors.H"
#include "core/ranks/Exchange.H"
#include "core/surface/pieces/SurfaceHalo.H"
#include "shapes/ExactAlpha.H"
#include "shapes/PeriodicBox.H"
#include "shapes/PolyMeshes.H"
#include "shapes/SurfaceChecks.H"

#include <gtest/gtest.h>

#include <random>

using namespace Foam;
using namespace Foam::stability;

namespace
{

CellComplexInput inputNamed(const std::string& name)
{
    if (name == "box")
    {
        return shapes::boxInput(shapes::oblongBox());
    }
    if (name == "perturbed")
    {
        return shapes::perturbedBox(shapes::oblongBox());
    }
    if (name == "tetrahedra")
    {
        return shapes::tetrahedralBox(shapes::oblongBox());
    }
    return shapes::refinedBox(
        shapes::oblongBox(),
        [](const point& x) { return x.x() + 0.3 * x.y() > 0.7 && x.z() < 0.7; }
    );
}

ReconstructionResult
smoothed(const FlowSnapshot& snapshot, const std::string& method, label smooth = 0)
{
    ReconstructionOptions options;
    options.method = method;
    options.smooth = smooth;
    return Reconstruction::New(options)->extract(snapshot);
}

vector unit(const vector& v)
{
    return v / mag(v);
}

FlowSnapshot complementOf(FlowSnapshot snapshot)
{
    for (scalar& alpha : snapshot.alphas[0])
    {
        alpha = 1 - alpha;
    }
    for (scalar& alpha : snapshot.boundaryAlphas[0])
    {
        alpha = 1 - alpha;
    }
    return snapshot;
}

using Case = std::tuple<std::string, std::string>;

class OnEveryMesh : public ::testing::TestWithParam<Case>
{
protected:
    std::string method() const { return std::get<0>(GetParam()); }
    const std::shared_ptr<const CellComplex> complex_ =
        shapes::complexOf(inputNamed(std::get<1>(GetParam())));

    FlowSnapshot of(const shapes::Shape& shape) const
    {
        return shapes::snapshotOf(complex_, shape);
    }

    void expectSound(const InterfaceMesh& mesh) const
    {
        const shapes::SurfaceReport report = shapes::inspect(mesh);
        EXPECT_GT(mesh.triangles.size(), 0);
        EXPECT_EQ(report.nCrowded, 0);
        EXPECT_EQ(report.nRimInside, 0);
        EXPECT_EQ(report.nMisoriented, 0);
        EXPECT_EQ(report.nUnused, 0);
        EXPECT_EQ(mesh.corners.size(), mesh.triangles.size());
        EXPECT_EQ(mesh.origins.size(), mesh.points.size());
        expectPlaced(mesh);
    }

    // From the centre of a cell to its farthest point, and a little more.
    scalar reach(label celli) const
    {
        scalar largest = 0;
        for (const label facei : complex_->cellFaces()[celli])
        {
            for (const label pointi : complex_->faces()[facei])
            {
                const point& x = complex_->points()[pointi];
                largest = max(largest, mag(x - complex_->cellCentres()[celli]));
            }
        }
        return 1.05 * largest; // planes of warped faces claim a little more
    }

    // Cells hold their points, and points of a boundary face lie on it.
    void expectPlaced(const InterfaceMesh& mesh) const
    {
        const boundBox& bounds = complex_->bounds();
        forAll(mesh.points, pointi)
        {
            const point& x = mesh.points[pointi];
            const scalar h = mesh.cellSizes[pointi];
            EXPECT_EQ(h, complex_->cellSizes()[mesh.cells[pointi]]);
            EXPECT_LT(
                mag(x - complex_->cellCentres()[mesh.cells[pointi]]),
                reach(mesh.cells[pointi])
            );
            scalar toWall = GREAT;
            for (direction d = 0; d < 3; ++d)
            {
                toWall = min(toWall, x[d] - bounds.min()[d]);
                toWall = min(toWall, bounds.max()[d] - x[d]);
            }
            EXPECT_GE(toWall, -1e-12);
            const label facei = mesh.boundaryFaces[pointi];
            EXPECT_EQ(facei >= 0, toWall < 1e-9);
            if (facei >= 0)
            {
                const label i = complex_->nInternalFaces() + facei;
                const vector arm = x - complex_->faceCentres()[i];
                EXPECT_NEAR(arm & unit(complex_->faceAreas()[i]), 0, 1e-12);
                EXPECT_LT(mag(arm), 2 * h);
            }
        }
    }
};

// Meets five walls, four edges and three corners of the box in part.
shapes::Shape cornerBall()
{
    return shapes::sphere(point(1.1, 0.93, 1.02), 0.55);
}
shapes::Shape obliquePlane()
{
    return shapes::halfSpace(point(0.61, 0.52, 0.53), vector(1, 0.7, -0.4));
}
shapes::Shape innerBall()
{
    return shapes::sphere(point(0.61, 0.47, 0.53), 0.35);
}

std::string nameOf(const ::testing::TestParamInfo<Case>& info)
{
    return std::get<0>(info.param) + "_" + std::get<1>(info.param);
}

} // namespace

TEST_P(OnEveryMesh, surfacesThatMeetWallsAreManifoldsWithRims)
{
    for (const label smooth : {0, 5})
    {
        for (const shapes::Shape& shape : {cornerBall(), obliquePlane()})
        {
            const auto result = smoothed(of(shape), method(), smooth);
            expectSound(result.mesh);
            const shapes::SurfaceReport report = shapes::inspect(result.mesh);
            EXPECT_EQ(report.euler, 1); // a disk
            EXPECT_GT(report.nRim, 30);
            EXPECT_LT(mag(result.volumeError()), 0.035);
        }
    }
}

TEST_P(OnEveryMesh, aBallIsAClosedSphere)
{
    const auto result = smoothed(of(innerBall()), method());
    expectSound(result.mesh);
    const shapes::SurfaceReport report = shapes::inspect(result.mesh);
    EXPECT_EQ(report.nRim, 0);
    EXPECT_EQ(report.euler, 2);
    EXPECT_LT(result.volumeError(), -0.01); // 1.1 (h/R)^2 and the like
    EXPECT_GT(result.volumeError(), -0.1);
}

// Each triangle with an area worth the name faces from the ball outwards, roughly.
TEST_P(OnEveryMesh, trianglesFaceTheSecondMaterial)
{
    const auto result = smoothed(of(innerBall()), method());
    scalar outwards = 0;
    forAll(result.mesh.triangles, trianglei)
    {
        const vector arm = result.mesh.centre(trianglei) - point(0.61, 0.47, 0.53);
        outwards += unit(arm) & result.mesh.areaVector(trianglei);
    }
    EXPECT_GT(outwards / result.mesh.area(), 0.75);
}

TEST_P(OnEveryMesh, volumeIsThatOfTheMesh)
{
    for (const label smooth : {0, 7})
    {
        const auto ball = smoothed(of(innerBall()), method(), smooth);
        EXPECT_NEAR(shapes::enclosedVolume(ball.mesh) / ball.volume, 1, 1e-11);

        // What one material gains at the walls the other one loses; but a value of
        // exactly 1/2 (the mean of a wet and a dry face) is inside for both, and its
        // slivers of 1e-3 of an edge count twice.
        const FlowSnapshot snapshot = of(cornerBall());
        const auto first = smoothed(snapshot, method(), smooth);
        const auto second = smoothed(complementOf(snapshot), method(), smooth);
        EXPECT_NEAR(
            scalar(first.mesh.triangles.size()) / second.mesh.triangles.size(), 1, 0.01
        );
        const scalar whole = sum(complex_->cellVolumes());
        EXPECT_NEAR((first.volume + second.volume) / whole, 1, 1e-6);
        EXPECT_NEAR((first.alphaVolume + second.alphaVolume) / whole, 1, 1e-11);
    }
}

// A start from setFields: fractions of 0 and 1, means of exactly 1/2.
TEST_P(OnEveryMesh, sharpStartIsOrdinary)
{
    scalarField alpha(complex_->nCells());
    const shapes::Shape column =
        shapes::block(point(-1, -1, -1), point(0.6, 0.55, 0.5));
    forAll(alpha, celli)
    {
        alpha[celli] = column(complex_->cellCentres()[celli]) < 0;
    }
    const auto result = smoothed(shapes::snapshotOf(complex_, alpha), method());
    expectSound(result.mesh);
    EXPECT_EQ(shapes::inspect(result.mesh).euler, 1);
    EXPECT_LT(mag(result.volumeError()), 0.06);
}

// Nothing but topology: every connection of the mesh is cut somewhere.
TEST_P(OnEveryMesh, noiseGivesAManifold)
{
    std::mt19937 generator(7);
    const auto uniform = [&] { return generator() / 4294967296.0; };
    scalarField alpha(complex_->nCells());
    for (scalar& a : alpha)
    {
        a = uniform();
    }
    FlowSnapshot snapshot = shapes::snapshotOf(complex_, alpha);
    for (scalar& a : snapshot.boundaryAlphas[0])
    {
        a = uniform();
    }
    const auto first = smoothed(snapshot, method());
    const shapes::SurfaceReport report = shapes::inspect(first.mesh);
    EXPECT_GT(first.mesh.triangles.size(), 5000);
    EXPECT_EQ(report.nCrowded, 0);
    EXPECT_EQ(report.nRimInside, 0);
    EXPECT_EQ(report.nMisoriented, 0);
    const auto second = smoothed(complementOf(snapshot), method());
    EXPECT_NEAR(
        (first.volume + second.volume) / sum(complex_->cellVolumes()), 1, 1e-11
    );
}

// B15: lengths of 1e-5 and 1e3 change nothing but the scale.
TEST_P(OnEveryMesh, scaleDoesNotMatter)
{
    const scalarField alpha = shapes::exactAlpha(*complex_, cornerBall());
    const auto plain = smoothed(shapes::snapshotOf(complex_, alpha), method(), 3);
    for (const scalar scale : {1e-5, 1e3})
    {
        const vector shift = scale * vector(0.37, -2.1, 0.83);
        const auto complex = shapes::complexOf(
            shapes::transformed(inputNamed(std::get<1>(GetParam())), scale, shift)
        );
        const auto scaled = smoothed(shapes::snapshotOf(complex, alpha), method(), 3);
        ASSERT_EQ(scaled.mesh.points.size(), plain.mesh.points.size());
        ASSERT_EQ(scaled.mesh.triangles.size(), plain.mesh.triangles.size());
        EXPECT_EQ(shapes::inspect(scaled.mesh).euler, 1);
        EXPECT_NEAR(scaled.volumeError(), plain.volumeError(), 1e-9);
        EXPECT_NEAR(scaled.mesh.area() / sqr(scale) / plain.mesh.area(), 1, 1e-9);
        forAll(plain.mesh.points, pointi)
        {
            const vector there = (scaled.mesh.points[pointi] - shift) / scale;
            EXPECT_LT(mag(there - plain.mesh.points[pointi]), 1e-9);
        }
    }
}

TEST_P(OnEveryMesh, nowhereIsAnEmptyMesh)
{
    for (const scalar value : {0.0, 0.3, 0.5, 1.0})
    {
        const scalarField alpha(complex_->nCells(), value);
        const auto result = smoothed(shapes::snapshotOf(complex_, alpha), method(), 2);
        EXPECT_TRUE(result.mesh.empty());
        EXPECT_EQ(result.mesh.points.size(), 0);
        const scalar whole = sum(complex_->cellVolumes());
        EXPECT_NEAR(result.volume, value >= 0.5 ? whole : 0, 1e-12);
        EXPECT_NEAR(result.alphaVolume, value * whole, 1e-12);
    }
    const auto nothing =
        shapes::snapshotOf(complex_, scalarField(complex_->nCells(), 0));
    EXPECT_EQ(smoothed(nothing, method()).volumeError(), 0);
}

INSTANTIATE_TEST_SUITE_P(
    Reconstruction, OnEveryMesh,
    ::testing::Combine(
        ::testing::Values("isoAlpha", "bonnell"),
        ::testing::Values("box", "perturbed", "tetrahedra", "refined")
    ),
    nameOf
);

TEST(Reconstruction, aFilmOnAWallAloneIsFound)
{
    // No cell is inside; the boundary faces of one side are.
    const auto complex = shapes::unitCube(4);
    FlowSnapshot snapshot = shapes::snapshotOf(complex, scalarField(64, 0.2));
    forAll(snapshot.boundaryAlphas[0], i)
    {
        snapshot.boundaryAlphas[0][i] = complex->patches()[i] == 4 ? 0.9 : 0.2;
    }
    for (const std::string method : {"isoAlpha", "bonnell"})
    {
        const auto result = smoothed(snapshot, method);
        EXPECT_FALSE(result.mesh.empty()) << method;
        EXPECT_EQ(shapes::inspect(result.mesh).nRimInside, 0) << method;
        EXPECT_GT(result.volume, 0) << method;
    }
}

TEST(Reconstruction, theSecondOfTwoMaterialsIsImplied)
{
    const auto complex = shapes::unitCube(8);
    FlowSnapshot snapshot =
        shapes::snapshotOf(complex, shapes::sphere(point(0.5, 0.47, 0.52), 0.3));
    const auto one = smoothed(snapshot, "bonnell");
    snapshot.alphas.append(scalarField(1 - snapshot.alphas[0]));
    snapshot.boundaryAlphas.append(scalarField(1 - snapshot.boundaryAlphas[0]));
    const auto two = smoothed(snapshot, "bonnell");
    EXPECT_GT(one.mesh.triangles.size(), 0);
    EXPECT_EQ(one.mesh.triangles, two.mesh.triangles);
    EXPECT_EQ(one.mesh.points, two.mesh.points);
    EXPECT_EQ(two.mesh.materials, List<labelPair>(two.mesh.triangles.size(), {0, 1}));
}

TEST(Reconstruction, threeMaterialsAreRefused)
{
    const auto complex = shapes::unitCube(2);
    FlowSnapshot snapshot = shapes::snapshotOf(complex, scalarField(8, 0.3));
    snapshot.alphas = List<scalarField>(3, snapshot.alphas[0]);
    snapshot.boundaryAlphas = List<scalarField>(3, snapshot.boundaryAlphas[0]);
    for (const ReconstructionMethod& method : reconstructionMethods())
    {
        EXPECT_THROW(smoothed(snapshot, method.name), BadInput);
    }
}

TEST(Reconstruction, unknownNamesAreAnsweredWithTheKnownOnes)
{
    ReconstructionOptions options;
    options.method = "isoAlfa";
    try
    {
        Reconstruction::New(options);
        FAIL() << "an unknown name was taken";
    }
    catch (const BadInput& error)
    {
        const std::string text = error.what();
        for (const char* part : {"isoAlfa", "isoAlpha", "bonnell", "plic", "fromFiles"})
        {
            EXPECT_NE(text.find(part), std::string::npos) << text;
        }
    }
    options = ReconstructionOptions();
    options.smooth = -1;
    EXPECT_THROW(Reconstruction::New(options), BadInput);
}

namespace
{

struct Layers
{
    scalar area = 0, volume = 0; // [m2] and [m3] per layer
    scalar pointArea = 0;        // [m2] per layer, summed over the points
};

// The points have the areas of the triangles around them, of which some are images.
scalar sumOfPointAreas(const InterfaceMesh& mesh, const CellComplex& complex)
{
    SurfacePiece owned;
    keepOwn(owned, mesh, complex);
    VoxelMask near(0.1);
    for (const point& x : owned.mesh.points)
    {
        near.add(x, 0.2);
    }
    const SerialExchange alone;
    const SurfaceHalo halo(owned, near, alone, complex.whole().images.get());
    const scalarField areas(halo.mesh().pointAreas());
    const List<bool> isPrimary(halo.primaryPoints());
    scalar sum = 0;
    forAll(areas, pointi)
    {
        sum += isPrimary[pointi] ? areas[pointi] : 0;
    }
    return sum;
}

// A cylinder along x in layers of cells between cyclic patches.
Layers inLayers(const std::string& method, label nLayers)
{
    shapes::BoxOptions options;
    options.n = Vector<label>(nLayers, 12, 12);
    options.max.x() = nLayers / 12.;
    const auto complex = shapes::withRings(
        shapes::periodicPiece(
            shapes::boxInput(options), {shapes::periodicInX(options)}
        ),
        6
    );
    const auto snapshot = shapes::periodicSnapshot(
        complex, [](const point&, scalar) { return vector(Zero); }, 0,
        [](const point& x)
        {
            const scalar distance = std::hypot(x.y() - 0.47, x.z() - 0.52) - 0.31;
            return std::min(std::max(0.5 - 12 * distance, 0.), 1.);
        }
    );
    const ReconstructionResult result = smoothed(*snapshot, method);
    Layers layers{
        0, result.volume / nLayers, sumOfPointAreas(result.mesh, *complex) / nLayers};
    forAll(result.mesh.triangles, i)
    {
        const bool own = complex->own(result.mesh.triangleCells[i]);
        layers.area += own ? mag(result.mesh.areaVector(i)) / nLayers : 0;
    }
    return layers;
}

} // namespace

// A cell may be its own neighbour. Nothing counts twice, and volumes close.
TEST(Reconstruction, anyNumberOfLayersBetweenCyclicPatches)
{
    for (const std::string method : {"isoAlpha", "bonnell"})
    {
        const Layers three = inLayers(method, 3);
        EXPECT_NEAR(three.area, 2 * M_PI * 0.31 / 12, 0.1 / 12) << method;
        EXPECT_NEAR(three.volume, M_PI * 0.31 * 0.31 / 12, 0.008 / 12) << method;
        for (const label nLayers : {1, 2})
        {
            const Layers layers = inLayers(method, nLayers);
            EXPECT_NEAR(layers.area, three.area, 1e-12) << method << nLayers;
            EXPECT_NEAR(layers.volume, three.volume, 1e-13) << method << nLayers;
            EXPECT_NEAR(layers.pointArea, layers.area, 1e-12) << method << nLayers;
        }
    }
}
