// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/cells/CanonicalOrder.H"

#include "shapes/PolyMeshes.H"

#include <gtest/gtest.h>

#include <algorithm>

namespace Foam::stability
{

namespace
{

shapes::BoxOptions smallBox()
{
    shapes::BoxOptions options;
    options.n = Vector<label>(4, 3, 5);
    options.kinds[3] = BoundaryKind::open;
    return options;
}

void expectSame(const CellComplexInput& a, const CellComplexInput& b)
{
    EXPECT_EQ(a.points, b.points);
    EXPECT_EQ(a.faces, b.faces);
    EXPECT_EQ(a.owner, b.owner);
    EXPECT_EQ(a.neighbour, b.neighbour);
    EXPECT_TRUE(a.kinds == b.kinds);
    EXPECT_EQ(a.patches, b.patches);
}

} // namespace

TEST(CanonicalOrder, doesNotDependOnTheNumbers)
{
    for (CellComplexInput mesh :
         {shapes::perturbedBox(smallBox()), shapes::tetrahedralBox(smallBox())})
    {
        CellComplexInput other(shapes::renumbered(mesh, 3));
        EXPECT_NE(mesh.owner, other.owner);
        orderByPosition(mesh);
        orderByPosition(other);
        expectSame(mesh, other);
    }
}

TEST(CanonicalOrder, geometryIsTheSameToTheLastBit)
{
    CellComplexInput mesh(shapes::perturbedBox(smallBox()));
    CellComplexInput other(shapes::renumbered(mesh, 5));
    orderByPosition(mesh);
    orderByPosition(other);
    const CellComplex a(mesh), b(other);
    EXPECT_EQ(a.cellVolumes(), b.cellVolumes());
    EXPECT_EQ(a.cellCentres(), b.cellCentres());
    EXPECT_EQ(a.faceAreas(), b.faceAreas());
    EXPECT_EQ(a.faceCentres(), b.faceCentres());
}

TEST(CanonicalOrder, saysWhatWasWhere)
{
    const CellComplexInput mesh(shapes::perturbedBox(smallBox()));
    CellComplexInput ordered(mesh);
    const CanonicalOrder order = orderByPosition(ordered);
    EXPECT_EQ(ordered.points, pointField(mesh.points, order.points));
    const CellComplex before(mesh), after(ordered);
    forAll(order.cells, celli)
    {
        EXPECT_LT(
            mag(after.cellCentres()[celli] - before.cellCentres()[order.cells[celli]]),
            1e-14
        );
    }
    forAll(order.faces, facei)
    {
        EXPECT_LT(
            mag(after.faceCentres()[facei] - before.faceCentres()[order.faces[facei]]),
            1e-14
        );
    }
}

TEST(CanonicalOrder, facesPointFromTheLowerCellAndBeginAtTheLowestPoint)
{
    CellComplexInput mesh(shapes::renumbered(shapes::perturbedBox(smallBox()), 7));
    orderByPosition(mesh);
    const CellComplex complex(mesh);
    for (label facei = 0; facei < complex.nInternalFaces(); ++facei)
    {
        EXPECT_LT(mesh.owner[facei], mesh.neighbour[facei]);
        const vector way = complex.cellCentres()[mesh.neighbour[facei]]
                           - complex.cellCentres()[mesh.owner[facei]];
        EXPECT_GT(way & complex.faceAreas()[facei], 0);
    }
    for (const face& f : mesh.faces)
    {
        EXPECT_EQ(f[0], *std::min_element(f.begin(), f.end()));
    }
}

// Two cells that touch without being joined: both sides have points of their own.
TEST(CanonicalOrder, pointsAtOnePlaceAreToldApart)
{
    shapes::BoxOptions left;
    left.n = Vector<label>(1, 1, 1);
    const CellComplexInput one(shapes::boxInput(left));
    left.min = point(1, 0, 0);
    left.max = point(2, 1, 1);
    const CellComplexInput two(shapes::boxInput(left));
    CellComplexInput both(one);
    both.points.append(two.points);
    for (face f : two.faces)
    {
        for (label& pointi : f)
        {
            pointi += one.points.size();
        }
        both.faces.append(f);
        both.owner.append(1);
    }
    both.nCells = 2;
    both.kinds.append(two.kinds);
    both.patches.append(two.patches);
    CellComplexInput other(shapes::renumbered(both, 11));
    orderByPosition(both);
    orderByPosition(other);
    expectSame(both, other);
}

} // namespace Foam::stability
