// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/results/ParameterSpace.H"
#include "core/results/ResultSurfaces.H"
#include "core/StabilityTracker.H"
#include "core/parametrization/ChartPacking.H"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

using namespace Foam;
using namespace Foam::stability;

namespace
{

const PointArray& arrayOf(const ResultSurface& surface, const std::string& name)
{
    const auto found = std::find_if(
        surface.arrays.begin(), surface.arrays.end(),
        [&](const PointArray& array) { return array.name == name; }
    );
    EXPECT_NE(found, surface.arrays.end()) << name;
    return *found;
}

// A strip of four triangles between two rows of points; the seam is the edge (2 3),
// on which each point has two parameters; point 5 is attached.
//     1 3 5
//     0 2 4
Classification seamed()
{
    Classification classification;
    ClassifiedSurface& surface = classification.interface;
    InterfaceMesh& mesh = surface.mesh;
    for (label i = 0; i < 6; ++i)
    {
        mesh.points.append(point(i / 2, i % 2, 0.1 * i));
    }
    mesh.triangles = List<triFace>{
        triFace(0, 2, 3), triFace(0, 3, 1), triFace(2, 4, 3), triFace(3, 4, 5)};
    mesh.clearParametrization();
    for (label i = 0; i < 8; ++i)
    {
        mesh.parameters.append(vector2D(0.1 * i, 0.5 - 0.05 * i));
        // 0..3 left of the seam, 4..7: points 2 3 4 5 right of it
    }
    const label corners[4][3] = {{0, 2, 3}, {0, 3, 1}, {4, 6, 5}, {5, 6, -1}};
    for (label i = 0; i < 4; ++i)
    {
        for (label k = 0; k < 3; ++k)
        {
            mesh.corners[i][k] = corners[i][k];
        }
    }
    mesh.setOrigins(mesh.points * 2.0);
    mesh.origins.append(point(-7, 5, 3)); // of point 2, right of the seam
    mesh.originCorners[2][0] = 6;
    mesh.cells = labelList(6, 0);
    mesh.cellSizes = scalarField(6, 0.3);
    mesh.cellSizes[4] = 0.7;
    surface.stability = List<Stability>(6, Stability::stable);
    surface.stability[5] = Stability::attached;
    surface.distance = scalarField(6, 0.01);
    surface.distance[4] = 0.02;
    surface.driftSpeed = scalarField(6, -0.5);
    surface.driftSpeed[2] = 0.25;
    surface.confidence = scalarField(6, 3);
    surface.confidence[1] = 8;
    surface.thin = List<bool>(6, false);
    surface.subGrid = List<bool>(6, false);
    surface.fromOutside = List<bool>(6, false);
    surface.thin[3] = surface.subGrid[0] = true;
    surface.preimages = labelList(6, 1);
    surface.nearWall = List<bool>(6, false);
    surface.components = labelList(6, 0);
    classification.timeSurface = surface;
    classification.timeSurface.stability[5] = Stability::detached;
    classification.timeSurface.nearWall[1] = true;
    return classification;
}

} // namespace

TEST(ResultSurfaces, pointsAreSplitAlongTheSeamAndAtTheSwatch)
{
    const ResultSurface surface(interfaceSurface(seamed().interface, 0.75));
    // 0 1 2 3 | 2 3 4 | 3 4 5 on the swatch
    EXPECT_EQ(surface.points.size(), 10);
    EXPECT_EQ(surface.triangles.size(), 4);
    EXPECT_EQ(surface.time, 0.75);
    const std::vector<double>& vertex = arrayOf(surface, "vertex").values;
    std::map<int, int> copies;
    for (const double v : vertex)
    {
        ++copies[int(v)];
    }
    EXPECT_EQ(
        copies, (std::map<int, int>{{0, 1}, {1, 1}, {2, 2}, {3, 3}, {4, 2}, {5, 1}})
    );
    const InterfaceMesh mesh(seamed().interface.mesh);
    forAll(surface.points, i)
    {
        EXPECT_EQ(surface.points[i], mesh.points[label(vertex[i])]);
    }
}

TEST(ResultSurfaces, everyCornerKeepsItsOwnParameter)
{
    const Classification classification(seamed());
    const ResultSurface surface(interfaceSurface(classification.interface, 0.75));
    const InterfaceMesh& mesh = classification.interface.mesh;
    const std::vector<double>& parameter = arrayOf(surface, "parameter").values;
    const std::vector<double>& texture = arrayOf(surface, "TCoords").values;
    forAll(surface.triangles, trianglei)
    {
        for (label k = 0; k < 3; ++k)
        {
            const label i = surface.triangles[trianglei][k];
            const label corner = mesh.corners[trianglei][k];
            const vector2D p = corner < 0 ? vector2D(-1, -1) : mesh.parameters[corner];
            EXPECT_EQ(parameter[2 * i], p.x());
            EXPECT_EQ(parameter[2 * i + 1], p.y());
            const vector2D shown = trianglei == 3 ? Swatches::attached() : p;
            EXPECT_EQ(texture[2 * i], shown.x());
            EXPECT_EQ(texture[2 * i + 1], shown.y());
        }
    }
}

