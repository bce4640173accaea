// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/comparison/SmallScales.H"
#include "core/comparison/ThinSheets.H"
#include "core/reconstruction/Reconstruction.H"
#include "shapes/BoxMesh.H"
#include "shapes/ExactAlpha.H"
#include "shapes/Surfaces.H"

#include <gtest/gtest.h>

#include <algorithm>

using namespace Foam;
using namespace Foam::stability;

namespace
{

// The share of the points away from the walls that are thin. Cells of one
// metre.
scalar thinShare(const shapes::Shape& shape, Sharpening sharpening)
{
    shapes::BoxOptions box;
    box.max = point(14, 14, 14);
    box.n = Vector<label>(14, 14, 14);
    ReconstructionOptions options;
    options.sharpening = sharpening;
    const InterfaceMesh mesh =
        Reconstruction::New(options)
            ->extract(shapes::snapshotOf(shapes::box(box), shape))
            .mesh;
    const List<bool> thin(thinPoints(mesh, mesh.cellSizes, 2));
    EXPECT_EQ(thin.size(), mesh.points.size());
    label nThin = 0, n = 0;
    forAll(thin, pointi)
    {
        if (cmptMin(mesh.points[pointi]) > 2 && cmptMax(mesh.points[pointi]) < 12)
        {
            ++n;
            nThin += thin[pointi];
        }
    }
    EXPECT_GT(n, 100);
    return scalar(nThin) / n;
}

// Layers of cells lie within it, so that their alpha exceeds 1/2.
shapes::Shape sheet(scalar thickness)
{
    const vector n = vector(0.04, 0.03, 1) / mag(vector(0.04, 0.03, 1));
    return [=](const point& x)
    { return mag((x - point(7.03, 6.98, 6.51)) & n) - 0.5 * thickness; };
}

shapes::Shape gap(const shapes::Shape& shape)
{
    return [=](const point& x) { return -shape(x); };
}

InterfaceMesh plane(scalar height, bool upwards, scalar cellSize)
{
    const auto up = [=](scalar u, scalar v) { return point(u, v, height); };
    const auto down = [=](scalar u, scalar v) { return point(v, u, height); };
    return shapes::asInterface(
        upwards ? shapes::grid(up, 9, 7) : shapes::grid(down, 7, 9), cellSize
    );
}

// Two planes over each other as one surface.
label nThin(scalar distance, bool lowerUpwards, bool upperUpwards)
{
    InterfaceMesh both(plane(0, lowerUpwards, 0.1));
    const InterfaceMesh upper(plane(distance, upperUpwards, 0.1));
    const label n = both.points.size();
    both.points.append(upper.points);
    for (triFace t : upper.triangles)
    {
        both.triangles.append(triFace(t[0] + n, t[1] + n, t[2] + n));
    }
    both.cellSizes = scalarField(both.points.size(), 0.1);
    const List<bool> thin(thinPoints(both, both.cellSizes, 1));
    return label(std::count(thin.begin(), thin.end(), true));
}

} // namespace

TEST(ThinSheets, sheetsBelowOneAndAHalfCellsAreThin)
{
    for (const Sharpening sharpening : {Sharpening::none, Sharpening::automatic})
    {
        EXPECT_GT(thinShare(sheet(0.8), sharpening), 0.99);
        EXPECT_EQ(thinShare(sheet(3), sharpening), 0);
        EXPECT_GT(thinShare(gap(sheet(0.8)), sharpening), 0.99);
        EXPECT_EQ(thinShare(gap(sheet(3)), sharpening), 0);
    }
}

// 80 points each, none at the rim left out: the rays are orthogonal to the
// planes.
TEST(ThinSheets, theOppositeSideFacesTheOtherWayWithinReach)
{
    EXPECT_EQ(nThin(0.149, true, false), 160);
    EXPECT_EQ(nThin(0.149, false, true), 160);
    EXPECT_EQ(nThin(0.151, true, false), 0);
    EXPECT_EQ(nThin(0.1, true, true), 0);
}

TEST(ThinSheets, aDropletOfThreeCellsIsNot)
{
    for (const Sharpening sharpening : {Sharpening::none, Sharpening::automatic})
    {
        EXPECT_EQ(thinShare(shapes::sphere(point(7.1, 6.8, 7.3), 3), sharpening), 0);
    }
}

// Layers of 0.1 m of cells of 1 m: a sheet of four layers is resolved, though thinner
// than half a cell by volume; one of 0.8 layers is not.
TEST(ThinSheets, sheetsInFlatCellsAreMeasuredInLayers)
{
    const SerialExchange alone;
    const auto thinIn = [&](scalar layers)
    {
        shapes::BoxOptions box;
        box.n = Vector<label>(8, 8, 20);
        box.max = point(8, 8, 2);
        const auto snapshot = std::make_shared<const FlowSnapshot>(shapes::snapshotOf(
            shapes::box(box),
            [=](const point& x) { return mag(x.z() - 1.05) - 0.05 * layers; }
        ));
        const SurfacePiece piece(wholeSurface(
            Reconstruction::New(ReconstructionOptions())->extract(*snapshot).mesh
        ));
        const SurfaceHalo halo(piece, VoxelMask(1), alone);
        const Components components(halo, point::zero, alone);
        const SmallScales scales(
            smallScales(piece, halo, components, snapshot, stability::Run{alone, 1})
        );
        EXPECT_GT(scales.thin.size(), 100);
        return scalar(std::count(scales.thin.begin(), scales.thin.end(), true))
               / scales.thin.size();
    };
    EXPECT_EQ(thinIn(4), 0);
    EXPECT_GT(thinIn(0.8), 0.99);
}

TEST(ThinSheets, nothingIsNotThin)
{
    EXPECT_TRUE(thinPoints(InterfaceMesh(), scalarField(), 1).empty());
}
