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

std::optional<PeriodicImages::LinearField> fieldOf(const WholeMesh& whole)
{
    if (whole.images)
    {
        return whole.images->invariantField();
    }
    PeriodicImages::LinearField field;
    field.centre = whole.bounds.centre();
    return field;
}

} // namespace

MarchingTets::MarchingTets(const CellComplex& complex, scalar margin)
    : complex_(complex), margin_(margin), vertices_(complex),
      field_(fieldOf(complex.whole()))
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
    const label pointi = points_.size();
    const point x = in.position + cutShare(in, out) * (out.position - in.position);
    cuts_.insert(key, pointi);
    keys_.append(key);
    points_.append(x);
    cells_.append(holdingCell(complex_, cells, x));
    boundaryFaces_.append(-1);
    return pointi;
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

void MarchingTets::close(const FixedList<Vertex, 3>& triangle, label facei)
{
    const label boundaryFacei = facei - complex_.nInternalFaces();
    label nIn = 0;
    for (const Vertex& v : triangle)
    {
        nIn += inside(v);
    }
    FixedList<point, 3> corners{
        triangle[0].position, triangle[1].position, triangle[2].position};
    scalar flux = nIn > 1 ? fluxThrough(corners, facei) : 0;
    if (nIn == 1 || nIn == 2)
    {
        label lone = 0;
        while (inside(triangle[lone]) != (nIn == 1))
        {
            ++lone;
        }
        const Vertex& tip = triangle[lone];
        for (const label k : {(lone + 1) % 3, (lone + 2) % 3})
        {
            const Vertex& in = nIn == 1 ? tip : triangle[k];
            const Vertex& out = nIn == 1 ? triangle[k] : tip;
            const scalar t = cutShare(in, out);
            corners[k] =
                tip.position
                + (nIn == 1 ? t : 1 - t) * (triangle[k].position - tip.position);
            markBoundary(in, out, boundaryFacei);
        }
        flux += (nIn == 1 ? 1 : -1) * fluxThrough(corners, facei);
    }
    boundaryFlux_ += flux;
}

void MarchingTets::closeWhole(label facei)
{
    const face& f = complex_.faces()[facei];
    forAll(f, k)
    {
        boundaryFlux_ += fluxThrough(
            {complex_.faceCentres()[facei], complex_.points()[f[k]],
             complex_.points()[f.nextLabel(k)]},
            facei
        );
    }
}

// Zero where the face is not this rank's.
scalar MarchingTets::fluxThrough(const FixedList<point, 3>& corners, label facei) const
{
    return field_ && complex_.own(complex_.owner()[facei])
               ? fluxThrough(corners[0], corners[1], corners[2])
               : 0;
}

scalar MarchingTets::fluxThrough(const point& a, const point& b, const point& c) const
{
    return (*field_)((a + b + c) / 3) & (0.5 * ((b - a) ^ (c - a)));
}

// The lowest face, so that the order of the visits does not matter.
void MarchingTets::markBoundary(
    const Vertex& in, const Vertex& out, label boundaryFacei
)
{
    const auto found = cuts_.cfind(edge(min(in.id, out.id), max(in.id, out.id)));
    if (found.found())
    {
        label& facei = boundaryFaces_[found.val()];
        facei = facei < 0 ? boundaryFacei : min(facei, boundaryFacei);
    }
}

std::optional<scalar> MarchingTets::volume() const
{
    if (!field_)
    {
        return std::nullopt;
    }
    scalar flux = boundaryFlux_;
    forAll(triangles_, trianglei)
    {
        if (complex_.own(triangleCells_[trianglei]))
        {
            const triFace& t = triangles_[trianglei];
            flux += fluxThrough(points_[t[0]], points_[t[1]], points_[t[2]]);
        }
    }
    return flux;
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
            mesh.names[pointi] = vertices_.nameOf(keys_[pointi]);
        }
    }
    mesh.clearParametrization();
    return mesh;
}

} // namespace Foam::stability
