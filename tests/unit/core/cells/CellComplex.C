// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/cells/CellComplex.H"
#include "core/base/Errors.H"
#include "shapes/PolyMeshes.H"

#include <gtest/gtest.h>

using namespace Foam;
using namespace Foam::stability;

namespace
{

// A sheared and graded box: no centre, volume or normal is a round number.
std::shared_ptr<const CellComplex> skewedBox()
{
    shapes::BoxOptions options;
    options.n = Vector<label>(5, 4, 3);
    options.min = point(-0.3, 0.2, 1.1);
    options.max = point(0.9, 1.0, 2.3);
    options.map = [](const point& x) {
        return point(
            x.x() + 0.3 * x.y(), x.y() * (1 + 0.1 * x.y()), x.z() + 0.2 * x.x()
        );
    };
    return shapes::box(options);
}

} // namespace

// The map has the Jacobian 1 + 0.2 y, so the whole has an exact volume. (The faces
// stay plane, since x and z are mapped linearly.)
TEST(CellComplex, volumesOfAGradedBoxAddUp)
{
    const auto complex = skewedBox();
    const scalar exact = 1.2 * 1.2 * ((1.0 + 0.1) - (0.2 + 0.1 * 0.04));
    EXPECT_NEAR(sum(complex->cellVolumes()), exact, 1e-12);
    EXPECT_EQ(complex->nCells(), 60);
}

TEST(CellComplex, faceAreasOfACellCloseIt)
{
    const auto complex = skewedBox();
    for (label celli = 0; celli < complex->nCells(); ++celli)
    {
        vector sum(Zero);
        for (const label facei : complex->cellFaces()[celli])
        {
            const bool owned = complex->owner()[facei] == celli;
            sum += owned ? complex->faceAreas()[facei] : -complex->faceAreas()[facei];
        }
        EXPECT_LT(mag(sum), 1e-14);
    }
}

TEST(CellComplex, findsTheCellThatHoldsAPoint)
{
    const auto complex = skewedBox();
    for (label celli = 0; celli < complex->nCells(); ++celli)
    {
        const point x = complex->cellCentres()[celli];
        // Off the centre, towards a face, yet inside.
        const label facei = complex->cellFaces()[celli][2];
        const point inside = 0.2 * x + 0.8 * complex->faceCentres()[facei];
        EXPECT_EQ(complex->findCell(inside), celli);
        EXPECT_TRUE(complex->holds(celli, inside));
        EXPECT_FALSE(complex->holds(celli, 3 * complex->faceCentres()[facei] - 2 * x));
    }
}

TEST(CellComplex, outsideTheNearestCellIsFound)
{
    const auto complex = shapes::unitCube(4);
    EXPECT_EQ(complex->findCell(point(7, 0.1, 0.9)), 3 + 4 * (0 + 4 * 3));
}

TEST(CellComplex, wallsMakeNearWallCells)
{
    shapes::BoxOptions options;
    options.n = Vector<label>(4, 4, 4);
    options.kinds = FixedList<BoundaryKind, 6>(BoundaryKind::open);
    options.kinds[5] = BoundaryKind::wall; // +z
    options.kinds[0] = BoundaryKind::symmetry;
    const auto complex = shapes::box(options);
    label n = 0;
    for (label celli = 0; celli < complex->nCells(); ++celli)
    {
        n += complex->nearWall(celli);
        EXPECT_EQ(complex->nearWall(celli), complex->cellCentres()[celli].z() > 0.75);
    }
    EXPECT_EQ(n, 16);
}

// A face pinched like an arrowhead has but two points from which all its triangles
// look outward.
TEST(CellComplex, tetBaseAvoidsInvertedTetrahedra)
{
    CellComplexInput input(shapes::boxInput(shapes::BoxOptions{
        point(0, 0, 0), point(1, 1, 1), Vector<label>(1, 1, 1), {}, {}}));
    // Pull one corner of the top face towards the opposite one: not convex any more.
    for (point& x : input.points)
    {
        if (x == point(1, 1, 1))
        {
            x = point(0.4, 0.4, 1);
        }
    }
    const CellComplex complex(std::move(input));
    for (label facei = 0; facei < complex.nFaces(); ++facei)
    {
        const face& f = complex.faces()[facei];
        const label base = complex.tetBase()[facei];
        const point& centre = complex.cellCentres()[0];
        for (label k = 1; k + 1 < f.size(); ++k)
        {
            const vector a = complex.points()[f[base]] - centre;
            const vector b = complex.points()[f[(base + k) % f.size()]] - centre;
            const vector c = complex.points()[f[(base + k + 1) % f.size()]] - centre;
            EXPECT_GT((a ^ b) & c, 0) << "face " << facei;
        }
    }
}

// The last cell owns no face, so that nobody must take the highest owner for it.
TEST(CellComplex, knowsAllCellsWhateverTheirNumbers)
{
    const CellComplexInput mesh(shapes::refinedBox(
        shapes::BoxOptions{
            point(0, 0, 0), point(1, 1, 1), Vector<label>(4, 4, 4), {}, {}},
        [](const point& x) { return x.x() < 0.5; }
    ));
    const CellComplexInput other(shapes::renumbered(mesh, 3));
    ASSERT_LT(max(other.owner), other.nCells - 1);
    const CellComplex complex(other);
    EXPECT_EQ(complex.nCells(), 32 + 8 * 32);
    EXPECT_NEAR(sum(complex.cellVolumes()), 1, 1e-12);

    const labelList last(complex.cellFaces()[complex.nCells() - 1]);
    EXPECT_GE(last.size(), 6);
    EXPECT_EQ(complex.findCell(complex.cellCentres().last()), complex.nCells() - 1);
}

TEST(CellComplex, refusesACellWithoutFaces)
{
    CellComplexInput input(shapes::boxInput(shapes::BoxOptions{}));
    ++input.nCells;
    EXPECT_THROW(CellComplex(std::move(input)), NumericalFailure);
}

TEST(CellComplex, refusesAMeshWithoutCells)
{
    EXPECT_THROW(CellComplex(CellComplexInput{}), BadInput);
}

TEST(CellComplex, refusesACellWithoutVolume)
{
    CellComplexInput input(shapes::boxInput(shapes::BoxOptions{}));
    for (point& x : input.points)
    {
        x.z() = 0;
    }
    EXPECT_THROW(CellComplex(std::move(input)), NumericalFailure);
}
