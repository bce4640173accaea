// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/flow/FluxVelocity.H"

#include "core/base/Errors.H"
#include "shapes/PolyMeshes.H"
#include "tensor.H"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

using namespace Foam;
using namespace Foam::stability;

namespace
{

const vector U0(1.7, -0.4, 0.25);
// Without trace, so without divergence.
const tensor gradient(0.3, -1.1, 0.7, 0.4, 0.5, -0.2, 1.3, 0.5, -0.8);

shapes::BoxOptions options()
{
    shapes::BoxOptions result;
    result.n = Vector<label>(5, 4, 3);
    result.max = point(1, 1.2, 0.6);
    return result;
}

// Exact where faces are flat and the velocity is linear.
scalarField
fluxesOf(const CellComplex& complex, const std::function<vector(const point&)>& flow)
{
    scalarField fluxes(complex.nFaces());
    forAll(fluxes, facei)
    {
        fluxes[facei] = flow(complex.faceCentres()[facei]) & complex.faceAreas()[facei];
    }
    return fluxes;
}

void expectUniform(const CellComplex& complex)
{
    const scalarField fluxes(fluxesOf(complex, [](const point&) { return U0; }));
    const vectorField U(FluxVelocity(complex)(fluxes));
    ASSERT_EQ(U.size(), complex.nCells());
    forAll(U, celli)
    {
        EXPECT_LT(mag(U[celli] - U0), 1e-12) << celli;
    }
}

std::string messageOf(const CellComplex& complex, const scalarField& fluxes)
{
    try
    {
        const FluxVelocity velocity(complex);
        velocity(fluxes);
    }
    catch (const BadInput& error)
    {
        return error.what();
    }
    return "";
}

} // namespace

TEST(FluxVelocity, aUniformVelocityIsExactInCellsOfAnyShape)
{
    const auto nearOrigin = [](const point& x) { return mag(x) < 0.6; };
    expectUniform(*shapes::box(options()));
    expectUniform(*shapes::complexOf(shapes::perturbedBox(options())));
    expectUniform(*shapes::complexOf(shapes::tetrahedralBox(options())));
    expectUniform(*shapes::complexOf(shapes::refinedBox(options(), nearOrigin)));
}

TEST(FluxVelocity, theSizeOfTheCellsDoesNotMatter)
{
    for (const scalar scale : {1e-9, 1e6})
    {
        expectUniform(*shapes::complexOf(shapes::transformed(
            shapes::tetrahedralBox(options()), scale, scale * vector(0.3, -0.1, 0.2)
        )));
    }
}

TEST(FluxVelocity, aLinearVelocityIsExactInBoxes)
{
    const auto complex = shapes::box(options());
    const auto flow = [](const point& x) { return U0 + (gradient & x); };
    const vectorField U(FluxVelocity(*complex)(fluxesOf(*complex, flow)));
    forAll(U, celli)
    {
        EXPECT_LT(mag(U[celli] - flow(complex->cellCentres()[celli])), 1e-12) << celli;
    }
}

// One cell of 2 x 1 x 1: all its faces are those of the boundary, and fluxes that no
// velocity has are met in the mean.
TEST(FluxVelocity, facesOfTheBoundaryCountAndMisfitsAreShared)
{
    shapes::BoxOptions one;
    one.n = Vector<label>(1, 1, 1);
    one.max = point(2, 1, 1);
    const auto complex = shapes::box(one);
    scalarField fluxes(6, 0);
    forAll(fluxes, facei)
    {
        const vector& area = complex->faceAreas()[facei];
        if (mag(area.x()) > 0.5)
        {
            fluxes[facei] = area.x() > 0 ? 5 : -2; // in at 2 m/s, out at 5 m/s
        }
        else if (area.y() > 1)
        {
            fluxes[facei] = 3; // through 2 m2 on one side, nothing on the other
        }
    }
    const vectorField U(FluxVelocity(*complex)(fluxes));
    EXPECT_LT(mag(U[0] - vector(3.5, 0.75, 0)), 1e-14);
}

TEST(FluxVelocity, namesFluxesThatDoNotFit)
{
    const auto complex = shapes::unitCube(2);
    scalarField fluxes(complex->nFaces(), 0.1);
    EXPECT_EQ(messageOf(*complex, fluxes), "");
    fluxes[7] = std::numeric_limits<scalar>::quiet_NaN();
    EXPECT_EQ(
        messageOf(*complex, fluxes),
        "The flux is not finite at " + textOf(complex->faceCentres()[7]) + "."
    );
    fluxes.setSize(35);
    EXPECT_EQ(
        messageOf(*complex, fluxes), "The flux has 35 values, the mesh has 36 faces."
    );
}
