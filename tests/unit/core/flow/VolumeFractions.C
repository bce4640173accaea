// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/flow/VolumeFractions.H"
#include "core/base/Errors.H"
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

// alpha linear in space, boundary values equal to those of the cells, as zeroGradient
// writes them: the walls get the linear function back, also where cells are skewed.
TEST(VolumeFractions, valuesOnWallsGoOnFromTheCells)
{
    shapes::BoxOptions options;
    options.n = Vector<label>(5, 4, 6);
    options.map = [](const point& x)
    { return point(x.x() + 0.2 * x.y(), x.y(), x.z() * (1 + 0.3 * x.z())); };
    const auto complex = shapes::box(options);
    const auto exact = [](const point& x)
    { return 0.2 + 0.21 * x.x() - 0.1 * x.y() + 0.13 * x.z(); };
    scalarField alpha(complex->nCells());
    forAll(alpha, celli)
    {
        alpha[celli] = exact(complex->cellCentres()[celli]);
    }
    const VolumeFractions fractions(shapes::snapshotOf(complex, alpha));
    forAll(fractions.boundaryFaces, i)
    {
        const point& x = complex->faceCentres()[complex->nInternalFaces() + i];
        EXPECT_NEAR(fractions.boundaryFaces[i], exact(x), 1e-5) << "face " << i;
    }
}

TEST(VolumeFractions, valuesThatTheSolverSetOnTheBoundaryStay)
{
    const auto complex = shapes::unitCube(3);
    scalarField alpha(27);
    forAll(alpha, celli)
    {
        alpha[celli] = complex->cellCentres()[celli].z();
    }
    FlowSnapshot snapshot = shapes::snapshotOf(complex, alpha);
    snapshot.boundaryAlphas[0] = 0.77;
    const VolumeFractions fractions(snapshot);
    EXPECT_EQ(min(fractions.boundaryFaces), 0.77);
    EXPECT_EQ(max(fractions.boundaryFaces), 0.77);
}
