// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/reconstruction/volumeFit/ConnectedPieces.H"
#include "core/reconstruction/Reconstruction.H"
#include "shapes/ExactAlpha.H"
#include "shapes/PolyMeshes.H"

#include <gtest/gtest.h>

using namespace Foam;
using namespace Foam::stability;

namespace
{

std::shared_ptr<const CellComplex> mesh(label n)
{
    shapes::BoxOptions options;
    options.max = point(n, n, n);
    options.n = Vector<label>(n, n, n);
    return shapes::complexOf(shapes::perturbedBox(options));
}

InterfaceMesh
surfaceOf(std::shared_ptr<const CellComplex> complex, const shapes::Shape& shape)
{
    return Reconstruction::New(ReconstructionOptions())
        ->extract(shapes::snapshotOf(complex, shape))
        .mesh;
}

// A shell around a bubble, and a ball that sticks to the wall z = 0.
shapes::Shape shellAndBall()
{
    const shapes::Shape outer = shapes::sphere(point(8.1, 7.9, 9.2), 5.3);
    const shapes::Shape inner = shapes::sphere(point(8.3, 7.7, 9.1), 2.6);
    const shapes::Shape ball = shapes::sphere(point(15.1, 15.2, 0.4), 2.2);
    return [=](const point& x)
    { return std::min(std::max(outer(x), -inner(x)), ball(x)); };
}

} // namespace

TEST(ConnectedPieces, whatIsClosedAndWhichWayRound)
{
    const InterfaceMesh surface = surfaceOf(mesh(18), shellAndBall());
    const ConnectedPieces pieces(surface);
    ASSERT_EQ(pieces.all.size(), 3u);
    std::size_t nTriangles = 0, nPoints = 0;
    label nClosed = 0;
    for (const ConnectedPiece& piece : pieces.all)
    {
        nTriangles += piece.triangles.size();
        nPoints += piece.points.size();
        nClosed += piece.closed;
        const bool outer = piece.volume > 0, inner = piece.volume < 0;
        const scalar radius = std::cbrt(3 * mag(piece.volume) / (4 * M_PI));
        EXPECT_NEAR(radius, outer ? 5.3 : inner ? 2.6 : 0, outer || inner ? 0.15 : 0);
        EXPECT_EQ(piece.closed, outer || inner);
    }
    EXPECT_EQ(nClosed, 2);
    EXPECT_EQ(nTriangles, std::size_t(surface.triangles.size()));
    EXPECT_EQ(nPoints, std::size_t(surface.points.size()));
}

TEST(ConnectedPieces, theVolumesInAllCellsAreThatOfThePiece)
{
    const auto complex = mesh(18);
    const InterfaceMesh surface = surfaceOf(complex, shellAndBall());
    const ConnectedPieces pieces(surface);
    for (const ConnectedPiece& piece : pieces.all)
    {
        if (!piece.closed)
        {
            continue;
        }
        const PieceColumns columns(surface, piece);
        const scalar sign = piece.volume > 0 ? 1 : -1;
        scalar sum = 0;
        label nWhole = 0, nCut = 0;
        for (label celli = 0; celli < complex->nCells(); ++celli)
        {
            const CellPieces cell(*complex, celli);
            const scalar share = sign * columns.volumeIn(cell) / cell.volume();
            EXPECT_GT(share, -1e-12);
            EXPECT_LT(share, 1 + 1e-12);
            nWhole += share > 1 - 1e-9;
            nCut += share > 1e-9 && share < 1 - 1e-9;
            sum += sign * share * cell.volume();
        }
        EXPECT_NEAR(sum / piece.volume, 1, 1e-12);
        EXPECT_GT(nWhole, 10);
        EXPECT_GT(nCut, 80);
    }
}

TEST(ConnectedPieces, nothingIsNoPiece)
{
    EXPECT_TRUE(ConnectedPieces(InterfaceMesh()).all.empty());
}
