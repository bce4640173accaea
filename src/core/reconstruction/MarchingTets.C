// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/reconstruction/MarchingTets.H"
#include "core/cells/CellPlacement.H"
#include "core/flow/VolumeFractions.H"

#include <utility>

namespace Foam::stability
{

namespace
{

using Vertex = MarchingTets::Vertex;

bool inside(const Vertex& v)
{
    return VolumeFractions::inside(v.value);
}

// The vertex that is alone on its side; -1 where all three are on one side.
label loneOf(const FixedList<Vertex, 3>& triangle)
{
    for (label k = 0; k < 3; ++k)
    {
        const bool side = inside(triangle[k]);
        if (inside(triangle[(k + 1) % 3]) != side
            && inside(triangle[(k + 2) % 3]) != side)
        {
            return k;
        }
    }
    return -1;
}

// The vertices opposite to vertex i, right-handed around the direction away from it.
constexpr label opposite[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

// Two vertices inside: even permutations that begin with them.
constexpr label pairFirst[6][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2},
                                   {1, 2, 0, 3}, {1, 3, 2, 0}, {2, 3, 0, 1}};

} // namespace

MarchingTets::MarchingTets(const CellComplex& complex, scalar margin)
    : complex_(complex), margin_(margin)
{
}

// The place at which the value is 1/2, as a share of the way from the inside end of the
// edge to the outside end, kept away from both by the margin.
scalar MarchingTets::cutShare(const Vertex& in, const Vertex& out) const
{
    const scalar t = (0.5 - in.value) / (out.value - in.value);
    return min(max(t, margin_), 1 - margin_);
}

void MarchingTets::cut(const FixedList<Vertex, 4>& tet, const UList<label>& cells)
{
    lowestCell_ = min(cells);
    FixedList<bool, 4> in;
    label nIn = 0;
    for (label i = 0; i < 4; ++i)
    {
        in[i] = inside(tet[i]);
        nIn += in[i];
    }
    if (nIn == 1 || nIn == 3)
    {
        label lone = 0;
        while (in[lone] != (nIn == 1))
        {
            ++lone;
        }
        cutOff(tet, lone, cells);
        return;
    }
    for (const auto& v : pairFirst)
    {
        if (nIn == 2 && in[v[0]] && in[v[1]])
        {
            addQuad(
                {cutEdge(tet[v[0]], tet[v[2]], cells),
                 cutEdge(tet[v[0]], tet[v[3]], cells),
                 cutEdge(tet[v[1]], tet[v[3]], cells),
                 cutEdge(tet[v[1]], tet[v[2]], cells)}
            );
        }
    }
}

void MarchingTets::cutOff(
    const FixedList<Vertex, 4>& tet, label lone, const UList<label>& cells
)
{
    const Vertex& tip = tet[lone];
    FixedList<label, 3> p;
    for (label k = 0; k < 3; ++k)
    {
        const Vertex& other = tet[opposite[lone][k]];
        p[k] = inside(tip) ? cutEdge(tip, other, cells) : cutEdge(other, tip, cells);
    }
    if (inside(tip))
    {
        addTriangle(p[0], p[1], p[2]);
    }
    else
    {
        addTriangle(p[0], p[2], p[1]);
    }
}

label MarchingTets::cutEdge(
    const Vertex& in, const Vertex& out, const UList<label>& cells
)
{
    const edge key(min(in.id, out.id), max(in.id, out.id));
    const auto found = cuts_.cfind(key);
    if (found.found())
    {
        return found.val();
    }
    const point x = in.position + cutShare(in, out) * (out.position - in.position);
    const label celli = holdingCell(complex_, cells, x);
    const std::optional<PlaneSection>& section = complex_.whole().section;
    const label pointi = addPoint(key, section ? section->inLow(x) : x, celli);
    if (section)
    {
        addPoint(key, section->inHigh(x), celli);
    }
    cuts_.insert(key, pointi);
    return pointi;
}

label MarchingTets::addPoint(const edge& key, const point& x, label celli)
{
    keys_.append(key);
    points_.append(x);
    cells_.append(celli);
    boundaryFaces_.append(-1);
    return points_.size() - 1;
}

void MarchingTets::cutTriangle(
    const FixedList<Vertex, 3>& triangle, const UList<label>& cells
)
{
    lowestCell_ = min(cells);
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
        const bool isInside = inside(tip);
        ends[isInside ? k : 1 - k] =
            isInside ? cutEdge(tip, other, cells) : cutEdge(other, tip, cells);
    }
    addTriangle(ends[0], ends[1], ends[1] + 1);
    addTriangle(ends[0], ends[1] + 1, ends[0] + 1);
}

void MarchingTets::addTriangle(label a, label b, label c)
{
    triangles_.append(triFace(a, b, c));
    triangleCells_.append(lowestCell_);
}

void MarchingTets::addQuad(const FixedList<label, 4>& q)
{
    if (splitsAtFirst(q))
    {
        addTriangle(q[0], q[1], q[2]);
        addTriangle(q[0], q[2], q[3]);
    }
    else
    {
        addTriangle(q[0], q[1], q[3]);
        addTriangle(q[1], q[2], q[3]);
    }
}

