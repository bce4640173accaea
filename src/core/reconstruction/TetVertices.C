// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/reconstruction/TetVertices.H"

#include <algorithm>

namespace Foam::stability
{

label TetVertices::ofMiddle(const edge& e)
{
    if (middles_.insert(e, edges_.size()))
    {
        edges_.append(e);
    }
    return complex_.nPoints() + complex_.nCells() + complex_.nBoundaryFaces()
           + middles_[e];
}

// The second entry of points, cells and boundary faces is negative and differs; that of
// a middle is a point. A boundary face of an image has the number of the real one.
FixedList<label, 3> TetVertices::nameOfVertex(label vertex) const
{
    const CellComplexInput& input = complex_.input();
    if (vertex < complex_.nPoints())
    {
        return {-1, -1, input.globalPoints[vertex]};
    }
    vertex -= complex_.nPoints();
    if (vertex < complex_.nCells())
    {
        return {-1, -2, input.globalCells[vertex]};
    }
    vertex -= complex_.nCells();
    if (vertex < complex_.nBoundaryFaces())
    {
        const label celli = complex_.owner()[complex_.nInternalFaces() + vertex];
        return {complex_.image(celli), -3, input.globalBoundaryFaces[vertex]};
    }
    const edge& e = edges_[vertex - complex_.nBoundaryFaces()];
    const label a = input.globalPoints[e.first()], b = input.globalPoints[e.second()];
    return {-1, min(a, b), max(a, b)};
}

PointName TetVertices::nameOf(const edge& cut, bool second) const
{
    FixedList<label, 3> a(nameOfVertex(cut.first())), b(nameOfVertex(cut.second()));
    if (std::lexicographical_compare(b.begin(), b.end(), a.begin(), a.end()) != second)
    {
        std::swap(a, b);
    }
    return {a[0], a[1], a[2], b[0], b[1], b[2]};
}

} // namespace Foam::stability
