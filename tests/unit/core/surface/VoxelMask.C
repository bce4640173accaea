// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/surface/VoxelMask.H"

#include <gtest/gtest.h>

using namespace Foam;
using namespace Foam::stability;

namespace
{

// Does the region meet the box, within another box?
bool meet(
    const VoxelMask& mask, const boundBox& box,
    const boundBox& within = boundBox(point(-99, -99, -99), point(99, 99, 99))
)
{
    VoxelIndex index(mask.size());
    index.add(boundBox(point(77, 77, 77), point(78, 78, 78)));
    index.add(box);
    const DynamicList<label> found(index.meeting(mask.within(within)));
    EXPECT_TRUE(found.empty() || (found.size() == 1 && found[0] == 1));
    return !found.empty();
}

} // namespace

TEST(VoxelMask, meetsWhatIsNearAndNothingElse)
{
    VoxelMask mask(0.5);
    mask.add(point(0.25, 0.25, 0.25), 0.1);
    EXPECT_TRUE(meet(mask, boundBox(point(0.4, 0.4, 0.4), point(3, 3, 3))));
    EXPECT_FALSE(meet(mask, boundBox(point(0.51, 0, 0), point(3, 3, 3))));
    EXPECT_TRUE(meet(mask, boundBox(point(-9, 0.1, 0.1), point(9, 0.2, 0.2))));
    EXPECT_FALSE(meet(mask, boundBox(point(-9, -0.2, 0.1), point(9, -0.1, 0.2))));

    // Points of one voxel add as much as each alone.
    VoxelMask many(0.5);
    many.add(point(0.25, 0.25, 0.25), 0.5);
    many.add(point(0.45, 0.25, 0.25), 0.5);
    EXPECT_TRUE(meet(many, boundBox(point(0.9, 0.2, 0.2), point(0.95, 0.3, 0.3))));
    EXPECT_FALSE(meet(many, boundBox(point(1.1, 0.2, 0.2), point(1.2, 0.3, 0.3))));

    // Several voxels far, for all points of a voxel at once; more than that adds more.
    VoxelMask wide(0.5);
    wide.add(point(0.25, 0.25, 0.25), 1);
    wide.add(point(0.45, 0.25, 0.25), 1);
    const boundBox atReach(point(1.4, 0.2, 0.2), point(1.45, 0.3, 0.3));
    const boundBox beyond(point(1.6, 0.2, 0.2), point(1.7, 0.3, 0.3));
    EXPECT_TRUE(meet(wide, atReach));
    EXPECT_TRUE(wide.meets(atReach));
    EXPECT_FALSE(meet(wide, beyond));
    EXPECT_FALSE(wide.meets(beyond));
    EXPECT_TRUE(wide.meets(boundBox(point(-9, -9, -9), point(-0.8, 0.4, 0.4))));
    wide.add(point(0.25, 0.25, 0.25), 1.5);
    EXPECT_TRUE(wide.meets(beyond));

    // A large triangle is followed along its surface, not by its box.
    VoxelMask triangle(0.1);
    const boundBox all(point(-9, -9, -9), point(9, 9, 9));
    triangle.add(point(0, 0, 0), point(4, 0, 4), point(0, 3, 0), 0.01, all);
    const boundBox onIt(point(2, 0.5, 2), point(2.01, 0.51, 2.01));
    EXPECT_TRUE(meet(triangle, onIt));
    EXPECT_TRUE(meet(triangle, onIt, boundBox(point(1, 0, 0), point(3, 3, 4))));
    EXPECT_FALSE(meet(triangle, onIt, boundBox(point(3, 0, 3), point(4, 3, 4))));
    EXPECT_FALSE(meet(triangle, boundBox(point(3, 0.5, 1), point(3.2, 0.7, 1.2))));

    // Of one that would never end what is in the box.
    VoxelMask far(0.1);
    far.add(point(-1, 0, 0), point(1e9, 0, 0), point(-1, 1e9, 0), 0.1, all);
    EXPECT_TRUE(meet(far, boundBox(point(4, 4, 0.01), point(4.01, 4.01, 0.02))));
    EXPECT_FALSE(meet(far, boundBox(point(20, 20, 0), point(21, 21, 0.1))));
}
