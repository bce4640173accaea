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

// The vertices opposite to vertex i, right-handed around the direction away from it.
constexpr label opposite[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

// Two vertices inside: even permutations that begin with them.
constexpr label pairFirst[6][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2},
                                   {1, 2, 0, 3}, {1, 3, 2, 0}, {2, 3, 0, 1}};

} // namespace

MarchingTets::MarchingTets(const CellComplex& complex, scalar margin)
    : complex_(complex), margin_(margin), vertices_(complex),
      field_(volumeField(complex.whole()))
{
}

// The lowest of the cells, or, where several images of it are among them, the one that
// each image of the tetrahedron chooses alike.
label MarchingTets::homeOf(const UList<label>& cells) const
{
    const label lowest = min(cells);
    const PeriodicImages* images = complex_.whole().images.get();
    if (!images)
    {
        return lowest;
    }
    const auto realCell = [&](label celli)
    { return images->realCell(complex_.globalCell(celli)); };
    DynamicList<label, 8> numbers;
    for (const label celli : cells)
    {
        if (realCell(celli) == realCell(lowest)
            && !numbers.found(complex_.image(celli)))
        {
            numbers.append(complex_.image(celli));
        }
    }
    return numbers.size() == 1
               ? lowest
               : complex_.localCell(
                   images->cell(realCell(lowest), images->representative(numbers))
               );
}

// The place at which the value is 1/2, as a share of the way from the inside end of the
// edge to the outside end, kept away from both by the margin.
scalar MarchingTets::cutShare(const Vertex& in, const Vertex& out) const
{
    const scalar t = (0.5 - in.value) / (out.value - in.value);
    const scalar margin = in.slender || out.slender ? narrow : margin_;
    return min(max(t, margin), 1 - margin);
}

void MarchingTets::cut(const FixedList<Vertex, 4>& tet, const UList<label>& cells)
{
    home_ = homeOf(cells);
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

void MarchingTets::addTriangle(label a, label b, label c)
{
    triangles_.append(triFace(a, b, c));
    triangleCells_.append(home_);
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

label MarchingTets::loneOf(const FixedList<Vertex, 3>& triangle)
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

void MarchingTets::close(const FixedList<Vertex, 3>& triangle, label facei)
{
    const label lone = loneOf(triangle);
    const bool mostlyIn = lone < 0 ? inside(triangle[0]) : !inside(triangle[lone]);
    FixedList<point, 3> corners{
        triangle[0].position, triangle[1].position, triangle[2].position};
    scalar volume = mostlyIn ? volumeTo(corners) : 0;
    if (lone >= 0)
    {
        const Vertex& tip = triangle[lone];
        for (const label k : {(lone + 1) % 3, (lone + 2) % 3})
        {
            const Vertex& in = mostlyIn ? triangle[k] : tip;
            const Vertex& out = mostlyIn ? tip : triangle[k];
            const scalar t = cutShare(in, out);
            corners[k] =
                tip.position
                + (mostlyIn ? 1 - t : t) * (triangle[k].position - tip.position);
            markBoundary(in, out, facei - complex_.nInternalFaces());
        }
        volume += (mostlyIn ? -1 : 1) * volumeTo(corners);
    }
    addBoundary(volume, facei);
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
    if (vertices_.haveNames())
    {
        mesh.names.setSize(keys_.size());
        forAll(keys_, pointi)
        {
            mesh.names[pointi] = vertices_.nameOf(
                keys_[pointi], pointi > 0 && keys_[pointi - 1] == keys_[pointi]
            );
        }
    }
    mesh.clearParametrization();
    return mesh;
}

} // namespace Foam::stability
