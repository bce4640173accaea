// SPDX-License-Identifier: GPL-3.0-or-later

// What is extracted on several ranks is what one rank extracts, to the last bit.

#include "core/reconstruction/Extraction.H"

#include "core/surface/GivenSurface.H"
#include "shapes/ExactAlpha.H"
#include "shapes/MeshParts.H"
#include "shapes/PolyMeshes.H"
#include "shapes/ThreadRanks.H"

#include <gtest/gtest.h>

#include <map>
#include <mutex>
#include <tuple>

using namespace Foam;
using namespace Foam::stability;

namespace
{

using Complex = std::shared_ptr<const CellComplex>;

// A corner: its position, its cell size, whether it is on the boundary.
using Corner = std::tuple<point, scalar, bool>;

struct Everything
{
    std::map<TriangleKey, std::vector<Corner>> triangles;
    ReconstructionResult result;
    label nMostTriangles = 0; // of a rank

    bool operator==(const Everything& other) const
    {
        return triangles == other.triangles
               && result.volume.value() == other.result.volume.value()
               && result.alphaVolume.value() == other.result.alphaVolume.value();
    }
};

void add(const SurfacePiece& piece, Everything& all)
{
    const InterfaceMesh& mesh = piece.mesh;
    all.nMostTriangles = std::max(all.nMostTriangles, mesh.triangles.size());
    forAll(mesh.triangles, i)
    {
        std::vector<Corner>& corners = all.triangles[piece.keys[i]];
        ASSERT_TRUE(corners.empty()) << "two triangles of one key";
        for (const label pointi : mesh.triangles[i])
        {
            EXPECT_EQ(piece.startPositions[pointi], mesh.points[pointi]);
            corners.emplace_back(
                mesh.points[pointi], mesh.cellSizes[pointi],
                mesh.boundaryFaces[pointi] >= 0
            );
        }
    }
}

constexpr label nRings = 10;

Everything extractedOn(
    label nRanks, const labelList& ranks, const FlowSnapshot& whole,
    const ReconstructionOptions& options
)
{
    const shapes::MeshParts parts(whole.complex, ranks);
    Everything all;
    std::mutex mutex;
    shapes::onRanks(
        nRanks,
        [&](const Exchange& exchange)
        {
            const auto snapshot = parts.part(parts.part(exchange, nRings), whole);
            snapshot->surface = exchange.isMaster() ? whole.surface : nullptr;
            const ExtractedSurface surface(extractSurface(
                *Reconstruction::New(options), options, snapshot, Run{exchange, 1}
            ));
            const std::lock_guard<std::mutex> lock(mutex);
            add(surface.piece, all);
            all.result = surface.result;
        }
    );
    return all;
}

// On slabs, on irregular parts, and where ranks have no cells.
void expectSameOnRanks(const FlowSnapshot& whole, const ReconstructionOptions& options)
{
    const CellComplex& complex = *whole.complex;
    const Everything serial(
        extractedOn(1, labelList(complex.nCells(), label(0)), whole, options)
    );
    ASSERT_GT(serial.triangles.size(), 100u);
    const vector across(1, 0.31, 0.17);
    labelList gaps(shapes::slabs(complex, 2, across));
    for (label& rank : gaps)
    {
        rank = rank == 0 ? 1 : 3; // of four; 0 and 2 are empty
    }
    const std::vector<std::pair<label, labelList>> cuts{
        {3, shapes::irregularParts(complex, 3)}, {4, gaps}};
    for (const auto& [nRanks, ranks] : cuts)
    {
        const Everything found(extractedOn(nRanks, ranks, whole, options));
        EXPECT_TRUE(found == serial) << nRanks;
        EXPECT_LT(found.nMostTriangles, serial.nMostTriangles) << nRanks;
        ASSERT_EQ(bool(found.result.volumeFit), bool(serial.result.volumeFit));
        if (found.result.volumeFit)
        {
            const VolumeFitResult &a = *found.result.volumeFit,
                                  &b = *serial.result.volumeFit;
            EXPECT_EQ(a.volume.value(), b.volume.value());
            EXPECT_EQ(a.largestMove, b.largestMove);
            EXPECT_EQ(a.nClosed, b.nClosed);
            EXPECT_EQ(a.nTooFar, b.nTooFar);
            EXPECT_EQ(a.nFolded, b.nFolded);
            EXPECT_EQ(a.nOpen, b.nOpen);
            EXPECT_EQ(a.nHeld, b.nHeld);
        }
    }
}

// Two balls that touch, a bubble in one of them, a ball farther away, and a layer
// of water.
FlowSnapshot dropsOverWater(const Complex& complex)
{
    const auto ball = [&](const point& centre, scalar radius)
    { return shapes::exactAlpha(*complex, shapes::sphere(centre, radius)); };
    const scalarField alpha(
        shapes::exactAlpha(
            *complex, shapes::halfSpace(point(0, 0, 2.2), vector(0.05, 0.02, 1))
        )
        + ball(point(4.1, 3.7, 8.2), 3.1) - ball(point(4.3, 3.5, 8.1), 1.6)
        + ball(point(4.4, 9.3, 8.3), 2.1) + ball(point(9.6, 8.9, 6.1), 1.9)
    );
    return shapes::snapshotOf(complex, scalarField(min(alpha, scalar(1))));
}

// The surface as a file has it: each triangle for itself, points with names.
std::shared_ptr<const GivenSurface> fileOf(const InterfaceMesh& mesh)
{
    auto surface = std::make_shared<GivenSurface>();
    surface->name = "given.vtp";
    surface->welding = Welding::byName;
    for (const triFace& t : mesh.triangles)
    {
        const label n = surface->points.size();
        surface->triangles.append(triFace(n, n + 1, n + 2));
        for (const label pointi : t)
        {
            surface->points.append(mesh.points[pointi]);
            surface->cellSizes.append(mesh.cellSizes[pointi]);
            surface->vertex.append(pointi);
        }
    }
    return surface;
}

} // namespace

