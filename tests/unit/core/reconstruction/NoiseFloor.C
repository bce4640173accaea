// SPDX-License-Identifier: GPL-3.0-or-later

// What a run says of its own noise, against the error that exact fractions tell.

#include "core/reconstruction/NoiseFloor.H"
#include "shapes/BoxMesh.H"
#include "shapes/ExactAlpha.H"
#include "shapes/Surfaces.H"
#include "shapes/ThreadRanks.H"

#include <gtest/gtest.h>

#include <cmath>

using namespace Foam;
using namespace Foam::stability;

namespace
{

const SerialExchange alone;

scalar quantileOf(const scalarField& values)
{
    return noiseQuantile(values, List<bool>(values.size(), true), alone);
}

struct Floors
{
    scalar told = 0, truth = 0; // [cells]
};

Floors floorsOf(
    label n, const shapes::Shape& shape, const std::string& method,
    Sharpening sharpening, label nThreads = 2
)
{
    ReconstructionOptions options;
    options.method = method;
    options.sharpening = sharpening;
    options.nThreads = nThreads;
    const FlowSnapshot snapshot =
        shapes::snapshotOf(shapes::box(shapes::boxOf(n)), shape);
    const auto result = Reconstruction::New(options)->extract(snapshot);
    scalarField errors(result.mesh.points.size());
    forAll(errors, pointi)
    {
        errors[pointi] = mag(shape(result.mesh.points[pointi]));
    }
    const auto extract = [&](const ReconstructionOptions& other)
    { return Reconstruction::New(other)->extract(snapshot).mesh; };
    const scalarField spread(
        result.sharpening ? result.sharpening->spread : scalarField(errors.size(), 0)
    );
    const List<bool> all(errors.size(), true);
    return {
        noiseFloor(result.mesh, spread, all, options, extract, Run{alone, nThreads}),
        noiseQuantile(errors, all, alone)};
}

const shapes::Shape smallBall = shapes::sphere(point(9.137, 8.732, 9.281), 4.8);
const shapes::Shape ring =
    shapes::torus(point(17.137, 16.732, 17.281), vector(1, 2, 3), 9, 4.8);

} // namespace

TEST(NoiseFloor, ofSharpenedInterfacesIsThatOfTheTruth)
{
    const Floors floors[] = {
        floorsOf(18, smallBall, "isoAlpha", Sharpening::automatic),
        floorsOf(34, ring, "isoAlpha", Sharpening::automatic)};
    for (const Floors& f : floors)
    {
        EXPECT_GT(f.told, f.truth / 3);
        EXPECT_LT(f.told, f.truth * 3);
        EXPECT_GT(f.truth, 1e-4);
    }
}

TEST(NoiseFloor, ofRawInterfacesIsThatOfTheTruth)
{
    for (const char* method : {"isoAlpha", "bonnell"})
    {
        const Floors f = floorsOf(18, smallBall, method, Sharpening::none);
        EXPECT_GT(f.told, 0.1);
        EXPECT_LT(f.told, 0.6);
        EXPECT_GT(f.told, f.truth / 3);
        EXPECT_LT(f.told, f.truth * 3);
    }
}

TEST(NoiseFloor, threadsChangeNothing)
{
    EXPECT_EQ(
        floorsOf(18, smallBall, "isoAlpha", Sharpening::none, 1).told,
        floorsOf(18, smallBall, "isoAlpha", Sharpening::none, 4).told
    );
}

TEST(NoiseFloor, quantilesLeaveOneInAThousandOut)
{
    scalarField values(2000);
    forAll(values, i)
    {
        values[i] = 2000 - i;
    }
    EXPECT_EQ(quantileOf(values), 1998);
    values.setSize(1001);
    EXPECT_EQ(quantileOf(values), 1999);
    EXPECT_EQ(quantileOf(scalarField(1, 0.7)), 0.7);
    EXPECT_EQ(quantileOf(scalarField()), 0);
}

// Values 1 to 2000 once each, however they are spread; what another rank counts is
// large.
TEST(NoiseFloor, quantilesAreThoseOfAllRanks)
{
    for (const label n : {1, 2, 3, 5})
    {
        scalarField found(n, -1);
        shapes::onRanks(
            n,
            [&](const Exchange& exchange)
            {
                DynamicList<scalar> values;
                DynamicList<bool> isPrimary;
                for (label i = 1; i <= 2000; ++i)
                {
                    const bool mine = (i / 7) % n == exchange.rank();
                    values.append(mine ? i : 10000);
                    isPrimary.append(mine);
                }
                found[exchange.rank()] =
                    noiseQuantile(scalarField(values), isPrimary, exchange);
            }
        );
        EXPECT_EQ(found, scalarField(n, 1998));
    }
}

// Three of 2000 points stay.
TEST(NoiseFloor, pointsThatStayAreAFifthOfACellOff)
{
    const List<bool> all(2000, true);
    scalarField spread(2000, 0.01);
    spread[0] = 0.5;
    spread[3] = spread[1200] = spread[1999] = -1;
    EXPECT_EQ(spreadFloor(spread, all, alone), 0.2);
    spread[3] = spread[1200] = 0.01;
    EXPECT_EQ(spreadFloor(spread, all, alone), 0.01);
}

// Half a metre apart, in cells of 0.4 and, at one point, of 0.1 m: farther than 3
// cells.
TEST(NoiseFloor, differencesAreInCellsUpToThree)
{
    const auto plane = [](scalar height)
    {
        return shapes::asInterface(
            shapes::grid(
                [=](scalar u, scalar v) { return point(4 * u, 4 * v, height); }, 6, 6
            ),
            0.4
        );
    };
    InterfaceMesh mesh(plane(0));
    const auto largestFrom = [&](const InterfaceMesh& other)
    { return quantileOf(distancesFrom(other, mesh, 1)); };
    EXPECT_NEAR(largestFrom(plane(0.5)), 1.25, 1e-12);
    EXPECT_EQ(largestFrom(plane(1.3)), 3);
    EXPECT_EQ(largestFrom(InterfaceMesh()), 3);
    mesh.cellSizes[20] = 0.1;
    EXPECT_EQ(largestFrom(plane(0.5)), 3);
}

TEST(NoiseFloor, withoutAnInterfaceThereIsNone)
{
    const shapes::Shape nowhere = [](const point&) { return 1.0; };
    EXPECT_EQ(floorsOf(6, nowhere, "isoAlpha", Sharpening::none).told, 0);
    EXPECT_EQ(floorsOf(6, nowhere, "isoAlpha", Sharpening::automatic).told, 0);
}
