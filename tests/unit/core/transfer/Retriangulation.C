// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/transfer/Retriangulation.H"

#include <gtest/gtest.h>

#include <map>
#include <set>

using namespace Foam;
using namespace Foam::stability;

namespace
{

// Corners 0 1 2, points within the edges 3 4 5; p of corner k is 10 + k, of a cut of
// edge k 20 + k before and 30 + k after.
const std::vector<point> places{point(0, 0, 1),       point(2, 0.1, 1),
                                point(0.7, 1.9, 1),   point(0.9, 0.045, 1),
                                point(1.61, 0.64, 1), point(0.21, 0.57, 1)};

const point& place(label i)
{
    return places[i];
}

vector areaOf(const triFace& t)
{
    return 0.5 * ((place(t[1]) - place(t[0])) ^ (place(t[2]) - place(t[0])));
}

const CornerIndices own{10, 11, 12};

// kind of the cut of an edge: 0 none, 1 within, 2 at its start, 3 at its end.
FixedList<EdgeCut, 3> cutsOf(label code)
{
    FixedList<EdgeCut, 3> cuts;
    for (label k = 0; k < 3; ++k, code /= 4)
    {
        const label kind = code % 4;
        if (kind > 0)
        {
            cuts[k].point = kind == 1 ? 3 + k : kind == 2 ? k : (k + 1) % 3;
            cuts[k].before = 20 + k;
            cuts[k].after = 30 + k;
        }
    }
    return cuts;
}

label nWithin(label code)
{
    return (code % 4 == 1) + (code / 4 % 4 == 1) + (code / 16 % 4 == 1);
}

} // namespace

// All patterns of cuts, also through corners: same area, same orientation, and each
// edge of the triangle is divided exactly at its cut.
TEST(Retriangulation, coversTheTriangleForEveryPattern)
{
    const vector whole = areaOf(triFace(0, 1, 2));
    for (label code = 0; code < 64; ++code)
    {
        for (label middle = 0; middle < 3; ++middle)
        {
            vector sum(Zero);
            std::map<std::pair<label, label>, label> edges;
            for (const CutTriangle& part :
                 retriangulate(triFace(0, 1, 2), own, cutsOf(code), middle, place))
            {
                EXPECT_GT(areaOf(part.points) & whole, 0) << code;
                sum += areaOf(part.points);
                for (label k = 0; k < 3; ++k)
                {
                    const label a = part.points[k], b = part.points[(k + 1) % 3];
                    ++edges[{std::min(a, b), std::max(a, b)}];
                    EXPECT_TRUE(part.corners[k] >= 0 || part.extrapolated == k);
                }
            }
            EXPECT_LT(mag(sum - whole), 1e-14) << code;

            label nOuter = 0;
            for (const auto& edge : edges)
            {
                EXPECT_LE(edge.second, 2);
                nOuter += edge.second == 1;
            }
            EXPECT_EQ(nOuter, 3 + nWithin(code)) << code;
        }
    }
}

TEST(Retriangulation, oneCutKeepsTheSidesApart)
{
    const auto parts = retriangulate(triFace(0, 1, 2), own, cutsOf(1), 0, place);
    ASSERT_EQ(parts.size(), 2u);
    EXPECT_EQ(parts[0].points, triFace(0, 3, 2));
    EXPECT_EQ(parts[0].corners, (CornerIndices{10, 20, 12}));
    EXPECT_EQ(parts[1].points, triFace(3, 1, 2));
    EXPECT_EQ(parts[1].corners, (CornerIndices{30, 11, 12}));
}

TEST(Retriangulation, twoCutsLeaveACornerAndAQuadrangle)
{
    // Edges 0 and 2: corner 0 is cut off.
    const auto parts = retriangulate(triFace(0, 1, 2), own, cutsOf(1 + 16), 0, place);
    ASSERT_EQ(parts.size(), 3u);
    EXPECT_EQ(parts[0].points, triFace(0, 3, 5));
    EXPECT_EQ(parts[0].corners, (CornerIndices{10, 20, 32}));
    for (std::size_t i = 1; i < 3; ++i)
    {
        for (label k = 0; k < 3; ++k)
        {
            const std::map<label, label> far{{1, 11}, {2, 12}, {3, 30}, {5, 22}};
            EXPECT_EQ(parts[i].corners[k], far.at(parts[i].points[k]));
        }
    }
}

