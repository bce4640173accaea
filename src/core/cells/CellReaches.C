// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/cells/CellReaches.H"

#include <algorithm>

namespace Foam::stability
{

CellReaches::Reach::Reach(
    const UList<point>& points, label nFaces, const vector& across
)
    : centre(Zero), box(points, false)
{
    for (const point& x : points)
    {
        centre += x / points.size();
    }
    frame = rounded(frameOf(points, centre, nFaces, across));
}

boundBox CellReaches::Reach::wide(scalar cells) const
{
    const vector by(cells * frame.halfWidths());
    return boundBox(box.min() - by, box.max() + by);
}

bool CellReaches::Reach::reaches(
    const UList<point>& points, const point& middle, scalar cells
) const
{
    constexpr scalar toCorner = 0.87; // from the centre
    const auto isNear = [&](const point& x)
    { return magSqr(frame.local(x - centre)) < sqr(cells + toCorner); };
    return isNear(middle) || std::any_of(points.begin(), points.end(), isNear);
}

CellReaches::CellReaches(
    const CellComplexInput& own, const Rows& cellFaces, scalar cells,
    const vector& across
)
    : cells_(cells), across_(across)
{
    DynamicList<boundBox> rim;
    forAll(own.kinds, i)
    {
        if (own.kinds[i] == BoundaryKind::coupledUnknown)
        {
            rim.append(boundBox(own.points, own.faces[own.neighbour.size() + i], false)
            );
        }
    }
    const BoxTree rimTree(rim);
    DynamicList<boundBox> wide;
    std::vector<label> labels;
    for (label celli = 0; celli < cellFaces.size(); ++celli)
    {
        labels.clear();
        for (const label facei : cellFaces[celli])
        {
            labels.insert(
                labels.end(), own.faces[facei].begin(), own.faces[facei].end()
            );
        }
        std::sort(labels.begin(), labels.end());
        labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
        List<point> points(labels.size());
        forAll(points, k)
        {
            points[k] = own.points[labels[k]];
        }
        const Reach reach(points, cellFaces[celli].size(), across);
        const boundBox box(reach.wide(2 * cells));
        if (rimTree.meets(box))
        {
            own_.push_back(reach);
            points_.push_back(points);
            wide.append(box);
        }
    }
    reaches_ = BoxTree(wide);
}

CellReaches::Nearness CellReaches::of(const UList<point>& points, label nFaces) const
{
    const Reach cell(points, nFaces, across_);
    Nearness nearness = Nearness::far;
    reaches_.meets(
        cell.box,
        [&](label i)
        {
            nearness = Nearness::onTheWay;
            if (own_[i].reaches(points, cell.centre, 2 * cells_)
                && cell.reaches(points_[i], own_[i].centre, cells_))
            {
                nearness = Nearness::near;
            }
            return nearness == Nearness::near;
        }
    );
    return nearness;
}

} // namespace Foam::stability
