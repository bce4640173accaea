// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/flow/VelocityInterval.H"

#include "core/base/Errors.H"
#include "shapes/AnalyticFlows.H"
#include "shapes/BoxMesh.H"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

using namespace Foam;
using namespace Foam::stability;

namespace
{

using Where = VelocitySample::Where;

// Linear in space and, between times, too.
vector flow(const point& x, scalar time)
{
    return shapes::obliqueVelocity + (shapes::obliqueGradient & x)
           + time * vector(-0.7, 2.1, 0.3);
}

shapes::BoxOptions openBox(label n)
{
    shapes::BoxOptions options;
    options.n = Vector<label>(n, n, n);
    options.kinds = FixedList<BoundaryKind, 6>(BoundaryKind::open);
    return options;
}

std::shared_ptr<const CellComplex> perturbedCube(label n)
{
    auto options = openBox(n);
    options.map = [n](const point& x)
    {
        const auto inside = [](scalar s) { return s > 1e-9 && s < 1 - 1e-9; };
        if (!inside(x.x()) || !inside(x.y()) || !inside(x.z()))
        {
            return x;
        }
        return x
               + 0.25 / n
                     * vector(
                         std::sin(91 * x.y() + 17 * x.z()),
                         std::sin(83 * x.z() - 29 * x.x()),
                         std::cos(97 * x.x() + 13 * x.y())
                     );
    };
    return shapes::box(options);
}

VelocityInterval interval(
    std::shared_ptr<const CellComplex> earlier,
    std::shared_ptr<const CellComplex> later, const shapes::Flow& flow
)
{
    return VelocityInterval(
        shapes::sampledVelocity(std::move(earlier), flow, 2),
        shapes::sampledVelocity(std::move(later), flow, 2.5)
    );
}

class Sampler
{
public:
    scalar operator()() { return distribution_(engine_); }
    // Where the values of the edges of the box have no influence.
    point inner() { return point(between(), between(), between()); }

private:
    scalar between() { return 0.2 + 0.6 * (*this)(); }

    std::mt19937 engine_{11};
    std::uniform_real_distribution<scalar> distribution_{0, 1};
};

} // namespace

TEST(VelocityInterval, LinearFieldIsExactOnHexesFromAnyHint)
{
    const auto complex = shapes::box(openBox(8));
    const VelocityInterval velocity = interval(complex, complex, flow);
    Sampler random;
    CellHint follow;
    for (label n = 0; n < 1000; ++n)
    {
        const point x = random.inner();
        const scalar time = 2 + 0.5 * random();
        CellHint poisoned{label(random() * complex->nCells()), 2};
        CellHint unused;
        const VelocitySample one = velocity.sample(x, time, follow, unused);
        const VelocitySample two = velocity.sample(x, time, poisoned, unused);
        ASSERT_EQ(one.where, Where::inside);
        ASSERT_EQ(one.position, x);
        ASSERT_NEAR(one.cellSize, 1.0 / 8, 1e-14);
        ASSERT_LT(mag(one.U - flow(x, time)), 1e-12);
        ASSERT_LT(mag(two.U - flow(x, time)), 1e-12);
    }
}

TEST(VelocityInterval, TimeIsNotExtrapolated)
{
    const auto complex = shapes::box(openBox(8));
    const VelocityInterval velocity = interval(complex, complex, flow);
    const point x(0.4, 0.5, 0.6);
    CellHint hint, unused;
    EXPECT_LT(mag(velocity.sample(x, 1, hint, unused).U - flow(x, 2)), 1e-12);
    EXPECT_LT(mag(velocity.sample(x, 3, hint, unused).U - flow(x, 2.5)), 1e-12);
}

