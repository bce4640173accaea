// SPDX-License-Identifier: GPL-3.0-or-later

// Surfaces dealt out to ranks, and what the ranks make of them, against the whole.

#include "core/surface/pieces/Components.H"
#include "core/surface/pieces/SurfaceColumns.H"
#include "core/surface/pieces/PointNumbers.H"
#include "core/transfer/SeamShape.H"
#include "core/transfer/DistributedChart.H"
#include "shapes/Surfaces.H"
#include "shapes/ThreadRanks.H"
#include "shapes/OneRank.H"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <set>

using namespace Foam;
using namespace Foam::stability;

namespace
{

constexpr scalar h = 0.1; // [m]
const label rankCounts[] = {1, 2, 3, 5};

// Points of triangles on one side get an origin of another place, besides their own.
void addMerger(InterfaceMesh& mesh)
{
    std::map<label, label> indices;
    forAll(mesh.triangles, trianglei)
    {
        for (label k = 0; k < 3 && mesh.centre(trianglei).y() > 0.1; ++k)
        {
            const label pointi = mesh.triangles[trianglei][k];
            const auto known = indices.insert({pointi, mesh.origins.size()});
            if (known.second)
            {
                mesh.origins.append(mesh.points[pointi] + vector(10, 0, 0));
            }
            mesh.originCorners[trianglei][k] = known.first->second;
        }
    }
}

// A large sphere, a small one beside it and a sheet; charts by halves of space, so that
// seams run around the spheres and across the sheet.
InterfaceMesh scene()
{
    const InterfaceMesh parts[] = {
        shapes::asInterface(shapes::sphere(point(0.03, 0.02, 0.01), 1, 4), h),
        shapes::asInterface(shapes::sphere(point(1.6, 0.1, 0.2), 0.15, 2), h),
        shapes::asInterface(
            shapes::grid(
                [](scalar u, scalar v) { return point(2 * u - 1, 2 * v - 1, -1.4); },
                20, 20
            ),
            h
        )};
    InterfaceMesh mesh;
    DynamicList<triFace> triangles;
    for (const InterfaceMesh& part : parts)
    {
        const label first = mesh.points.size();
        mesh.points.append(part.points);
        mesh.cellSizes.append(part.cellSizes);
        for (const triFace& t : part.triangles)
        {
            triangles.append(triFace(t[0] + first, t[1] + first, t[2] + first));
        }
    }
    mesh.triangles.transfer(triangles);
    mesh.cells = identity(mesh.points.size());
    mesh.boundaryFaces = identity(mesh.points.size(), 7);
    mesh.clearParametrization();
    forAll(mesh.materials, trianglei)
    {
        mesh.materials[trianglei] = labelPair(trianglei % 3, trianglei % 5);
    }
    mesh.setOrigins(mesh.points);
    addMerger(mesh);
    DynamicList<vector2D> parameters;
    forAll(mesh.triangles, trianglei)
    {
        const bool right = mesh.centre(trianglei).x() > 0.2;
        for (label k = 0; k < 3; ++k)
        {
            const point& x = mesh.points[mesh.triangles[trianglei][k]];
            mesh.corners[trianglei][k] = parameters.size();
            parameters.append(vector2D(x.y() + (right ? 9 : 0), x.z()));
        }
    }
    mesh.parameters.transfer(parameters);
    return mesh;
}

// In the order that all pieces follow, p welded.
const SurfacePiece& wholeScene()
{
    static const SurfacePiece whole(join({wholeSurface(scene())}).piece);
    return whole;
}

// In blocks of space, so that ranks touch along lines.
label rankOf(const point& x, label nRanks)
{
    const label block =
        label(std::floor(x.x() / 0.7)) + 2 * label(std::floor(x.y() / 0.9)) + 60;
    return block % nRanks;
}

SurfacePiece share(const SurfacePiece& whole, const Exchange& exchange)
{
    DynamicList<label> mine;
    forAll(whole.mesh.triangles, trianglei)
    {
        if (rankOf(whole.mesh.centre(trianglei), exchange.nRanks()) == exchange.rank())
        {
            mine.append(trianglei);
        }
    }
    return partOf(whole, mine);
}

VoxelMask around(const SurfacePiece& piece, scalar reach)
{
    VoxelMask mask(reach);
    for (const point& x : piece.mesh.points)
    {
        mask.add(x, reach);
    }
    return mask;
}

List<bool> whichMeet(const VoxelMask& region, const InterfaceMesh& mesh)
{
    VoxelIndex index(region.size());
    for (const triFace& t : mesh.triangles)
    {
        boundBox box(mesh.points[t[0]], mesh.points[t[0]]);
        box.add(mesh.points[t[1]]);
        box.add(mesh.points[t[2]]);
        index.add(box);
    }
    const boundBox everywhere(point(-9, -9, -9), point(9, 9, 9));
    List<bool> result(mesh.triangles.size(), false);
    for (const label trianglei : index.meeting(region.within(everywhere)))
    {
        result[trianglei] = true;
    }
    return result;
}

// Assertions of threads one after the other.
void onEachCount(
    label nRanks, const std::function<void(const Exchange&, std::mutex&)>& work
)
{
    std::mutex turn;
    shapes::onRanks(nRanks, [&](const Exchange& exchange) { work(exchange, turn); });
}

void expectSame(const SurfacePiece& a, const SurfacePiece& b)
{
    EXPECT_TRUE(a.mesh.triangles == b.mesh.triangles);
    const auto same = [](const auto& x, const auto& y) { return x == y; };
    forEachColumn([&](auto, const auto&... columns)
                  { EXPECT_TRUE((same(columns(a), columns(b)) && ...)); });
}

} // namespace

