// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/transfer/SeamLines.H"

#include "core/surface/SurfaceLocator.H"

#include <vector>

namespace Foam::stability
{

namespace
{

class LineWalk
{
public:
    LineWalk(label nPoints, const UList<triFace>& edges)
        : edges_(edges), pointEdges_(
                             nPoints,
                             [&](auto&& add)
                             {
                                 forAll(edges, edgei)
                                 {
                                     add(edges[edgei][0], edgei);
                                     add(edges[edgei][1], edgei);
                                 }
                             }
                         ),
          done_(edges.size(), 0)
    {
    }

    label nEdges(label pointi) const { return pointEdges_[pointi].size(); }
    const UList<label> edgesAt(label pointi) const { return pointEdges_[pointi]; }
    bool isDone(label edgei) const { return done_[edgei]; }

    // The points of the line that leaves `pointi` by the edge, up to a node or back
    // to where it began.
    std::vector<label> follow(label pointi, label edgei)
    {
        std::vector<label> line{pointi};
        for (;;)
        {
            done_[edgei] = 1;
            pointi = edges_[edgei][edges_[edgei][0] == pointi ? 1 : 0];
            line.push_back(pointi);
            if (nEdges(pointi) != 2)
            {
                return line;
            }
            const UList<label> both = pointEdges_[pointi];
            edgei = both[0] == edgei ? both[1] : both[0];
            if (done_[edgei])
            {
                return line;
            }
        }
    }

private:
    const UList<triFace>& edges_;
    Rows pointEdges_;
    std::vector<char> done_;
};

void keepCorners(
    const std::vector<label>& line, const pointField& points,
    const scalarField& tolerance, std::vector<char>& kept
)
{
    std::vector<std::pair<std::size_t, std::size_t>> parts{{0, line.size() - 1}};
    while (!parts.empty())
    {
        const auto [first, last] = parts.back();
        parts.pop_back();
        const point &a = points[line[first]], &b = points[line[last]];
        scalar largest = 1;
        std::size_t corner = first;
        for (std::size_t i = first + 1; i < last; ++i)
        {
            const scalar excess =
                closestPoint(points[line[i]], a, b, b).distance / tolerance[line[i]];
            if (excess > largest)
            {
                largest = excess;
                corner = i;
            }
        }
        if (corner > first)
        {
            kept[line[corner]] = 1;
            parts.push_back({first, corner});
            parts.push_back({corner, last});
        }
    }
}

} // namespace

SeamCorners seamCorners(
    const pointField& points, const UList<triFace>& edges, const scalarField& tolerance
)
{
    LineWalk walk(points.size(), edges);
    std::vector<char> kept(points.size(), 0);
    const auto followFrom = [&](label pointi)
    {
        for (const label edgei : walk.edgesAt(pointi))
        {
            if (!walk.isDone(edgei))
            {
                kept[pointi] = 1;
                keepCorners(walk.follow(pointi, edgei), points, tolerance, kept);
            }
        }
    };
    for (const bool nodes : {true, false})
    {
        forAll(points, pointi)
        {
            if ((walk.nEdges(pointi) != 2) == nodes)
            {
                followFrom(pointi);
            }
        }
    }

    DynamicList<label> corners;
    DynamicList<bool> isNode;
    forAll(points, pointi)
    {
        const bool node = walk.nEdges(pointi) > 0 && walk.nEdges(pointi) != 2;
        if (kept[pointi] || node)
        {
            corners.append(pointi);
            isNode.append(node);
        }
    }
    return {labelList(std::move(corners)), List<bool>(std::move(isNode))};
}

} // namespace Foam::stability