TEST(VelocityInterval, ContinuousAcrossWarpedFaces)
{
    const auto complex = perturbedCube(8);
    // Rough on purpose: every cell has its own velocity.
    const auto rough = [](const point& x, scalar)
    {
        return vector(
            std::sin(997 * x.x() + 31 * x.y()), std::cos(771 * x.y() - 11 * x.z()),
            std::sin(883 * x.z())
        );
    };
    const VelocityInterval velocity = interval(complex, complex, rough);
    CellHint hint, unused;
    label nCrossed = 0;
    for (label facei = 0; facei < complex->nInternalFaces(); ++facei)
    {
        const face& f = complex->faces()[facei];
        const label base = complex->tetBase()[facei];
        const auto corner = [&](label i)
        { return complex->points()[f[(base + i) % f.size()]]; };
        // A point of the second triangle of the face, seen from both cells.
        const point x = 0.2 * corner(0) + 0.5 * corner(2) + 0.3 * corner(3);
        const vector across =
            complex->faceAreas()[facei] / mag(complex->faceAreas()[facei]);
        const auto one = velocity.sample(x - 1e-9 * across, 2.2, hint, unused);
        const label cell = hint.cell;
        const auto two = velocity.sample(x + 1e-9 * across, 2.2, hint, unused);
        nCrossed += hint.cell != cell;
        ASSERT_LT(mag(one.U - two.U), 1e-6);
    }
    EXPECT_EQ(nCrossed, complex->nInternalFaces());
}

TEST(VelocityInterval, BeyondAnOpeningTheBoundaryRules)
{
    const auto complex = shapes::box(openBox(8));
    const VelocityInterval velocity = interval(complex, complex, flow);
    CellHint hint{0, 0}, unused;
    const VelocitySample sample =
        velocity.sample(point(0.43, 1.2, 0.61), 2.25, hint, unused);
    EXPECT_EQ(sample.where, Where::outside);
    EXPECT_LT(mag(sample.position - point(0.43, 1, 0.61)), 1e-12);
    // Not what the field would be further out.
    EXPECT_LT(mag(sample.U - flow(point(0.43, 1, 0.61), 2.25)), 1e-12);
    EXPECT_EQ(complex->patchNames()[complex->patches()[sample.boundaryFace]], "yMax");

    label patch = -1;
    const point inside(0.41, 0.9, 0.6);
    const point outside(0.47, 1.2, 0.63);
    const point exit = velocity.exitPoint(inside, outside, hint, patch);
    EXPECT_LT(mag(exit - (inside + (outside - inside) / 3)), 1e-10);
    ASSERT_GE(patch, 0);
    EXPECT_EQ(complex->patchNames()[patch], "yMax");
}

TEST(VelocityInterval, TwoComplexesHaveTheirOwnHints)
{
    const auto fine = shapes::box(openBox(9));
    const auto coarse = shapes::box(openBox(5));
    const VelocityInterval velocity = interval(fine, coarse, flow);
    EXPECT_FALSE(velocity.sharesComplex());
    Sampler random;
    CellHint hint, earlierHint;
    for (label n = 0; n < 300; ++n)
    {
        const point x = random.inner();
        const scalar time = 2 + 0.5 * random();
        const VelocitySample sample = velocity.sample(x, time, hint, earlierHint);
        ASSERT_EQ(sample.where, Where::inside);
        ASSERT_LT(mag(sample.U - flow(x, time)), 1e-12);
        ASSERT_EQ(hint.cell, coarse->findCell(x));
        ASSERT_EQ(earlierHint.cell, fine->findCell(x));
        ASSERT_NEAR(sample.cellSize, time < 2.25 ? 1.0 / 9 : 1.0 / 5, 1e-13);
    }
    label patch = -1;
    const point exit =
        velocity.exitPoint(point(0.5, 0.5, 0.5), point(0.5, 0.5, -0.5), hint, patch);
    EXPECT_LT(mag(exit - point(0.5, 0.5, 0)), 1e-10);
    EXPECT_EQ(coarse->patchNames()[patch], "zMin");
}

TEST(VelocityInterval, SnapshotsMustFollowEachOther)
{
    const auto complex = shapes::box(openBox(2));
    const auto now = shapes::sampledVelocity(complex, flow, 2);
    const auto before = shapes::sampledVelocity(complex, flow, 1);
    EXPECT_THROW(VelocityInterval(now, now), BadInput);
    EXPECT_THROW(VelocityInterval(now, before), BadInput);
    EXPECT_NO_THROW(VelocityInterval(before, now));
}
