// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/reconstruction/volumeFit/SurfaceComponents.H"
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

TEST(SurfaceComponents, whatIsClosedAndWhichWayRound)
{
    const InterfaceMesh surface = surfaceOf(mesh(18), shellAndBall());
    const SurfaceComponents components(surface);
    ASSERT_EQ(components.all.size(), 3u);
    std::size_t nTriangles = 0, nPoints = 0;
    label nClosed = 0;
    for (const SurfaceComponent& component : components.all)
    {
        nTriangles += component.triangles.size();
        nPoints += component.points.size();
        nClosed += component.closed;
        const bool outer = component.volume > 0, inner = component.volume < 0;
        const scalar radius = std::cbrt(3 * mag(component.volume) / (4 * M_PI));
        EXPECT_NEAR(radius, outer ? 5.3 : inner ? 2.6 : 0, outer || inner ? 0.15 : 0);
        EXPECT_EQ(component.closed, outer || inner);
    }
    EXPECT_EQ(nClosed, 2);
    EXPECT_EQ(nTriangles, std::size_t(surface.triangles.size()));
    EXPECT_EQ(nPoints, std::size_t(surface.points.size()));
}

TEST(SurfaceComponents, theVolumesInAllCellsAreThatOfTheComponent)
{
    const auto complex = mesh(18);
    const InterfaceMesh surface = surfaceOf(complex, shellAndBall());
    const SurfaceComponents components(surface);
    for (const SurfaceComponent& component : components.all)
    {
        if (!component.closed)
        {
            continue;
        }
        const ComponentColumns columns(surface, component);
        const scalar sign = component.volume > 0 ? 1 : -1;
        scalar sum = 0;
        label nWhole = 0, nCut = 0;
        for (label celli = 0; celli < complex->nCells(); ++celli)
        {
            const CellSolid cell(*complex, celli);
            const scalar share = sign * columns.volumeIn(cell) / cell.volume();
            EXPECT_GT(share, -1e-12);
            EXPECT_LT(share, 1 + 1e-12);
            nWhole += share > 1 - 1e-9;
            nCut += share > 1e-9 && share < 1 - 1e-9;
            sum += sign * share * cell.volume();
        }
        EXPECT_NEAR(sum / component.volume, 1, 1e-12);
        EXPECT_GT(nWhole, 10);
        EXPECT_GT(nCut, 80);
    }
}

TEST(SurfaceComponents, nothingIsNoComponent)
{
    EXPECT_TRUE(SurfaceComponents(InterfaceMesh()).all.empty());
}
