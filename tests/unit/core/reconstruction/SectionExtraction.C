// SPDX-License-Identifier: GPL-3.0-or-later

// Interfaces in two dimensions: ribbons across one layer of cells.

#include "core/reconstruction/Reconstruction.H"
#include "core/surface/Ribbon.H"
#include "core/surface/SurfaceTopology.H"
#include "shapes/ExactAlpha.H"
#include "shapes/PolyMeshes.H"
#include "shapes/SectionMesh.H"

#include <gtest/gtest.h>

#include <cmath>

// Rooms of tests are compiled as one unit.
namespace Foam::stability::ribbons
{

namespace
{

constexpr scalar radius = 4.8;
const point offGrid(9.137, 8.732, 0);

shapes::SectionOptions sectionOf(direction normal = 2)
{
    shapes::SectionOptions options;
    options.max = point(18, 17, 0);
    options.nx = 18;
    options.ny = 17;
    options.normal = normal;
    options.middle = 0.37;
    return options;
}

// The disc of this radius around a place of the section; along the way across constant.
shapes::Shape
disc(const shapes::SectionOptions& options, const point& centre, scalar radius)
{
    const point c = shapes::placed(options, centre);
    const vector n =
        shapes::placed(options, point(0, 0, 1)) - shapes::placed(options, Zero);
    return [=](const point& x)
    {
        const vector d = x - c;
        return mag(d - (d & n) * n) - radius;
    };
}

ReconstructionResult ribbonBy(
    const FlowSnapshot& snapshot, const std::string& method,
    Sharpening sharpening = Sharpening::none
)
{
    ReconstructionOptions options;
    options.method = method;
    options.sharpening = sharpening;
    return Reconstruction::New(options)->extract(snapshot);
}

// All points are pairs in the two planes, all edges along the planes are rims of the
// surface, and all triangles face away from the shape. Returns the number of ends.
label expectRibbon(const InterfaceMesh& mesh, const CellComplex& complex)
{
    const PlaneSection& section = *complex.whole().section;
    const labelList pairs(pairsAcross(mesh, section));
    label nEnds = 0;
    forAll(mesh.points, pointi)
    {
        const point& x = mesh.points[pointi];
        EXPECT_NE(pairs[pointi], pointi);
        EXPECT_EQ(x, section.isLow(x) ? section.inLow(x) : section.inHigh(x));
        EXPECT_EQ(mesh.cells[pointi], mesh.cells[pairs[pointi]]);
    }
    const SurfaceTopology topology(mesh.points.size(), mesh.triangles);
    for (const SurfaceEdge& edge : topology.edges())
    {
        const bool along =
            section.isLow(mesh.points[edge.a]) == section.isLow(mesh.points[edge.b]);
        if (along)
        {
            EXPECT_EQ(edge.nTriangles, 1);
        }
        else if (edge.nTriangles == 1)
        {
            ++nEnds;
            EXPECT_GE(mesh.boundaryFaces[edge.a], 0);
            EXPECT_EQ(mesh.boundaryFaces[edge.a], mesh.boundaryFaces[edge.b]);
        }
        else
        {
            EXPECT_EQ(edge.nTriangles, 2);
        }
    }
    return nEnds;
}

struct Errors
{
    scalar rms = 0, largest = 0;
};

// In cells; weighted by length.
Errors errorsOf(const InterfaceMesh& mesh, const shapes::Shape& shape)
{
    Errors e;
    const scalarField areas(mesh.pointAreas());
    forAll(mesh.points, pointi)
    {
        const scalar d = shape(mesh.points[pointi]) / mesh.cellSizes[pointi];
        e.rms += areas[pointi] * sqr(d);
        e.largest = std::max(e.largest, std::abs(d));
    }
    e.rms = std::sqrt(e.rms / sum(areas));
    return e;
}

// The sections that every method must be right on, by name.
std::vector<std::pair<std::string, CellComplexInput>> zoo()
{
    std::vector<std::pair<std::string, CellComplexInput>> meshes;
    const shapes::SectionOptions plain(sectionOf());
    meshes.push_back({"quadrangles", shapes::sectionInput(plain)});
    for (direction normal = 0; normal < 2; ++normal)
    {
        meshes.push_back(
            {"across " + std::to_string(normal),
             shapes::sectionInput(sectionOf(normal))}
        );
    }
    shapes::SectionOptions refined(plain);
    refined.refine = [](const point& x) { return x.x() > 9 && x.y() < 11; };
    meshes.push_back({"refined", shapes::sectionInput(refined)});
    shapes::SectionOptions triangles(plain);
    triangles.triangles = true;
    meshes.push_back({"triangles", shapes::sectionInput(triangles)});
    shapes::SectionOptions sheared(plain);
    sheared.map = [](const point& x)
    {
        const scalar bump = std::sin(M_PI * x.x() / 18) * std::sin(M_PI * x.y() / 17);
        return x + 1.5 * bump * vector(std::sin(0.6 * x.y()), std::cos(0.5 * x.x()), 0);
    };
    meshes.push_back({"bent", shapes::sectionInput(sheared)});
    return meshes;
}

std::shared_ptr<const CellComplex> renumberedComplex(const CellComplexInput& mesh)
{
    CellComplexInput input(shapes::renumbered(mesh, 7));
    input.whole = mesh.whole;
    return shapes::complexOf(input);
}

shapes::Shape discIn(const CellComplex& complex)
{
    shapes::SectionOptions options;
    const PlaneSection& section = *complex.whole().section;
    options.normal = section.normal.x() > 0.5 ? 0 : section.normal.y() > 0.5 ? 1 : 2;
    options.middle = section.middle;
    return disc(options, offGrid, radius);
}

} // namespace

TEST(SectionExtraction, ribbonOnEveryMesh)
{
    for (const auto& [name, mesh] : zoo())
    {
        for (const auto& complex : {shapes::complexOf(mesh), renumberedComplex(mesh)})
        {
            const FlowSnapshot snapshot(shapes::snapshotOf(complex, discIn(*complex)));
            for (const char* method : {"isoAlpha", "bonnell"})
            {
                SCOPED_TRACE(name + " " + method);
                const ReconstructionResult result = ribbonBy(snapshot, method);
                EXPECT_EQ(expectRibbon(result.mesh, *complex), 0);
                EXPECT_LT(errorsOf(result.mesh, discIn(*complex)).largest, 0.5);
                EXPECT_NEAR(result.volumeError(), 0, 0.02);
                const scalar inPlane =
                    result.mesh.area() / complex->whole().section->thickness;
                EXPECT_NEAR(inPlane / (2 * M_PI * radius), 1, 0.12);
            }
        }
    }
}

TEST(SectionExtraction, sharpenedDisc)
{
    for (const auto& [name, mesh] : zoo())
    {
        const auto complex = shapes::complexOf(mesh);
        const FlowSnapshot snapshot(shapes::snapshotOf(complex, discIn(*complex)));
        for (const Sharpening kind : {Sharpening::automatic, Sharpening::profile})
        {
            SCOPED_TRACE(name + " " + sharpeningNames()[int(kind)]);
            const ReconstructionResult result = ribbonBy(snapshot, "isoAlpha", kind);
            EXPECT_EQ(expectRibbon(result.mesh, *complex), 0);
            const Errors e = errorsOf(result.mesh, discIn(*complex));
            EXPECT_LT(e.rms, kind == Sharpening::automatic ? 0.002 : 0.03);
            EXPECT_NEAR(result.volumeError(), 0, 0.01);
        }
    }
}

TEST(SectionExtraction, halfPlanes)
{
    for (const auto& [name, mesh] : zoo())
    {
        const auto complex = shapes::complexOf(mesh);
        const PlaneSection& section = *complex->whole().section;
        const vector n = section.inPlane(vector(0.35, 0.81, 0.47));
        const shapes::Shape plane =
            shapes::halfSpace(complex->bounds().centre() + vector(0.2, 0.1, 0.3), n);
        const FlowSnapshot snapshot(shapes::snapshotOf(complex, plane));
        for (const char* method : {"isoAlpha", "bonnell"})
        {
            SCOPED_TRACE(name + " " + method);
            const ReconstructionResult result = ribbonBy(snapshot, method);
            EXPECT_EQ(expectRibbon(result.mesh, *complex), 2);
            EXPECT_NEAR(result.volumeError(), 0, 0.02);
        }
        const ReconstructionResult sharp =
            ribbonBy(snapshot, "isoAlpha", Sharpening::automatic);
        EXPECT_EQ(expectRibbon(sharp.mesh, *complex), 2);
        const Errors e = errorsOf(sharp.mesh, plane);
        EXPECT_LT(e.rms, name == "triangles" ? 0.02 : 1e-4);
    }
}

TEST(SectionExtraction, smoothedAlongTheCurve)
{
    for (const auto& [name, mesh] : zoo())
    {
        SCOPED_TRACE(name);
        const auto complex = shapes::complexOf(mesh);
        const shapes::Shape disc = discIn(*complex);
        const FlowSnapshot snapshot(shapes::snapshotOf(complex, disc));
        ReconstructionOptions options;
        const ReconstructionResult plain =
            Reconstruction::New(options)->extract(snapshot);
        options.smooth = 3;
        const ReconstructionResult smooth =
            Reconstruction::New(options)->extract(snapshot);
        EXPECT_EQ(expectRibbon(smooth.mesh, *complex), 0);
        EXPECT_LT(
            errorsOf(smooth.mesh, disc).rms, 0.9 * errorsOf(plain.mesh, disc).rms
        );
        EXPECT_NEAR(smooth.volume / plain.volume, 1, 0.005);
    }
}

TEST(SectionExtraction, plicLiesInRectangles)
{
    for (const auto& [name, mesh] : zoo())
    {
        SCOPED_TRACE(name);
        const auto complex = shapes::complexOf(mesh);
        const shapes::Shape disc = discIn(*complex);
        const FlowSnapshot snapshot(shapes::snapshotOf(complex, disc));
        const ReconstructionResult result = ribbonBy(snapshot, "plic");
        EXPECT_EQ(result.nFailed, 0);
        EXPECT_EQ(2 * result.mesh.points.size(), 4 * result.mesh.triangles.size());
        const PlaneSection& section = *complex->whole().section;
        const labelList pairs(pairsAcross(result.mesh, section));
        forAll(pairs, pointi)
        {
            EXPECT_NE(pairs[pointi], pointi);
        }
        EXPECT_LT(errorsOf(result.mesh, disc).rms, 0.04);
        EXPECT_NEAR(
            result.mesh.area() / section.thickness / (2 * M_PI * radius), 1, 0.02
        );
        forAll(result.mesh.triangles, i)
        {
            const point x = result.mesh.centre(i);
            EXPECT_GT(
                disc(x + 0.1 * result.mesh.areaVector(i))
                    - disc(x - 0.1 * result.mesh.areaVector(i)),
                0
            );
        }
    }
}

} // namespace Foam::stability::ribbons
