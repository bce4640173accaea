// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/parametrization/seams/DiskCut.H"

#include "core/base/Errors.H"
#include "shapes/RaggedSurface.H"
#include "shapes/Surfaces.H"

#include <gtest/gtest.h>

using namespace Foam;
using namespace Foam::stability;
using namespace Foam::stability::shapes;

namespace
{

struct Case
{
    const char* name;
    PlainSurface surface;
    label euler;  // of the surface
    label nLoops; // of the surface
    bool needsCut;
};

std::vector<Case> cases()
{
    const boundBox box(point(-1, -1, -1), point(1, 1, 1));
    const auto ball = [](const point& p)
    { return mag(p - point(.013, .021, .007)) - .6; };
    // A third loop where a triangle is missing.
    PlainSurface threeLoops = annulus(0.4, 1, 24, 4);
    threeLoops.triangles[60] = threeLoops.triangles[threeLoops.triangles.size() - 1];
    threeLoops.triangles.setSize(threeLoops.triangles.size() - 1);
    return {
        {"sphere", sphere(point(1, 2, 3), 0.7, 3), 2, 0, true},
        {"ragged sphere", marchingTetrahedra(ball, box, 10), 2, 0, true},
        {"torus", torus(1, 0.4, 24, 12), 0, 0, true},
        {"two handles", columns({"XXXXX", "X X X", "XXXXX"}), -2, 0, true},
        {"three handles", columns({"XXXXXXX", "X X X X", "XXXXXXX"}), -4, 0, true},
        {"annulus", annulus(0.5, 1, 16, 3), 0, 2, true},
        {"three loops", threeLoops, -1, 3, true},
        {"hemisphere", hemisphere(point(0, 0, 0), 1, 3), 1, 1, false},
    };
}

} // namespace

TEST(DiskCut, MakesADiskOfAnyTopology)
{
    for (const Case& c : cases())
    {
        SCOPED_TRACE(c.name);
        const SurfaceShape before =
            shapeOf(c.surface.points.size(), c.surface.triangles);
        EXPECT_TRUE(before.manifold);
        EXPECT_EQ(before.euler, c.euler);
        EXPECT_EQ(before.nLoops, c.nLoops);

        const DiskCut cut(c.surface);
        const PlainSurface disk = cut.disk();
        const SurfaceShape after = shapeOf(disk.points.size(), disk.triangles);
        EXPECT_TRUE(after.isDisk());
        EXPECT_EQ(after.euler, 1);
        EXPECT_EQ(after.nLoops, 1);
        EXPECT_EQ(cut.seams().size() > 0, c.needsCut);
        EXPECT_NE(cut.seams().size(), 1);
    }
}

// The corners of the disk stand on the points that the triangles had.
TEST(DiskCut, KeepsTriangles)
{
    const PlainSurface surface = torus(1, 0.4, 24, 12);
    const DiskCut cut(surface);
    ASSERT_EQ(cut.fans().corners.size(), surface.triangles.size());
    forAll(surface.triangles, trianglei)
    {
        for (label k = 0; k < 3; ++k)
        {
            const label vertex = cut.fans().corners[trianglei][k];
            EXPECT_EQ(cut.fans().points[vertex], surface.triangles[trianglei][k]);
            EXPECT_EQ(
                mag(cut.disk().points[vertex]
                    - surface.points[cut.fans().points[vertex]]),
                0
            );
        }
    }
    // Both sides of each seam edge are edges of the boundary.
    const List<labelList> loops =
        boundaryLoops(cut.disk().points.size(), cut.disk().triangles);
    EXPECT_EQ(loops[0].size(), 2 * cut.seams().size());
}

// From pole to pole, as far as the surface is long, and two branches to what is then
// farthest: a quarter of the girth to the back of the slit, and a little less.
TEST(DiskCut, OpensASphereOverItsLength)
{
    const scalar radius = 0.7;
    const PlainSurface surface = sphere(point(1, 2, 3), radius, 4);
    const DiskCut cut(surface);
    const List<labelList> loops =
        boundaryLoops(cut.disk().points.size(), cut.disk().triangles);
    scalar length = 0;
    forAll(loops[0], i)
    {
        length +=
            mag(cut.disk().points[loops[0][i]]
                - cut.disk().points[loops[0][loops[0].fcIndex(i)]]);
    }
    EXPECT_GT(0.5 * length, 0.97 * (1 + 0.5 + 0.25) * M_PI * radius);
    EXPECT_LT(0.5 * length, 1.25 * (1 + 0.5 + 0.25) * M_PI * radius);
}

// The smallest closed surface: its farthest points are one edge apart, and one edge
// opens nothing. With the branch to the fourth point the cut is a tree of three edges.
TEST(DiskCut, OpensATetrahedron)
{
    PlainSurface surface;
    surface.points =
        pointField({point(0, 0, 0), point(1, 0, 0), point(0, 1, 0), point(0, 0, 1)});
    surface.triangles = List<triFace>(
        {triFace(0, 2, 1), triFace(0, 1, 3), triFace(1, 2, 3), triFace(0, 3, 2)}
    );
    const DiskCut cut(surface);
    EXPECT_EQ(cut.seams().size(), 3);
    EXPECT_EQ(cut.disk().points.size(), 6);
}

// A band with a half twist is not oriented: the edge where its triangles disagree is
// a boundary.
TEST(DiskCut, TreatsAMobiusBandAsOpen)
{
    PlainSurface surface = grid(
        [](scalar u, scalar v)
        {
            const scalar phi = 2 * M_PI * u, r = 1 + (v - .5) * std::cos(.5 * phi);
            return point(
                r * std::cos(phi), r * std::sin(phi), (v - .5) * std::sin(.5 * phi)
            );
        },
        20, 2
    );
    // Weld the last column to the first one, upside down.
    labelList renumber = identity(surface.points.size());
    forAll(surface.points, i)
    {
        forAll(surface.points, j)
        {
            if (j < i && mag(surface.points[i] - surface.points[j]) < 1e-12)
            {
                renumber[i] = j;
            }
        }
    }
    label nWelded = 0;
    for (triFace& t : surface.triangles)
    {
        for (label& i : t)
        {
            nWelded += renumber[i] != i;
            i = renumber[i];
        }
    }
    ASSERT_GT(nWelded, 0);
    const DiskCut cut(surface);
    EXPECT_TRUE(shapeOf(cut.disk().points.size(), cut.disk().triangles).isDisk());
    EXPECT_EQ(cut.seams().size(), 0);
}

TEST(DiskCut, ExtendsToAPoint)
{
    const PlainSurface surface = hemisphere(point(0, 0, 0), 1, 3);
    label top = 0;
    forAll(surface.points, i)
    {
        top = surface.points[i].z() > surface.points[top].z() ? i : top;
    }
    DiskCut cut(surface);
    EXPECT_TRUE(cut.extendTo(top));
    EXPECT_GE(cut.seams().size(), 5);
    EXPECT_TRUE(shapeOf(cut.disk().points.size(), cut.disk().triangles).isDisk());
    EXPECT_EQ(cut.disk().points.size(), surface.points.size() + cut.seams().size());
    EXPECT_FALSE(cut.extendTo(top));
}

TEST(DiskCut, RefusesWhatIsNotOneComponent)
{
    const PlainSurface two =
        inOneScene({hemisphere(point(0, 0, 0), 1, 2), hemisphere(point(5, 0, 0), 1, 2)}
        );
    EXPECT_THROW(DiskCut{two}, NumericalFailure);
}
