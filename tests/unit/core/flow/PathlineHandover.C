// SPDX-License-Identifier: GPL-3.0-or-later

// A pathline that is handed over between pieces of a mesh, also within a step, ends
// where it ends on the whole mesh, to the last bit.

#include "core/cells/CellBlock.H"
#include "core/flow/PathlineIntegrator.H"
#include "core/flow/PointVelocity.H"
#include "core/flow/VelocityInterval.H"
#include "shapes/PolyMeshes.H"

#include <gtest/gtest.h>

#include <functional>

namespace Foam::stability
{

namespace
{

CellComplexInput numberedBox()
{
    shapes::BoxOptions options;
    options.n = Vector<label>(10, 9, 8);
    CellComplexInput mesh(shapes::perturbedBox(options));
    orderByPosition(mesh);
    mesh.globalCells = identity(mesh.nCells);
    mesh.globalPoints = identity(mesh.points.size());
    mesh.globalBoundaryFaces = identity(mesh.kinds.size());
    mesh.cellBehind = labelList(mesh.kinds.size(), -1);
    return mesh;
}

// Rotates around the middle, faster and faster.
vector velocityAt(const point& x, scalar time)
{
    const vector arm = x - point(0.5, 0.5, 0.5);
    return (1 + time) * (vector(0.2, 0.5, 1) ^ arm);
}

std::shared_ptr<const CellComplex>
piece(const CellComplexInput& mesh, const std::function<bool(const point&)>& accepts)
{
    const CellComplex complex(mesh);
    DynamicList<label> cells;
    for (label celli = 0; celli < complex.nCells(); ++celli)
    {
        if (accepts(complex.cellCentres()[celli]))
        {
            cells.append(celli);
        }
    }
    return std::make_shared<const CellComplex>(
        assemble({blockOf(mesh, facesOfCells(mesh), cells)}, mesh.patchNames)
    );
}

VelocityInterval velocityOn(const std::shared_ptr<const CellComplex>& complex)
{
    const auto at = [&](scalar time)
    {
        auto snapshot = std::make_shared<FlowSnapshot>();
        snapshot->complex = complex;
        snapshot->time = time;
        for (const point& x : complex->cellCentres())
        {
            snapshot->U.append(velocityAt(x, time));
        }
        for (label i = 0; i < complex->nBoundaryFaces(); ++i)
        {
            snapshot->boundaryU.append(
                velocityAt(complex->faceCentres()[complex->nInternalFaces() + i], time)
            );
        }
        return std::make_shared<const PointVelocity>(snapshot, WallVelocity::slip);
    };
    return VelocityInterval(at(0), at(1));
}

} // namespace

TEST(PathlineHandover, endsWhereItEndsOnTheWhole)
{
    const CellComplexInput mesh(numberedBox());
    const auto all = std::make_shared<const CellComplex>(mesh);
    const VelocityInterval onWhole(velocityOn(all));
    const std::shared_ptr<const CellComplex> pieces[2] = {
        piece(mesh, [](const point& x) { return x.x() < 0.65; }),
        piece(mesh, [](const point& x) { return x.x() > 0.35; })};
    const VelocityInterval onPieces[2] = {velocityOn(pieces[0]), velocityOn(pieces[1])};

    label nHandovers = 0, nWithin = 0;
    for (label i = 0; i < 40; ++i)
    {
        Pathline whole;
        whole.x = point(0.07 + 0.01 * i, 0.31 + 0.013 * i, 0.72 - 0.011 * i);
        Pathline handed(whole);
        IntegrationCounts counts;
        ASSERT_TRUE(advance(whole, onWhole, IntegrationOptions(), counts));

        label here = handed.x.x() > 0.5;
        handed.hint.cell = pieces[here]->findCell(handed.x);
        label n = 0;
        while (!advance(handed, onPieces[here], IntegrationOptions(), counts))
        {
            ASSERT_LT(++n, 20);
            nWithin += handed.stage > 0;
            const label global = pieces[here]->globalCell(handed.hint.cell);
            here = 1 - here;
            handed.hint.cell = pieces[here]->localCell(global);
            ASSERT_GE(handed.hint.cell, 0);
            ASSERT_TRUE(pieces[here]->hasAllNeighbours(handed.hint.cell));
        }
        nHandovers += n;
        EXPECT_EQ(handed.x, whole.x);
        EXPECT_EQ(handed.nSteps, whole.nSteps);
    }
    EXPECT_GT(nHandovers, 20);
    EXPECT_GT(nWithin, 5);
}

} // namespace Foam::stability
