// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

#include "core/reconstruction/VolumeFractions.H"
#include "core/Errors.H"
#include "shapes/ExactAlpha.H"
#include "shapes/BoxMesh.H"

#include <gtest/gtest.h>

using namespace Foam;
using namespace Foam::stability;

TEST(VolumeFractions, clampsAndSumsUp)
{
    const auto complex = shapes::unitCube(2);
    scalarField alpha(8, 0.25);
    alpha[0] = -1e-3;
    alpha[1] = 1 + 1e-3;
    const VolumeFractions fractions(shapes::snapshotOf(complex, alpha));
    EXPECT_EQ(fractions.cells[0], 0);
    EXPECT_EQ(fractions.cells[1], 1);
    EXPECT_EQ(min(fractions.boundaryFaces), 0);
    EXPECT_EQ(max(fractions.boundaryFaces), 1);
    EXPECT_NEAR(fractions.volume, (1 + 6 * 0.25) / 8, 1e-15);
}

TEST(VolumeFractions, roundOffDoesNotChangeTheSide)
{
    EXPECT_EQ(VolumeFractions::rounded(0.5), 0.5);
    EXPECT_EQ(VolumeFractions::rounded(0.5 - 1e-14), 0.5);
    EXPECT_EQ(VolumeFractions::rounded(1), 1);
    EXPECT_NEAR(VolumeFractions::rounded(0.5 - 1e-12), 0.5 - 1e-12, 1e-16);
    EXPECT_FALSE(VolumeFractions::inside(VolumeFractions::rounded(0.5 - 1e-12)));
}

TEST(VolumeFractions, moreThanTwoMaterialsAreRefused)
{
    FlowSnapshot snapshot =
        shapes::snapshotOf(shapes::unitCube(2), scalarField(8, 0.3));
    snapshot.alphas = List<scalarField>(3, scalarField(8, 0.3));
    snapshot.boundaryAlphas = List<scalarField>(3, scalarField(24, 0.3));
    try
    {
        const VolumeFractions fractions(snapshot);
        FAIL() << "three materials were taken";
    }
    catch (const BadInput& error)
    {
        const std::string text = error.what();
        EXPECT_NE(text.find("supports two materials, found 3"), std::string::npos);
    }
}
