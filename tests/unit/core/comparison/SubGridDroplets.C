// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/comparison/SmallScales.H"
#include "core/reconstruction/Reconstruction.H"
#include "shapes/BoxMesh.H"
#include "shapes/ExactAlpha.H"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

using namespace Foam;
using namespace Foam::stability;

namespace
{

constexpr scalar h = 0.25; // [m]
const point centre(3.53, 3.41, 3.62);

struct Found
{
    std::vector<Droplet> droplets;
    label nPoints = 0;  // of the surface
    label nFlagged = 0; // of them
};

Found find(const shapes::Shape& shape, Sharpening sharpening = Sharpening::none)
{
    shapes::BoxOptions box;
    box.max = point(30, 30, 30) * h;
    box.n = Vector<label>(30, 30, 30);
    const auto snapshot =
        std::make_shared<const FlowSnapshot>(shapes::snapshotOf(shapes::box(box), shape)
        );
    ReconstructionOptions options;
    options.sharpening = sharpening;
    const SurfacePiece surface(
        wholeSurface(Reconstruction::New(options)->extract(*snapshot).mesh)
    );
    const SerialExchange alone;
    const SurfaceHalo halo(surface, VoxelMask(h), alone);
    const SmallScales scales(smallScales(
        surface, halo, Components(halo, centre, alone), snapshot, Run{alone, 1}
    ));
    Found found;
    found.droplets = scales.droplets;
    const List<bool>& flags = scales.subGrid;
    found.nPoints = flags.size();
    found.nFlagged = label(std::count(flags.begin(), flags.end(), true));
    return found;
}

shapes::Shape drop(scalar cells, const point& at = centre)
{
    return shapes::sphere(at, cells * h);
}

shapes::Shape outside(const shapes::Shape& shape)
{
    return [=](const point& x) { return -shape(x); };
}

scalar ballVolume(scalar cells)
{
    return 4 * M_PI / 3 * pow3(cells * h);
}

} // namespace

TEST(SubGridDroplets, volumeAndCentroidOfADropletAndABubbleAreThoseOfAlpha)
{
    for (const Sharpening sharpening : {Sharpening::none, Sharpening::automatic})
    {
        for (const bool bubble : {false, true})
        {
            const Found found =
                find(bubble ? outside(drop(1.2)) : drop(1.2), sharpening);
            ASSERT_EQ(found.droplets.size(), 1u);
            const Droplet& d = found.droplets[0];
            EXPECT_EQ(d.bubble, bubble);
            EXPECT_TRUE(d.fromAlpha);
            EXPECT_NEAR(d.radius, 1.2, 1e-3);
            EXPECT_NEAR(d.volume / ballVolume(1.2), 1, 2e-3);
            EXPECT_LT(mag(d.centroid - centre), 0.02 * h); // of cells' centres
            EXPECT_EQ(d.nPoints, found.nPoints);
            EXPECT_EQ(found.nFlagged, found.nPoints);
            EXPECT_GT(found.nPoints, 20);
        }
    }
}

TEST(SubGridDroplets, dropletsOfThreeCellsAreNot)
{
    for (const Sharpening sharpening : {Sharpening::none, Sharpening::automatic})
    {
        for (const scalar cells : {1.53, 3.0})
        {
            const Found found = find(drop(cells), sharpening);
            EXPECT_TRUE(found.droplets.empty()) << cells;
            EXPECT_EQ(found.nFlagged, 0);
        }
    }
}

// The isosurface of a droplet of 1.47 cells is a third too small, alpha is not.
TEST(SubGridDroplets, alphaDecidesNotTheSurface)
{
    const Found found = find(drop(1.47));
    ASSERT_EQ(found.droplets.size(), 1u);
    EXPECT_NEAR(found.droplets[0].radius, 1.47, 1e-3);
}

// Where two droplets share mixed cells, and where one trails a thread of its
// fluid, alpha is not the droplet's alone.
TEST(SubGridDroplets, theSurfaceTellsWhereAlphaIsNotOfOneDropletAlone)
{
    const point beside = centre + vector(3.1, 0.2, 0.1) * h;
    const Found two = find(shapes::unionOf(drop(1.3), drop(1.3, beside)));
    ASSERT_EQ(two.droplets.size(), 2u);
    EXPECT_EQ(two.droplets[1].component, 1);
    for (const Droplet& d : two.droplets)
    {
        EXPECT_FALSE(d.fromAlpha);
        EXPECT_LT(d.volume, 0.9 * ballVolume(1.3)); // what isosurfaces lose
        EXPECT_GT(d.volume, 0.4 * ballVolume(1.3));
        const scalar off = std::min(mag(d.centroid - centre), mag(d.centroid - beside));
        EXPECT_LT(off, 0.1 * h);
    }
    EXPECT_EQ(two.nFlagged, two.nPoints);

    const vector wide(0.1 * h, 0.1 * h, 0);
    const shapes::Shape thread =
        shapes::block(centre - wide, centre + wide + vector(0, 0, 6 * h));
    const Found trailing = find(shapes::unionOf(drop(1.3), thread));
    ASSERT_EQ(trailing.droplets.size(), 1u);
    EXPECT_FALSE(trailing.droplets[0].fromAlpha);
}

// Each alone, however far it is from the other.
TEST(SubGridDroplets, dropletsBesideLargeOnesAreFoundAlone)
{
    const point far(1.2, 1.1, 6.1);
    const Found found = find(shapes::unionOf(drop(4), drop(1.2, far)));
    ASSERT_EQ(found.droplets.size(), 1u);
    EXPECT_TRUE(found.droplets[0].fromAlpha);
    EXPECT_LT(mag(found.droplets[0].centroid - far), 0.02 * h);
    EXPECT_EQ(found.nFlagged, found.droplets[0].nPoints);
    EXPECT_LT(found.nFlagged, found.nPoints / 4);
}

TEST(SubGridDroplets, whatTouchesAWallIsNotClosed)
{
    const Found found = find(drop(1.2, point(3.53, 3.41, 0.3 * h)));
    EXPECT_GT(found.nPoints, 10);
    EXPECT_TRUE(found.droplets.empty());
}

TEST(SubGridDroplets, aRowTellsADropletAtATime)
{
    const Droplet droplet{4, true, false, 1.25, 1e-3, point(5, 6, 7), 8};
    const DropletRow row{droplet, 0.5};
    std::map<std::string, scalar> values;
    for (const TableColumn<DropletRow>& column : dropletTable().columns)
    {
        EXPECT_TRUE(values.emplace(column.name, column.value(row)).second);
    }
    const std::map<std::string, scalar> expected{
        {"Time", 0.5},    {"component", 4}, {"bubble", 1},    {"fromAlpha", 0},
        {"radius", 1.25}, {"volume", 1e-3}, {"centroidX", 5}, {"centroidY", 6},
        {"centroidZ", 7}, {"points", 8}};
    EXPECT_EQ(values, expected);
}

TEST(SubGridDroplets, whereAllIsFullThereAreNone)
{
    EXPECT_TRUE(find([](const point&) { return 1.0; }).droplets.empty());
}
