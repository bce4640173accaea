// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/reconstruction/MarchingTets.H"
#include "shapes/BoxMesh.H"

#include <gtest/gtest.h>

#include <array>

using namespace Foam;
using namespace Foam::stability;

namespace
{

using Vertex = MarchingTets::Vertex;

// The tetrahedron of the origin and the three axes, right-handed.
std::array<Vertex, 4> cornerTet(const std::array<scalar, 4>& values)
{
    const point x[4] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    std::array<Vertex, 4> tet;
    for (label i = 0; i < 4; ++i)
    {
        tet[i] = {10 + i, values[i], x[i]};
    }
    return tet;
}

// Its surface as seen by the extraction: outwards right-handed.
constexpr label sides[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

struct Outcome
{
    InterfaceMesh mesh;
    scalar volume;
};

Outcome march(const std::array<Vertex, 4>& v)
{
    const auto complex = shapes::unitCube(2);
    MarchingTets tets(*complex);
    labelList cells(1, label(0));
    tets.cut({v[0], v[1], v[2], v[3]}, cells);
    for (const auto& s : sides)
    {
        tets.close({v[s[0]], v[s[1]], v[s[2]]}, complex->nInternalFaces() + 3);
    }
    const scalar volume = *tets.volume();
    return {tets.takeMesh(), volume};
}

vector areaOf(const InterfaceMesh& mesh)
{
    vector sum(Zero);
    forAll(mesh.triangles, trianglei)
    {
        sum += mesh.areaVector(trianglei);
    }
    return sum;
}

// The volume where a linear function of distinct values is at least 1/2 (the sum
// over the inside vertices of the tips they would have alone, any signs).
scalar exactShare(const std::array<scalar, 4>& values)
{
    scalar share = 0;
    for (label i = 0; i < 4; ++i)
    {
        scalar tip = 1;
        for (label j = 0; j < 4; ++j)
        {
            tip *= j == i ? 1 : (values[i] - 0.5) / (values[i] - values[j]);
        }
        share += values[i] >= 0.5 ? tip : 0;
    }
    return share;
}

} // namespace

TEST(MarchingTets, everyCaseHasItsExactVolumeAndFacesOutwards)
{
    const scalar inside[4] = {0.93, 0.81, 0.77, 0.62};
    const scalar outside[4] = {0.11, 0.23, 0.02, 0.38};
    for (label bits = 0; bits < 16; ++bits)
    {
        std::array<scalar, 4> values;
        for (label i = 0; i < 4; ++i)
        {
            values[i] = (bits >> i) % 2 ? inside[i] : outside[i];
        }
        const auto tet = cornerTet(values);
        const Outcome outcome = march(tet);
        EXPECT_NEAR(outcome.volume, exactShare(values) / 6, 1e-15) << bits;

        // The gradient of the function, against which the surface must look.
        const vector gradient(
            values[1] - values[0], values[2] - values[0], values[3] - values[0]
        );
        forAll(outcome.mesh.triangles, trianglei)
        {
            EXPECT_LT(outcome.mesh.areaVector(trianglei) & gradient, 0) << bits;
        }
        const label nIn = (bits & 1) + (bits >> 1 & 1) + (bits >> 2 & 1) + (bits >> 3);
        EXPECT_EQ(outcome.mesh.triangles.size(), nIn % 4 == 0 ? 0 : 2 - nIn % 2);
    }
}

TEST(MarchingTets, exactlyOneHalfIsInsideAndCutsAreClamped)
{
    const Outcome outcome = march(cornerTet({0.5, 0, 0.1, 0.2}));
    ASSERT_EQ(outcome.mesh.triangles.size(), 1);
    for (const point& x : outcome.mesh.points)
    {
        EXPECT_NEAR(mag(x), 1e-3, 1e-15);
    }
    EXPECT_EQ(march(cornerTet({0.5, 0.5, 0.5, 0.5})).mesh.triangles.size(), 0);
}

TEST(MarchingTets, turnedInsideOutTheConnectionsDecideTheOrientation)
{
    auto tet = cornerTet({0.9, 0.2, 0.1, 0.3});
    const vector before = areaOf(march(tet).mesh);
    tet[0].position = point(1, 1, 1); // through the opposite side
    const vector after = areaOf(march(tet).mesh);
    EXPECT_GT(before & vector(1, 1, 1), 0);
    EXPECT_GT(after & vector(1, 1, 1), 0);
}

TEST(MarchingTets, pointsKnowTheLowestBoundaryFaceTheyLieOn)
{
    const auto complex = shapes::unitCube(2);
    const auto v = cornerTet({0.9, 0.2, 0.1, 0.3});
    MarchingTets tets(*complex);
    labelList cells(1, label(0));
    tets.cut({v[0], v[1], v[2], v[3]}, cells);
    tets.close({v[0], v[1], v[3]}, complex->nInternalFaces() + 2);
    tets.close({v[0], v[3], v[2]}, complex->nInternalFaces() + 5);
    const InterfaceMesh mesh = tets.takeMesh();
    ASSERT_EQ(mesh.points.size(), 3);
    forAll(mesh.points, pointi)
    {
        const point& x = mesh.points[pointi];
        // On the z axis both meet, on the others one each.
        const label expected = x.z() > 0 ? 2 : (x.y() > 0 ? 5 : 2);
        EXPECT_EQ(mesh.boundaryFaces[pointi], expected);
    }
}
