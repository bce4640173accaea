// SPDX-License-Identifier: GPL-3.0-or-later

// Points that ranks share are one, whatever round-off makes of their positions.

#include "core/surface/pieces/SharedPoints.H"

#include "core/cells/CellBlock.H"
#include "core/reconstruction/Reconstruction.H"
#include "shapes/ExactAlpha.H"
#include "shapes/PolyMeshes.H"
#include "shapes/SurfaceChecks.H"
#include "shapes/ThreadRanks.H"

#include <gtest/gtest.h>

#include <mutex>
#include <set>

namespace Foam::stability
{

namespace
{

// All ranks know all cells; those of a rank are a third of them by their x.
std::shared_ptr<FlowSnapshot> ballOn(const Exchange& exchange, bool tetrahedra)
{
    shapes::BoxOptions options(shapes::oblongBox());
    CellComplexInput mesh(
        tetrahedra ? shapes::tetrahedralBox(options) : shapes::perturbedBox(options)
    );
    orderByPosition(mesh);
    mesh.globalCells = identity(mesh.nCells);
    mesh.globalPoints = identity(mesh.points.size());
    mesh.globalBoundaryFaces = identity(mesh.kinds.size());
    mesh.cellBehind = labelList(mesh.kinds.size(), -1);
    const CellComplex plain(mesh);
    mesh.own.setSize(mesh.nCells);
    forAll(mesh.own, celli)
    {
        const scalar third = plain.cellCentres()[celli].x() / 0.4001;
        mesh.own[celli] = label(third) % exchange.nRanks() == exchange.rank();
    }
    const auto complex = std::make_shared<const CellComplex>(mesh);
    return std::make_shared<FlowSnapshot>(shapes::snapshotOf(
        complex,
        shapes::exactAlpha(*complex, shapes::sphere(point(0.57, 0.48, 0.13), 0.4))
    ));
}

struct Pieces
{
    std::vector<SurfacePiece> ofRanks;
    std::vector<scalarField> spreads;
    label nShared = 0;
};

// Each rank has the positions that another gets, off by round-off.
Pieces extractedOn(label nRanks, const ReconstructionOptions& options, bool tetrahedra)
{
    Pieces pieces;
    pieces.ofRanks.resize(nRanks);
    pieces.spreads.resize(nRanks);
    std::mutex turn;
    shapes::onRanks(
        nRanks,
        [&](const Exchange& exchange)
        {
            const label rank = exchange.rank();
            const auto snapshot = ballOn(exchange, tetrahedra);
            InterfaceMesh mesh(Reconstruction::New(options)->extract(*snapshot).mesh);
            for (point& x : mesh.points)
            {
                x *= 1 + 3e-16 * rank;
            }
            SurfacePiece& piece = pieces.ofRanks[rank];
            piece.sharesPoints = reconstructionMethod(options.method).sharesPoints;
            const labelList kept(keepOwn(piece, mesh, *snapshot->complex));
            scalarField spread(kept.size(), rank);
            const auto shared = sharedPoints(mesh, kept, *snapshot->complex);
            agreeOnPoints(piece, spread, shared, exchange);
            pieces.spreads[rank] = spread;
            const std::lock_guard<std::mutex> lock(turn);
            pieces.nShared += shared.size();
        }
    );
    return pieces;
}

} // namespace

TEST(SharedPoints, weldToTheSurfaceOfOneRank)
{
    for (const char* method : {"isoAlpha", "bonnell"})
    {
        for (const bool tetrahedra : {false, true})
        {
            ReconstructionOptions options;
            options.method = method;
            const Pieces alone(extractedOn(1, options, tetrahedra));
            const Pieces pieces(extractedOn(3, options, tetrahedra));
            const InterfaceMesh& whole = alone.ofRanks[0].mesh;
            const JoinedSurface joined(join(pieces.ofRanks));
            const InterfaceMesh& mesh = joined.piece.mesh;
            EXPECT_GT(pieces.nShared, 100);
            EXPECT_EQ(mesh.points.size(), whole.points.size());
            EXPECT_EQ(mesh.triangles.size(), whole.triangles.size());
            const shapes::SurfaceReport report(shapes::inspect(mesh));
            EXPECT_EQ(report.nRimInside, 0);
            EXPECT_EQ(report.nCrowded, 0);
            EXPECT_EQ(report.euler, 1); // the ball is cut by a wall
            std::set<label> numbers;
            for (const PointKey& key : joined.piece.pointKeys)
            {
                numbers.insert(key.number);
            }
            EXPECT_EQ(label(numbers.size()), mesh.points.size());
            EXPECT_EQ(*numbers.rbegin(), mesh.points.size() - 1);
        }
    }
}

TEST(SharedPoints, haveThePlaceThatTheLowestRankGivesThem)
{
    const Pieces pieces(extractedOn(3, ReconstructionOptions(), false));
    std::map<label, std::pair<point, scalar>> first;
    label nMet = 0;
    for (std::size_t ranki = 0; ranki < pieces.spreads.size(); ++ranki)
    {
        const SurfacePiece& piece = pieces.ofRanks[ranki];
        forAll(piece.pointKeys, i)
        {
            const auto met = first.insert(
                {piece.pointKeys[i].number,
                 {piece.mesh.points[i], pieces.spreads[ranki][i]}}
            );
            nMet += !met.second;
            EXPECT_EQ(met.first->second.first, piece.mesh.points[i]);
            EXPECT_EQ(piece.startPositions[i], piece.mesh.points[i]);
            EXPECT_EQ(met.first->second.second, pieces.spreads[ranki][i]);
            EXPECT_TRUE(met.second || pieces.spreads[ranki][i] < scalar(ranki));
        }
    }
    EXPECT_GT(nMet, 50);
}

TEST(SharedPoints, areNoneWherePolygonsLieSideBySide)
{
    ReconstructionOptions options;
    options.method = "plic";
    const Pieces pieces(extractedOn(2, options, false));
    EXPECT_EQ(pieces.nShared, 0);
    label n = 0;
    for (const SurfacePiece& piece : pieces.ofRanks)
    {
        n += piece.mesh.points.size();
    }
    EXPECT_EQ(join(pieces.ofRanks).piece.mesh.points.size(), n);
}

// Two triangles on two ranks, with new points on their common edge and one within.
TEST(SharedPoints, onSplitEdgesAreCountedFromTheLowerEnd)
{
    InterfaceMesh mesh;
    mesh.points = List<point>{
        point(0, 0, 0),   point(1, 0, 0),       point(1, 1, 0),      point(0, 1, 0),
        point(.8, .8, 0), point(0.3, 0.3, 0.0), point(0.7, 0.2, 0.0)};
    const List<triFace> upper{triFace(0, 5, 3), triFace(5, 4, 3), triFace(4, 2, 3)};
    const List<triFace> lower{
        triFace(0, 1, 6), triFace(1, 2, 4), triFace(1, 4, 6), triFace(4, 5, 6),
        triFace(5, 0, 6)};
    List<triFace> all(upper);
    all.append(lower);
    mesh.triangles = all;
    mesh.cells = labelList(7, 0);
    mesh.boundaryFaces = labelList(7, -1);
    mesh.cellSizes = scalarField(7, 1);
    mesh.clearParametrization();
    const labelList parents{1, 1, 1, 0, 0, 0, 0, 0};
    std::vector<SurfacePiece> pieces(2);
    shapes::onRanks(
        2,
        [&](const Exchange& exchange)
        {
            InterfaceMesh mine(mesh);
            if (exchange.rank() == 1)
            {
                mine.points[4].z() = mine.points[5].z() = 1e-15; // what it made of them
            }
            SurfacePiece before;
            before.mesh.points = List<point>(SubList<point>(mesh.points, 4));
            before.mesh.triangles = List<triFace>{triFace(0, 1, 2), triFace(0, 2, 3)};
            before.pointKeys = List<PointKey>{{7, 0}, {8, 0}, {3, 0}, {9, 0}};
            before.keys = List<TriangleKey>{{point(7, 0, 0), 0}, {point(8, 0, 0), 0}};
            const List<bool> own{exchange.rank() == 0, exchange.rank() == 1};
            JoinedSurface joined(ownParts(mine, parents, before, own));
            const auto shared = sharedPoints(joined, mine, parents, before, own);
            EXPECT_EQ(shared.size(), 4);
            agreeOnPoints(joined.piece, shared, exchange);
            pieces[exchange.rank()] = joined.piece;
        }
    );
    const JoinedSurface whole(join(pieces));
    EXPECT_EQ(whole.piece.mesh.points.size(), 7);
    EXPECT_EQ(shapes::inspect(whole.piece.mesh).nRim, 4);
    for (const point& x : pieces[1].mesh.points)
    {
        EXPECT_EQ(x.z(), 0);
    }
}

} // namespace Foam::stability
