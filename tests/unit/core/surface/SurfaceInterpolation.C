// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/surface/SurfaceInterpolation.H"

#include "shapes/ChartedSurfaces.H"

#include <gtest/gtest.h>

using namespace Foam;
using namespace Foam::stability;
using namespace Foam::stability::shapes;

namespace
{

using Interpolation = SurfaceInterpolation<vector>;

InterfaceMesh sheet(label n)
{
    return flatSheet(vector2D(0, 0), vector2D(1, 1), n, n, 0, 1.0 / n);
}

Interpolation interpolationOf(const InterfaceMesh& mesh, const List<vector>& values)
{
    return Interpolation(
        mesh, values,
        [&](label trianglei, label k) { return mesh.triangles[trianglei][k]; }
    );
}

CornerIndices cornersOf(const InterfaceMesh& mesh, label trianglei)
{
    const triFace& t = mesh.triangles[trianglei];
    return CornerIndices{t[0], t[1], t[2]};
}

// The value on an edge, at this share of the way between its ends, by one triangle.
vector onEdge(
    const InterfaceMesh& mesh, const Interpolation& interpolation, label trianglei,
    const SurfaceEdge& edge, scalar share
)
{
    FixedList<scalar, 3> weights(0.0);
    for (label k = 0; k < 3; ++k)
    {
        const label pointi = mesh.triangles[trianglei][k];
        weights[k] = pointi == edge.a ? 1 - share : pointi == edge.b ? share : 0;
    }
    return interpolation.at(trianglei, cornersOf(mesh, trianglei), weights);
}

// Values that are smooth, and ones that are rough from point to point.
List<vector> valuesOn(const InterfaceMesh& mesh, scalar roughness)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<scalar> noise(-roughness, roughness);
    List<vector> values;
    for (const point& x : mesh.points)
    {
        values.append(vector(
            x.x() + 0.2 * sqr(x.y()) + noise(random), x.y() + noise(random),
            0.3 * std::sin(3 * x.x()) + noise(random)
        ));
    }
    return values;
}

} // namespace

TEST(SurfaceInterpolation, trianglesAgreeOnTheirEdges)
{
    const InterfaceMesh mesh = sheet(9);
    const SurfaceTopology topology(mesh.points.size(), mesh.triangles);
    for (const scalar roughness : {0.0, 0.003, 0.03, 0.3})
    {
        const List<vector> values(valuesOn(mesh, roughness));
        const Interpolation interpolation(interpolationOf(mesh, values));
        label nBent = 0;
        for (const SurfaceEdge& edge : topology.edges())
        {
            if (edge.nTriangles != 2)
            {
                continue;
            }
            const auto by = [&](label side)
            { return onEdge(mesh, interpolation, edge.triangles[side], edge, 0.3); };
            EXPECT_LT(mag(by(0) - by(1)), 1e-14) << roughness;
            const vector line = 0.7 * values[edge.a] + 0.3 * values[edge.b];
            nBent += mag(by(0) - line) > 1e-9;
        }
        EXPECT_GT(nBent, 20);
    }
}

// A little more of a value changes the result a little, whatever the values.
TEST(SurfaceInterpolation, isContinuousInTheValues)
{
    const InterfaceMesh mesh = sheet(5);
    const label middle = 2 * 6 + 2;
    const FixedList<scalar, 3> centre(1.0 / 3);
    constexpr scalar step = 1e-4;
    List<vector> values(valuesOn(mesh, 0.01));
    List<vector> last;
    for (label i = 0; i < 4000; ++i)
    {
        values[middle].x() += step;
        const Interpolation interpolation(interpolationOf(mesh, values));
        List<vector> now;
        forAll(mesh.triangles, trianglei)
        {
            now.append(interpolation.at(trianglei, cornersOf(mesh, trianglei), centre));
        }
        forAll(last, trianglei)
        {
            ASSERT_LT(mag(now[trianglei] - last[trianglei]), 3 * step) << i;
        }
        last = now;
    }
}

// Of a quadratic, linear interpolation errs by the square of the spacing, this by far
// less away from the boundary.
TEST(SurfaceInterpolation, isOfSecondOrder)
{
    scalar errors[2];
    for (label i = 0; i < 2; ++i)
    {
        const label n = 10 * (i + 1);
        const InterfaceMesh mesh = sheet(n);
        const List<vector> values(valuesOn(mesh, 0));
        const Interpolation interpolation(interpolationOf(mesh, values));
        errors[i] = 0;
        const FixedList<scalar, 3> weights{0.5, 0.2, 0.3};
        forAll(mesh.triangles, trianglei)
        {
            const triFace& t = mesh.triangles[trianglei];
            const point x = 0.5 * mesh.points[t[0]] + 0.2 * mesh.points[t[1]]
                            + 0.3 * mesh.points[t[2]];
            if (mag(x.x() - 0.5) < 0.3 && mag(x.y() - 0.5) < 0.3)
            {
                const vector truth(
                    x.x() + 0.2 * sqr(x.y()), x.y(), 0.3 * std::sin(3 * x.x())
                );
                const vector found =
                    interpolation.at(trianglei, cornersOf(mesh, trianglei), weights);
                errors[i] = std::max(errors[i], mag(found - truth));
            }
        }
    }
    EXPECT_LT(errors[1], errors[0] / 6);
}
