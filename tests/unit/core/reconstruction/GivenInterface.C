// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/reconstruction/GivenInterface.H"
#include "core/base/Errors.H"
#include "core/cells/CellPlacement.H"
#include "shapes/ExactAlpha.H"
#include "shapes/PolyMeshes.H"

#include <gtest/gtest.h>

#include <limits>

using namespace Foam;
using namespace Foam::stability;

namespace
{

const point middle(0.61, 0.47, 0.53);

ReconstructionResult extracted(
    const FlowSnapshot& snapshot, const std::string& method,
    Sharpening sharpening = Sharpening::none
)
{
    ReconstructionOptions options;
    options.method = method;
    options.sharpening = sharpening;
    return Reconstruction::New(options)->extract(snapshot);
}

ReconstructionResult put(FlowSnapshot snapshot, const GivenSurface& surface)
{
    snapshot.surface = std::make_shared<const GivenSurface>(surface);
    return extracted(snapshot, "fromFiles");
}

// Every triangle with points of its own, the last triangle's first, each with its
// cell's size.
GivenSurface tornApart(const InterfaceMesh& mesh, Welding welding)
{
    GivenSurface surface;
    surface.name = "torn.vtp";
    surface.welding = welding;
    const label n = 3 * mesh.triangles.size();
    surface.points.setSize(n);
    surface.vertex.setSize(n);
    surface.cellSizes.setSize(n);
    forAll(mesh.triangles, trianglei)
    {
        triFace t;
        for (label k = 0; k < 3; ++k)
        {
            t[k] = n - 1 - (3 * trianglei + k);
            surface.vertex[t[k]] = 7 + 2 * mesh.triangles[trianglei][k];
            surface.points[t[k]] = mesh.points[mesh.triangles[trianglei][k]];
            surface.cellSizes[t[k]] = mesh.cellSizes[mesh.triangles[trianglei][k]];
        }
        surface.triangles.append(t);
    }
    return surface;
}

GivenSurface ofMesh(const InterfaceMesh& mesh)
{
    GivenSurface surface;
    surface.name = "whole.vtp";
    surface.points = mesh.points;
    surface.triangles = mesh.triangles;
    return surface;
}

std::string complaint(const FlowSnapshot& snapshot, const GivenSurface& surface)
{
    try
    {
        put(snapshot, surface);
    }
    catch (const BadInput& error)
    {
        return error.what();
    }
    return "";
}

bool has(const std::string& text, const std::string& part)
{
    return text.find(part) != text.npos;
}

FlowSnapshot boxSnapshot(const shapes::Shape& shape)
{
    return shapes::snapshotOf(
        shapes::complexOf(shapes::boxInput(shapes::oblongBox())), shape
    );
}

FlowSnapshot ball()
{
    return boxSnapshot(shapes::sphere(middle, 0.35));
}

// Welded by name, an extracted surface comes back as it was, in cells of the same sizes
// that it touches.
void expectRepeated(
    const FlowSnapshot& snapshot, const std::string& method, Sharpening sharpening
)
{
    const InterfaceMesh before = extracted(snapshot, method, sharpening).mesh;
    const InterfaceMesh after = put(snapshot, tornApart(before, Welding::byName)).mesh;
    EXPECT_GT(before.points.size(), 100);
    EXPECT_EQ(after.points, before.points);
    EXPECT_EQ(after.triangles, before.triangles);
    EXPECT_EQ(after.cellSizes, before.cellSizes);
    EXPECT_EQ(after.materials, before.materials);
    EXPECT_EQ(after.corners.size(), before.corners.size());
    EXPECT_EQ(after.origins.size(), before.origins.size());
    forAll(after.cells, i)
    {
        const label celli = after.cells[i];
        EXPECT_EQ(snapshot.complex->cellSizes()[celli], after.cellSizes[i]);
        EXPECT_TRUE(liesWithin(*snapshot.complex, celli, after.points[i], 0.3));
        EXPECT_EQ(after.boundaryFaces[i] >= 0, before.boundaryFaces[i] >= 0);
    }
}

void expectRepeatedByAll(const FlowSnapshot& snapshot)
{
    expectRepeated(snapshot, "isoAlpha", Sharpening::none);
    expectRepeated(snapshot, "isoAlpha", Sharpening::automatic);
    expectRepeated(snapshot, "bonnell", Sharpening::none);
    expectRepeated(snapshot, "plic", Sharpening::none);
}

} // namespace