// Along the shorter diagonal; where they are alike, from the lowest key.
bool MarchingTets::splitsAtFirst(const FixedList<label, 4>& q) const
{
    const scalar first = magSqr(points_[q[2]] - points_[q[0]]);
    const scalar second = magSqr(points_[q[3]] - points_[q[1]]);
    if (mag(first - second) > 1e-9 * (first + second))
    {
        return first < second;
    }
    const auto key = [&](label corner)
    { return std::make_pair(keys_[q[corner]].first(), keys_[q[corner]].second()); };
    return min(key(0), key(2)) < min(key(1), key(3));
}

void MarchingTets::close(const FixedList<Vertex, 3>& triangle, label facei)
{
    const label boundaryFacei = facei - complex_.nInternalFaces();
    const label lone = loneOf(triangle);
    scalar share = inside(triangle[0]) ? 1 : 0;
    if (lone >= 0)
    {
        const Vertex& corner = triangle[lone];
        share = 1; // of the area, at the lone corner
        for (label k = 1; k < 3; ++k)
        {
            const Vertex& other = triangle[(lone + k) % 3];
            const Vertex& in = inside(corner) ? corner : other;
            const Vertex& out = inside(corner) ? other : corner;
            const scalar t = cutShare(in, out);
            share *= inside(corner) ? t : 1 - t;
            markBoundary(in, out, boundaryFacei);
        }
        share = inside(corner) ? share : 1 - share;
    }
    if (!complex_.own(complex_.owner()[facei]))
    {
        return;
    }
    const point& a = triangle[0].position;
    const vector area = 0.5 * ((triangle[1].position - a) ^ (triangle[2].position - a));
    boundaryFlux_ += share * ((a - complex_.whole().bounds.centre()) & area);
}

void MarchingTets::closePart(const FixedList<Vertex, 2>& part, label facei)
{
    const bool same = inside(part[0]) == inside(part[1]);
    scalar share = inside(part[0]) ? 1 : 0;
    if (!same)
    {
        const Vertex& in = part[inside(part[0]) ? 0 : 1];
        const Vertex& out = part[inside(part[0]) ? 1 : 0];
        share = cutShare(in, out);
        markBoundary(in, out, facei - complex_.nInternalFaces());
    }
    if (complex_.own(complex_.owner()[facei]))
    {
        const point& inEnd = part[inside(part[0]) ? 0 : 1].position;
        const point& outEnd = part[inside(part[0]) ? 1 : 0].position;
        const point middle = inEnd + 0.5 * share * (outEnd - inEnd);
        boundaryFlux_ += 3
                         * complex_.whole()
                               .section
                               ->coneTo(
                                   middle, 0.5 * share * complex_.faceAreas()[facei],
                                   complex_.whole().bounds.centre()
                               )
                               .volume;
    }
}

void MarchingTets::closeWhole(label facei)
{
    const vector arm = complex_.faceCentres()[facei] - complex_.whole().bounds.centre();
    if (complex_.own(complex_.owner()[facei]))
    {
        boundaryFlux_ += arm & complex_.faceAreas()[facei];
    }
}

// The lowest face, so that the order of the visits does not matter.
void MarchingTets::markBoundary(
    const Vertex& in, const Vertex& out, label boundaryFacei
)
{
    const auto found = cuts_.cfind(edge(min(in.id, out.id), max(in.id, out.id)));
    if (found.found())
    {
        const label nSides = complex_.whole().section ? 2 : 1;
        for (label side = 0; side < nSides; ++side)
        {
            label& facei = boundaryFaces_[found.val() + side];
            facei = facei < 0 ? boundaryFacei : min(facei, boundaryFacei);
        }
    }
}

scalar MarchingTets::volume() const
{
    const std::optional<PlaneSection>& section = complex_.whole().section;
    const point origin = complex_.whole().bounds.centre();
    scalar flux = boundaryFlux_;
    forAll(triangles_, trianglei)
    {
        if (!complex_.own(triangleCells_[trianglei]))
        {
            continue;
        }
        const triFace& t = triangles_[trianglei];
        const vector a = points_[t[0]] - origin;
        const vector b = points_[t[1]] - origin;
        const vector c = points_[t[2]] - origin;
        flux +=
            section
                ? 3
                      * section
                            ->coneTo(t.centre(points_), t.areaNormal(points_), origin)
                            .volume
                : 0.5 * (a & (b ^ c));
    }
    return flux / 3;
}

InterfaceMesh MarchingTets::takeMesh()
{
    InterfaceMesh mesh;
    mesh.points.transfer(points_);
    mesh.triangles.transfer(triangles_);
    mesh.triangleCells.transfer(triangleCells_);
    mesh.cells.transfer(cells_);
    mesh.boundaryFaces.transfer(boundaryFaces_);
    mesh.cellSizes.setSize(mesh.points.size());
    forAll(mesh.cells, pointi)
    {
        mesh.cellSizes[pointi] = complex_.cellSizes()[mesh.cells[pointi]];
    }
    mesh.clearParametrization();
    return mesh;
}

} // namespace Foam::stability
