// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

#include "core/flow/CanonicalOrder.H"

#include "shapes/PolyMeshes.H"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

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

labelList shuffled(label n, std::mt19937& random)
{
    labelList order(identity(n));
    std::shuffle(order.begin(), order.end(), random);
    return order;
}

// The same mesh with other numbers: of points, of cells, of faces within the inside and
// within each patch, with faces that begin elsewhere and look the other way.
CellComplexInput renumbered(const CellComplexInput& mesh, unsigned seed)
{
    std::mt19937 random(seed);
    CellComplexInput result(mesh);
    const labelList points = shuffled(mesh.points.size(), random);
    forAll(points, i)
    {
        result.points[points[i]] = mesh.points[i];
    }
    const labelList cells = shuffled(max(mesh.owner) + 1, random);
    const label nInternal = mesh.neighbour.size();
    const labelList internal = shuffled(nInternal, random);
    forAll(mesh.faces, facei)
    {
        face f(mesh.faces[facei]);
        for (label& pointi : f)
        {
            pointi = points[pointi];
        }
        std::rotate(f.begin(), f.begin() + random() % f.size(), f.end());
        const label to = facei < nInternal ? internal[facei] : facei;
        label owner = cells[mesh.owner[facei]];
        if (facei < nInternal)
        {
            label neighbour = cells[mesh.neighbour[facei]];
            if (random() % 2)
            {
                std::swap(owner, neighbour);
                f.flip();
            }
            result.neighbour[to] = neighbour;
        }
        result.owner[to] = owner;
        result.faces[to] = f;
    }
    for (label i = nInternal; i + 1 < result.faces.size(); ++i)
    {
        if (result.patches[i - nInternal] == result.patches[i + 1 - nInternal])
        {
            std::swap(result.faces[i], result.faces[i + 1]);
            std::swap(result.owner[i], result.owner[i + 1]);
        }
    }
    return result;
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
        CellComplexInput other(renumbered(mesh, 3));
        EXPECT_NE(mesh.owner, other.owner);
        orderByPosition(mesh);
        orderByPosition(other);
        expectSame(mesh, other);
    }
}

TEST(CanonicalOrder, geometryIsTheSameToTheLastBit)
{
    CellComplexInput mesh(shapes::perturbedBox(smallBox()));
    CellComplexInput other(renumbered(mesh, 5));
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
    CellComplexInput mesh(renumbered(shapes::perturbedBox(smallBox()), 7));
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
    both.kinds.append(two.kinds);
    both.patches.append(two.patches);
    CellComplexInput other(renumbered(both, 11));
    orderByPosition(both);
    orderByPosition(other);
    expectSame(both, other);
}

} // namespace Foam::stability