TEST(Retriangulation, threeCutsLeaveAMiddleForOneSheet)
{
    const auto parts = retriangulate(triFace(0, 1, 2), own, cutsOf(21), 1, place);
    ASSERT_EQ(parts.size(), 4u);
    EXPECT_EQ(parts[2].corners, (CornerIndices{12, 22, 31}));
    EXPECT_EQ(parts[3].points, triFace(4, 5, 3));
    EXPECT_EQ(parts[3].corners, (CornerIndices{21, -1, 30}));
    EXPECT_EQ(parts[3].extrapolated, 1);
}

TEST(Retriangulation, aCutThroughTheFarCornerTakesItsOtherSide)
{
    // Edge 0 is cut within, edge 1 at its end, corner 2: corner 1 is cut off.
    const auto parts = retriangulate(triFace(0, 1, 2), own, cutsOf(1 + 12), 0, place);
    ASSERT_EQ(parts.size(), 2u);
    EXPECT_EQ(parts[0].points, triFace(1, 2, 3));
    EXPECT_EQ(parts[0].corners, (CornerIndices{11, 21, 30}));
    std::map<label, label> other;
    for (label k = 0; k < 3; ++k)
    {
        other[parts[1].points[k]] = parts[1].corners[k];
    }
    EXPECT_EQ(other, (std::map<label, label>{{2, 12}, {0, 10}, {3, 20}}));
}

TEST(Retriangulation, divisionIsConforming)
{
    for (label code = 0; code < 8; ++code)
    {
        FixedList<label, 3> points(-1);
        for (label k = 0; k < 3; ++k)
        {
            points[k] = code >> k & 1 ? 3 + k : -1;
        }
        vector sum(Zero);
        std::set<std::pair<label, label>> sides;
        const std::vector<triFace> parts = divide(triFace(0, 1, 2), points, place);
        for (const triFace& part : parts)
        {
            EXPECT_GT(areaOf(part) & areaOf(triFace(0, 1, 2)), 0);
            sum += areaOf(part);
            for (label k = 0; k < 3; ++k)
            {
                EXPECT_TRUE(sides.insert({part[k], part[(k + 1) % 3]}).second);
            }
        }
        EXPECT_LT(mag(sum - areaOf(triFace(0, 1, 2))), 1e-14);
        label nOuter = 0;
        for (const auto& side : sides)
        {
            nOuter += !sides.count({side.second, side.first});
        }
        EXPECT_EQ(nOuter, label(parts.size() + 2));
        EXPECT_EQ(label(parts.size()), 1 + label(__builtin_popcount(code)));
    }
}

TEST(Retriangulation, similarCornerKeepsAngles)
{
    const point a(0.3, -1, 2), b(1.4, 0.2, 2.5), c(-0.2, 0.9, 3.1);
    // The same triangle laid out in the plane by its edge lengths.
    const scalar ab = mag(b - a), ac = mag(c - a), bc = mag(c - b);
    const scalar x = (ab * ab + ac * ac - bc * bc) / (2 * ab);
    const scalar y = std::sqrt(ac * ac - x * x);
    const scalar s = 0.037, turn = 0.7;
    const auto lay = [&](scalar u, scalar v)
    {
        return s
               * vector2D(
                   std::cos(turn) * u - std::sin(turn) * v + 3,
                   std::sin(turn) * u + std::cos(turn) * v - 1
               );
    };
    const vector2D kept = similarCorner(a, b, c, lay(0, 0), lay(ab, 0), 1);
    EXPECT_LT(mag(kept - lay(x, y)), 1e-15);
    const vector2D mirrored = similarCorner(a, b, c, lay(0, 0), lay(ab, 0), -1);
    EXPECT_LT(mag(mirrored - lay(x, -y)), 1e-15);
}
