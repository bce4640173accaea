// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/cells/ThinWallPoints.H"

#include "shapes/BoxMesh.H"
#include "shapes/CutOut.H"
#include "shapes/PolyMeshes.H"

#include <gtest/gtest.h>

using namespace Foam;
using namespace Foam::stability;

namespace
{

bool nowhere(const point&)
{
    return false;
}

// A wall at x = 1/2, from the floor to this height.
auto wallTo(scalar height)
{
    return [height](const point& x)
    { return mag(x.x() - 0.5) < 0.05 && x.z() < height; };
}

// The unit cube with a thin wall, its points split.
CellComplexInput parted(const CellComplexInput& mesh, scalar height)
{
    CellComplexInput result(shapes::cutOut(mesh, nowhere, wallTo(height)));
    splitThinWallPoints(result);
    return result;
}

} // namespace

TEST(ThinWallPoints, eachSideHasPointsOfItsOwnAndTheRimIsOne)
{
    const shapes::BoxOptions box; // 8 x 8 x 8
    const CellComplexInput plain(shapes::boxInput(box));
    const CellComplex complex(parted(plain, 0.5));
    // The wall's points below its rim, with those on the sides of the box.
    const label nDoubled = 9 * 4;
    EXPECT_EQ(complex.nPoints(), plain.points.size() + nDoubled);
    label nOnWall = 0, nOnRim = 0;
    forAll(complex.points(), pointi)
    {
        const point& x = complex.points()[pointi];
        if (mag(x.x() - 0.5) > 1e-9 || x.z() > 0.5 + 1e-9)
        {
            continue;
        }
        bool left = false, right = false;
        for (const label celli : complex.pointCells()[pointi])
        {
            const bool isLeft = complex.cellCentres()[celli].x() < 0.5;
            left = left || isLeft;
            right = right || !isLeft;
        }
        const bool rim = x.z() > 0.5 - 1e-9;
        EXPECT_EQ(left && right, rim);
        (rim ? nOnRim : nOnWall) += 1;
    }
    EXPECT_EQ(nOnWall, 2 * nDoubled);
    EXPECT_EQ(nOnRim, 9);
    // No cell sees the other side, but where the wall ends.
    const label celli = complex.findCell(point(0.49, 0.45, 0.2));
    for (const label other : complex.pointNeighbours(celli))
    {
        EXPECT_LT(complex.cellCentres()[other].x(), 0.5);
    }
}

TEST(ThinWallPoints, aMeshWithoutThemStays)
{
    const CellComplexInput plain(shapes::boxInput(shapes::BoxOptions()));
    const auto inObstacle = [](const point& x)
    { return mag(x - point(0.5, 0.5, 0)) < 0.3; };
    for (const CellComplexInput& mesh :
         {plain, shapes::cutOut(plain, inObstacle),
          shapes::refinedBox(shapes::BoxOptions(), inObstacle)})
    {
        CellComplexInput split(mesh);
        splitThinWallPoints(split);
        EXPECT_EQ(split.points, mesh.points);
        EXPECT_EQ(split.faces, mesh.faces);
    }
}

// Obstacles that touch along an edge: no fluid passes there.
TEST(ThinWallPoints, cellsThatOnlyTouchAreParted)
{
    const auto diagonal = [](const point& x) { return (x.x() < 0.5) != (x.y() < 0.5); };
    CellComplexInput mesh(
        shapes::cutOut(shapes::boxInput(shapes::BoxOptions()), diagonal)
    );
    const label nPoints = mesh.points.size();
    splitThinWallPoints(mesh);
    EXPECT_EQ(mesh.points.size(), nPoints + 9);
}
