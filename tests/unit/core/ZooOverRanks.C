// SPDX-License-Identifier: GPL-3.0-or-later

// The whole method on the meshes of the zoo: on any number of ranks what one rank
// gives.

#include "core/StabilityTracker.H"

#include "core/comparison/StabilityTables.H"
#include "core/surface/pieces/SurfaceColumns.H"
#include "shapes/MeshParts.H"
#include "shapes/PolyMeshes.H"
#include "shapes/ThreadRanks.H"
#include "shapes/Zoo.H"

#include <gtest/gtest.h>

#include <map>
#include <mutex>

namespace Foam::stability
{

namespace
{

using shapes::MeshParts;
using shapes::Way;
using shapes::ways;
using shapes::ZooKind;
using shapes::ZooMesh;

struct Cut
{
    std::string name;
    label nRanks;
    labelList (*ranksOf)(const CellComplex&, label nRanks);

    friend std::ostream& operator<<(std::ostream& stream, const Cut& cut)
    {
        return stream << cut.name;
    }
};

labelList inSlabs(const CellComplex& complex, label nRanks)
{
    return shapes::slabs(complex, nRanks, vector(1, 0.1, 0.01));
}

// Through the layers of the zoo's walls, too.
labelList inLayers(const CellComplex& complex, label nRanks)
{
    return shapes::slabs(complex, nRanks, vector(0.01, 0.02, 1));
}

const Cut cuts[] = {
    {"twoSlabs", 2, inSlabs},
    {"threeLayers", 3, inLayers},
    {"threeIrregular", 3, shapes::irregularParts},
    {"sevenIrregular", 7, shapes::irregularParts}};

TrackerOptions optionsOf(const Way& way)
{
    TrackerOptions options;
    options.reconstruction.method = way.method;
    options.reconstruction.sharpening = way.sharpening;
    options.matching.epsilon.value = 0.4;
    return options;
}

// The ball drifts with the flow for a time of 1 s, but on one side it grows by more
// than the band: there it detaches and attaches.
std::vector<FlowSnapshot> storyOf(const ZooMesh& mesh)
{
    const auto complex = shapes::complexOf(mesh.make());
    const scalar h = mesh.radius / 4.8;
    const vector U = h * vector(0.5, -0.3, mag(mesh.axis) > 0 ? 0 : 0.2);
    std::vector<FlowSnapshot> story;
    for (const label step : {0, 1})
    {
        ZooMesh moved = mesh;
        moved.middle += step * U;
        const shapes::Shape ball = moved.ball();
        const point middle = moved.middle;
        const scalar growth = step == 0 ? 0 : 0.8 / 4.8;
        const shapes::Shape grown = [=](const point& x)
        { return ball(x) - growth * std::max(scalar(0), x.y() - middle.y()); };
        story.push_back(shapes::snapshotOf(complex, grown));
        story.back().U = U;
        story.back().boundaryU = U;
        story.back().time = step;
    }
    return story;
}

struct Outcome
{
    ClassifiedSurface interface, timeSurface;
    Statistics statistics;
    List<InstabilityParticle> particles;
};

// The results of each of the times, on the given ranks.
std::vector<Outcome> outcomesOf(
    const std::vector<FlowSnapshot>& story, const Way& way, const labelList& ranks
)
{
    const MeshParts parts(story[0].complex, ranks);
    std::vector<Outcome> outcomes;
    shapes::onRanks(
        max(ranks) + 1,
        [&](const Exchange& exchange)
        {
            const auto complex =
                parts.part(exchange, reachOf(optionsOf(way).reconstruction));
            StabilityTracker tracker(optionsOf(way), exchange);
            for (const FlowSnapshot& whole : story)
            {
                const auto snapshot = parts.part(complex, whole);
                tracker.started() ? tracker.advance(snapshot) : tracker.start(snapshot);
                const Classification& result = tracker.classify();
                Outcome here;
                here.interface = gathered(result.interface, exchange);
                here.timeSurface = gathered(result.timeSurface, exchange);
                here.statistics = result.statistics;
                here.particles = tracker.particles().gathered(exchange);
                if (exchange.rank() == 0)
                {
                    outcomes.push_back(std::move(here));
                }
            }
        }
    );
    return outcomes;
}

// Made once for each mesh and way.
struct Truth
{
    std::vector<FlowSnapshot> story;
    std::map<std::string, std::vector<Outcome>> serial; // by way
};

Truth& truthOf(const ZooMesh& mesh)
{
    static std::map<std::string, Truth> truths;
    Truth& truth = truths[mesh.name];
    if (truth.story.empty())
    {
        truth.story = storyOf(mesh);
    }
    return truth;
}

void expectSame(const ClassifiedSurface& a, const ClassifiedSurface& b)
{
    ASSERT_EQ(a.mesh.points.size(), b.mesh.points.size());
    ASSERT_EQ(a.mesh.triangles.size(), b.mesh.triangles.size());
    EXPECT_TRUE(a.mesh.triangles == b.mesh.triangles);
    EXPECT_TRUE(a.mesh.points == b.mesh.points);
    EXPECT_TRUE(a.mesh.corners == b.mesh.corners);
    EXPECT_TRUE(a.mesh.parameters == b.mesh.parameters);
    EXPECT_TRUE(a.mesh.origins == b.mesh.origins);
    EXPECT_TRUE(a.stability == b.stability);
    EXPECT_TRUE(a.distance == b.distance);
    EXPECT_TRUE(a.components == b.components);
    EXPECT_TRUE(a.thin == b.thin && a.subGrid == b.subGrid);
    EXPECT_TRUE(a.preimages == b.preimages);
}

void expectSame(const Outcome& a, const Outcome& b)
{
    for (const auto* table : {&stabilityTable(), &survivalTable()})
    {
        for (const auto& column : table->columns)
        {
            // The volume is the sum of what the ranks sum; all else has exact sums.
            const scalar roundOff = column.name == "volumeError" ? 1e-12 : 0;
            EXPECT_NEAR(
                column.value(a.statistics), column.value(b.statistics), roundOff
            ) << column.name;
        }
    }
    expectSame(a.interface, b.interface);
    expectSame(a.timeSurface, b.timeSurface);
    ASSERT_EQ(a.particles.size(), b.particles.size());
    forAll(a.particles, i)
    {
        EXPECT_EQ(a.particles[i].path.x, b.particles[i].path.x);
        EXPECT_EQ(a.particles[i].parameter, b.particles[i].parameter);
    }
}

using ZooCase = std::tuple<ZooMesh, Way, Cut>;

class ZooOverRanks : public ::testing::TestWithParam<ZooCase>
{
};

std::string caseName(const ::testing::TestParamInfo<ZooCase>& info)
{
    return std::get<0>(info.param).name + "_" + std::get<1>(info.param).name + "_"
           + std::get<2>(info.param).name;
}

} // namespace

TEST_P(ZooOverRanks, isWhatOneRankGives)
{
    const auto& [mesh, way, cut] = GetParam();
    Truth& truth = truthOf(mesh);
    const CellComplex& complex = *truth.story[0].complex;
    std::vector<Outcome>& serial = truth.serial[way.name];
    if (serial.empty())
    {
        serial = outcomesOf(truth.story, way, labelList(complex.nCells(), label(0)));
    }
    const auto parallel =
        outcomesOf(truth.story, way, cut.ranksOf(complex, cut.nRanks));
    ASSERT_EQ(serial.size(), parallel.size());
    for (std::size_t i = 0; i < serial.size(); ++i)
    {
        SCOPED_TRACE("time " + std::to_string(i));
        expectSame(serial[i], parallel[i]);
    }
    if (mesh.kind != ZooKind::tiny)
    {
        EXPECT_GT(serial[1].statistics.attachedArea, 0);
        EXPECT_GT(serial[1].statistics.stableArea, 0);
        EXPECT_GT(serial[1].particles.size(), 10);
    }
}

// A few; the others with --gtest_also_run_disabled_tests, as tests/cases/zoo does.
INSTANTIATE_TEST_SUITE_P(
    Zoo, ZooOverRanks,
    ::testing::Combine(
        ::testing::Values(
            shapes::zooMesh("tetrahedra"), shapes::zooMesh("layers10"),
            shapes::zooMesh("loneCell"), shapes::zooMesh("oneCell"),
            shapes::zooMesh("oneLayer")
        ),
        ::testing::Values(ways[1]), ::testing::Values(cuts[2])
    ),
    caseName
);
INSTANTIATE_TEST_SUITE_P(
    DISABLED_WholeZoo, ZooOverRanks,
    ::testing::Combine(
        ::testing::ValuesIn(shapes::zoo()), ::testing::ValuesIn(ways),
        ::testing::ValuesIn(cuts)
    ),
    caseName
);

} // namespace Foam::stability