TEST(SurfacePieces, partsJoinToTheWhole)
{
    const SurfacePiece whole(wholeScene());
    EXPECT_LT(whole.mesh.parameters.size(), 2 * whole.mesh.points.size());
    for (const label nRanks : rankCounts)
    {
        std::vector<SurfacePiece> parts;
        for (label ranki = nRanks - 1; ranki >= 0; --ranki)
        {
            DynamicList<label> triangles;
            forAll(whole.mesh.triangles, trianglei)
            {
                if (rankOf(whole.mesh.centre(trianglei), nRanks) == ranki)
                {
                    triangles.append(trianglei);
                }
            }
            parts.push_back(partOf(whole, triangles));
            Packet packet;
            pack(parts.back(), packet);
            expectSame(parts.back(), unpackedSurface(packet));
        }
        const JoinedSurface joined(join(parts));
        expectSame(joined.piece, whole);
        const label n = whole.mesh.points.size();
        EXPECT_GE(joined.pointPlaces.size(), nRanks > 1 ? n + 20 : n);
    }
}

TEST(SurfacePieces, whatSharesNoPointsStaysApart)
{
    SurfacePiece whole(wholeScene());
    whole.sharesPoints = false;
    DynamicList<label> halves[2];
    forAll(whole.mesh.triangles, trianglei)
    {
        halves[rankOf(whole.mesh.centre(trianglei), 2)].append(trianglei);
    }
    const JoinedSurface joined(join({partOf(whole, halves[0]), partOf(whole, halves[1])}
    ));
    EXPECT_GT(joined.piece.mesh.points.size(), whole.mesh.points.size() + 20);
}

// One number for each point of the whole, whoever has it, and no number without a
// point.
TEST(SurfacePieces, pointsAreNumberedAlikeOnAllRanks)
{
    const SurfacePiece whole(wholeScene());
    for (const label nRanks : rankCounts)
    {
        std::map<label, point> startPositions;
        label nPoints = 0;
        onEachCount(
            nRanks,
            [&](const Exchange& exchange, std::mutex& turn)
            {
                const SurfacePiece piece(share(whole, exchange));
                const labelList numbers(pointNumbers(piece, exchange));
                const std::lock_guard<std::mutex> lock(turn);
                nPoints += numbers.size();
                forAll(numbers, i)
                {
                    const auto at =
                        startPositions.insert({numbers[i], piece.startPositions[i]})
                            .first;
                    EXPECT_EQ(at->second, piece.startPositions[i]);
                }
            }
        );
        EXPECT_EQ(label(startPositions.size()), whole.startPositions.size());
        EXPECT_EQ(startPositions.begin()->first, 0);
        EXPECT_EQ(startPositions.rbegin()->first, whole.startPositions.size() - 1);
        EXPECT_GE(nPoints, whole.startPositions.size() + (nRanks > 1 ? 20 : 0));
    }
}

// What is not joined: the ranks' points one after the other.
TEST(SurfacePieces, pointsOfSurfacesThatShareNoneAllHaveNumbersOfTheirOwn)
{
    std::set<label> found;
    onEachCount(
        3,
        [&](const Exchange& exchange, std::mutex& turn)
        {
            SurfaceOrder order;
            order.sharesPoints = false;
            order.pointKeys = List<PointKey>(4 - exchange.rank(), PointKey{5, 0});
            const labelList numbers(pointNumbers(order, exchange));
            const std::lock_guard<std::mutex> lock(turn);
            found.insert(numbers.begin(), numbers.end());
        }
    );
    EXPECT_EQ(found, (std::set<label>{0, 1, 2, 3, 4, 5, 6, 7, 8}));
}

