// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/transfer/Transfer.H"

#include "shapes/ChartedSurfaces.H"
#include "shapes/OneRank.H"

#include <gtest/gtest.h>

using namespace Foam;
using namespace Foam::stability;
using namespace Foam::stability::shapes;

namespace
{

// Linear, not a similarity: interpolation and extrapolation are exact.
vector2D linearChart(label, const point& x)
{
    return vector2D(
        0.35 + 0.13 * x.x() + 0.02 * x.y(), 0.35 - 0.03 * x.x() + 0.11 * x.y()
    );
}

point linearOrigin(const point& x)
{
    return point(3 * x.x() - x.y(), x.y() + 0.5, 2 - x.x());
}

InterfaceMesh target(scalar z, scalar h)
{
    InterfaceMesh mesh = flatSheet(vector2D(-1, -1), vector2D(2, 1.5), 9, 8, z, h);
    addCharts(
        mesh, [](const point&) { return 0; }, linearChart
    );
    forAll(mesh.points, pointi)
    {
        mesh.origins[pointi] = linearOrigin(mesh.points[pointi]);
    }
    return mesh;
}

InterfaceMesh freshMesh(scalar h)
{
    InterfaceMesh mesh =
        flatSheet(vector2D(-0.83, -0.71), vector2D(1.77, 1.31), 11, 7, 0, h);
    mesh.setOrigins(pointField(mesh.points.size(), point(-77, -77, -77)));
    return mesh;
}

struct Transferred
{
    InterfaceMesh mesh;
    List<Match> matches;
    TransferResult result;
};

Transferred carried(
    const InterfaceMesh& from, const InterfaceMesh& to, const TransferOptions& options,
    scalar epsilon = 0.5
)
{
    MatchingOptions matching;
    matching.epsilon.value = epsilon;
    const MatchTarget matchTarget(from, matching);
    Transferred t{to, matchPoints(to, matchTarget, matching), {}};
    t.result = transfer(t.mesh, t.matches, matchTarget, options);
    return t;
}

vector2D parameterOf(const InterfaceMesh& mesh, label trianglei, label k)
{
    return mesh.parameters[mesh.corners[trianglei][k]];
}

} // namespace

TEST(Transfer, interpolatesParameterAndOrigin)
{
    const scalar h = 0.4;
    for (const bool seamTreatment : {true, false})
    {
        TransferOptions options;
        options.seamTreatment = seamTreatment;
        const Transferred t = carried(target(0.1, h), freshMesh(h), options);
        forAll(t.mesh.points, pointi)
        {
            point x = t.mesh.points[pointi];
            EXPECT_LT(mag(t.mesh.origins[pointi] - linearOrigin(x)), 1e-13);
        }
        forAll(t.mesh.triangles, trianglei)
        {
            ASSERT_TRUE(t.mesh.parametrized(trianglei));
            for (label k = 0; k < 3; ++k)
            {
                const point& x = t.mesh.points[t.mesh.triangles[trianglei][k]];
                EXPECT_LT(
                    mag(parameterOf(t.mesh, trianglei, k) - linearChart(0, x)), 1e-14
                );
            }
        }
        EXPECT_EQ(t.mesh.parameters.size(), t.mesh.points.size());
        EXPECT_EQ(t.result.nCrossing, 0);
        EXPECT_EQ(t.result.nSplit, 0);
        EXPECT_EQ(t.mesh.triangles, freshMesh(h).triangles);
    }
}

TEST(Transfer, whatIsAttachedStartsHereWithoutParameter)
{
    const scalar h = 0.4;
    InterfaceMesh m = freshMesh(h);
    for (point& x : m.points)
    {
        x.z() = x.x() > 0.6 ? 0.9 * h : 0; // a step away from T
    }
    const Transferred t = carried(target(0, h), m, TransferOptions());
    label nAttached = 0;
    forAll(m.points, pointi)
    {
        const point& x = t.mesh.points[pointi];
        const bool attached = x.x() > 0.6;
        nAttached += attached;
        EXPECT_EQ(t.matches[pointi].stable, !attached);
        EXPECT_LT(
            mag(t.mesh.origins[pointi] - (attached ? x : linearOrigin(x))), 1e-13
        );
    }
    EXPECT_GT(nAttached, 10);
    EXPECT_EQ(t.mesh.points.size(), m.points.size());
    forAll(t.mesh.triangles, trianglei)
    {
        for (label k = 0; k < 3; ++k)
        {
            const label pointi = t.mesh.triangles[trianglei][k];
            EXPECT_EQ(
                t.mesh.corners[trianglei][k] >= 0, bool(t.matches[pointi].stable)
            );
        }
    }
}

