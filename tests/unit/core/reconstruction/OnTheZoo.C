// SPDX-License-Identifier: GPL-3.0-or-later

// Every method of reconstruction and every sharpening on every mesh of the zoo: what
// they owe whatever the cells are, and how far they are off. doc/interfaces.md has the
// table.

#include "core/reconstruction/Reconstruction.H"

#include "shapes/PolyMeshes.H"
#include "shapes/SurfaceChecks.H"
#include "shapes/SurfaceErrors.H"
#include "shapes/Zoo.H"

#include <gtest/gtest.h>

#include <map>

namespace Foam::stability
{

namespace
{

using shapes::Way;
using shapes::ways;
using shapes::ZooKind;
using shapes::ZooMesh;

// Exact fractions on a mesh, made once.
struct Scene
{
    FlowSnapshot ball, plane;
};

const Scene& sceneOf(const ZooMesh& mesh)
{
    static std::map<std::string, Scene> scenes;
    const auto known = scenes.find(mesh.name);
    if (known != scenes.end())
    {
        return known->second;
    }
    const auto complex = shapes::complexOf(mesh.make());
    return scenes[mesh.name] = {
               shapes::snapshotOf(complex, mesh.ball()),
               shapes::snapshotOf(complex, mesh.plane())};
}

bool isLayered(const ZooMesh& mesh)
{
    return mesh.kind == ZooKind::stretched || mesh.kind == ZooKind::thinnest;
}

// The largest rms allowed, in cell sizes, or in layers in extents of the cell along the
// normal.
struct Allowed
{
    scalar ball, plane, planeAwayFromWalls;
};

Allowed allowed(const ZooMesh& mesh, const Way& way)
{
    if (mesh.kind == ZooKind::oblique)
    {
        return {0.3, 0.3, 0.4};
    }
    if (way.name == "auto")
    {
        return mesh.kind == ZooKind::hexahedra ? Allowed{0.002, 0.006, 1e-6}
               : isLayered(mesh)               ? Allowed{0.005, 0.01, 1e-6}
                                               : Allowed{0.011, 0.03, 0.002};
    }
    return way.name == "profile"   ? Allowed{0.05, 0.11, 0.1}
           : way.name == "bonnell" ? Allowed{0.26, 0.3, 0.33}
                                   : Allowed{0.2, 0.2, 0.2};
}

// Triangles that face inwards: none after sharpening, but so many at most where the
// fractions do not tell better on such cells.
label allowedFlips(const ZooMesh& mesh)
{
    static const std::map<std::string, label> known{
        {"refinedOblique", 120},
        {"tetrahedra", 5},
        {"polyhedra", 40},
        {"graded", 1},
        {"baffle", 2}};
    const auto found = known.find(mesh.name);
    return found == known.end() ? 0 : found->second;
}

class OnTheZoo : public ::testing::TestWithParam<std::tuple<ZooMesh, Way>>
{
protected:
    const ZooMesh mesh_ = std::get<0>(GetParam());
    const Way way_ = std::get<1>(GetParam());

    InterfaceMesh surfaceOf(const FlowSnapshot& snapshot) const
    {
        ReconstructionOptions options;
        options.method = way_.method;
        options.sharpening = way_.sharpening;
        options.nThreads = 2;
        return Reconstruction::New(options)->extract(snapshot).mesh;
    }

    void expectSound(const InterfaceMesh& surface) const
    {
        const shapes::SurfaceReport report = shapes::inspect(surface);
        EXPECT_EQ(report.nUnused, 0);
        if (reconstructionMethod(way_.method).sharesPoints)
        {
            EXPECT_EQ(report.nCrowded, 0);
            EXPECT_EQ(report.nRimInside, 0);
            EXPECT_EQ(report.nMisoriented, 0);
        }
    }

    shapes::SurfaceErrors errorsOf(
        const InterfaceMesh& surface, const FlowSnapshot& snapshot,
        const shapes::Shape& shape, const std::string& what
    ) const
    {
        const shapes::SurfaceErrors e = shapes::errorsOf(
            surface, shape, *snapshot.complex,
            isLayered(mesh_) ? shapes::CellLength::extent : shapes::CellLength::size
        );
        EXPECT_GT(surface.triangles.size(), 20) << what;
        if (way_.sharpening != Sharpening::none)
        {
            EXPECT_LE(e.nFlipped, allowedFlips(mesh_)) << what;
        }
        // For the table of doc/interfaces.md: --gtest_output=xml.
        RecordProperty(what + "Rms", std::to_string(e.rms));
        RecordProperty(what + "Largest", std::to_string(e.largest));
        RecordProperty(what + "RmsInside", std::to_string(e.rmsInside));
        RecordProperty(what + "Flipped", e.nFlipped);
        return e;
    }
};

std::string zooCaseName(const ::testing::TestParamInfo<std::tuple<ZooMesh, Way>>& info)
{
    return std::get<0>(info.param).name + "_" + std::get<1>(info.param).name;
}

} // namespace

TEST_P(OnTheZoo, aBallAndAPlaneAreFound)
{
    const Scene& scene = sceneOf(mesh_);
    const Allowed bounds(allowed(mesh_, way_));
    const InterfaceMesh ball(surfaceOf(scene.ball));
    expectSound(ball);
    const InterfaceMesh plane(surfaceOf(scene.plane));
    expectSound(plane);
    if (mesh_.kind != ZooKind::tiny)
    {
        EXPECT_LT(errorsOf(ball, scene.ball, mesh_.ball(), "ball").rms, bounds.ball);
        const shapes::SurfaceErrors e =
            errorsOf(plane, scene.plane, mesh_.plane(), "plane");
        EXPECT_LT(e.rms, bounds.plane);
        EXPECT_LE(e.rmsInside, bounds.planeAwayFromWalls);
        if (way_.name == "auto"
            && (isLayered(mesh_) || mesh_.kind == ZooKind::hexahedra))
        {
            const auto unit = shapes::CellLength::size;
            EXPECT_LT(
                shapes::errorsOf(ball, mesh_.ball(), *scene.ball.complex, unit).rms,
                0.002
            );
        }
    }
}

INSTANTIATE_TEST_SUITE_P(
    Zoo, OnTheZoo,
    ::testing::Combine(::testing::ValuesIn(shapes::zoo()), ::testing::ValuesIn(ways)),
    zooCaseName
);

} // namespace Foam::stability
