// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/surface/InterfaceMesh.H"

#include <gtest/gtest.h>

using namespace Foam;
using namespace Foam::stability;

namespace
{

// Two triangles of unequal size that share an edge, in a tilted plane.
InterfaceMesh kite()
{
    InterfaceMesh mesh;
    mesh.points =
        List<point>{point(0, 0, 0), point(2, 0, 2), point(2, 1, 2), point(0, 3, 0)};
    mesh.triangles = List<triFace>{triFace(0, 1, 2), triFace(0, 2, 3)};
    mesh.clearParametrization();
    return mesh;
}

} // namespace

TEST(InterfaceMesh, pointAreasAddUpToTheArea)
{
    const InterfaceMesh mesh(kite());
    const scalar first = 0.5 * std::sqrt(8.0) * 1;
    const scalar second = 0.5 * 3 * std::sqrt(8.0);
    EXPECT_NEAR(mesh.area(), first + second, 1e-14);
    const scalarField areas(mesh.pointAreas());
    EXPECT_NEAR(areas[0], (first + second) / 3, 1e-14);
    EXPECT_NEAR(areas[1], first / 3, 1e-14);
    EXPECT_NEAR(sum(areas), mesh.area(), 1e-14);
}

TEST(InterfaceMesh, normalsFollowTheRightHand)
{
    const InterfaceMesh mesh(kite());
    const vector exact = vector(-1, 0, 1) / std::sqrt(2.0);
    for (const vector& n : mesh.pointNormals())
    {
        EXPECT_LT(mag(n - exact), 1e-14);
    }
}

TEST(InterfaceMesh, clearingLeavesNoParameter)
{
    InterfaceMesh mesh(kite());
    mesh.parameters = List<vector2D>{vector2D(0.1, 0.2)};
    mesh.corners[0] = CornerIndices(0);
    EXPECT_TRUE(mesh.parametrized(0));
    EXPECT_FALSE(mesh.parametrized(1));
    mesh.corners[0][2] = InterfaceMesh::noParameter;
    EXPECT_FALSE(mesh.parametrized(0));
    mesh.clearParametrization();
    EXPECT_TRUE(mesh.parameters.empty());
    EXPECT_EQ(mesh.corners.size(), 2);
    EXPECT_EQ(mesh.origins.size(), 4);
}
