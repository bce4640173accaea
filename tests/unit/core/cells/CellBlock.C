// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/cells/CellBlock.H"

#include "shapes/PolyMeshes.H"

#include <gtest/gtest.h>

#include <functional>

namespace Foam::stability
{

namespace
{

// A mesh that is its own whole.
CellComplexInput numbered(CellComplexInput mesh)
{
    mesh.globalCells = identity(mesh.nCells);
    mesh.globalPoints = identity(mesh.points.size());
    mesh.globalBoundaryFaces = identity(mesh.kinds.size());
    mesh.cellBehind = labelList(mesh.kinds.size(), -1);
    return mesh;
}

CellComplexInput whole()
{
    shapes::BoxOptions options;
    options.n = Vector<label>(6, 5, 4);
    return numbered(shapes::perturbedBox(options));
}

CellBlock
part(const CellComplexInput& mesh, const std::function<bool(const point&)>& accepts)
{
    const CellComplex complex(mesh);
    DynamicList<label> cells;
    for (label celli = complex.nCells() - 1; celli >= 0; --celli)
    {
        if (accepts(complex.cellCentres()[celli]))
        {
            cells.append(celli);
        }
    }
    return blockOf(mesh, facesOfCells(mesh), cells);
}

} // namespace

TEST(CellBlock, partsMakeTheWhole)
{
    CellComplexInput mesh(whole());
    const std::vector<CellBlock> blocks{
        part(mesh, [](const point& x) { return x.x() > 0.4; }),
        part(mesh, [](const point& x) { return x.y() > 0.5 && x.x() < 0.6; }),
        part(mesh, [](const point& x) { return x.x() <= 0.4; })};
    const CellComplexInput joined(assemble(blocks, mesh.patchNames));
    const CanonicalOrder order = orderByPosition(mesh);
    EXPECT_EQ(joined.points, mesh.points);
    EXPECT_EQ(joined.faces, mesh.faces);
    EXPECT_EQ(joined.owner, mesh.owner);
    EXPECT_EQ(joined.neighbour, mesh.neighbour);
    EXPECT_TRUE(joined.kinds == mesh.kinds);
    EXPECT_EQ(joined.patches, mesh.patches);
    EXPECT_EQ(joined.globalCells, order.cells);
    EXPECT_EQ(joined.globalPoints, order.points);
    const label nInternal = mesh.neighbour.size();
    forAll(joined.globalBoundaryFaces, i)
    {
        EXPECT_EQ(
            joined.globalBoundaryFaces[i], order.faces[nInternal + i] - nInternal
        );
    }
}

// What is known of a piece is that of the whole, to the last bit, also at its rim.
TEST(CellBlock, aPieceIsThatOfTheWhole)
{
    CellComplexInput mesh(whole());
    const CellComplexInput input(assemble(
        {part(mesh, [](const point& x) { return x.x() + x.y() < 0.9; })},
        mesh.patchNames
    ));
    const CanonicalOrder order = orderByPosition(mesh);
    const CellComplex piece(input), all(mesh);
    ASSERT_LT(piece.nCells(), all.nCells());
    label nComplete = 0;
    for (label celli = 0; celli < piece.nCells(); ++celli)
    {
        const label there = order.cells.find(piece.globalCell(celli));
        EXPECT_EQ(piece.cellVolumes()[celli], all.cellVolumes()[there]);
        EXPECT_EQ(piece.cellCentres()[celli], all.cellCentres()[there]);
        EXPECT_EQ(piece.localCell(piece.globalCell(celli)), celli);
        nComplete += piece.hasAllNeighbours(celli);
        if (piece.hasAllNeighbours(celli))
        {
            for (const label facei : piece.cellFaces()[celli])
            {
                for (const label pointi : piece.faces()[facei])
                {
                    const label whereAll =
                        order.points.find(input.globalPoints[pointi]);
                    EXPECT_EQ(
                        piece.pointCells()[pointi].size(),
                        all.pointCells()[whereAll].size()
                    );
                    EXPECT_EQ(
                        piece.pointBoundaryFaces()[pointi].size(),
                        all.pointBoundaryFaces()[whereAll].size()
                    );
                }
            }
        }
    }
    EXPECT_GT(nComplete, 10);
    EXPECT_LT(nComplete, piece.nCells());
    EXPECT_EQ(piece.localCell(order.cells.last()), -1);
}

TEST(CellBlock, facesAtTheRimTellTheCellBehind)
{
    const CellComplexInput mesh(whole());
    const CellComplexInput input(assemble(
        {part(mesh, [](const point& x) { return x.z() < 0.5; })}, mesh.patchNames
    ));
    const CellComplex all(mesh), piece(input);
    label nBeyond = 0;
    forAll(input.kinds, i)
    {
        if (input.kinds[i] != BoundaryKind::coupledUnknown)
        {
            EXPECT_EQ(input.cellBehind[i], -1);
            continue;
        }
        ++nBeyond;
        const label facei = piece.nInternalFaces() + i;
        const vector way =
            all.cellCentres()[input.cellBehind[i]] - piece.faceCentres()[facei];
        EXPECT_GT(way & piece.faceAreas()[facei], 0);
        EXPECT_GT(all.cellCentres()[input.cellBehind[i]].z(), 0.5);
    }
    EXPECT_EQ(nBeyond, 30);
}

} // namespace Foam::stability
