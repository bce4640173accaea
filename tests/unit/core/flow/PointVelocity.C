// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/flow/PointVelocity.H"

#include "shapes/AnalyticFlows.H"
#include "shapes/BoxMesh.H"
#include "shapes/CutOut.H"

#include <cmath>
#include <gtest/gtest.h>

using namespace Foam;
using namespace Foam::stability;

namespace
{

shapes::BoxOptions bentBox(BoundaryKind kind)
{
    shapes::BoxOptions options;
    options.n = Vector<label>(5, 4, 3);
    options.max = point(1, 1.2, 0.6);
    options.kinds = FixedList<BoundaryKind, 6>(kind);
    return options;
}

std::shared_ptr<FlowSnapshot> changeable(const shapes::BoxOptions& options)
{
    const auto complex = shapes::box(options);
    const auto flow =
        shapes::linearFlow(shapes::obliqueVelocity, shapes::obliqueGradient);
    return std::make_shared<FlowSnapshot>(*shapes::sampled(complex, flow, 0));
}

// The point of the mesh nearest to x.
label pointAt(const CellComplex& complex, const point& x)
{
    label nearest = 0;
    forAll(complex.points(), i)
    {
        if (mag(complex.points()[i] - x) < mag(complex.points()[nearest] - x))
        {
            nearest = i;
        }
    }
    return nearest;
}

// Of all cells within reach of x: on uniform hexes those that meet there.
vector meanOfCells(const FlowSnapshot& snapshot, const point& x, scalar reach)
{
    vector sum(Zero);
    label n = 0;
    forAll(snapshot.U, celli)
    {
        const vector arm = snapshot.complex->cellCentres()[celli] - x;
        if (mag(arm) < reach)
        {
            sum += snapshot.U[celli];
            ++n;
        }
    }
    return sum / n;
}

void expectNear(const vector& value, const vector& wanted, scalar tolerance)
{
    for (direction d = 0; d < 3; ++d)
    {
        EXPECT_NEAR(value[d], wanted[d], tolerance) << "component " << int(d);
    }
}

// The mesh with this velocity in its cells, and walls at rest.
std::shared_ptr<FlowSnapshot> besideWalls(CellComplexInput mesh, const vector& U)
{
    const auto complex = std::make_shared<const CellComplex>(std::move(mesh));
    auto snapshot = std::make_shared<FlowSnapshot>(
        *shapes::sampled(complex, shapes::uniformFlow(U), 0)
    );
    snapshot->boundaryU = vector::zero;
    return snapshot;
}

} // namespace

TEST(PointVelocity, LinearFieldIsExactAtInteriorAndFlatOpenPoints)
{
    const auto snapshot = changeable(bentBox(BoundaryKind::open));
    const PointVelocity velocity(snapshot, WallVelocity::slip);
    const CellComplex& complex = *snapshot->complex;
    label nChecked = 0;
    forAll(complex.points(), pointi)
    {
        // Along the edges of the box the faces around lie on one side of the point.
        const label nFaces = complex.pointBoundaryFaces()[pointi].size();
        const bool onEdge = nFaces > 0 && complex.pointCells()[pointi].size() < 4;
        if (!onEdge)
        {
            const point& x = complex.points()[pointi];
            expectNear(
                velocity.atPoint(pointi),
                shapes::obliqueVelocity + (shapes::obliqueGradient & x), 1e-13
            );
            ++nChecked;
        }
    }
    EXPECT_EQ(nChecked, 4 * 3 * 2 + 2 * (4 * 3 + 4 * 2 + 3 * 2));
}

TEST(PointVelocity, WeighsCellsWithInverseDistance)
{
    auto options = bentBox(BoundaryKind::open);
    options.map = [](const point& x) { return point(x.x() * x.x(), x.y(), x.z()); };
    const auto snapshot = changeable(options);
    const CellComplex& complex = *snapshot->complex;
    const label pointi = pointAt(complex, point(0.16, 0.6, 0.2));
    const point& x = complex.points()[pointi];

    vector sum(Zero);
    scalar weights = 0;
    label n = 0;
    forAll(snapshot->U, celli)
    {
        bool has = false;
        for (const label facei : complex.cellFaces()[celli])
        {
            has = has || complex.faces()[facei].found(pointi);
        }
        if (has)
        {
            const scalar weight = 1 / mag(complex.cellCentres()[celli] - x);
            sum += weight * snapshot->U[celli];
            weights += weight;
            ++n;
        }
    }
    ASSERT_EQ(n, 8);
    const PointVelocity velocity(snapshot, WallVelocity::slip);
    expectNear(velocity.atPoint(pointi), sum / weights, 1e-13);
    // The plain mean is something else: the weights matter here.
    EXPECT_GT(mag(meanOfCells(*snapshot, x, 0.3) - sum / weights), 1e-3);
}

