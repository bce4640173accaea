// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/reconstruction/volumeFit/MaterialShares.H"
#include "core/reconstruction/Reconstruction.H"
#include "shapes/ExactAlpha.H"
#include "shapes/PolyMeshes.H"

#include <gtest/gtest.h>

using namespace Foam;
using namespace Foam::stability;

namespace
{

struct Shares
{
    InterfaceMesh mesh;
    std::vector<SurfaceComponent> components;
    std::vector<MaterialShare> shares;

    // [m3], with the sign of the component.
    scalar target(std::size_t i) const { return components[i].volume + shares[i].gain; }
};

Shares sharesOf(
    std::shared_ptr<const CellComplex> complex, const scalarField& alpha,
    label nThreads = 1
)
{
    const FlowSnapshot snapshot = shapes::snapshotOf(complex, alpha);
    Shares result;
    result.mesh = Reconstruction::New(ReconstructionOptions())->extract(snapshot).mesh;
    const SurfaceComponents components(result.mesh);
    result.shares = materialShares(
        result.mesh, components, *complex, VolumeFractions(snapshot), nThreads
    );
    result.components = components.all;
    return result;
}

} // namespace

// The whole of alpha, though the raw surface lacks some percent, and a wisp that hangs
// together with the ball counts.
TEST(MaterialShares, aBallHasAllOfAlpha)
{
    const auto complex = shapes::box(shapes::boxOf(14));
    scalarField alpha =
        shapes::exactAlpha(*complex, shapes::sphere(point(7.1, 6.8, 7.3), 3.7));
    for (const scalar wisp : {0.0, 0.1})
    {
        alpha[complex->findCell(point(11.5, 7.5, 7.5))] = wisp;
        const Shares found = sharesOf(complex, alpha);
        ASSERT_EQ(found.shares.size(), 1u);
        EXPECT_GT(found.shares[0].gain, 0.02 * found.components[0].volume);
        EXPECT_NEAR(found.target(0) / shapes::materialIn(*complex, alpha), 1, 1e-11);
        EXPECT_EQ(found.shares[0].openVolume, 0);
    }
}

// Nested components, with a wall of 3 and one of 1.1 cells between them, where single
// cells are cut by both.
TEST(MaterialShares, aBubbleInADropHasItsOwn)
{
    const auto complex = shapes::box(shapes::boxOf(18));
    const scalarField outer =
        shapes::exactAlpha(*complex, shapes::sphere(point(9.1, 8.8, 9.3), 6.2));
    for (const scalar shift : {0.0, 1.9})
    {
        const scalarField inner = shapes::exactAlpha(
            *complex, shapes::sphere(point(9.1 + shift, 8.8, 9.3), 3.2)
        );
        const Shares found = sharesOf(complex, outer - inner);
        ASSERT_EQ(found.shares.size(), 2u);
        const scalar tolerance = shift > 0 ? 5e-4 : 1e-8;
        for (std::size_t i = 0; i < 2; ++i)
        {
            const bool bubble = found.components[i].volume < 0;
            const scalar truth = shapes::materialIn(*complex, bubble ? inner : outer);
            EXPECT_NEAR(mag(found.target(i)) / truth, 1, tolerance);
        }
        EXPECT_NEAR(
            found.target(0) + found.target(1),
            shapes::materialIn(*complex, outer - inner), 1e-5
        );
    }
}

// Next to a film that ends at the walls alpha is not the ball's alone.
TEST(MaterialShares, whatIsSharedWithAFilmIsTold)
{
    const auto complex = shapes::box(shapes::boxOf(16));
    const scalarField film = shapes::exactAlpha(
        *complex, shapes::halfSpace(point(0, 0, 2.4), vector(0, 0.02, 1))
    );
    for (const scalar height : {6.3, 8.9})
    {
        const scalarField ball =
            shapes::exactAlpha(*complex, shapes::sphere(point(7.1, 6.8, height), 2.9));
        const Shares found = sharesOf(complex, ball + film);
        ASSERT_EQ(found.shares.size(), 2u);
        label nClosed = 0;
        for (std::size_t i = 0; i < 2; ++i)
        {
            if (!found.components[i].closed)
            {
                EXPECT_EQ(found.shares[i].gain, 0);
                continue;
            }
            ++nClosed;
            if (height > 8)
            {
                EXPECT_EQ(found.shares[i].openVolume, 0);
                EXPECT_NEAR(
                    found.target(i) / shapes::materialIn(*complex, ball), 1, 1e-11
                );
            }
            else
            {
                EXPECT_GT(found.shares[i].openVolume, 0.01);
            }
        }
        EXPECT_EQ(nClosed, 1);
    }
}

TEST(MaterialShares, threadsDoNotMatter)
{
    const auto complex = shapes::box(shapes::boxOf(16));
    const scalarField alpha = shapes::exactAlpha(
        *complex, shapes::unionOf(
                      shapes::sphere(point(4.6, 5.1, 7.2), 2.8),
                      shapes::sphere(point(10.5, 8.3, 7.9), 2.8)
                  )
    );
    const Shares one = sharesOf(complex, alpha, 1), four = sharesOf(complex, alpha, 4);
    ASSERT_EQ(one.shares.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i)
    {
        EXPECT_EQ(one.shares[i].gain, four.shares[i].gain);
    }
}
