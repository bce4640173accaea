// SPDX-License-Identifier: GPL-3.0-or-later

// Forty transfers from one triangulation to the next: what decays in silence when
// seams are not treated (algorithms 0.12), judged by the planted chart.

#include "core/transfer/Transfer.H"

#include "shapes/ChartedSurfaces.H"
#include "shapes/OneRank.H"

#include <gtest/gtest.h>

using namespace Foam;
using namespace Foam::stability;
using namespace Foam::stability::shapes;

namespace
{

constexpr label nTransfers = 40;

TransferResult step(InterfaceMesh& surface, InterfaceMesh next, bool seamTreatment)
{
    MatchingOptions matching;
    TransferOptions options;
    options.seamTreatment = seamTreatment;
    const MatchTarget target(surface, matching);
    List<Match> matches = matchPoints(next, target, matching);
    const TransferResult result = transfer(next, matches, target, options);
    EXPECT_EQ(result.nUnresolved, 0);
    surface = next;
    return result;
}

Revolution triangulation(label stepi)
{
    Revolution r;
    r.nPhi = 57 + stepi % 5;
    r.nZ = 19 + stepi % 3;
    r.phase = 1.234 * stepi;
    r.jitter = 0.2;
    r.seed = stepi + 5;
    return r;
}

struct Cylinder
{
    InterfaceMesh surface;
    scalar seam = 0.3; // its angle
};

// B10: the surface turns by a little between transfers.
Cylinder turnedCylinder(bool seamTreatment)
{
    Cylinder c;
    Revolution first;
    first.nPhi = 60;
    first.nZ = 20;
    first.phase = c.seam;
    c.surface = first(onCylinder);
    first.addChart(c.surface, cylinderChart);
    for (label i = 0; i < nTransfers; ++i)
    {
        const scalar turn = 0.11;
        c.seam += turn;
        for (point& x : c.surface.points)
        {
            x = point(
                std::cos(turn) * x.x() - std::sin(turn) * x.y(),
                std::sin(turn) * x.x() + std::cos(turn) * x.y(), x.z()
            );
        }
        const InterfaceMesh next = triangulation(i)(onCylinder);
        const scalar area = next.area();
        const label nBoundary = nBoundaryEdges(next);
        const TransferResult result = step(c.surface, next, seamTreatment);
        EXPECT_EQ(result.nSplit > 0, seamTreatment);
        EXPECT_NEAR(c.surface.area() / area, 1, 1e-12);
        // The seam divides one edge at each end, no more.
        EXPECT_EQ(nBoundaryEdges(c.surface), nBoundary + (seamTreatment ? 2 : 0));
    }
    return c;
}

// Area of triangles whose middle is mapped to another place than its own.
scalar wrongShare(const Cylinder& c, scalar tolerance)
{
    scalar wrong = 0;
    forAll(c.surface.triangles, trianglei)
    {
        const point x = c.surface.centre(trianglei);
        const bool right =
            c.surface.parametrized(trianglei)
            && mag(cylinderPoint(centroidParameter(c.surface, trianglei), c.seam) - x)
                   < tolerance;
        wrong += right ? 0 : mag(c.surface.areaVector(trianglei));
    }
    return wrong / c.surface.area();
}

} // namespace

TEST(RepeatedTransfer, seamOfATurningCylinderStaysWhereItIs)
{
    const Cylinder c = turnedCylinder(true);
    EXPECT_LT(wrongShare(c, 0.1), 0.005);

    const InterfaceMesh& mesh = c.surface;
    const SurfaceTopology topology(mesh.points.size(), mesh.triangles);
    scalar length = 0;
    for (const SurfaceEdge& edge : topology.edges())
    {
        if (isSeam(mesh, edge))
        {
            length += mag(mesh.points[edge.b] - mesh.points[edge.a]);
            for (const label pointi : {edge.a, edge.b})
            {
                const point& x = mesh.points[pointi];
                const scalar angle = std::atan2(x.y(), x.x()) - c.seam;
                EXPECT_LT(std::abs(std::remainder(angle, 2 * M_PI)), 0.01);
            }
        }
    }
    EXPECT_NEAR(length, 2, 0.02);
}

TEST(RepeatedTransfer, withoutTreatmentTheSeamEatsTheSurface)
{
    EXPECT_GT(wrongShare(turnedCylinder(false), 0.1), 0.05);
}

// A seam along a whole meridian, with an azimuthal chart that leaves a wedge open.
TEST(RepeatedTransfer, meridianOfASphere)
{
    // But for a small cap at each pole, as the grid has it.
    const auto onSphere = [](scalar phi, scalar z)
    {
        const scalar theta = M_PI * (0.02 + 0.96 * z - 0.5);
        return point(
            std::cos(theta) * std::cos(phi), std::cos(theta) * std::sin(phi),
            std::sin(theta)
        );
    };
    const auto chart = [](scalar phi, scalar z)
    {
        const scalar theta = M_PI * (0.02 + 0.96 * z - 0.5);
        const scalar r = 0.09 * (M_PI / 2 + theta),
                     turn = 0.85 * 2 * M_PI * (phi - 0.5);
        return vector2D(0.5 + r * std::cos(turn), 0.5 + r * std::sin(turn));
    };
    Revolution first;
    first.nPhi = 80;
    first.nZ = 40;
    first.phase = 0.2;
    InterfaceMesh surface = first(onSphere);
    first.addChart(surface, chart);
    for (label i = 0; i < nTransfers; ++i)
    {
        Revolution next = triangulation(i);
        next.nPhi += 20;
        next.nZ += 15;
        step(surface, next(onSphere), true);
    }
    scalar wrong = 0;
    forAll(surface.triangles, trianglei)
    {
        const vector2D p = centroidParameter(surface, trianglei);
        const scalar r = std::hypot(p.x() - 0.5, p.y() - 0.5) / 0.09;
        const scalar turn =
            std::atan2(p.y() - 0.5, p.x() - 0.5) / 0.85 / (2 * M_PI) + 0.5;
        const scalar theta = r - M_PI / 2, phi = 0.2 + 2 * M_PI * turn;
        const point x(
            std::cos(theta) * std::cos(phi), std::cos(theta) * std::sin(phi),
            std::sin(theta)
        );
        wrong += mag(x - surface.centre(trianglei)) < 0.1
                     ? 0
                     : mag(surface.areaVector(trianglei));
    }
    EXPECT_LT(wrong / surface.area(), 0.005);
}
