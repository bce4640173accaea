// SPDX-License-Identifier: GPL-3.0-or-later

// What MarchingTets does in a section: it cuts triangles.

#include "core/reconstruction/MarchingTets.H"
#include "core/flow/VolumeFractions.H"

namespace Foam::stability
{

namespace
{

bool isInside(const MarchingTets::Vertex& v)
{
    return VolumeFractions::inside(v.value);
}

} // namespace

void MarchingTets::cutTriangle(
    const FixedList<Vertex, 3>& triangle, const UList<label>& cells
)
{
    home_ = homeOf(cells);
    const label lone = loneOf(triangle);
    if (lone < 0)
    {
        return;
    }
    const Vertex& tip = triangle[lone];
    label ends[2]; // in the lower plane
    for (label k = 0; k < 2; ++k)
    {
        const Vertex& other = triangle[(lone + 1 + k) % 3];
        const bool outwards = isInside(tip);
        ends[outwards ? k : 1 - k] =
            outwards ? cutEdge(tip, other, cells) : cutEdge(other, tip, cells);
    }
    addTriangle(ends[0], ends[1], ends[1] + 1);
    addTriangle(ends[0], ends[1] + 1, ends[0] + 1);
}

void MarchingTets::closePart(const FixedList<Vertex, 2>& part, label facei)
{
    const bool same = isInside(part[0]) == isInside(part[1]);
    scalar share = isInside(part[0]) ? 1 : 0;
    if (!same)
    {
        const Vertex& in = part[isInside(part[0]) ? 0 : 1];
        const Vertex& out = part[isInside(part[0]) ? 1 : 0];
        share = cutShare(in, out);
        markBoundary(in, out, facei - complex_.nInternalFaces());
    }
    const point& inEnd = part[isInside(part[0]) ? 0 : 1].position;
    const point& outEnd = part[isInside(part[0]) ? 1 : 0].position;
    const point middle = inEnd + 0.5 * share * (outEnd - inEnd);
    addBoundary(volumeTo(middle, 0.5 * share * complex_.faceAreas()[facei]), facei);
}

} // namespace Foam::stability
