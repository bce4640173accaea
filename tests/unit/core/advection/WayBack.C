// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/advection/WayBack.H"

#include "shapes/PathlineRuns.H"
#include "shapes/Surfaces.H"

#include <gtest/gtest.h>

using namespace Foam;
using namespace Foam::stability;

// In a uniform flow everything within U t of the inlet came in, and how far beyond it
// was is known.
TEST(WayBack, findsWhatCameInThroughTheInlet)
{
    const auto complex = shapes::box(shapes::channel(6, BoundaryKind::symmetry));
    const vector U(0.8, 0, 0);
    VelocityHistory history;
    for (label i = 0; i <= 7; ++i)
    {
        const auto velocity =
            shapes::sampledVelocity(complex, shapes::uniformFlow(U), 2 + 0.1 * i);
        i ? history.add(velocity) : history.begin(velocity);
    }
    const scalar way = 0.7 * U.x();
    const auto place = [](scalar u, scalar v) { return point(2 * u, v, 0.37); };
    InterfaceMesh mesh(shapes::asInterface(shapes::grid(place, 13, 4), 0.1));
    forAll(mesh.cells, i)
    {
        mesh.cells[i] = complex->findCell(mesh.points[i]);
    }
    List<bool> wanted(mesh.points.size(), true);
    wanted[0] = false;
    const SerialExchange alone;
    const Crossings crossings(wayBack(mesh, wanted, history, {}, *complex, alone));
    EXPECT_FALSE(crossings.crossed[0]); // for it was not asked for
    forAll(mesh.points, i)
    {
        const point& x = mesh.points[i];
        if (wanted[i])
        {
            const scalar beyond = way - x.x();
            EXPECT_EQ(crossings.crossed[i], beyond > 0) << x.x();
            EXPECT_LT(mag(crossings.beyond[i] + vector(max(beyond, 0.0), 0, 0)), 1e-9);
            EXPECT_LT(
                mag(crossings.ends[i] - x + min(way, x.x()) * vector(1, 0, 0)), 1e-9
            );
        }
    }
}
