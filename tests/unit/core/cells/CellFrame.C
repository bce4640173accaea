// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/cells/CellFrame.H"

#include "shapes/PolyMeshes.H"
#include "shapes/SectionMesh.H"

#include <gtest/gtest.h>

#include <cmath>

namespace Foam::stability
{

namespace
{

// A box of 3 x 4 x 5 cells with these edges [m], turned by a tensor.
shapes::BoxOptions cells(const vector& edges, const tensor& turn = tensor::I)
{
    shapes::BoxOptions options;
    options.n = Vector<label>(3, 4, 5);
    options.max = point(3 * edges.x(), 4 * edges.y(), 5 * edges.z());
    options.map = [turn](const point& x) { return turn & x; };
    return options;
}

tensor obliqueTurn()
{
    const scalar c = std::cos(0.7), s = std::sin(0.7);
    return tensor(c, -s, 0, s, c, 0, 0, 0, 1) & tensor(1, 0, 0, 0, c, -s, 0, s, c);
}

} // namespace

TEST(CellFrame, hasTheEdgesOfABox)
{
    const tensor turn(obliqueTurn());
    for (const vector& edges :
         {vector(1, 2, 3), vector(0.001, 1, 1), vector(5, 5, 0.05)})
    {
        const auto complex = shapes::box(cells(edges, turn));
        const CellFrame frame(frameOf(*complex, 17));
        for (direction d = 0; d < 3; ++d)
        {
            vector axis(Zero);
            axis[d] = 1;
            const vector along = turn & axis;
            EXPECT_NEAR(frame.along(along) / edges[d], 1, 1e-6);
            EXPECT_NEAR(mag(frame.local(edges[d] * along)), 1, 1e-6);
        }
        EXPECT_NEAR(frame.volume / (edges.x() * edges.y() * edges.z()), 1, 1e-6);
    }
}

TEST(CellFrame, isRoundedWhereCellsAreALittleFlat)
{
    const tensor turn(obliqueTurn());
    const auto extent = [&](const vector& edges, direction d)
    {
        const auto complex = shapes::box(cells(edges, turn));
        vector axis(Zero);
        axis[d] = 1;
        return rounded(frameOf(*complex, 17)).along(turn & axis);
    };
    for (const vector& edges : {vector(2, 1, 7), vector(3, 3, 0.5), vector(1, 1, 1)})
    {
        for (direction d = 0; d < 3; ++d)
        {
            EXPECT_NEAR(extent(edges, d) / cmptMax(edges), 1, 1e-6);
        }
    }
    EXPECT_NEAR(extent(vector(1, 20, 20), 0), 1, 1e-6);
    scalar before = 10;
    for (const scalar thickness : {10 / 8.5, 10 / 10., 10 / 13., 10 / 15.5})
    {
        const scalar across = extent(vector(10, 10, thickness), 2);
        EXPECT_LT(across, before);
        EXPECT_GT(across, thickness);
        EXPECT_NEAR(extent(vector(10, 10, thickness), 0), 10, 1e-5);
        before = across;
    }
    EXPECT_LT(before, 1.3);
}

TEST(CellFrame, isRoundInCubesAndInSlicesOfCubes)
{
    const auto expectRound = [](const CellComplex& complex)
    {
        for (label celli = 0; celli < complex.nCells(); ++celli)
        {
            const CellFrame frame(frameOf(complex, celli));
            EXPECT_EQ(frame.extents, frame.extents.xx() * symmTensor(I));
        }
    };
    expectRound(*shapes::box(cells(vector(2, 2, 2))));
    expectRound(*shapes::complexOf(shapes::tetrahedralBox(cells(vector(2, 2, 2)))));
    expectRound(*shapes::complexOf(shapes::perturbedBox(cells(vector(1, 1.2, 1)), 0.1))
    );
}

TEST(CellFrame, isFlatInSlicesOfFlatCells)
{
    const auto complex =
        shapes::complexOf(shapes::tetrahedralBox(cells(vector(1, 1, 0.02))));
    for (label celli = 0; celli < complex->nCells(); ++celli)
    {
        const CellFrame frame(frameOf(*complex, celli));
        const scalar across = frame.along(vector(0, 0, 1));
        EXPECT_NEAR(frame.along(vector(1, 0, 0)) / across, 50, 20);
        EXPECT_NEAR(frame.along(vector(0, 1, 0)) / across, 50, 20);
    }
}

// Across the frame has the mean of the extents within the section.
TEST(CellFrame, isThatOfThePlaneInASection)
{
    for (const direction normal : {0, 1, 2})
    {
        shapes::SectionOptions options;
        options.max = point(2, 2, 0);
        options.nx = 5;
        options.normal = normal;
        for (const label ny : {5, 10, 40})
        {
            options.ny = ny;
            CellComplexInput input(shapes::sectionInput(options));
            const auto complex = shapes::complexOf(input);
            const vector x = shapes::placed(options, point(1, 0, 0))
                             - shapes::placed(options, point(0, 0, 0));
            const vector z = complex->whole().section->normal;
            const CellFrame frame(frameOf(*complex, 7));
            const scalar width = 0.4, height = 2.0 / ny;
            const bool isRound = ny < 40; // the span
            const scalar span = std::sqrt((sqr(width) + sqr(height)) / 2);
            EXPECT_NEAR(frame.along(x), isRound ? span : width, 1e-6);
            EXPECT_NEAR(frame.along(x ^ z), isRound ? span : height, 1e-6);
            EXPECT_NEAR(
                frame.along(z), isRound ? span : std::sqrt(width * height), 1e-6
            );
        }
    }
}

// The step is normal to the surface in the frame, and so long there.
TEST(CellFrame, stepsAcrossASurface)
{
    const auto complex = shapes::box(cells(vector(1, 0.1, 3), obliqueTurn()));
    const CellFrame frame(frameOf(*complex, 30));
    const vector n = vector(1, 2, -1) / std::sqrt(6.0);
    const vector step(frame.local(frame.step(n, 0.7)));
    EXPECT_NEAR(mag(step), 0.7, 1e-12);
    const vector within = n ^ vector(0.3, 0.1, 2);
    EXPECT_NEAR(step & frame.local(within), 0, 1e-12);
    EXPECT_NEAR(frame.step(n, 0.7) & n, 0.7 * frame.along(n), 1e-12);
}

TEST(CellFrame, gradientsOfLinearFunctionsAreExact)
{
    const auto complex = shapes::box(cells(vector(1, 1, 0.001), obliqueTurn()));
    const vector g(3, -2, 500);
    const scalarField values(complex->cellCentres() & g);
    const vector found = gradientOver(
        *complex, complex->pointNeighbours(30), values, frameOf(*complex, 30)
    );
    EXPECT_LT(mag(found - g) / mag(g), 1e-5);
}

} // namespace Foam::stability