TEST(Extraction, isTheSameOnAnyRanks)
{
    const auto complex = shapes::complexOf(shapes::perturbedBox(shapes::boxOf(12)));
    ReconstructionOptions options;
    for (const char* method : {"isoAlpha", "bonnell", "plic"})
    {
        options.method = method;
        expectSameOnRanks(dropsOverWater(complex), options);
    }
}

TEST(Extraction, fitsVolumesAlikeOnAnyRanks)
{
    ReconstructionOptions options;
    options.volumeFit = VolumeFit::component;
    options.sharpening = Sharpening::automatic;
    for (const Complex& complex :
         {shapes::complexOf(shapes::perturbedBox(shapes::boxOf(12)))})
    {
        const FlowSnapshot snapshot(dropsOverWater(complex));
        const Everything serial(
            extractedOn(1, labelList(complex->nCells(), label(0)), snapshot, options)
        );
        EXPECT_EQ(serial.result.volumeFit->nClosed, 3);
        EXPECT_GT(serial.result.volumeFit->largestMove, 1e-3);
        expectSameOnRanks(snapshot, options);
    }
}

// On a mesh on which cells have different sizes, so that it matters which cell is
// taken.
TEST(Extraction, givesFilesAlikeOnAnyRanks)
{
    const auto complex = shapes::complexOf(shapes::perturbedBox(shapes::boxOf(12)));
    FlowSnapshot snapshot(dropsOverWater(complex));
    ReconstructionOptions options;
    snapshot.surface = fileOf(Reconstruction::New(options)->extract(snapshot).mesh);
    options.method = "fromFiles";
    expectSameOnRanks(snapshot, options);
}

// A closed surface around all that is not the first material.
TEST(Extraction, knowsTheVolumeInAFileOnAnyRanks)
{
    const auto complex = shapes::box(shapes::boxOf(10));
    const scalarField bubble(
        1 - shapes::exactAlpha(*complex, shapes::sphere(point(5.1, 4.8, 5.3), 3.1))
    );
    FlowSnapshot snapshot(shapes::snapshotOf(complex, bubble));
    ReconstructionOptions options;
    snapshot.surface = fileOf(Reconstruction::New(options)->extract(snapshot).mesh);
    options.method = "fromFiles";
    expectSameOnRanks(snapshot, options);
    const Everything serial(
        extractedOn(1, labelList(complex->nCells(), label(0)), snapshot, options)
    );
    EXPECT_NEAR(serial.result.volumeError(), 0, 0.02);
    EXPECT_NE(serial.result.volume.value(), serial.result.alphaVolume.value());
}

// The message of a bad file comes on all ranks.
TEST(Extraction, refusesABadFileOnAllRanks)
{
    const auto complex = shapes::box(shapes::boxOf(10));
    FlowSnapshot snapshot(
        shapes::snapshotOf(complex, shapes::sphere(point(5.1, 4.8, 5.3), 3.1))
    );
    ReconstructionOptions options;
    InterfaceMesh mesh(Reconstruction::New(options)->extract(snapshot).mesh);
    mesh.points[5] = point(5, 5, 20);
    snapshot.surface = fileOf(mesh);
    options.method = "fromFiles";
    try
    {
        extractedOn(3, shapes::irregularParts(*complex, 3), snapshot, options);
        FAIL() << "accepted";
    }
    catch (const std::runtime_error& error)
    {
        const std::string text(error.what());
        EXPECT_NE(text.find("given.vtp has a point outside the domain"), text.npos)
            << text;
    }
}