// 6.1: in a triangle with corners without p the largest weight decides, and p is
// extrapolated from the complete triangle beside it.
TEST(Transfer, largestWeightDecidesWhereCornersLackP)
{
    const scalar h = 0.4;
    InterfaceMesh from = target(0, h);
    forAll(from.triangles, trianglei)
    {
        for (label k = 0; k < 3; ++k)
        {
            if (from.points[from.triangles[trianglei][k]].x() > 0.5)
            {
                from.corners[trianglei][k] = InterfaceMesh::noParameter;
            }
        }
    }
    const Transferred t = carried(from, freshMesh(h), TransferOptions());
    label nExtrapolated = 0, nWithout = 0;
    forAll(t.mesh.triangles, trianglei)
    {
        for (label k = 0; k < 3; ++k)
        {
            const label pointi = t.mesh.triangles[trianglei][k];
            const SurfacePoint& at = t.matches[pointi].nearest;
            ASSERT_TRUE(t.matches[pointi].stable);
            label largest = 0;
            for (label i = 1; i < 3; ++i)
            {
                largest = at.weights[i] > at.weights[largest] ? i : largest;
            }
            const bool has = from.parametrized(at.triangle)
                             || from.corners[at.triangle][largest] >= 0;
            ASSERT_EQ(t.mesh.corners[trianglei][k] >= 0, has);
            nWithout += !has;
            if (has)
            {
                nExtrapolated += !from.parametrized(at.triangle);
                const vector2D truth = linearChart(0, t.mesh.points[pointi]);
                EXPECT_LT(mag(parameterOf(t.mesh, trianglei, k) - truth), 1e-13);
            }
        }
    }
    EXPECT_GT(nExtrapolated, 5);
    EXPECT_GT(nWithout, 20);
}

// The corner's own p, where no complete triangle shares it.
TEST(Transfer, aLonelyParameterIsTakenAsItIs)
{
    InterfaceMesh from = triangles(
        pointField(List<point>{point(0, 0, 0), point(1, 0, 0), point(0, 1, 0)}),
        List<triFace>{triFace(0, 1, 2)}, 1
    );
    from.parameters.setSize(1, vector2D(0.3, 0.7));
    from.corners[0] = CornerIndices{-1, 0, -1};
    const InterfaceMesh to = triangles(
        pointField(List<point>{
            point(0.6, 0.1, 0.1), point(0.7, 0.2, 0.1), point(0.1, 0.6, 0.1)}),
        List<triFace>{triFace(0, 1, 2)}, 1
    );
    const Transferred t = carried(from, to, TransferOptions());
    EXPECT_EQ(parameterOf(t.mesh, 0, 0), vector2D(0.3, 0.7));
    EXPECT_EQ(parameterOf(t.mesh, 0, 1), vector2D(0.3, 0.7));
    EXPECT_EQ(t.mesh.corners[0][2], InterfaceMesh::noParameter);
}

TEST(Transfer, mergersAreCountedAndUntrackedOnDemand)
{
    const scalar h = 0.4;
    InterfaceMesh from = target(-0.1 * h, h);
    const InterfaceMesh above =
        flatSheet(vector2D(0.31, -1), vector2D(2, 1.5), 5, 8, 0.3 * h, h);
    const label nPoints = from.points.size();
    from.points.append(above.points);
    from.origins.append(above.points);
    for (triFace t : above.triangles)
    {
        for (label& pointi : t)
        {
            pointi += nPoints;
        }
        from.triangles.append(t);
        from.corners.append(CornerIndices(-1));
    }
    from.setOrigins(pointField(from.origins));

    const InterfaceMesh m = freshMesh(h);
    for (const Merge merge : {Merge::nearest, Merge::untracked})
    {
        TransferOptions options;
        options.merge = merge;
        const Transferred t = carried(from, m, options);
        label merged = 0;
        forAll(t.mesh.triangles, trianglei)
        {
            bool any = false;
            for (label k = 0; k < 3; ++k)
            {
                const label pointi = t.mesh.triangles[trianglei][k];
                const bool two = t.matches[pointi].nPreimages == 2;
                EXPECT_EQ(two, m.points[pointi].x() > 0.31 - 0.4 * h);
                EXPECT_TRUE(t.matches[pointi].stable);
                EXPECT_EQ(
                    t.mesh.corners[trianglei][k] >= 0, !two || merge == Merge::nearest
                );
                any = any || two;
            }
            merged += any;
        }
        EXPECT_EQ(t.result.nMerged, merged);
        EXPECT_GT(merged, 20);
        EXPECT_LT(merged, m.triangles.size() - 20);
    }
}

TEST(Transfer, nothingIsCarriedFromOrToNothing)
{
    InterfaceMesh empty;
    complete(empty, 0.4);
    const Transferred from = carried(empty, freshMesh(0.4), TransferOptions());
    EXPECT_EQ(from.mesh.origins, from.mesh.points);
    EXPECT_EQ(from.mesh.parameters.size(), 0);
    EXPECT_EQ(from.mesh.corners[3], CornerIndices(-1));
    const Transferred to = carried(target(0, 0.4), empty, TransferOptions());
    EXPECT_EQ(to.mesh.points.size(), 0);
    EXPECT_EQ(to.mesh.triangles.size(), 0);
}