TEST(ResultSurfaces, arraysHaveTheirClassesAndSizes)
{
    const Classification classification(seamed());
    const ResultSurface surface(interfaceSurface(classification.interface, 0.75));
    for (const PointArray& array : surface.arrays)
    {
        EXPECT_EQ(
            array.values.size(), size_t(array.nComponents) * surface.points.size()
        ) << array.name;
    }
    const std::vector<double>& vertex = arrayOf(surface, "vertex").values;
    forAll(surface.points, i)
    {
        const label v = label(vertex[i]);
        EXPECT_EQ(arrayOf(surface, "stability").values[i], v == 5 ? 1 : 0);
        EXPECT_EQ(arrayOf(surface, "distance").values[i], v == 4 ? 0.02 : 0.01);
        EXPECT_EQ(arrayOf(surface, "driftSpeed").values[i], v == 2 ? 0.25 : -0.5);
        EXPECT_EQ(arrayOf(surface, "confidence").values[i], v == 1 ? 8 : 3);
        EXPECT_EQ(arrayOf(surface, "cellSize").values[i], v == 4 ? 0.7 : 0.3);
        EXPECT_EQ(arrayOf(surface, "thin").values[i], v == 3);
        EXPECT_EQ(arrayOf(surface, "subGrid").values[i], v == 0);
        // Triangle (2 4 3) and its corner (index 4 of p) are right of the seam.
        const bool elsewhere =
            v == 2 && arrayOf(surface, "parameter").values[2 * i] == 0.4;
        const std::vector<double>& origin = arrayOf(surface, "origin").values;
        EXPECT_EQ(origin[3 * i], elsewhere ? -7 : 2 * (v / 2));
        EXPECT_EQ(origin[3 * i + 2], elsewhere ? 3 : 0.2 * v);
    }
    EXPECT_EQ(arrayOf(surface, "preimageCount").nComponents, 1);
    EXPECT_TRUE(arrayOf(surface, "component").integer);
}

TEST(ResultSurfaces, theTimeSurfaceKnowsWallsAndKeepsItsSeams)
{
    const ResultSurface surface(timeSurface(seamed().timeSurface, 0.75));
    // 0 1 2 3 | 2 3 4 | 5 without p: no swatch here
    EXPECT_EQ(surface.points.size(), 8);
    const std::vector<double>& vertex = arrayOf(surface, "vertex").values;
    forAll(surface.points, i)
    {
        EXPECT_EQ(arrayOf(surface, "nearWall").values[i], vertex[i] == 1 ? 1 : 0);
        EXPECT_EQ(
            arrayOf(surface, "driftSpeed").values[i], vertex[i] == 2 ? 0.25 : -0.5
        );
        EXPECT_EQ(arrayOf(surface, "confidence").values[i], vertex[i] == 1 ? 8 : 3);
        EXPECT_EQ(arrayOf(surface, "cellSize").values[i], vertex[i] == 4 ? 0.7 : 0.3);
        EXPECT_EQ(arrayOf(surface, "thin").values[i], vertex[i] == 3);
        EXPECT_EQ(arrayOf(surface, "subGrid").values[i], vertex[i] == 0);
        EXPECT_EQ(arrayOf(surface, "stability").values[i], vertex[i] == 5 ? 2 : 0);
    }
}

TEST(ResultSurfaces, emptySurfacesHaveAllArrays)
{
    const ResultSurface surface(interfaceSurface(ClassifiedSurface(), 0.3));
    EXPECT_EQ(surface.points.size(), 0);
    EXPECT_EQ(surface.arrays.size(), 15u);
    const ResultSurface cloud(particleCloud(List<InstabilityParticle>(), 0.3));
    EXPECT_EQ(cloud.arrays.size(), 11u);
}

// The triangles with p at all corners, each point where its p is.
TEST(ResultSurfaces, parameterSpaceLaysTheInterfaceOut)
{
    const ResultSurface flat(parameterSpace(interfaceSurface(seamed().interface, 0.75))
    );
    EXPECT_EQ(flat.time, 0.75);
    ASSERT_EQ(flat.triangles.size(), 3);
    ASSERT_EQ(flat.points.size(), 7);
    const PointArray& parameter = arrayOf(flat, "parameter");
    const PointArray& vertex = arrayOf(flat, "vertex");
    const PointArray& origin = arrayOf(flat, "origin");
    forAll(flat.points, i)
    {
        EXPECT_EQ(
            flat.points[i],
            point(parameter.values[2 * i], parameter.values[2 * i + 1], 0)
        );
    }
    // Point 2 lies on both sides of the seam, with its own origin on the right.
    const triFace& left = flat.triangles[0];
    const triFace& right = flat.triangles[2];
    EXPECT_EQ(vertex.values[left[1]], 2);
    EXPECT_EQ(vertex.values[right[0]], 2);
    EXPECT_NEAR(flat.points[left[1]].x(), 0.2, 1e-15);
    EXPECT_NEAR(flat.points[right[0]].x(), 0.4, 1e-15);
    EXPECT_EQ(origin.values[3 * right[0]], -7);
    for (const PointArray& array : flat.arrays)
    {
        EXPECT_EQ(array.values.size(), std::size_t(7 * array.nComponents))
            << array.name;
    }
}
