// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/base/Errors.H"
#include "core/parametrization/Parametrization.H"
#include "shapes/Surfaces.H"
#include "shapes/ThreadRanks.H"
#include "shapes/OneRank.H"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <tuple>
#include <vector>

using namespace Foam;
using namespace Foam::stability;
using namespace Foam::stability::shapes;

namespace
{

const scalar cellSize = 0.3; // [m]

// In the order of their keys. Some are equal, so that only the order tells them apart;
// one has no area and cannot be flattened, one is too small to be remeshed.
std::vector<PlainSurface> components()
{
    PlainSurface flat = openCylinder(1, 1, 90, 4, 2);
    for (point& p : flat.points)
    {
        p = point(1, 2, 3);
    }
    return {sphere(point(5, 0, 1), 0.7, 2),      torus(1.3, 0.4, 24, 12),
            sphere(point(-5, 2, 0), 0.11, 0),    flat,
            openCylinder(0.5, 3, 270, 14, 10),   sphere(point(0, 7, 1), 0.7, 2),
            hemisphere(point(0, -6, 0), 1.1, 3), openCylinder(0.5, 3, 270, 14, 10)};
}

// What one rank has of them: those that are dealt to it.
struct Part
{
    std::vector<PlainSurface> surfaces;
    DynamicList<TriangleKey> keys;

    Part(const labelList& ranks, label rank)
    {
        const std::vector<PlainSurface> all = components();
        forAll(ranks, i)
        {
            if (ranks[i] == rank)
            {
                surfaces.push_back(all[i]);
                forAll(all[i].triangles, trianglei)
                {
                    keys.append(TriangleKey{point(0.25 * i - 1, -i, 3), trianglei});
                }
            }
        }
    }

    SurfacePiece piece() const
    {
        SurfacePiece piece;
        if (!surfaces.empty())
        {
            piece.mesh = asInterface(inOneScene(surfaces), cellSize);
        }
        piece.keys = keys;
        return piece;
    }
};

std::vector<ParametrizationResult> parametrizeOn(label nRanks, const labelList& ranks)
{
    std::vector<ParametrizationResult> results(nRanks);
    onRanks(
        nRanks,
        [&](const Exchange& exchange)
        {
            const Part part(ranks, exchange.rank());
            results[exchange.rank()] =
                parametrize(part.piece(), ParametrizationOptions(), exchange);
        }
    );
    return results;
}

// All that there is of a triangle, by its component and its place there.
using Corner = std::tuple<point, vector2D, label>; // with the boundary face
using Triangles = std::map<std::pair<scalar, label>, std::array<Corner, 3>>;

Triangles trianglesOf(const std::vector<ParametrizationResult>& results)
{
    Triangles triangles;
    for (const ParametrizationResult& result : results)
    {
        const InterfaceMesh& surface = result.surface.mesh;
        EXPECT_EQ(result.surface.keys.size(), surface.triangles.size());
        forAll(surface.triangles, i)
        {
            const TriangleKey& key = result.surface.keys[i];
            EXPECT_TRUE(i == 0 || result.surface.keys[i - 1] < key);
            std::array<Corner, 3> corners;
            for (label k = 0; k < 3; ++k)
            {
                const label pointi = surface.triangles[i][k];
                const label parameter = surface.corners[i][k];
                corners[k] = Corner(
                    surface.points[pointi],
                    parameter < 0 ? vector2D(-1, -1) : surface.parameters[parameter],
                    surface.boundaryFaces[pointi]
                );
            }
            EXPECT_TRUE(triangles
                            .emplace(std::make_pair(key.where.x(), key.place), corners)
                            .second);
        }
    }
    return triangles;
}

// All that charts.dat tells of them.
std::vector<std::string> rowsOf(const std::vector<ChartReport>& charts)
{
    std::vector<std::string> rows;
    for (const ChartReport& chart : charts)
    {
        std::string row;
        for (const TableColumn<ChartRow>& column : chartTable().columns)
        {
            row += column.text ? column.text({chart, 0})
                               : std::to_string(column.value({chart, 0}));
            row += ' ';
        }
        rows.push_back(row);
    }
    return rows;
}

} // namespace

// The truth is what one rank makes of everything, without any exchange.
TEST(ParametrizationOverRanks, IsTheSameWhateverIsWhere)
{
    const ParametrizationResult whole = parametrize(
        asInterface(inOneScene(components()), cellSize), ParametrizationOptions()
    );
    ASSERT_EQ(whole.nCharts, 7);
    ASSERT_EQ(whole.nFallbacks, 1);
    EXPECT_EQ(whole.nPatches, 8);
    ASSERT_EQ(whole.charts.size(), components().size());
    const ChartReport& flat = whole.charts[3];
    EXPECT_EQ(flat.patch, 4);
    EXPECT_EQ(flat.nTriangles, 16);
    EXPECT_LT(mag(flat.centre - point(1, 2, 3)), 1e-12);
    EXPECT_NE(
        flat.fallback.find("abf failed (it has no area), it gets no"), std::string::npos
    ) << flat.fallback;
    ASSERT_GT(whole.nKept, 0);
    ASSERT_GT(whole.remeshingDistance, 0);
    const Triangles wanted = trianglesOf({whole});
    ASSERT_EQ(wanted.rbegin()->first.first, 7);

    const std::vector<std::pair<label, labelList>> deals{
        {1, {0, 0, 0, 0, 0, 0, 0, 0}}, {2, {0, 1, 0, 1, 0, 1, 0, 1}},
        {2, {1, 1, 1, 1, 0, 0, 0, 0}}, {2, {1, 1, 1, 1, 1, 1, 1, 1}},
        {3, {2, 0, 1, 1, 2, 0, 1, 0}}, {3, {0, 2, 2, 0, 2, 0, 2, 0}}};
    for (const auto& [nRanks, ranks] : deals)
    {
        const std::vector<ParametrizationResult> results = parametrizeOn(nRanks, ranks);
        for (const ParametrizationResult& result : results)
        {
            EXPECT_EQ(result.scale, whole.scale);
            EXPECT_EQ(result.nCharts, whole.nCharts);
            EXPECT_EQ(result.nFallbacks, whole.nFallbacks);
            EXPECT_EQ(result.nKept, whole.nKept);
            EXPECT_EQ(result.nPatches, whole.nPatches);
            EXPECT_EQ(result.remeshingDistance, whole.remeshingDistance);
        }
        EXPECT_TRUE(trianglesOf(results) == wanted);
        ASSERT_EQ(results[0].charts.size(), whole.charts.size());
        EXPECT_EQ(rowsOf(results[0].charts), rowsOf(whole.charts));
    }
}

TEST(ParametrizationOverRanks, OfNothingIsNothing)
{
    for (const ParametrizationResult& result : parametrizeOn(3, labelList()))
    {
        EXPECT_TRUE(result.surface.mesh.empty());
        EXPECT_EQ(result.nCharts, 0);
        EXPECT_EQ(result.scale, 1);
    }
}

// On every rank, with or without components.
TEST(ParametrizationOverRanks, RefusesAnUnknownMethodEverywhere)
{
    std::array<bool, 3> refused{};
    onRanks(
        3,
        [&](const Exchange& exchange)
        {
            ParametrizationOptions options;
            options.flattening = "orthographic";
            const Part part({0, 2}, exchange.rank());
            try
            {
                parametrize(part.piece(), options, exchange);
            }
            catch (const BadInput&)
            {
                refused[exchange.rank()] = true;
            }
        }
    );
    EXPECT_TRUE(refused[0] && refused[1] && refused[2]);
}
