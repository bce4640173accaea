// SPDX-License-Identifier: GPL-3.0-or-later

#include "shapes/ExactAlpha.H"
#include "shapes/PolyMeshes.H"
#include "mathematicalConstants.H"

#include <gtest/gtest.h>

using namespace Foam;
using namespace Foam::stability;

namespace
{

using constant::mathematical::pi;

scalar volumeInside(const CellComplex& complex, const scalarField& alpha)
{
    return sum(alpha * complex.cellVolumes());
}

} // namespace

TEST(ExactAlpha, sphereHasItsVolumeOnEveryMesh)
{
    shapes::BoxOptions options;
    options.n = Vector<label>(12, 12, 12);
    const shapes::Shape ball = shapes::sphere(point(0.513, 0.479, 0.527), 0.31);
    const scalar exact = 4.0 / 3 * pi * pow3(0.31);
    const auto left = [](const point& x) { return x.x() < 0.5; };
    for (const CellComplexInput& input :
         {shapes::boxInput(options), shapes::perturbedBox(options),
          shapes::refinedBox(options, left)})
    {
        const CellComplex complex(input);
        const scalarField alpha = shapes::exactAlpha(complex, ball);
        EXPECT_NEAR(volumeInside(complex, alpha) / exact, 1, 1e-6);
    }
}

TEST(ExactAlpha, torusHasItsVolume)
{
    const CellComplex complex(shapes::boxInput(shapes::boxOf(12)));
    const shapes::Shape ring =
        shapes::torus(point(6.13, 5.87, 6.08), vector(1, 2, 3), 3.3, 1.9);
    const scalar exact = 2 * sqr(pi) * 3.3 * sqr(1.9);
    const scalarField alpha = shapes::exactAlpha(complex, ring);
    EXPECT_NEAR(volumeInside(complex, alpha) / exact, 1, 1e-5);
}

TEST(ExactAlpha, cellsAreExactToOneInAMillion)
{
    const auto complex = shapes::unitCube(20);
    const shapes::Shape ball = shapes::sphere(point(0.513, 0.479, 0.527), 0.31);
    const scalarField coarse = shapes::exactAlpha(*complex, ball, 2);
    const scalarField fine = shapes::exactAlpha(*complex, ball, 4);
    EXPECT_LT(max(mag(coarse - fine)), 3e-6);
    EXPECT_GT(max(mag(coarse - fine)), 0); // the depth does something
}

// The half space x + 2 y + 3 z < 0.3 (h) cuts a tetrahedron off the corner of a cube.
TEST(ExactAlpha, cornerOfACubeInClosedForm)
{
    const auto complex = shapes::unitCube(1);
    const shapes::Shape corner = shapes::halfSpace(point(0.3, 0, 0), vector(1, 2, 3));
    const scalar exact = 0.3 * 0.15 * 0.1 / 6;
    EXPECT_NEAR(shapes::exactAlpha(*complex, corner)[0], exact, 1e-14);
}

TEST(ExactAlpha, alignedBlockIsExact)
{
    const auto complex = shapes::unitCube(8);
    const shapes::Shape column =
        shapes::block(point(-1, -1, -1), point(0.3125, 0.25, 0.625));
    const scalarField alpha = shapes::exactAlpha(*complex, column, 3);
    EXPECT_NEAR(volumeInside(*complex, alpha), 0.3125 * 0.25 * 0.625, 1e-4);
}
