// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/reconstruction/IsoAlpha.H"
#include "shapes/ExactAlpha.H"
#include "shapes/PolyMeshes.H"
#include "shapes/ReconstructionErrors.H"
#include "shapes/SurfaceChecks.H"

#include <gtest/gtest.h>

#include <algorithm>

using namespace Foam;
using namespace Foam::stability;

namespace
{

ReconstructionOptions smoothedIsoAlpha(label pairs)
{
    ReconstructionOptions options;
    options.smooth = pairs;
    return options;
}

// The same mesh with its cells numbered backwards: owners and neighbours swap.
CellComplexInput renumbered(CellComplexInput input, label nCells)
{
    forAll(input.owner, facei)
    {
        label& owner = input.owner[facei];
        owner = nCells - 1 - owner;
        if (facei < input.neighbour.size())
        {
            label& neighbour = input.neighbour[facei];
            neighbour = nCells - 1 - neighbour;
            std::swap(owner, neighbour);
            input.faces[facei].flip();
        }
    }
    return input;
}

pointField sorted(pointField points)
{
    const auto before = [](const point& a, const point& b)
    {
        for (direction d = 0; d < 3; ++d)
        {
            if (mag(a[d] - b[d]) > 1e-9)
            {
                return a[d] < b[d];
            }
        }
        return false;
    };
    std::sort(points.begin(), points.end(), before);
    return points;
}

} // namespace

// B4: a ball of R = 9.6 h, exact fractions, centres off the grid.
TEST(IsoAlpha, ballOfExactFractions)
{
    const shapes::BallErrors errors =
        shapes::ballErrors(*std::make_unique<IsoAlpha>(smoothedIsoAlpha(0)), 6);
    EXPECT_GT(errors.meanVolume, -0.013);
    EXPECT_LT(errors.meanVolume, -0.008);
    EXPECT_LT(errors.largestDistance, 0.2);
    EXPECT_GT(errors.largestDistance, 0.1);
    EXPECT_NEAR(errors.rmsDistance, 0.063, 0.008);
    EXPECT_NEAR(errors.meanArea, 0.02, 0.01);
}

TEST(IsoAlpha, smoothingFlattensTheStaircase)
{
    const shapes::BallErrors five =
        shapes::ballErrors(IsoAlpha(smoothedIsoAlpha(5)), 3);
    const shapes::BallErrors ten =
        shapes::ballErrors(IsoAlpha(smoothedIsoAlpha(10)), 3);
    EXPECT_LT(mag(five.meanArea), 0.005);
    EXPECT_LT(mag(ten.meanArea), 0.005);
    EXPECT_LT(five.largestDistance, 0.14);
    EXPECT_LT(five.rmsDistance, 0.054);
    EXPECT_NEAR(ten.meanVolume, -0.009, 0.003); // it does not shrink
}

// B17, a plane that moves through the cells.
TEST(IsoAlpha, movingPlane)
{
    const scalar largest = shapes::planeError(IsoAlpha(smoothedIsoAlpha(0)));
    EXPECT_LT(largest, 0.2);
    EXPECT_GT(largest, 0.05);
}

// A plane between two layers of cells is met exactly, but for cuts that are kept off
// the mesh points: a thousandth of their edges.
TEST(IsoAlpha, alignedPlaneAfterWholeCellsIsExact)
{
    const auto complex = shapes::unitCube(10);
    const shapes::Shape shape = shapes::halfSpace(point(0.6, 0, 0), vector(1, 0, 0));
    const auto result =
        IsoAlpha(smoothedIsoAlpha(0)).extract(shapes::snapshotOf(complex, shape));
    EXPECT_NEAR(result.volume, 0.6, 1e-3 * 0.05);
    EXPECT_NEAR(result.mesh.area(), 1, 1e-5);
    EXPECT_LT(mag(result.volumeError()), 1e-4);
}

// A start from setFields has means of exactly 1/2: no numbering may turn them.
TEST(IsoAlpha, numberingDoesNotChangeTheSurface)
{
    shapes::BoxOptions options;
    options.min = point(0.1, -0.2, 0.3);
    options.max = point(1.07, 0.83, 1.41);
    options.n = Vector<label>(17, 13, 15);
    const label n = 17 * 13 * 15;
    const CellComplexInput input = shapes::boxInput(options);
    const auto plain = shapes::complexOf(input);
    const auto other = shapes::complexOf(renumbered(input, n));

    const shapes::Shape ball = shapes::sphere(point(0.5, 0.3, 0.9), 0.41);
    scalarField alpha(n);
    scalarField reversed(n);
    for (label celli = 0; celli < n; ++celli)
    {
        alpha[celli] = ball(plain->cellCentres()[celli]) < 0;
        reversed[n - 1 - celli] = alpha[celli];
    }
    const IsoAlpha method(smoothedIsoAlpha(0));
    const auto a = method.extract(shapes::snapshotOf(plain, alpha));
    const auto b = method.extract(shapes::snapshotOf(other, reversed));
    ASSERT_GT(a.mesh.points.size(), 500);
    ASSERT_EQ(a.mesh.points.size(), b.mesh.points.size());
    EXPECT_EQ(a.mesh.triangles.size(), b.mesh.triangles.size());
    EXPECT_LT(max(mag(sorted(a.mesh.points) - sorted(b.mesh.points))), 1e-12);
}

// A face of two pieces between the same two cells is one face.
TEST(IsoAlpha, facesInPiecesStayManifold)
{
    shapes::BoxOptions options;
    options.n = Vector<label>(4, 3, 3);
    CellComplexInput input = shapes::boxInput(options);
    // Cut one inner face along its diagonal.
    const label facei = 20;
    const face f = input.faces[facei];
    ASSERT_EQ(f.size(), 4);
    input.faces[facei] = face{f[0], f[1], f[2]};
    const auto insertAt = [](auto& list, label i, const auto& value)
    {
        list.setSize(list.size() + 1);
        std::rotate(list.begin() + i, list.end() - 1, list.end());
        list[i] = value;
    };
    const label owner = input.owner[facei];
    const label neighbour = input.neighbour[facei];
    insertAt(input.faces, facei + 1, face{f[0], f[2], f[3]});
    insertAt(input.owner, facei + 1, owner);
    insertAt(input.neighbour, facei + 1, neighbour);

    scalarField alpha(36, 0.1);
    alpha[owner] = 0.9;
    const auto result =
        IsoAlpha(smoothedIsoAlpha(0))
            .extract(shapes::snapshotOf(shapes::complexOf(input), alpha));
    const shapes::SurfaceReport report = shapes::inspect(result.mesh);
    EXPECT_GT(result.mesh.triangles.size(), 10);
    EXPECT_EQ(report.nCrowded, 0);
    EXPECT_EQ(report.nRimInside, 0);
    EXPECT_EQ(report.nMisoriented, 0);
}