TEST(PointVelocity, SlipFollowsTheWallAndNoSlipTakesItsVelocity)
{
    const auto snapshot = changeable(bentBox(BoundaryKind::wall));
    const CellComplex& complex = *snapshot->complex;
    // The floor moves up and, like a lid, along x.
    const vector lid(3, 0, 0.125);
    forAll(snapshot->boundaryU, i)
    {
        const bool floor = complex.patchNames()[complex.patches()[i]] == "zMin";
        snapshot->boundaryU[i] = floor ? lid : vector::zero;
    }
    const PointVelocity slip(snapshot, WallVelocity::slip);
    const PointVelocity noSlip(snapshot, WallVelocity::noSlip);

    const point onFloor(0.4, 0.6, 0);
    const vector mean = meanOfCells(*snapshot, onFloor, 0.25);
    const label floor = pointAt(complex, onFloor);
    expectNear(slip.atPoint(floor), vector(mean.x(), mean.y(), 0.125), 1e-13);
    expectNear(noSlip.atPoint(floor), lid, 1e-13);

    const point onEdge(0.4, 0, 0);
    const vector edgeMean = meanOfCells(*snapshot, onEdge, 0.25);
    const label edge = pointAt(complex, onEdge);
    expectNear(slip.atPoint(edge), vector(edgeMean.x(), 0, 0.125), 1e-13);

    const label corner = pointAt(complex, point(1, 1.2, 0));
    expectNear(slip.atPoint(corner), vector(0, 0, 0.125), 1e-13);
    EXPECT_GT(mag(edgeMean.x()), 0.1);
}

TEST(PointVelocity, WallWinsOverOpeningAndSymmetryAlwaysSlips)
{
    auto options = bentBox(BoundaryKind::wall);
    options.kinds[1] = BoundaryKind::open;
    options.kinds[2] = BoundaryKind::symmetry;
    const auto snapshot = changeable(options);
    const CellComplex& complex = *snapshot->complex;
    const vector wallU(0, 0.5, 0);
    forAll(snapshot->boundaryU, i)
    {
        if (complex.kinds()[i] == BoundaryKind::wall)
        {
            snapshot->boundaryU[i] = wallU;
        }
    }
    const PointVelocity slip(snapshot, WallVelocity::slip);
    const PointVelocity noSlip(snapshot, WallVelocity::noSlip);

    const point rim(1, 0.6, 0);
    const vector rimMean = meanOfCells(*snapshot, rim, 0.25);
    const label rimPoint = pointAt(complex, rim);
    expectNear(slip.atPoint(rimPoint), vector(rimMean.x(), rimMean.y(), 0), 1e-13);
    expectNear(noSlip.atPoint(rimPoint), wallU, 1e-13);

    const point mirror(0.6, 0, 0.2);
    const vector mirrorMean = meanOfCells(*snapshot, mirror, 0.25);
    const label mirrorPoint = pointAt(complex, mirror);
    const vector boundary =
        shapes::obliqueVelocity + (shapes::obliqueGradient & mirror);
    ASSERT_GT(mag(boundary.y()), 0.1);
    for (const PointVelocity* velocity : {&slip, &noSlip})
    {
        const vector U = velocity->atPoint(mirrorPoint);
        EXPECT_NEAR(U.x(), mirrorMean.x(), 1e-13);
        EXPECT_NEAR(U.y(), boundary.y(), 1e-13);
    }
}

TEST(PointVelocity, BentWallIsNoEdge)
{
    // A half pipe of 18 flats of 10 degrees: on every point two of them meet.
    shapes::BoxOptions options;
    options.n = Vector<label>(4, 18, 2);
    options.map = [](const point& x)
    {
        const scalar r = 1 + x.x();
        const scalar phi = 3.14159265358979 * x.y();
        return point(r * std::cos(phi), r * std::sin(phi), x.z());
    };
    const auto complex = shapes::box(options);
    const vector omega(0, 0, 1);
    const PointVelocity velocity(
        shapes::sampled(complex, shapes::rotation(point::zero, omega), 0),
        WallVelocity::slip
    );
    const label outer = pointAt(*complex, point(0, 2, 0.5));
    ASSERT_NEAR(complex->points()[outer].y(), 2, 1e-12);
    const vector U = velocity.atPoint(outer);
    // The centres of the cells lie at a radius of about 1.875.
    EXPECT_NEAR(U.x(), -1.87, 0.03);
    EXPECT_NEAR(U.y(), 0, 1e-12);
    EXPECT_NEAR(U.z(), 0, 1e-12);
}

