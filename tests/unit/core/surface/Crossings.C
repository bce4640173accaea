// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/surface/Crossings.H"
#include "shapes/Surfaces.H"

#include <gtest/gtest.h>

using namespace Foam;
using namespace Foam::stability;

namespace
{

// A plane of 3 x 2 m2, oblique in its 17 x 13 quadrilaterals, carried along x until it
// has moved `way` [m]; the domain ends at x = 3.
struct Carried
{
    InterfaceMesh start;
    Crossings crossings;
};

Carried carried(scalar way)
{
    const auto place = [](scalar u, scalar v)
    { return point(3 * u, 2 * v + 0.3 * u * (1 - u), 0); };
    Carried result;
    result.start = shapes::asInterface(shapes::grid(place, 17, 13), 0.1);
    const label n = result.start.points.size();
    result.crossings = Crossings(n);
    for (label i = 0; i < n; ++i)
    {
        const point& x = result.start.points[i];
        const scalar beyond = x.x() + way - 3;
        result.crossings.crossed[i] = beyond > 0;
        result.crossings.beyond[i] = vector(max(beyond, scalar(0)), 0, 0);
        result.crossings.ends[i] = x + vector(min(way, 3 - x.x()), 0, 0);
    }
    return result;
}

} // namespace

TEST(Crossings, theAreaThatCrossesAPlaneIsExact)
{
    for (const scalar way : {0.0, 0.07, 0.4999, 1.3, 3.2})
    {
        const Carried c(carried(way));
        scalar left = 0;
        forAll(c.start.triangles, trianglei)
        {
            left += crossedShare(c.start.triangles[trianglei], c.crossings)
                    * mag(c.start.areaVector(trianglei));
        }
        EXPECT_NEAR(left, 2 * min(way, scalar(3)), 1e-12) << way;
    }
}

// Triangles on the boundary keep their area for those inside; what lies flat on it is
// nothing.
TEST(Crossings, areasInsideAddUp)
{
    Carried c(carried(0.4999));
    InterfaceMesh now(c.start);
    now.points = c.crossings.ends;
    const auto areasBy = [&](const InterfaceMesh& mesh, bool withoutCrossed) {
        return pointAreas(
            mesh, cornerShares(mesh.triangles, c.crossings, withoutCrossed)
        );
    };
    const scalarField areas(areasBy(now, false));
    EXPECT_NEAR(sum(areas), 2 * (3 - 0.4999), 5e-3);
    forAll(areas, i)
    {
        EXPECT_EQ(areas[i] > 0, !c.crossings.crossed[i]);
    }
    EXPECT_NEAR(sum(areasBy(c.start, true)), 2 * (3 - 0.4999), 1e-12);
    const scalarField even(c.start.pointAreas());
    c.crossings = Crossings();
    const scalarField all(areasBy(c.start, true));
    forAll(even, i)
    {
        EXPECT_NEAR(all[i], even[i], 1e-15);
    }
}
