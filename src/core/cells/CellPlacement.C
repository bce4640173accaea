// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/cells/CellPlacement.H"
#include "triPointRef.H"

namespace Foam::stability
{

namespace
{

// How far x lies beyond the planes of the cell's faces [m]; zero within the cell and
// within round-off of its faces.
scalar transgression(const CellComplex& complex, label celli, const point& x)
{
    scalar largest = roundOffOfPlanes * complex.cellSizes()[celli];
    const scalar tolerance = largest;
    for (const label facei : complex.cellFaces()[celli])
    {
        const vector& S = complex.faceAreas()[facei];
        const scalar outwards = complex.owner()[facei] == celli ? 1 : -1;
        const scalar area = mag(S);
        if (area > 0)
        {
            const vector arm =
                complex.whole().inMiddle(x) - complex.faceCentres()[facei];
            largest = max(largest, outwards * (arm & S) / area);
        }
    }
    return largest - tolerance;
}

// True where a face, taken as triangles around its centre, passes x at this distance
// [m] or less.
bool passes(const CellComplex& complex, label facei, const point& x, scalar distance)
{
    const pointField& points = complex.points();
    const point& centre = complex.faceCentres()[facei];
    const face& f = complex.faces()[facei];
    forAll(f, k)
    {
        const triPointRef triangle(centre, points[f[k]], points[f.nextLabel(k)]);
        if (triangle.nearestPoint(complex.whole().inMiddle(x)).distance() <= distance)
        {
            return true;
        }
    }
    return false;
}

} // namespace

label holdingCell(
    const CellComplex& complex, const UList<label>& candidates, const point& x
)
{
    label best = candidates[0];
    scalar least = GREAT;
    for (const label celli : candidates)
    {
        const scalar beyond = transgression(complex, celli, x);
        if (beyond < least)
        {
            best = celli;
            least = beyond;
        }
    }
    return best;
}

bool liesWithin(const CellComplex& complex, label celli, const point& x, scalar beyond)
{
    const scalar allowed = (beyond - roundOffOfPlanes) * complex.cellSizes()[celli];
    return transgression(complex, celli, x) <= allowed;
}

label boundaryFaceAt(
    const CellComplex& complex, label celli, const point& x, scalar tolerance
)
{
    label lowest = -1;
    for (const label ownFacei : complex.cellFaces()[celli])
    {
        for (const label pointi : complex.faces()[ownFacei])
        {
            for (const label facei : complex.pointBoundaryFaces()[pointi])
            {
                const label boundaryFacei = facei - complex.nInternalFaces();
                if ((lowest < 0 || boundaryFacei < lowest)
                    && passes(complex, facei, x, tolerance))
                {
                    lowest = boundaryFacei;
                }
            }
        }
    }
    return lowest;
}

} // namespace Foam::stability
