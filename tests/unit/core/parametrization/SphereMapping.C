// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/parametrization/SphereMapping.H"

#include "core/parametrization/Chart.H"
#include "shapes/ChartOverlap.H"
#include "shapes/Surfaces.H"

#include <gtest/gtest.h>

#include <cmath>

using namespace Foam;
using namespace Foam::stability;
using namespace Foam::stability::shapes;

// Differences of longitude and latitude are those of the directions from the centre,
// also where the surface faces it.
TEST(SphereMapping, GivesLongitudeAndLatitude)
{
    PlainSurface surface = ringedHemisphere(point(0.3, 7, 0), 0.02, 12);
    for (label turn = 0; turn < 2; ++turn)
    {
        const List<vector2D> chart =
            Flattening::New("sphere")->flatten(surface).parameters;
        EXPECT_EQ(countFlips(chart, surface.triangles), 0);
        // The poles lie on the rim; the top of the hemisphere is a quarter turn from
        // both, and midway between the longitudes of the rim's halves.
        EXPECT_NEAR(chart[0].y(), 0, 1e-9);
        scalar low = GREAT, high = -GREAT;
        forAll(chart, i)
        {
            low = min(low, chart[i].x());
            high = max(high, chart[i].x());
        }
        EXPECT_NEAR(high - low, M_PI, 1e-9);
        EXPECT_NEAR(chart[0].x(), 0.5 * (high + low), 1e-9);
        label north = 0;
        forAll(chart, i)
        {
            north = chart[i].y() > chart[north].y() ? i : north;
        }
        const point centre(0.3, 7, 0);
        const vector axis = normalised(surface.points[north] - centre);
        forAll(chart, i)
        {
            const vector d = normalised(surface.points[i] - centre);
            EXPECT_NEAR(std::sin(chart[i].y()), d & axis, 1e-9);
        }
        for (triFace& t : surface.triangles)
        {
            t.flip();
        }
    }
}

// A whole sphere is opened from pole to pole only, and no method else is needed; a
// torus has two points on a ray from its centre.
TEST(SphereMapping, NeedsAStarShape)
{
    const auto methods = flatteningsFor("sphere");
    const Chart ball = makeChart(sphere(point(1, 2, 3), 0.01, 3), methods);
    EXPECT_EQ(ball.method, "sphere") << ball.failure;
    const Chart ring = makeChart(torus(1, 0.4, 48, 24), methods);
    EXPECT_EQ(ring.method, "abf");
    EXPECT_TRUE(ring.fallback);
    EXPECT_EQ(ring.failure.rfind("sphere failed (it", 0), 0u) << ring.failure;
}
