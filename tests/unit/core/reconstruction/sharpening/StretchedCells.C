// SPDX-License-Identifier: GPL-3.0-or-later

// Points of alpha = 1/2 moved onto what exact fractions describe, in flat cells; and
// ranks that make the same of it.

#include "core/reconstruction/Reconstruction.H"
#include "core/surface/pieces/SharedPoints.H"
#include "shapes/MeshParts.H"
#include "shapes/PolyMeshes.H"
#include "shapes/SectionMesh.H"
#include "shapes/SurfaceChecks.H"
#include "shapes/SurfaceErrors.H"
#include "shapes/ThreadRanks.H"

#include <gtest/gtest.h>

#include <cmath>

namespace Foam::stability
{

namespace
{

// Cells of 1 m, but flat along one direction.
shapes::BoxOptions flatCells(direction along, scalar aspect)
{
    shapes::BoxOptions options;
    options.n = Vector<label>(10, 10, 10);
    options.max = point(10, 10, 10);
    options.max[along] /= aspect;
    return options;
}

ReconstructionOptions sharpenedBy(Sharpening kind)
{
    ReconstructionOptions options;
    options.sharpening = kind;
    return options;
}

// The rms distance of the points from the shape, in extents of their cells along its
// normal, of a surface that must be closed. Of the triangles of flat tetrahedra, and of
// those that lie obliquely in layers, some are folded before, and stay so.
scalar errorIn(
    const CellComplexInput& mesh, const shapes::Shape& shape,
    Sharpening kind = Sharpening::automatic, scalar shareOfFolds = 0
)
{
    const auto complex = shapes::complexOf(mesh);
    const ReconstructionResult result =
        Reconstruction::New(sharpenedBy(kind))
            ->extract(shapes::snapshotOf(complex, shape));
    const shapes::SurfaceReport report = shapes::inspect(result.mesh);
    EXPECT_EQ(report.nCrowded, 0);
    EXPECT_EQ(report.nRimInside, 0);
    EXPECT_EQ(report.nMisoriented, 0);
    const shapes::SurfaceErrors errors =
        shapes::errorsOf(result.mesh, shape, *complex, shapes::CellLength::extent);
    EXPECT_LE(errors.nFlipped, shareOfFolds * result.mesh.triangles.size());
    return errors.rms;
}

// As curved, in cells, as a ball of 20 of them.
shapes::Shape capAcross(scalar aspect)
{
    return shapes::sphere(point(5.2, 4.7, 5.13 / aspect - 20 * aspect), 20 * aspect);
}

shapes::Shape capAlong(scalar aspect)
{
    return shapes::sphere(point(5.1 / aspect, 4.7, 5.13 - 25), 25);
}

} // namespace

TEST(StretchedCells, flatAcrossTheInterface)
{
    for (const scalar aspect : {3., 10., 1000.})
    {
        const CellComplexInput mesh(shapes::boxInput(flatCells(2, aspect)));
        const shapes::Shape cap = capAcross(aspect);
        EXPECT_LT(errorIn(mesh, cap), 0.002) << aspect;
    }
    const CellComplexInput mesh(shapes::boxInput(flatCells(2, 100)));
    EXPECT_GT(errorIn(mesh, capAcross(100), Sharpening::none), 0.04);
    EXPECT_LT(errorIn(mesh, capAcross(100), Sharpening::profile), 0.03);
}

TEST(StretchedCells, flatAlongTheInterface)
{
    for (const scalar aspect : {3., 10., 1000.})
    {
        const CellComplexInput mesh(shapes::boxInput(flatCells(0, aspect)));
        const shapes::Shape cap = capAlong(aspect);
        EXPECT_LT(errorIn(mesh, cap), 0.002) << aspect;
    }
    const CellComplexInput mesh(shapes::boxInput(flatCells(0, 100)));
    EXPECT_LT(errorIn(mesh, capAlong(100), Sharpening::profile), 0.03);
}

TEST(StretchedCells, flatObliquelyToTheInterface)
{
    for (const scalar aspect : {3., 100.})
    {
        const vector n = vector(1, 0.3, 0.5) / mag(vector(1, 0.3, 0.5));
        const shapes::Shape cap =
            shapes::sphere(point(5.1, 4.7, 5.1 / aspect) - 20 * n, 20);
        const CellComplexInput mesh(shapes::boxInput(flatCells(2, aspect)));
        EXPECT_LT(errorIn(mesh, cap, Sharpening::automatic, 0.01), 0.01) << aspect;
    }
}

// Cells of 1 m that are flat in a section; a disc as curved in space as on square
// cells.
TEST(StretchedCells, discsInALittleFlatCells)
{
    const scalar largest[2][2] = {{2, 0.001}, {4, 0.004}};
    for (const auto& [aspect, allowed] : largest)
    {
        shapes::SectionOptions options;
        options.nx = 13;
        options.ny = label(13 * aspect);
        options.max = point(13, 13, 0);
        const auto complex = shapes::section(options);
        const shapes::Shape disc = [](const point& x)
        { return std::hypot(x.x() - 6.637, x.y() - 6.432) - 4.8; };
        const InterfaceMesh mesh(Reconstruction::New(sharpenedBy(Sharpening::automatic))
                                     ->extract(shapes::snapshotOf(
                                         complex, shapes::sectionAlpha(*complex, disc)
                                     ))
                                     .mesh);
        const shapes::SurfaceErrors errors =
            shapes::errorsOf(mesh, disc, *complex, shapes::CellLength::extent);
        EXPECT_LT(errors.rms, allowed) << aspect;
    }
}

TEST(StretchedCells, flatTetrahedra)
{
    constexpr scalar folds = 0.005;
    const auto errorOf = [](const shapes::BoxOptions& cells, const shapes::Shape& cap) {
        return errorIn(
            shapes::tetrahedralBox(cells), cap, Sharpening::automatic, folds
        );
    };
    EXPECT_LT(errorOf(flatCells(2, 100), capAcross(100)), 0.03);
    EXPECT_LT(errorOf(flatCells(0, 10), capAlong(10)), 0.03);
    EXPECT_LT(errorOf(flatCells(0, 100), capAlong(100)), 0.05);
}

namespace
{

// The surface that ranks make of the fractions of a shape, joined.
InterfaceMesh madeByRanks(
    label nRanks, const CellComplexInput& mesh, const shapes::Shape& shape,
    const ReconstructionOptions& options
)
{
    const auto complex = shapes::complexOf(mesh);
    const FlowSnapshot whole(shapes::snapshotOf(complex, shape));
    const shapes::MeshParts parts(complex, shapes::irregularParts(*complex, nRanks));
    std::vector<SurfacePiece> pieces(nRanks);
    shapes::onRanks(
        nRanks,
        [&](const Exchange& exchange)
        {
            const auto part = parts.part(exchange, reachOf(options));
            const InterfaceMesh extracted(
                Reconstruction::New(options)->extract(*parts.part(part, whole)).mesh
            );
            SurfacePiece& piece = pieces[exchange.rank()];
            const labelList kept(keepOwn(piece, extracted, *part));
            agreeOnPoints(piece, sharedPoints(extracted, kept, *part), exchange);
        }
    );
    return join(pieces).piece.mesh;
}

void expectSame(const CellComplexInput& mesh, const shapes::Shape& shape)
{
    const ReconstructionOptions options(sharpenedBy(Sharpening::automatic));
    const InterfaceMesh alone(madeByRanks(1, mesh, shape, options));
    EXPECT_GT(alone.points.size(), 300);
    const InterfaceMesh joined(madeByRanks(3, mesh, shape, options));
    EXPECT_EQ(shapes::inspect(joined).nRimInside, 0);
    EXPECT_EQ(joined.triangles, alone.triangles);
    EXPECT_EQ(joined.points, alone.points);
}

} // namespace

// Rows of small cells beside large ones, which reach across more of them than rings go.
TEST(StretchedCells, ranksMakeTheSameOfThem)
{
    for (const scalar thin : {0.05, 0.15})
    {
        shapes::BoxOptions graded;
        graded.n = Vector<label>(14, 30, 12);
        graded.max = point(14, 30, 12);
        graded.map = [thin](const point& x)
        {
            const scalar y = x.y();
            return point(x.x(), y < 12 ? thin * y : 12 * thin + (y - 12) * 0.6, x.z());
        };
        expectSame(
            shapes::boxInput(graded), shapes::sphere(point(6.8, 4.1, -19.2), 25)
        );
    }
    expectSame(
        shapes::boxInput(flatCells(0, 30)), shapes::sphere(point(0.17, 4.3, -19.9), 25)
    );
    const auto refine = [](const point& x)
    { return x.x() > 9 && mag(x.y() - 5) < 2 && mag(x.z() - 5) < 2; };
    shapes::BoxOptions cubes;
    cubes.n = Vector<label>(16, 10, 10);
    cubes.max = point(16, 10, 10);
    expectSame(
        shapes::refinedBox(cubes, refine), shapes::sphere(point(8.3, 5.2, -19.9), 25)
    );
}

} // namespace Foam::stability