// Two triangles become three and one: those of the own one stay, with keys in order.
TEST(SurfacePieces, partsOfOwnTrianglesHaveKeysOfTheirOwn)
{
    InterfaceMesh mesh;
    mesh.points = List<point>{
        point(0, 0, 0), point(1, 0, 0), point(0, 1, 0), point(1, 1, 0),
        point(0.3, 0.3, 0)};
    mesh.triangles = List<triFace>{
        triFace(0, 1, 4), triFace(1, 3, 2), triFace(1, 2, 4), triFace(2, 0, 4)};
    mesh.cells = labelList(5, -1);
    mesh.boundaryFaces = labelList(5, -1);
    mesh.cellSizes = scalarField(5, 1);
    mesh.clearParametrization();
    SurfacePiece before;
    before.keys = List<TriangleKey>{{point(7, 0, 0), 4}, {point(8, 0, 0), 0}};
    const JoinedSurface own(
        ownParts(mesh, labelList{0, 1, 0, 0}, before, List<bool>{true, false})
    );
    EXPECT_EQ(own.triangleSources, (labelList{0, 2, 3}));
    EXPECT_EQ(own.pointSources, (labelList{0, 1, 4, 2}));
    forAll(own.piece.keys, i)
    {
        EXPECT_EQ(own.piece.keys[i].where, point(7, 0, 0));
        EXPECT_EQ(own.piece.keys[i].place, i);
    }
}

TEST(SurfaceHalo, hasAllThatMeetsTheVoxelsAndKnowsWhatIsOwn)
{
    const SurfacePiece whole(wholeScene());
    for (const label nRanks : rankCounts)
    {
        label nCounted = 0, nOwn = 0;
        onEachCount(
            nRanks,
            [&](const Exchange& exchange, std::mutex& turn)
            {
                const SurfacePiece owned(share(whole, exchange));
                const VoxelMask wanted(around(owned, 0.25));
                const SurfaceHalo halo(owned, wanted, exchange);
                labelList numbers(owned.mesh.triangles.size());
                forAll(numbers, i)
                {
                    numbers[i] = 100000 * exchange.rank() + i;
                }
                const labelList values(halo.triangleValues(numbers));

                const std::lock_guard<std::mutex> lock(turn);
                const List<bool> near(whichMeet(wanted, whole.mesh));
                std::size_t next = 0;
                forAll(whole.mesh.triangles, i)
                {
                    const bool own =
                        rankOf(whole.mesh.centre(i), nRanks) == exchange.rank();
                    if (own || near[i])
                    {
                        ASSERT_LT(label(next), halo.piece().keys.size());
                        EXPECT_TRUE(halo.piece().keys[next] == whole.keys[i]);
                        EXPECT_EQ(halo.isOwn(next), own);
                        EXPECT_EQ(
                            values[next] / 100000, rankOf(whole.mesh.centre(i), nRanks)
                        );
                        ++next;
                    }
                }
                EXPECT_EQ(label(next), halo.piece().keys.size());
                const List<bool> isPrimary(halo.primaryPoints());
                nCounted += std::count(isPrimary.begin(), isPrimary.end(), true);
                nOwn += owned.mesh.triangles.size();
                // There and back.
                EXPECT_TRUE(
                    halo.toOwned(halo.toHalo(owned.mesh.cells)) == owned.mesh.cells
                );
                EXPECT_TRUE(halo.toOwned(halo.mesh().cells) == owned.mesh.cells);
            }
        );
        EXPECT_EQ(nCounted, whole.mesh.points.size());
        EXPECT_EQ(nOwn, whole.mesh.triangles.size());
    }
}

// The large sphere, the small one, the sheet: in this order, whoever has what.
TEST(Components, areNumberedAndWholeAcrossRanks)
{
    const SurfacePiece whole(wholeScene());
    const auto expected = [](const point& x) {
        return x.z() < -1.2 ? 2 : x.x() > 1.3 ? 1 : 0;
    };
    scalar volumes[3] = {0, 0, 0};
    forAll(whole.mesh.triangles, i)
    {
        const triFace& t = whole.mesh.triangles[i];
        const pointField& x = whole.mesh.points;
        volumes[expected(whole.mesh.centre(i))] += (x[t[0]] & (x[t[1]] ^ x[t[2]])) / 6;
    }
    for (const label nRanks : rankCounts)
    {
        label nWhole = 0;
        onEachCount(
            nRanks,
            [&](const Exchange& exchange, std::mutex& turn)
            {
                const SurfacePiece owned(share(whole, exchange));
                const SurfaceHalo halo(owned, around(owned, 0.2), exchange);
                const Components components(halo, point(1, 2, 3), exchange);
                const List<bool> all(owned.mesh.triangles.size(), true);
                const WholeComponents here(
                    wholeComponents(owned, components, all, exchange)
                );
                const labelList numbers(components.ofOwnedTriangles());

                const std::lock_guard<std::mutex> lock(turn);
                forAll(numbers, i)
                {
                    const label component = expected(owned.mesh.centre(i));
                    EXPECT_EQ(numbers[i], component);
                    const Components::Body& body = components.bodyOf(i);
                    EXPECT_EQ(body.closed, component != 2);
                    if (body.closed)
                    {
                        EXPECT_NEAR(body.volume / volumes[component], 1, 1e-12);
                    }
                    EXPECT_NEAR(body.cellSize, whole.mesh.cellSizes[0], 1e-12);
                }
                forAll(halo.mesh().points, i)
                {
                    EXPECT_EQ(
                        components.ofPoints()[i], expected(halo.mesh().points[i])
                    );
                }
                label n[3] = {0, 0, 0};
                forAll(here.components, i)
                {
                    ASSERT_LT(here.components[i], 3);
                    ++n[here.components[i]];
                }
                label total[3] = {0, 0, 0};
                forAll(whole.mesh.triangles, i)
                {
                    ++total[expected(whole.mesh.centre(i))];
                }
                for (label i = 0; i < 3; ++i)
                {
                    EXPECT_TRUE(n[i] == 0 || n[i] == total[i]);
                    nWhole += n[i] > 0;
                }
            }
        );
        EXPECT_EQ(nWhole, 3);
    }
}

