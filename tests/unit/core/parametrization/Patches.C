// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/parametrization/Patches.H"

#include "core/parametrization/SurfaceShape.H"
#include "shapes/Surfaces.H"

#include <gtest/gtest.h>

using namespace Foam;
using namespace Foam::stability;
using namespace Foam::stability::shapes;

namespace
{

// The points of the patches are those of the interface.
void expectSamePoints(const InterfaceMesh& mesh, const List<Patch>& patches)
{
    for (const Patch& patch : patches)
    {
        ASSERT_EQ(patch.points.size(), patch.surface.points.size());
        forAll(patch.points, i)
        {
            EXPECT_EQ(patch.surface.points[i], mesh.points[patch.points[i]]);
        }
    }
}

} // namespace

TEST(Patches, AreComponentsInOrder)
{
    const PlainSurface drop = sphere(point(9, 0, 0), 0.1, 1);
    const PlainSurface sheet = hemisphere(point(0, 0, 0), 1, 2);
    const InterfaceMesh mesh = asInterface(inOneScene({drop, sheet, drop}), 0.1);
    const List<Patch> patches = patchesOf(mesh);
    ASSERT_EQ(patches.size(), 3);
    EXPECT_EQ(patches[0].surface.triangles.size(), drop.triangles.size());
    EXPECT_EQ(patches[1].surface.triangles.size(), sheet.triangles.size());
    EXPECT_EQ(patches[2].surface.triangles.size(), drop.triangles.size());
    EXPECT_EQ(patches[1].surface.points.size(), sheet.points.size());
    expectSamePoints(mesh, patches);
    EXPECT_TRUE(patchesOf(InterfaceMesh()).empty());
}

TEST(Patches, PartWhereMaterialsChange)
{
    InterfaceMesh mesh = asInterface(sphere(point(0, 0, 0), 1, 3), 0.1);
    forAll(mesh.triangles, trianglei)
    {
        const bool upper = mesh.centre(trianglei).z() > 0.1;
        mesh.materials[trianglei] = upper ? labelPair(0, 2) : labelPair(0, 1);
    }
    const List<Patch> patches = patchesOf(mesh);
    ASSERT_EQ(patches.size(), 2);
    EXPECT_NE(patches[0].materials, patches[1].materials);
    for (const Patch& patch : patches)
    {
        const SurfaceShape shape =
            shapeOf(patch.surface.points.size(), patch.surface.triangles);
        EXPECT_TRUE(shape.isDisk());
        const bool upper = patch.materials == labelPair(0, 2);
        EXPECT_EQ(
            patch.surface.triangles[0].centre(patch.surface.points).z() > 0.1, upper
        );
    }
}

// Three sheets at one edge, as where three materials meet.
TEST(Patches, PartAtNonManifoldEdges)
{
    InterfaceMesh mesh;
    mesh.points = pointField(
        {point(0, 0, 0), point(0, 0, 1), point(1, 0, 0), point(-1, 1, 0),
         point(-1, -1, 0)}
    );
    mesh.triangles =
        List<triFace>({triFace(0, 1, 2), triFace(0, 1, 3), triFace(0, 1, 4)});
    mesh.clearParametrization();
    EXPECT_EQ(patchesOf(mesh).size(), 3);
}

// Two cones that share their tip are two components; a surface that touches itself
// in a point gets two points there.
TEST(Patches, PartAtPoints)
{
    InterfaceMesh mesh;
    mesh.points = pointField(
        {point(0, 0, 0), point(1, 0, 1), point(0, 1, 1), point(-1, -1, 1),
         point(1, 0, -1), point(0, 1, -1), point(-1, -1, -1)}
    );
    mesh.triangles = List<triFace>(
        {triFace(0, 1, 2), triFace(0, 2, 3), triFace(0, 3, 1), triFace(0, 5, 4),
         triFace(0, 6, 5), triFace(0, 4, 6)}
    );
    mesh.clearParametrization();
    const List<Patch> patches = patchesOf(mesh);
    ASSERT_EQ(patches.size(), 2);
    EXPECT_EQ(patches[0].surface.points.size(), 4);
    EXPECT_EQ(patches[1].surface.points.size(), 4);
    expectSamePoints(mesh, patches);
}
