// SPDX-License-Identifier: GPL-3.0-or-later

// What a piece of a mesh extracts in its own cells is what the whole has there, to the
// last bit, with enough rings of cells around them.

#include "core/reconstruction/InterfaceOrder.H"
#include "core/surface/pieces/SurfacePiece.H"

#include "core/cells/CellBlock.H"
#include "core/reconstruction/Reconstruction.H"
#include "shapes/ExactAlpha.H"
#include "shapes/PolyMeshes.H"

#include <gtest/gtest.h>

#include <set>

namespace Foam::stability
{

namespace
{

using Corners = std::array<scalar, 9>;

Corners cornersOf(const InterfaceMesh& mesh, const triFace& t)
{
    Corners corners;
    for (label k = 0; k < 3; ++k)
    {
        for (direction d = 0; d < 3; ++d)
        {
            corners[3 * k + d] = mesh.points[t[k]][d];
        }
    }
    return corners;
}

// The whole with a number for everything, smeared fractions of a ball that touches a
// wall.
std::shared_ptr<FlowSnapshot> wholeBall()
{
    shapes::BoxOptions options;
    options.n = Vector<label>(20, 12, 12);
    options.max = point(20, 12, 12);
    CellComplexInput mesh(shapes::perturbedBox(options, 0.1));
    orderByPosition(mesh);
    mesh.globalCells = identity(mesh.nCells);
    mesh.globalPoints = identity(mesh.points.size());
    mesh.globalBoundaryFaces = identity(mesh.kinds.size());
    mesh.cellBehind = labelList(mesh.kinds.size(), -1);
    const auto complex = std::make_shared<const CellComplex>(mesh);
    return std::make_shared<FlowSnapshot>(shapes::snapshotOf(
        complex, shapes::exactAlpha(*complex, shapes::sphere(point(9.7, 5.9, 3.2), 4.1))
    ));
}

// Own cells are those left of the middle.
std::shared_ptr<FlowSnapshot> leftOf(const FlowSnapshot& whole, label nRings)
{
    const CellComplex& all = *whole.complex;
    DynamicList<label> cells;
    const scalar end = 10 + nRings;
    forAll(all.cellCentres(), celli)
    {
        if (all.cellCentres()[celli].x() < end)
        {
            cells.append(celli);
        }
    }
    CellComplexInput input(
        assemble({blockOf(all.input(), all.cellFaces(), cells)}, all.patchNames())
    );
    input.whole = all.whole();
    auto piece = std::make_shared<FlowSnapshot>();
    piece->alphas =
        List<scalarField>(1, scalarField(whole.alphas[0], input.globalCells));
    scalarField boundary(input.globalBoundaryFaces.size(), 0);
    forAll(boundary, i)
    {
        const label there = input.globalBoundaryFaces[i];
        boundary[i] = there < 0 ? 0 : whole.boundaryAlphas[0][there];
    }
    piece->boundaryAlphas = List<scalarField>(1, boundary);
    input.own.setSize(input.globalCells.size());
    forAll(input.own, celli)
    {
        input.own[celli] = all.cellCentres()[input.globalCells[celli]].x() < 10;
    }
    piece->complex = std::make_shared<const CellComplex>(input);
    return piece;
}

} // namespace

TEST(InterfaceOrder, aPieceExtractsWhatTheWholeHas)
{
    const auto whole = wholeBall();
    for (const char* method : {"isoAlpha", "bonnell", "plic"})
    {
        for (const Sharpening sharpening : {Sharpening::none, Sharpening::automatic})
        {
            if (sharpening != Sharpening::none && method != std::string("isoAlpha"))
            {
                continue;
            }
            ReconstructionOptions options;
            options.method = method;
            options.sharpening = sharpening;
            const auto reconstruction = Reconstruction::New(options);
            const InterfaceMesh all(reconstruction->extract(*whole).mesh);
            std::multiset<Corners> expected;
            forAll(all.triangles, i)
            {
                if (whole->complex->cellCentres()[all.triangleCells[i]].x() < 10)
                {
                    expected.insert(cornersOf(all, all.triangles[i]));
                }
            }
            const auto piece = leftOf(*whole, 9);
            const InterfaceMesh extracted(reconstruction->extract(*piece).mesh);
            const label before = extracted.triangles.size();
            SurfacePiece own;
            const bool sharesPoints = reconstructionMethod(method).sharesPoints;
            own.sharesPoints = sharesPoints;
            const labelList kept(keepOwn(own, extracted, *piece->complex));
            EXPECT_EQ(own.sharesPoints, sharesPoints);
            const InterfaceMesh& part = own.mesh;
            EXPECT_LT(part.triangles.size(), before);
            EXPECT_EQ(kept.size(), part.points.size());
            std::multiset<Corners> found;
            for (const triFace& t : part.triangles)
            {
                found.insert(cornersOf(part, t));
            }
            EXPECT_GT(found.size(), 200);
            EXPECT_TRUE(found == expected) << method << ", " << found.size() << " and "
                                           << expected.size() << " triangles";
        }
    }
}

TEST(InterfaceOrder, trianglesAreThoseOfAscendingCells)
{
    const auto whole = wholeBall();
    const InterfaceMesh mesh(
        Reconstruction::New(ReconstructionOptions())->extract(*whole).mesh
    );
    label next = 0;
    forAll(mesh.triangles, i)
    {
        EXPECT_TRUE(i == 0 || mesh.triangleCells[i] >= mesh.triangleCells[i - 1]);
        for (const label pointi : mesh.triangles[i])
        {
            EXPECT_LE(pointi, next);
            next = std::max(next, pointi + 1);
        }
    }
    EXPECT_EQ(next, mesh.points.size());
}

} // namespace Foam::stability
