// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/surface/TaubinSmoothing.H"
#include "mathematicalConstants.H"

#include <gtest/gtest.h>

#include <cmath>

using namespace Foam;
using namespace Foam::stability;

namespace
{

using constant::mathematical::pi;

// A sheet of n x n squares, z(i, j), its rim on four walls: -x +x -y +y.
InterfaceMesh sheet(label n, const std::function<scalar(label, label)>& height)
{
    InterfaceMesh mesh;
    for (label j = 0; j <= n; ++j)
    {
        for (label i = 0; i <= n; ++i)
        {
            mesh.points.append(point(i, j, height(i, j)));
            const label wall = i == 0 ? 0 : i == n ? 1 : j == 0 ? 2 : j == n ? 3 : -1;
            mesh.boundaryFaces.append(wall);
        }
    }
    for (label j = 0; j < n; ++j)
    {
        for (label i = 0; i < n; ++i)
        {
            const label a = i + (n + 1) * j;
            mesh.triangles.append(triFace(a, a + 1, a + n + 2));
            mesh.triangles.append(triFace(a, a + n + 2, a + n + 1));
        }
    }
    mesh.cells.setSize(mesh.points.size(), 0);
    mesh.cellSizes.setSize(mesh.points.size(), 1);
    mesh.clearParametrization();
    return mesh;
}

vectorField wallNormals()
{
    vectorField normals(4);
    normals[0] = vector(-3, 0, 0);
    normals[1] = vector(2, 0, 0);
    normals[2] = vector(0, -1, 0);
    normals[3] = vector(0, 5, 0);
    return normals;
}

TaubinOptions pairs(label n)
{
    TaubinOptions options;
    options.pairs = n;
    return options;
}

} // namespace

// The transfer function of one pair is (1 - lambda k)(1 - mu k) with k the eigenvalue
// of the umbrella: 1 - (2 cos wx + 2 cos wy + 2 cos(wx + wy))/6 on this lattice.
TEST(TaubinSmoothing, wavesDecayByTheTransferFunction)
{
    const label n = 32;
    const scalar wx = 2 * pi / 8;
    const scalar wy = 2 * pi / 4;
    const auto wave = [&](label i, label j)
    { return 0.05 * std::cos(wx * i + wy * j + 0.4); };
    const InterfaceMesh mesh = sheet(n, wave);
    const vectorField moves = taubinDisplacements(mesh, wallNormals(), pairs(2));
    const scalar k =
        1 - (2 * std::cos(wx) + 2 * std::cos(wy) + 2 * std::cos(wx + wy)) / 6;
    const scalar gain = std::pow((1 - 0.5 * k) * (1 + 0.53 * k), 2);
    EXPECT_LT(gain, 0.95);
    for (label j = 10; j < 22; ++j)
    {
        for (label i = 10; i < 22; ++i)
        {
            const vector move = moves[i + (n + 1) * j];
            EXPECT_NEAR(move.z(), (gain - 1) * wave(i, j), 1e-14);
            EXPECT_NEAR(mag(move - vector(0, 0, move.z())), 0, 1e-13);
        }
    }
}

TEST(TaubinSmoothing, rimsStayOnTheirWallsAndCornersStay)
{
    const label n = 12;
    const auto rough = [](label i, label j)
    { return 0.2 * std::sin(2.3 * i + 0.4) * std::cos(1.7 * j); };
    const InterfaceMesh mesh = sheet(n, rough);
    const vectorField moves = taubinDisplacements(mesh, wallNormals(), pairs(5));
    scalar rimMoves = 0;
    for (label k = 0; k <= n; ++k)
    {
        EXPECT_EQ(moves[(n + 1) * k].x(), 0);
        EXPECT_EQ(moves[(n + 1) * k + n].x(), 0);
        EXPECT_EQ(moves[k].y(), 0);
        EXPECT_EQ(moves[k + (n + 1) * n].y(), 0);
        rimMoves += mag(moves[k].z());
    }
    EXPECT_GT(rimMoves, 0.1);
    for (const label corner : {label(0), n, (n + 1) * n, (n + 1) * n + n})
    {
        EXPECT_EQ(mag(moves[corner]), 0);
    }
}

TEST(TaubinSmoothing, noPointMovesFartherThanTheCap)
{
    const auto spikes = [](label i, label j)
    { return (i * 7 + j * 3) % 5 == 0 ? 3 : 0; };
    const InterfaceMesh mesh = sheet(12, spikes);
    const vectorField moves = taubinDisplacements(mesh, wallNormals(), pairs(4));
    EXPECT_NEAR(max(mag(moves)), 0.3, 1e-12);
}

TEST(TaubinSmoothing, noPairsNoMoves)
{
    const auto rough = [](label i, label j) { return 0.1 * ((i * j) % 3); };
    const InterfaceMesh mesh = sheet(6, rough);
    EXPECT_EQ(max(mag(taubinDisplacements(mesh, wallNormals(), pairs(0)))), 0);
}

// A sheet that rises by a function of its place sweeps a volume that is a difference
// of volumes below.
TEST(TaubinSmoothing, sweptVolumeIsExact)
{
    const label n = 6;
    const auto before = [](label i, label j) { return 0.1 * i * i - 0.2 * j; };
    const auto after = [](label i, label j) { return 1 + 0.3 * i + 0.05 * i * j; };
    const InterfaceMesh low = sheet(n, before);
    const InterfaceMesh high = sheet(n, after);
    const auto below = [](const InterfaceMesh& mesh)
    {
        scalar volume = 0;
        forAll(mesh.triangles, trianglei)
        {
            volume += mesh.areaVector(trianglei).z() * mesh.centre(trianglei).z();
        }
        return volume;
    };
    const scalar swept = sum(sweptVolumes(low, vectorField(high.points - low.points)));
    EXPECT_NEAR(swept, below(high) - below(low), 1e-11);
    EXPECT_GT(swept, 10);
}