TEST(PointVelocity, AtAConvexEdgeOnlyWhatPointsIntoTheObstacleIsTaken)
{
    const auto inObstacle = [](const point& x)
    { return mag(x.x() - 0.5) < 0.25 && mag(x.y() - 0.5) < 0.25 && x.z() < 0.5; };
    const struct
    {
        point x;
        vector U, wanted;
    } cases[] = {
        // The top edge at the front: past it, off it, on into one face, along it.
        {{0.25, 0.5, 0.5}, {1, 0.07, 0.11}, {1, 0.07, 0.11}},
        {{0.25, 0.5, 0.5}, {-1, 0.07, -0.11}, {-1, 0.07, -0.11}},
        {{0.25, 0.5, 0.5}, {1, 0.07, -0.11}, {1, 0.07, 0}},
        {{0.25, 0.5, 0.5}, {0.1, 0.07, -1}, {0, 0.07, -1}},
        // A corner of the top, where it keeps out of all three faces.
        {{0.25, 0.25, 0.5}, {1, 0.07, -0.11}, {1, 0, -0.11}},
        {{0.25, 0.25, 0.5}, {1, -0.07, -0.11}, {1, -0.07, -0.11}},
        // The foot of an edge, on the floor.
        {{0.25, 0.25, 0}, {1, -0.2, -0.11}, {1, -0.2, 0}},
        {{0.25, 0.25, 0}, {1, 0.2, 0.11}, {1, 0, 0}},
        // The foot of a face is concave.
        {{0.25, 0.5, 0}, {-1, 0.07, 0.11}, {0, 0.07, 0}}};
    for (const auto& at : cases)
    {
        const auto snapshot = besideWalls(
            shapes::cutOut(shapes::boxInput(shapes::BoxOptions()), inObstacle), at.U
        );
        const label pointi = pointAt(*snapshot->complex, at.x);
        ASSERT_LT(mag(snapshot->complex->points()[pointi] - at.x), 1e-12);
        SCOPED_TRACE(
            testing::Message() << "at " << at.x.x() << " " << at.x.y() << " "
                               << at.x.z() << " with U " << at.U.x()
        );
        expectNear(
            PointVelocity(snapshot, WallVelocity::slip).atPoint(pointi), at.wanted,
            1e-12
        );
    }
}

TEST(PointVelocity, TheFlowGoesAroundTheRimOfAThinWall)
{
    const auto none = [](const point&) { return false; };
    const auto baffle = [](const point& x)
    { return mag(x.x() - 0.5) < 1e-6 && x.z() < 0.5; };
    const vector U(1, 0.07, -0.11);
    const auto snapshot = besideWalls(
        shapes::cutOut(shapes::boxInput(shapes::BoxOptions()), none, baffle), U
    );
    const PointVelocity velocity(snapshot, WallVelocity::slip);
    const CellComplex& complex = *snapshot->complex;
    expectNear(velocity.atPoint(pointAt(complex, point(0.5, 0.5, 0.5))), U, 1e-12);
    // Where the rim meets the side of the box, that side is kept to.
    expectNear(
        velocity.atPoint(pointAt(complex, point(0.5, 0, 0.5))), vector(U.x(), 0, U.z()),
        1e-12
    );
}

TEST(PointVelocity, SameBitsOnAnyNumberOfThreads)
{
    auto options = bentBox(BoundaryKind::wall);
    options.n = Vector<label>(12, 12, 12);
    options.kinds[5] = BoundaryKind::open;
    const auto snapshot = changeable(options);
    const label nPoints = snapshot->complex->nPoints();

    const PointVelocity alone(snapshot, WallVelocity::slip);
    vectorField wanted(nPoints);
    forAll(wanted, i)
    {
        wanted[i] = alone.atPoint(i);
    }

    for (label round = 0; round < 10; ++round)
    {
        const PointVelocity shared(snapshot, WallVelocity::slip);
        label nDifferent = 0;
#pragma omp parallel num_threads(4) reduction(+ : nDifferent)
        {
            // Every thread asks for every point, so that they meet.
            for (label i = 0; i < nPoints; ++i)
            {
                nDifferent += shared.atPoint(i) != wanted[i];
            }
        }
        EXPECT_EQ(nDifferent, 0);
    }
}