TEST(GivenInterface, repeatsWhatWasExtracted)
{
    const auto refine = [](const point& x) { return x.x() > 0.6; };
    for (const CellComplexInput& input :
         {shapes::boxInput(shapes::oblongBox()),
          shapes::perturbedBox(shapes::oblongBox()),
          shapes::tetrahedralBox(shapes::oblongBox()),
          shapes::refinedBox(shapes::oblongBox(), refine)})
    {
        for (const shapes::Shape& shape :
             {shapes::sphere(point(1.1, 0.93, 1.02), 0.55),
              shapes::sphere(middle, 0.35)})
        {
            expectRepeatedByAll(shapes::snapshotOf(shapes::complexOf(input), shape));
        }
    }
}

// The surface of a box of whole cells lies on faces, edges and points of cells of
// different sizes.
TEST(GivenInterface, repeatsPointsOnFaces)
{
    shapes::BoxOptions graded = shapes::oblongBox();
    graded.map = [](const point& x)
    { return point(x.x() * (0.6 + 0.3 * x.x()), x.y() * (1.4 - 0.3 * x.y()), x.z()); };
    const auto complex = shapes::box(graded);
    scalarField alpha(complex->nCells());
    forAll(alpha, celli)
    {
        const point& x = complex->cellCentres()[celli];
        alpha[celli] = x.x() < 0.6 && x.y() < 0.7 && x.z() < 0.55;
    }
    expectRepeatedByAll(shapes::snapshotOf(complex, alpha));
}

// Of the cells at a corner, a face or inside of one: the size tells which, if one has
// it.
TEST(GivenInterface, theSizeTellsTheCell)
{
    shapes::BoxOptions graded = shapes::oblongBox();
    graded.map = [](const point& x) { return point(x.x() * x.x(), x.y(), x.z()); };
    const auto complex = shapes::box(graded);
    const FlowSnapshot snapshot =
        shapes::snapshotOf(complex, shapes::sphere(middle, 0.35));
    const scalar side = sqr(0.48); // a plane of faces
    const label left = complex->findCell(point(side - 1e-3, 0.35, 0.42));
    const label right = complex->findCell(point(side + 1e-3, 0.35, 0.42));
    const scalarField& sizes = complex->cellSizes();
    EXPECT_LT(sizes[left], 0.95 * sizes[right]);
    GivenSurface surface;
    surface.triangles.append(triFace(0, 1, 2));
    surface.points = List<point>{
        point(side, 0.35, 0.42), point(side, 0.36, 0.42), point(0.17, 0.35, 0.45)};
    const auto cellsOf = [&](scalar first, scalar others)
    {
        surface.cellSizes = List<scalar>{first, others, others};
        return put(snapshot, surface).mesh.cells;
    };
    EXPECT_EQ(cellsOf(sizes[left], sizes[right]), (labelList{left, right, left}));
    EXPECT_EQ(cellsOf(sizes[right], sizes[left]), (labelList{right, left, left}));
    // Of another mesh.
    EXPECT_EQ(cellsOf(1.001 * sizes[right], 0), (labelList{left, left, left}));
}

TEST(GivenInterface, pointsAtOnePlaceAreOne)
{
    const FlowSnapshot snapshot = ball();
    const ReconstructionResult before = extracted(snapshot, "isoAlpha");
    const ReconstructionResult after =
        put(snapshot, tornApart(before.mesh, Welding::byPosition));
    EXPECT_EQ(after.mesh.points.size(), before.mesh.points.size());
    EXPECT_EQ(after.mesh.triangles.size(), before.mesh.triangles.size());
    EXPECT_NEAR(after.volume / before.volume, 1, 1e-12);

    // Torn apart and not welded it is not closed: its volume is not known.
    const ReconstructionResult torn =
        put(snapshot, tornApart(before.mesh, Welding::none));
    EXPECT_EQ(torn.mesh.points.size(), 3 * before.mesh.triangles.size());
    EXPECT_EQ(torn.volume, before.alphaVolume);
    EXPECT_LT(before.volume, 0.99 * before.alphaVolume);
}

