// SPDX-License-Identifier: GPL-3.0-or-later

// Surfaces on both sides of a thin wall: each is what it would be without the other.

#include "core/reconstruction/Reconstruction.H"
#include "shapes/BoxMesh.H"
#include "shapes/CutOut.H"
#include "shapes/ExactAlpha.H"

#include <gtest/gtest.h>

using namespace Foam;
using namespace Foam::stability;

namespace
{

// The cells of the box between two x; all sides are walls.
shapes::BoxOptions half(scalar low, scalar high)
{
    shapes::BoxOptions box;
    box.n = Vector<label>(label(8 * (high - low) + 0.5), 7, 8);
    box.min.x() = low;
    box.max.x() = high;
    return box;
}

const vector normal(0.1, -0.15, 1); // of the surface of the water

// Water up to another height on each side of x = 1/2.
scalar height(bool left)
{
    return left ? 0.41 : 0.47;
}

FlowSnapshot waterIn(const std::shared_ptr<const CellComplex>& complex)
{
    const auto level = [&](bool left)
    {
        return shapes::exactAlpha(
            *complex, shapes::halfSpace(point(0.5, 0.5, height(left)), normal)
        );
    };
    scalarField alpha(level(true));
    const scalarField right(level(false));
    forAll(alpha, celli)
    {
        const bool isLeft = complex->cellCentres()[celli].x() < 0.5;
        alpha[celli] = isLeft ? alpha[celli] : right[celli];
    }
    return shapes::snapshotOf(complex, alpha);
}

pointField pointsOf(const FlowSnapshot& snapshot, const ReconstructionOptions& options)
{
    return Reconstruction::New(options)->extract(snapshot).mesh.points;
}

scalar distanceFrom(const pointField& points, const point& x)
{
    scalar least = GREAT;
    for (const point& other : points)
    {
        least = min(least, mag(other - x));
    }
    return least;
}

} // namespace

TEST(AtThinWalls, eachSideIsAsIfAlone)
{
    const auto nowhere = [](const point&) { return false; };
    const auto wall = [](const point& x) { return mag(x.x() - 0.5) < 0.05; };
    const FlowSnapshot both(waterIn(shapes::withThinWalls(
        shapes::cutOut(shapes::boxInput(half(0, 1)), nowhere, wall)
    )));
    const FlowSnapshot left(waterIn(shapes::box(half(0, 0.5))));
    const FlowSnapshot right(waterIn(shapes::box(half(0.5, 1))));
    const struct
    {
        std::string method;
        Sharpening sharpening;
    } kinds[] = {
        {"isoAlpha", Sharpening::none},
        {"isoAlpha", Sharpening::plic},
        {"isoAlpha", Sharpening::profile},
        {"bonnell", Sharpening::none},
        {"plic", Sharpening::none}};
    for (const auto& kind : kinds)
    {
        SCOPED_TRACE(kind.method + std::to_string(int(kind.sharpening)));
        ReconstructionOptions options;
        options.method = kind.method;
        options.sharpening = kind.sharpening;
        pointField apart(pointsOf(left, options));
        apart.append(pointsOf(right, options));
        const pointField together(pointsOf(both, options));
        ASSERT_EQ(together.size(), apart.size());
        for (const point& x : together)
        {
            EXPECT_LT(distanceFrom(apart, x), 1e-9);
        }
    }
}
