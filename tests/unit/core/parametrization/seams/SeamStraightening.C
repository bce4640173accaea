// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/parametrization/seams/SeamStraightening.H"

#include "core/surface/SurfaceLocator.H"
#include "shapes/Surfaces.H"

#include <gtest/gtest.h>

using namespace Foam;
using namespace Foam::stability;
using namespace Foam::stability::shapes;

namespace
{

constexpr label nSquares = 12; // squares along each side

// On a bulge, so that straight in the plane is not straight on the surface.
PlainSurface bulge()
{
    return grid(
        [](scalar u, scalar v)
        { return point(u, v, 0.2 * std::sin(2 * u + 0.3) * std::cos(v)); },
        nSquares, nSquares
    );
}

label pointNear(const PlainSurface& surface, scalar u, scalar v)
{
    label nearest = 0;
    forAll(surface.points, i)
    {
        const auto distance = [&](label j)
        { return std::hypot(surface.points[j].x() - u, surface.points[j].y() - v); };
        nearest = distance(i) < distance(nearest) ? i : nearest;
    }
    return nearest;
}

// Stairs along the diagonal that the triangles do not have, ends inside.
labelList stairs(const PlainSurface& surface)
{
    labelList points;
    for (label i = 2; i < nSquares - 2; ++i)
    {
        const scalar down = 1 - i / scalar(nSquares);
        points.append(pointNear(surface, i / scalar(nSquares), down));
        points.append(pointNear(surface, (i + 1) / scalar(nSquares), down));
    }
    return points;
}

List<labelPair> edgesOf(const labelList& line)
{
    List<labelPair> edges;
    for (label i = 1; i < line.size(); ++i)
    {
        edges.append(labelPair(line[i - 1], line[i]));
    }
    return edges;
}

scalar turnOf(const PlainSurface& surface, const labelList& line)
{
    scalar worst = 0;
    for (label i = 1; i + 1 < line.size(); ++i)
    {
        const vector a = surface.points[line[i]] - surface.points[line[i - 1]];
        const vector b = surface.points[line[i + 1]] - surface.points[line[i]];
        worst = max(worst, std::acos((a & b) / (mag(a) * mag(b))));
    }
    return worst;
}

void expectNoneTurnedOrShrunk(const PlainSurface& given, const PlainSurface& surface)
{
    forAll(given.triangles, i)
    {
        const vector before = given.triangles[i].areaNormal(given.points);
        const vector after = surface.triangles[i].areaNormal(surface.points);
        EXPECT_GT(before & after, 0.24 * magSqr(before));
    }
}

} // namespace

TEST(SeamStraightening, stairsBecomeALine)
{
    const PlainSurface given = bulge();
    PlainSurface surface(given);
    const labelList line = stairs(given);
    straightenSeams(surface, edgesOf(line));

    EXPECT_GT(turnOf(given, line), 1.4);
    EXPECT_LT(turnOf(surface, line), 0.35);
    EXPECT_EQ(surface.points[line.first()], given.points[line.first()]);
    EXPECT_EQ(surface.points[line.last()], given.points[line.last()]);

    const SurfaceLocator locator(given.points, given.triangles, 1.0 / nSquares);
    label nMoved = 0;
    forAll(surface.points, i)
    {
        nMoved += surface.points[i] != given.points[i];
        EXPECT_LT(locator.closest(surface.points[i], 1).distance, 1e-12);
    }
    EXPECT_GT(nMoved, line.size() / 2);
    EXPECT_LE(nMoved, line.size() - 2);
    expectNoneTurnedOrShrunk(given, surface);
}

TEST(SeamStraightening, branchingsAndTheBoundaryStay)
{
    const PlainSurface given = bulge();
    PlainSurface surface(given);
    const auto at = [&](label i, label j)
    { return pointNear(given, i / scalar(nSquares), j / scalar(nSquares)); };
    List<labelPair> edges =
        edgesOf({at(6, 4), at(6, 5), at(6, 6), at(7, 6), at(8, 6), at(8, 7)});
    edges.append(labelPair(at(6, 6), at(5, 6)));
    edges.append(edgesOf({at(0, 2), at(0, 3), at(1, 3), at(1, 4)}));
    straightenSeams(surface, edges);
    expectNoneTurnedOrShrunk(given, surface); // corners cut off would leave no area
    for (const label pointi : {at(6, 6), at(0, 2), at(0, 3)})
    {
        EXPECT_EQ(surface.points[pointi], given.points[pointi]);
    }
    EXPECT_NE(surface.points[at(8, 6)], given.points[at(8, 6)]);
    EXPECT_NE(surface.points[at(1, 3)], given.points[at(1, 3)]);
}

TEST(SeamStraightening, nothingToDo)
{
    const PlainSurface given = bulge();
    PlainSurface surface(given);
    straightenSeams(surface, List<labelPair>());
    EXPECT_EQ(surface.points, given.points);
}