TEST(GivenInterface, volumeFollowsTheOrientation)
{
    const FlowSnapshot snapshot = ball();
    const ReconstructionResult before = extracted(snapshot, "isoAlpha");
    GivenSurface surface = ofMesh(before.mesh);
    for (triFace& t : surface.triangles)
    {
        t.flip();
    }
    const scalar whole = sum(snapshot.complex->cellVolumes());
    EXPECT_NEAR(put(snapshot, surface).volume + before.volume, whole, 1e-12);
}

TEST(GivenInterface, whatIsNotUsedIsDropped)
{
    const FlowSnapshot snapshot = ball();
    GivenSurface surface = ofMesh(extracted(snapshot, "isoAlpha").mesh);
    const label n = surface.points.size();
    surface.points.append(point(0.5, 0.5, 0.5)); // no triangle's
    surface.points.append(point(surface.points[0]));
    surface.triangles.append(triFace(0, n + 1, 1));
    surface.welding = Welding::byPosition;
    const InterfaceMesh mesh = put(snapshot, surface).mesh;
    EXPECT_EQ(mesh.points.size(), n);
    EXPECT_EQ(mesh.triangles.size(), surface.triangles.size() - 1);
}

// Single precision puts points beyond the walls that they are on.
TEST(GivenInterface, singlePrecisionIsNotOutside)
{
    const FlowSnapshot snapshot =
        boxSnapshot(shapes::sphere(point(1.1, 0.93, 1.02), 0.55));
    const InterfaceMesh before = extracted(snapshot, "isoAlpha").mesh;
    GivenSurface surface = ofMesh(before);
    label nBeyond = 0;
    for (point& x : surface.points)
    {
        for (direction d = 0; d < 3; ++d)
        {
            x[d] = float(x[d]);
        }
        nBeyond += cmptMax(x - snapshot.complex->bounds().max()) > 0;
    }
    EXPECT_GT(nBeyond, 10);
    const InterfaceMesh after = put(snapshot, surface).mesh;
    forAll(before.points, i)
    {
        EXPECT_EQ(after.boundaryFaces[i] >= 0, before.boundaryFaces[i] >= 0);
    }
}

TEST(GivenInterface, mistakesNameTheFile)
{
    const FlowSnapshot snapshot = ball();
    const GivenSurface good = ofMesh(extracted(snapshot, "isoAlpha").mesh);
    EXPECT_EQ(complaint(snapshot, good), "");

    GivenSurface bad = good;
    bad.points[5].y() = std::numeric_limits<scalar>::quiet_NaN();
    EXPECT_TRUE(
        has(complaint(snapshot, bad), "whole.vtp has a point that is not finite")
    );
    for (const scalar x : {1.2 + 1e-4, 30.0})
    {
        bad = good;
        bad.points[5].x() = x;
        EXPECT_TRUE(has(complaint(snapshot, bad), "whole.vtp has a point outside"))
            << x;
    }
    bad = tornApart(extracted(snapshot, "isoAlpha").mesh, Welding::byName);
    bad.points[5].y() += 1e-3;
    EXPECT_TRUE(has(complaint(snapshot, bad), "torn.vtp has points of the same number")
    );
    bad = good;
    bad.triangles.clear();
    EXPECT_TRUE(has(complaint(snapshot, bad), "whole.vtp has no triangles"));
    EXPECT_THROW(extracted(snapshot, "fromFiles"), BadInput);
}

TEST(GivenInterface, nowhereIsAnEmptyMesh)
{
    GivenSurface nothing;
    for (const scalar value : {0.0, 1.0})
    {
        const auto complex = shapes::unitCube(3);
        const FlowSnapshot snapshot =
            shapes::snapshotOf(complex, scalarField(27, value));
        const ReconstructionResult result = put(snapshot, nothing);
        EXPECT_TRUE(result.mesh.empty());
        EXPECT_NEAR(result.volume, value, 1e-12);
    }
}
