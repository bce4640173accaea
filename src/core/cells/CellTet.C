// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/cells/CellTet.H"

namespace Foam::stability
{

namespace
{

// Volume over the product of the edges at the centre, below which there is none.
constexpr scalar flat = 1e-14;

// Which tetrahedra `weigh` is to look at.
enum class Wanted : unsigned char
{
    cone, // only those whose cone holds x: quick to refuse
    any
};

// Sets w; false for a tetrahedron that is not wanted, flat or inside out.
bool weigh(
    const CellComplex& complex, label celli, label facei, label k, const point& x,
    Wanted wanted, CellTet& tet
)
{
    const face& f = complex.faces()[facei];
    const label base = complex.tetBase()[facei];
    const label n = f.size();
    const label second = base + 1 + k;
    const label third = second + 1;
    tet.facei = facei;
    tet.points[0] = f[base];
    tet.points[1] = f[second < n ? second : second - n];
    tet.points[2] = f[third < n ? third : third - n];

    const pointField& points = complex.points();
    const point& centre = complex.cellCentres()[celli];
    const vector a = points[tet.points[0]] - centre;
    const vector b = points[tet.points[1]] - centre;
    const vector c = points[tet.points[2]] - centre;
    const vector d = x - centre;

    // Six times signed volumes, positive for the owner where all is well.
    const scalar sign = complex.owner()[facei] == celli ? 1 : -1;
    const vector bc = b ^ c;
    const scalar volume = sign * (a & bc);
    const scalar v1 = sign * (d & bc);
    if (!(volume > 0) || (wanted == Wanted::cone && v1 < 0))
    {
        return false;
    }
    const scalar v2 = sign * (d & (c ^ a));
    const scalar v3 = sign * (d & (a ^ b));
    const scalar edges = magSqr(a) * magSqr(b) * magSqr(c);
    if ((wanted == Wanted::cone && min(v2, v3) < 0) || sqr(volume) < sqr(flat) * edges)
    {
        return false;
    }
    tet.w[1] = v1 / volume;
    tet.w[2] = v2 / volume;
    tet.w[3] = v3 / volume;
    tet.w[0] = 1 - tet.w[1] - tet.w[2] - tet.w[3];
    return true;
}

// The hinted tetrahedron of the cell; false if it is not the one.
bool tryHint(
    const CellComplex& complex, const point& x, const CellHint& hint, CellTet& tet
)
{
    label k = hint.tet;
    for (const label facei : complex.cellFaces()[hint.cell])
    {
        const label nTets = complex.faces()[facei].size() - 2;
        if (k < nTets)
        {
            return weigh(complex, hint.cell, facei, k, x, Wanted::cone, tet)
                   && tet.holds();
        }
        k -= nTets;
    }
    return false;
}

// Among the wanted ones the first that holds x, else the one whose cone holds it
// best: then x lies beyond its face. False if there is none.
bool chooseTet(
    const CellComplex& complex, const point& x, Wanted wanted, CellHint& hint,
    CellTet& tet
)
{
    scalar deepest = -GREAT;
    label tetIndex = -1;
    CellTet candidate;
    for (const label facei : complex.cellFaces()[hint.cell])
    {
        const label nTets = complex.faces()[facei].size() - 2;
        for (label k = 0; k < nTets; ++k)
        {
            ++tetIndex;
            if (!weigh(complex, hint.cell, facei, k, x, wanted, candidate))
            {
                continue;
            }
            const bool holds = candidate.holds();
            const scalar depth = holds ? GREAT : candidate.coneDepth();
            if (depth > deepest)
            {
                deepest = depth;
                tet = candidate;
                hint.tet = tetIndex;
            }
            if (holds)
            {
                return true;
            }
        }
    }
    return deepest > -GREAT;
}

} // namespace

bool chooseTet(const CellComplex& complex, const point& x, CellHint& hint, CellTet& tet)
{
    return (hint.tet >= 0 && tryHint(complex, x, hint, tet))
           || chooseTet(complex, x, Wanted::cone, hint, tet)
           // Round-off may leave x in no cone at all.
           || chooseTet(complex, x, Wanted::any, hint, tet);
}

} // namespace Foam::stability
