// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/cells/BoxTree.H"

#include <algorithm>
#include <numeric>

namespace Foam::stability
{

BoxTree::BoxTree(const UList<boundBox>& boxes) : order_(boxes.size())
{
    std::iota(order_.begin(), order_.end(), label(0));
    if (!boxes.empty())
    {
        build(boxes, 0, boxes.size());
    }
    boxes_.setSize(boxes.size());
    forAll(order_, i)
    {
        boxes_[i] = boxes[order_[i]];
    }
}

// Halves the boxes at the median of their middles along the longest side.
void BoxTree::build(const UList<boundBox>& boxes, label begin, label end)
{
    constexpr label ofLeaf = 4;
    const label node = nodes_.size();
    nodes_.append(Node());
    boundBox around, middles;
    for (label i = begin; i < end; ++i)
    {
        around.add(boxes[order_[i]]);
        middles.add(boxes[order_[i]].midpoint());
    }
    if (end - begin <= ofLeaf)
    {
        nodes_[node].begin = begin;
        nodes_[node].end = end;
    }
    else
    {
        const vector span(middles.span());
        direction d = span.x() < span.y() ? 1 : 0;
        d = span[d] < span.z() ? 2 : d;
        const label half = begin + (end - begin) / 2;
        std::nth_element(
            order_.begin() + begin, order_.begin() + half, order_.begin() + end,
            [&](label a, label b)
            { return boxes[a].midpoint()[d] < boxes[b].midpoint()[d]; }
        );
        build(boxes, begin, half);
        build(boxes, half, end);
    }
    nodes_[node].box = around;
    nodes_[node].next = nodes_.size();
}

} // namespace Foam::stability