TEST(SeamShape, isThatOfTheWholeOnAnyNumberOfRanks)
{
    const SurfacePiece whole(wholeScene());
    const SurfaceTopology topology(whole.mesh.points.size(), whole.mesh.triangles);
    const SeamShape expected(seamShape(whole.mesh, topology));
    ASSERT_GT(expected.nodes.size(), 10);
    for (const label nRanks : rankCounts)
    {
        std::vector<point> found;
        onEachCount(
            nRanks,
            [&](const Exchange& exchange, std::mutex& turn)
            {
                const SurfacePiece owned(share(whole, exchange));
                const SurfaceHalo halo(owned, around(owned, 0.2), exchange);
                const SeamShape shape(seamShape(
                    halo.piece(),
                    SurfaceTopology(halo.mesh().points.size(), halo.mesh().triangles),
                    halo.ownTriangles(), exchange
                ));
                const std::lock_guard<std::mutex> lock(turn);
                EXPECT_EQ(shape.scale, expected.scale);
                const boundBox box(halo.mesh().points, false);
                label next = 0;
                for (const SeamNode& node : expected.nodes)
                {
                    if (box.contains(node.x))
                    {
                        ASSERT_LT(next, shape.nodes.size());
                        const SeamNode& same = shape.nodes[next++];
                        EXPECT_EQ(same.x, node.x);
                        EXPECT_EQ(same.normal, node.normal);
                        EXPECT_EQ(same.isEnd, node.isEnd);
                    }
                }
                EXPECT_EQ(next, shape.nodes.size());
            }
        );
    }
}

// The chart of one rank is dealt out, and says the same to all.
TEST(DistributedChart, readsTheSameOnAnyNumberOfRanks)
{
    SurfacePiece whole(wholeScene());
    whole.sharesPoints = false;
    const label n = whole.mesh.points.size();
    // What asks: a copy a little aside, p rough.
    InterfaceMesh asking(whole.mesh);
    asking.setOrigins(asking.points + 0.01 * h * vector(1, 2, -1));
    for (vector2D& p : asking.parameters)
    {
        p += vector2D(0.1 * h, -0.1 * h);
    }
    List<InterfaceMesh> read;
    for (const label nRanks : rankCounts)
    {
        WholeMesh mesh;
        for (label ranki = 0; ranki <= nRanks; ++ranki)
        {
            mesh.firstCells.append(ranki * n / nRanks);
        }
        onEachCount(
            nRanks,
            [&](const Exchange& exchange, std::mutex& turn)
            {
                const labelList none;
                const DistributedChart chart(
                    exchange.rank() == nRanks - 1 ? whole : partOf(whole, none), mesh,
                    exchange
                );
                InterfaceMesh mine(asking);
                chart.around(asking, pointField(), exchange).readOff(mine);
                const std::lock_guard<std::mutex> lock(turn);
                read.append(mine);
                if (nRanks > 1)
                {
                    EXPECT_GT(chart.nTriangles(), 0.5 * n / nRanks);
                    EXPECT_LT(chart.nTriangles(), 4 * n / nRanks);
                }
            }
        );
    }
    label nRead = 0;
    forAll(asking.origins, i)
    {
        nRead += read[0].origins[i] != asking.origins[i];
    }
    EXPECT_GT(nRead, n / 10); // p beyond the unit square is left alone
    for (const InterfaceMesh& other : read)
    {
        EXPECT_TRUE(other.parameters == read[0].parameters);
        EXPECT_TRUE(other.origins == read[0].origins);
    }
}
