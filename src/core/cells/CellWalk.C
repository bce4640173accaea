// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/cells/CellWalk.H"

#include "core/cells/CellTet.H"
#include "DynamicList.H"

#include <cmath>

namespace Foam::stability
{

namespace
{

constexpr label maxCells = 200;  // visited in one walk
constexpr label maxPutBacks = 3; // a corner has three walls
constexpr scalar onFace = 1e-10; // weight of the centre that is no crossing yet
constexpr scalar overlap = 1e-6; // the same between two cells that disagree
constexpr scalar farthest = 0.5; // the same where all else failed
constexpr scalar trusted = 8;    // reach of a hint, in radii of its cell
constexpr scalar inward = 1e-6;  // distance kept from walls, in h

enum class Ended : unsigned char
{
    found,
    boundary,
    elsewhere,
    failed
};

// From cell to cell through the face that the line from the centre to x crosses.
Ended walk(const CellComplex& complex, const point& x, CellHint& hint, CellTet& tet)
{
    label previous = -1;
    for (label n = 0; n < maxCells; ++n)
    {
        if (!complex.hasAllNeighbours(hint.cell))
        {
            return Ended::elsewhere;
        }
        if (!chooseTet(complex, x, hint, tet))
        {
            return Ended::failed;
        }
        if (tet.w[0] >= -onFace)
        {
            // In no cone: a cell whose centre sees some of its faces from behind.
            return tet.least() >= -overlap ? Ended::found : Ended::failed;
        }
        if (tet.facei >= complex.nInternalFaces())
        {
            return Ended::boundary;
        }
        const label owner = complex.owner()[tet.facei];
        const label next = owner == hint.cell ? complex.neighbour()[tet.facei] : owner;
        if (next == previous)
        {
            // Each sends x to the other: round-off, or cells that overlap.
            return tet.w[0] >= -overlap ? Ended::found : Ended::failed;
        }
        previous = hint.cell;
        hint = CellHint{next, -1};
    }
    return Ended::failed;
}

// Largest distance of a point of the cell from its centre [m].
scalar radius(const CellComplex& complex, label celli)
{
    scalar largest = 0;
    for (const label facei : complex.cellFaces()[celli])
    {
        for (const label pointi : complex.faces()[facei])
        {
            const vector arm = complex.points()[pointi] - complex.cellCentres()[celli];
            largest = max(largest, magSqr(arm));
        }
    }
    return std::sqrt(largest);
}

bool within(const CellComplex& complex, label celli, const point& x, scalar radii)
{
    const vector arm = x - complex.cellCentres()[celli];
    return magSqr(arm) <= sqr(radii * radius(complex, celli));
}

// Walks from the hint and, where that does not help, from the cell that a search of
// the whole complex gives.
Ended find(const CellComplex& complex, const point& x, CellHint& hint, CellTet& tet)
{
    const label start = hint.cell;
    if (start >= 0 && start < complex.nCells())
    {
        const Ended ended = walk(complex, x, hint, tet);
        // On the way from a distant hint an obstacle proves nothing.
        if (ended == Ended::found || ended == Ended::elsewhere
            || (ended == Ended::boundary && within(complex, start, x, trusted)))
        {
            return ended;
        }
    }
    const label celli = complex.findCell(x);
    hint = CellHint{celli, -1};
    const Ended ended = walk(complex, x, hint, tet);
    if (ended != Ended::failed)
    {
        return ended;
    }
    hint = CellHint{celli, -1};
    if (!chooseTet(complex, x, hint, tet))
    {
        return Ended::failed;
    }
    const bool near = min(tet.w[0], tet.least()) >= -farthest;
    return near || complex.holds(celli, x) ? Ended::found : Ended::failed;
}

// Around an edge of an obstacle the line from the centre may hit the wall although x
// lies in the fluid. Looks for its cell among those at the points of the face, as
// far as they hang together by faces (so not on the other side of a thin wall).
bool findAround(const CellComplex& complex, const point& x, label facei, CellHint& hint)
{
    DynamicList<label, 64> around;
    label target = -1;
    for (const label pointi : complex.faces()[facei])
    {
        for (const label celli : complex.pointCells()[pointi])
        {
            if (!around.found(celli))
            {
                around.append(celli);
                target = target < 0 && complex.holds(celli, x) ? celli : target;
            }
        }
    }
    if (target < 0)
    {
        return false;
    }
    DynamicList<label, 64> reached;
    reached.append(complex.owner()[facei]);
    for (label i = 0; i < reached.size() && reached[i] != target; ++i)
    {
        for (const label other : complex.cellFaces()[reached[i]])
        {
            if (other >= complex.nInternalFaces())
            {
                continue;
            }
            for (const label next :
                 {complex.owner()[other], complex.neighbour()[other]})
            {
                if (around.found(next) && !reached.found(next))
                {
                    reached.append(next);
                }
            }
        }
    }
    if (!reached.found(target))
    {
        return false;
    }
    hint = CellHint{target, -1};
    return true;
}

// Along the normal onto the plane of the triangle, a little inside for a wall.
point putBack(
    const CellComplex& complex, const CellTet& tet, label celli, const point& x
)
{
    const pointField& points = complex.points();
    const point& a = points[tet.points[0]];
    vector normal = (points[tet.points[1]] - a) ^ (points[tet.points[2]] - a);
    normal /= mag(normal);
    const label i = tet.facei - complex.nInternalFaces();
    const scalar gap = complex.kinds()[i] == BoundaryKind::open
                           ? 0
                           : inward * complex.cellSizes()[celli];
    // Faces of the boundary point outward.
    return x - (((x - a) & normal) + gap) * normal;
}

// Weights without negative ones; position where they clamped it.
void settle(
    const CellComplex& complex, const CellTet& tet, bool clamped, Location& location
)
{
    location.points = tet.points;
    scalar sum = 0;
    for (direction i = 0; i < 4; ++i)
    {
        location.weights[i] = max(tet.w[i], scalar(0));
        sum += location.weights[i];
    }
    for (scalar& weight : location.weights)
    {
        weight /= sum;
    }
    if (clamped)
    {
        location.position = location.weights[0] * complex.cellCentres()[location.cell];
        for (direction i = 0; i < 3; ++i)
        {
            location.position +=
                location.weights[i + 1] * complex.points()[tet.points[i]];
        }
    }
}

} // namespace

Location locate(const CellComplex& complex, const point& x, CellHint& hint)
{
    Location location;
    location.position = x;
    if (!std::isfinite(x.x()) || !std::isfinite(x.y()) || !std::isfinite(x.z()))
    {
        return location;
    }

    if (complex.nCells() == 0)
    {
        return location;
    }

    CellTet tet;
    bool open = false;
    Ended ended = find(complex, x, hint, tet);
    for (label n = 0; ended == Ended::boundary && n < maxPutBacks; ++n)
    {
        if (n == 0 && findAround(complex, x, tet.facei, hint))
        {
            ended = find(complex, x, hint, tet);
            continue;
        }
        location.boundaryFace = tet.facei - complex.nInternalFaces();
        open = open || complex.kinds()[location.boundaryFace] == BoundaryKind::open;
        location.position = putBack(complex, tet, hint.cell, location.position);
        ended = find(complex, location.position, hint, tet);
    }
    if (ended == Ended::elsewhere)
    {
        location.where = Location::Where::elsewhere;
        return location;
    }
    if (ended == Ended::failed)
    {
        return location;
    }
    location.cell = hint.cell;
    settle(complex, tet, ended == Ended::boundary, location);
    const vector moved = location.position - x;
    if (magSqr(moved) > 0 && magSqr(moved) > sqr(trusted * radius(complex, hint.cell)))
    {
        return location;
    }
    location.where = open ? Location::Where::outside : Location::Where::inside;
    return location;
}

} // namespace Foam::stability
