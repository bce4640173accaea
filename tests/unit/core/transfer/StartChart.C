// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/transfer/StartChart.H"

#include "shapes/ChartedSurfaces.H"
#include "shapes/OneRank.H"

#include <gtest/gtest.h>

#include <algorithm>

using namespace Foam;
using namespace Foam::stability;
using namespace Foam::stability::shapes;

namespace
{

constexpr scalar cellSize = 0.2;
constexpr scalar seam = 0.3; // [rad]

// Points of a jittered seam lie beyond it: charts are to hold them.
const vector2D margin(0.05, 0.05);

InterfaceMesh cylinder(label nPhi, scalar jitter)
{
    Revolution revolution;
    revolution.nPhi = nPhi;
    revolution.phase = seam;
    revolution.jitter = jitter;
    revolution.cellSize = cellSize;
    InterfaceMesh mesh = revolution(onCylinder);
    revolution.addChart(mesh, cylinderChart);
    // A jittered point is not at its grid place: p by where it is.
    List<label> places(mesh.parameters.size(), -1);
    forAll(mesh.triangles, trianglei)
    {
        for (label k = 0; k < 3; ++k)
        {
            places[mesh.corners[trianglei][k]] = mesh.triangles[trianglei][k];
        }
    }
    forAll(mesh.parameters, i)
    {
        const point& x = mesh.points[places[i]];
        const scalar roughly = 8 * mesh.parameters[i].x();
        scalar phi = std::atan2(x.y(), x.x()) - seam;
        phi += 2 * M_PI * std::round((roughly - phi) / (2 * M_PI));
        mesh.parameters[i] = vector2D(phi / 8, x.z() / 8) + margin;
    }
    return mesh;
}

// Of p from where the origin is, in metres.
scalar errorOf(const vector2D& p, const point& origin)
{
    return mag(cylinderPoint(p - margin, seam) - origin);
}

} // namespace

TEST(StartChart, readsPAndOriginOffTheStartSurface)
{
    const StartChart chart(startChart(cylinder(40, 0)));
    InterfaceMesh mesh = cylinder(37, 0.05);
    const InterfaceMesh exact(mesh);
    forAll(mesh.points, pointi)
    {
        // Interpolation on chords loses radius.
        mesh.origins[pointi] = cmptMultiply(mesh.points[pointi], vector(0.99, 0.99, 1));
    }
    forAll(mesh.parameters, i)
    {
        mesh.parameters[i] += vector2D(0.07, -0.05) * (cellSize / 8);
    }
    chart.readOff(mesh);

    scalar worst = 0, worstOrigin = 0;
    forAll(mesh.triangles, trianglei)
    {
        for (label k = 0; k < 3; ++k)
        {
            const label pointi = mesh.triangles[trianglei][k];
            const point& x = exact.points[pointi];
            const vector2D& p = mesh.parameters[mesh.corners[trianglei][k]];
            worst = max(worst, errorOf(p, x));
            worstOrigin = max(worstOrigin, mag(mesh.origins[pointi] - x));
            // On the side that it had.
            const vector2D& was = exact.parameters[exact.corners[trianglei][k]];
            EXPECT_LT(mag(p - was), 0.1 * cellSize / 8);
        }
    }
    // The chords of the start surface are 0.0031 off; carried were .017 and .01.
    EXPECT_LT(worst, 0.005);
    EXPECT_LT(worstOrigin, 0.005);
}

TEST(StartChart, leavesWhatIsAnotherPlaceAlone)
{
    const StartChart chart(startChart(cylinder(40, 0)));
    InterfaceMesh mesh = cylinder(37, 0.05);
    mesh.setOrigins(pointField(mesh.points.size(), point(0.2, -0.1, 7))
    ); // attached: where it appeared
    const InterfaceMesh given(mesh);
    chart.readOff(mesh);
    EXPECT_EQ(mesh.parameters, given.parameters);
    EXPECT_EQ(mesh.origins, given.origins);

    mesh.setOrigins(mesh.points);
    for (vector2D& p : mesh.parameters)
    {
        p.y() += 0.7 * cellSize / 8; // merged with something from elsewhere
    }
    const InterfaceMesh elsewhere(mesh);
    chart.readOff(mesh);
    EXPECT_EQ(mesh.parameters, elsewhere.parameters);
    EXPECT_EQ(mesh.origins, elsewhere.origins);
}

TEST(StartChart, knowsTheSideOfASeam)
{
    const StartChart chart(startChart(cylinder(40, 0)));
    const vector2D first(0, 0.1), last(2 * M_PI / 8, 0.1);
    for (const scalar off : {0.001, 0.02, 0.1})
    {
        const point after = onCylinder(seam + off, 0.4);
        const point before = onCylinder(seam - off, 0.4);
        EXPECT_TRUE(chart.isNearer(after, first, last));
        EXPECT_FALSE(chart.isNearer(after, last, first));
        EXPECT_TRUE(chart.isNearer(before, last, first));
        EXPECT_FALSE(chart.isNearer(before, first, last));
    }
    EXPECT_FALSE(chart.isNearer(point(9, 9, 9), first, last));
}

TEST(StartChart, knowsWhereSeamsMeet)
{
    InterfaceMesh sheet = flatSheet(vector2D(-1, -1), vector2D(1, 1), 8, 8, 0.5, 0.25);
    const auto region = [](const point& x) {
        return x.x() < 0 ? 0 : x.y() < 0.25 ? 1 : 2;
    };
    addCharts(
        sheet, region,
        [](label r, const point& x)
        { return vector2D(0.1 * x.x() + 0.3 * r, 0.1 * x.y() + 0.2); }
    );
    const StartChart chart(startChart(sheet));
    const point meeting(0, 0.25, 0.5);
    const SeamNode* node = chart.seamEndNear(meeting + vector(0.05, 0.02, 0), 0.1);
    ASSERT_TRUE(node);
    EXPECT_EQ(node->x, meeting);
    EXPECT_FALSE(chart.seamEndNear(meeting + vector(0.2, 0, 0), 0.1));
    EXPECT_FALSE(StartChart().seamEndNear(meeting, 1));
}

TEST(StartChart, withoutASurfaceNothingChanges)
{
    InterfaceMesh mesh = cylinder(37, 0.05);
    const InterfaceMesh given(mesh);
    const StartChart chart;
    EXPECT_TRUE(chart.empty());
    chart.readOff(mesh);
    EXPECT_EQ(mesh.parameters, given.parameters);
}

TEST(StartChart, staysInTheUnitSquare)
{
    const auto atTheEdge = [](label nPhi, scalar jitter)
    {
        InterfaceMesh mesh = cylinder(nPhi, jitter);
        for (vector2D& p : mesh.parameters)
        {
            p.x() -= margin.x();
        }
        return mesh;
    };
    const StartChart chart(startChart(atTheEdge(40, 0)));
    InterfaceMesh mesh = atTheEdge(37, 0.05);
    mesh.setOrigins(mesh.points);
    EXPECT_LT(
        std::min_element(
            mesh.parameters.begin(), mesh.parameters.end(),
            [](const vector2D& a, const vector2D& b) { return a.x() < b.x(); }
        )->x(),
        0
    );
    chart.readOff(mesh);
    for (const vector2D& p : mesh.parameters)
    {
        EXPECT_GE(p.x(), 0);
    }
}
