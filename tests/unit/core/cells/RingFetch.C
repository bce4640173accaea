// SPDX-License-Identifier: GPL-3.0-or-later

// Rings of images of cells behind cyclic patches.

#include "core/cells/RingFetch.H"

#include "shapes/PeriodicBox.H"

#include <gtest/gtest.h>

#include "MinMax.H"

#include <algorithm>
#include <cmath>

namespace Foam::stability
{

namespace
{

// Graded and bent, the same at both ends in x.
shapes::BoxOptions bentBox()
{
    shapes::BoxOptions options;
    options.n = Vector<label>(6, 5, 4);
    options.max = point(1.3, 0.9, 0.7);
    options.map = [](const point& x)
    {
        const scalar phase = 2 * M_PI * x.x() / 1.3 + 0.4;
        return point(
            x.x() + 0.03 * std::sin(phase), x.y() + 0.04 * x.z() * std::cos(phase),
            x.z() + 0.02 * std::sin(phase + x.y())
        );
    };
    return options;
}

// The quarter of a square bar around its edge x = y = 0, which lies obliquely.
shapes::CyclicPair aroundAnEdge(shapes::BoxOptions& options)
{
    const scalar c = std::cos(0.7), s = std::sin(0.7);
    const tensor tilt(
        tensor(c, -s, 0, s, c, 0, 0, 0, 1) & tensor(1, 0, 0, 0, s, -c, 0, c, s)
    );
    options.n = Vector<label>(5, 5, 3);
    options.max = point(1, 1, 0.5);
    options.map = [tilt](const point& x) { return tilt & x; };
    shapes::CyclicPair pair{2, 0, {}};
    pair.motion.rotation = tilt & tensor(0, 1, 0, -1, 0, 0, 0, 0, 1) & tilt.T();
    return pair;
}

// Of an image everything is what it is of the cell itself, but moved.
void expectMoved(const CellComplex& complex)
{
    const PeriodicImages& images = *complex.whole().images;
    for (label celli = 0; celli < complex.nCells(); ++celli)
    {
        const label image = complex.image(celli);
        EXPECT_EQ(complex.own(celli), image == 0);
        const label real =
            complex.localCell(images.realCell(complex.globalCell(celli)));
        ASSERT_GE(real, 0);
        EXPECT_NEAR(complex.cellVolumes()[celli], complex.cellVolumes()[real], 1e-15);
        const point moved(images.motion(image)(complex.cellCentres()[real]));
        EXPECT_LT(mag(complex.cellCentres()[celli] - moved), 1e-14);
        const UList<label> faces(complex.cellFaces()[celli]);
        const UList<label> realFaces(complex.cellFaces()[real]);
        ASSERT_EQ(faces.size(), realFaces.size());
        forAll(faces, i)
        {
            // Split in the same way, whatever the frame.
            const auto baseOf = [&](label facei)
            {
                const face& f = complex.faces()[facei];
                return complex.input().homes[f[complex.tetBase()[facei]]];
            };
            EXPECT_EQ(baseOf(faces[i]), baseOf(realFaces[i]));
        }
    }
}

label nIncomplete(const CellComplex& complex)
{
    label n = 0;
    for (label celli = 0; celli < complex.nCells(); ++celli)
    {
        n += complex.own(celli) && !complex.hasAllNeighbours(celli);
    }
    return n;
}

} // namespace

TEST(RingFetch, goesOnBehindATranslation)
{
    const shapes::BoxOptions options(bentBox());
    const auto piece = shapes::periodicPiece(
        shapes::boxInput(options), {shapes::periodicInX(options)}
    );
    EXPECT_EQ(nIncomplete(*shapes::withRings(piece, 0)), 2 * 5 * 4);
    for (const label nRings : {1, 2, 5})
    {
        const auto complex = shapes::withRings(piece, nRings);
        EXPECT_EQ(complex->nCells(), (6 + 2 * nRings) * 5 * 4);
        EXPECT_EQ(nIncomplete(*complex), 0);
        expectMoved(*complex);
    }
}

// A mesh of one cell is its own neighbour, again and again.
TEST(RingFetch, goesRoundAThinMesh)
{
    shapes::BoxOptions options(bentBox());
    options.n.x() = 1;
    const auto piece = shapes::periodicPiece(
        shapes::boxInput(options), {shapes::periodicInX(options)}
    );
    const auto complex = shapes::withRings(piece, 3);
    EXPECT_EQ(complex->nCells(), 7 * 5 * 4);
    expectMoved(*complex);
}

TEST(RingFetch, goesOnBehindTheEdgesOfTwoPairs)
{
    shapes::BoxOptions options;
    options.n = Vector<label>(4, 3, 3);
    shapes::CyclicPair inY{2, 3, {}};
    inY.motion.shift.y() = -1;
    const auto piece = shapes::periodicPiece(
        shapes::boxInput(options), {shapes::periodicInX(options), inY}
    );
    const auto complex = shapes::withRings(piece, 1);
    EXPECT_EQ(complex->nCells(), 6 * 5 * 3);
    EXPECT_EQ(nIncomplete(*complex), 0);
    expectMoved(*complex);
}

TEST(RingFetch, goesRoundTheAxisOfARotation)
{
    shapes::BoxOptions options;
    const shapes::CyclicPair pair(aroundAnEdge(options));
    const auto piece = shapes::periodicPiece(shapes::boxInput(options), {pair});
    const auto one = shapes::withRings(piece, 1);
    // The row behind each of the patches, and the column across the axis.
    EXPECT_EQ(one->nCells(), (25 + 2 * 5 + 1) * 3);
    EXPECT_EQ(nIncomplete(*one), 0);
    expectMoved(*one);
    const auto whole = shapes::withRings(piece, 5);
    EXPECT_EQ(whole->nCells(), 100 * 3);
    expectMoved(*whole);
    forAll(whole->kinds(), i)
    {
        EXPECT_EQ(whole->kinds()[i], BoundaryKind::wall);
    }
}

// Thin cells at both ends and thick ones between: the thick ones reach each other
// across more thin ones than there are rings.
TEST(RingFetch, goesOnWhereLargeCellsAreNear)
{
    const std::vector<scalar> ends{0,   0.02, 0.04, 0.06, 0.08, 0.1,  0.5,  0.9,
                                   1.3, 1.7,  1.8,  1.82, 1.84, 1.86, 1.88, 1.9};
    shapes::BoxOptions options;
    options.n = Vector<label>(ends.size() - 1, 4, 3);
    options.max = point(ends.size() - 1, 1.6, 1.2);
    options.map = [&](const point& x)
    { return point(ends[std::lround(x.x())], x.y(), x.z()); };
    shapes::CyclicPair pair(shapes::periodicInX(options));
    pair.motion.shift.x() = -ends.back();
    const auto piece = shapes::periodicPiece(shapes::boxInput(options), {pair});
    const auto wide = shapes::withRings(piece, 14);
    FetchReach reach(1);
    reach.cells = 2;
    reach.stencil = 1;
    const auto complex = shapes::withRings(piece, reach);
    expectMoved(*complex);

    // The range of each cell along x.
    const auto range = [](const CellComplex& cells, label celli)
    {
        scalarMinMax x;
        for (const label facei : cells.cellFaces()[celli])
        {
            for (const label pointi : cells.faces()[facei])
            {
                x.add(cells.points()[pointi].x());
            }
        }
        return x;
    };
    label nNear = 0;
    for (label celli = 0; celli < wide->nCells(); ++celli)
    {
        bool near = false;
        for (label other = 0; other < wide->nCells() && !wide->own(celli); ++other)
        {
            const scalarMinMax a(range(*wide, celli)), b(range(*wide, other));
            const scalar gap = std::max(a.min() - b.max(), b.min() - a.max());
            near = near
                   || (wide->own(other) && gap < 1.99 * std::min(a.mag(), 2 * b.mag()));
        }
        const label here = complex->localCell(wide->globalCell(celli));
        EXPECT_TRUE(!near || (here >= 0 && complex->hasAllNeighbours(here)));
        nNear += near;
    }
    // Two rings are less, and lack the thick cells behind the thin ones.
    EXPECT_GT(nNear, 2 * 3 * 12);
    EXPECT_GT(complex->nCells(), shapes::withRings(piece, 2)->nCells() + 2 * 3 * 12);
    EXPECT_LT(complex->nCells(), wide->nCells());
}

TEST(RingFetch, thePatchIsNoBoundaryOnEitherSide)
{
    const shapes::BoxOptions options(bentBox());
    const auto piece = shapes::periodicPiece(
        shapes::boxInput(options), {shapes::periodicInX(options)}
    );
    const auto complex = shapes::withRings(piece, 1);
    label nThrough = 0; // faces between a real cell and an image
    for (label facei = 0; facei < complex->nInternalFaces(); ++facei)
    {
        nThrough += complex->own(complex->owner()[facei])
                    != complex->own(complex->neighbour()[facei]);
    }
    EXPECT_EQ(nThrough, 2 * 5 * 4);
}

// Behind both ends of a box, the n-th layer of cells is the n-th ring.
TEST(RingFetch, tellsTheRingOfACell)
{
    shapes::BoxOptions options;
    options.n = Vector<label>(6, 3, 2);
    const auto piece = shapes::periodicPiece(
        shapes::boxInput(options), {shapes::periodicInX(options)}
    );
    const auto complex = shapes::withRings(piece, 4);
    label nFar = 0;
    for (label celli = 0; celli < complex->nCells(); ++celli)
    {
        const scalar x = complex->cellCentres()[celli].x();
        const scalar layers = 6 * std::max(-x, x - 1);
        EXPECT_EQ(complex->ring(celli), std::max(0, int(std::ceil(layers)))) << x;
        nFar += complex->ring(celli) == 4;
    }
    EXPECT_EQ(nFar, 2 * 3 * 2);
}

} // namespace Foam::stability
