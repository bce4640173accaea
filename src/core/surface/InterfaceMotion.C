// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/surface/InterfaceMotion.H"
#include "core/surface/TaubinSmoothing.H"
#include "core/cells/CellPlacement.H"

#include <algorithm>
#include <cmath>

namespace Foam::stability
{

namespace
{

void addNew(const UList<label>& values, DynamicList<label>& list)
{
    for (const label value : values)
    {
        if (!list.found(value))
        {
            list.append(value);
        }
    }
}

// Shortens the move so that it covers at most half the distance to each of these
// boundary faces. The move of a point on the boundary is scaled as a whole, so that it
// stays there.
void keepInside(
    const CellComplex& complex, const UList<label>& walls, const point& x, bool onWall,
    vector& move
)
{
    for (const label facei : walls)
    {
        const scalar area = mag(complex.faceAreas()[facei]);
        const vector n = complex.faceAreas()[facei] / max(area, VSMALL);
        const scalar distance = (complex.faceCentres()[facei] - x) & n;
        const scalar approach = move & n;
        if (distance < 0 || approach <= 0.5 * distance)
        {
            continue;
        }
        if (!onWall)
        {
            move -= (approach - 0.5 * distance) * n;
        }
        else if (approach > 1e-9 * complex.cellSizes()[complex.owner()[facei]])
        {
            move *= 0.5 * distance / approach;
        }
    }
}

// The first of these boundary faces that x lies on; -1 if it lies on none.
label faceUnder(const CellComplex& complex, const UList<label>& walls, const point& x)
{
    constexpr scalar roundOff = 1e-6; // of the width of the face
    for (const label facei : walls)
    {
        const scalar area = mag(complex.faceAreas()[facei]);
        const vector n = complex.faceAreas()[facei] / max(area, VSMALL);
        const scalar width = std::sqrt(area);
        bool on = mag((x - complex.faceCentres()[facei]) & n) < roundOff * width;
        const face& f = complex.faces()[facei];
        for (label k = 0; on && k < f.size(); ++k)
        {
            const point& a = complex.points()[f[k]];
            const point& b = complex.points()[f.nextLabel(k)];
            on = (((b - a) ^ (x - a)) & n) > -roundOff * width * mag(b - a);
        }
        if (on)
        {
            return facei;
        }
    }
    return -1;
}

// A point on a wall must not slide past the edge where the wall ends.
void keepOnWall(
    const CellComplex& complex, const UList<label>& walls, const point& x, vector& move
)
{
    constexpr label maxHalvings = 3;
    for (label i = 0; i <= maxHalvings; ++i)
    {
        if (faceUnder(complex, walls, x + move) >= 0)
        {
            return;
        }
        move *= 0.5;
    }
    move = Zero;
}

} // namespace

Surroundings::Surroundings(const CellComplex& complex, label celli)
{
    for (const label facei : complex.cellFaces()[celli])
    {
        for (const label pointi : complex.faces()[facei])
        {
            addNew(complex.pointCells()[pointi], cells);
            addNew(complex.pointBoundaryFaces()[pointi], boundaryFaces);
        }
    }
}

ExactSum
moveInterface(InterfaceMesh& mesh, const CellComplex& complex, vectorField moves)
{
    labelList cells(mesh.cells);
    forAll(moves, pointi)
    {
        const point& x = mesh.points[pointi];
        const label celli = mesh.cells[pointi];
        if (celli < 0 || liesWithin(complex, celli, x + moves[pointi]))
        {
            continue;
        }
        const Surroundings around(complex, celli);
        const bool onWall = mesh.boundaryFaces[pointi] >= 0;
        keepInside(complex, around.boundaryFaces, x, onWall, moves[pointi]);
        if (onWall && faceUnder(complex, around.boundaryFaces, x) >= 0)
        {
            keepOnWall(complex, around.boundaryFaces, x, moves[pointi]);
        }
        cells[pointi] = holdingCell(complex, around.cells, x + moves[pointi]);
    }
    const scalarField swept(sweptVolumes(mesh, moves));
    mesh.points += moves;
    mesh.cells = cells;
    forAll(cells, pointi)
    {
        if (cells[pointi] >= 0)
        {
            mesh.cellSizes[pointi] = complex.cellSizes()[cells[pointi]];
        }
    }
    const std::optional<PlaneSection>& section = complex.whole().section;
    ExactSum sum;
    forAll(swept, trianglei)
    {
        if (mesh.triangleCells.empty() || complex.own(mesh.triangleCells[trianglei]))
        {
            sum.add(
                swept[trianglei]
                * (section ? section->factor(mesh.centre(trianglei)) : 1)
            );
        }
    }
    return sum;
}

label settledCell(const CellComplex& complex, label celli, const point& x)
{
    constexpr scalar deep = 0.05; // in cells: warped faces bulge by less
    bool inside = true;
    for (const label facei : complex.cellFaces()[celli])
    {
        const vector& S = complex.faceAreas()[facei];
        const scalar outwards = complex.owner()[facei] == celli ? 1 : -1;
        const scalar distance = outwards * ((x - complex.faceCentres()[facei]) & S);
        inside = inside && distance < -deep * complex.cellSizes()[celli] * mag(S);
    }
    if (inside)
    {
        return celli;
    }
    Surroundings around(complex, celli);
    std::sort(around.cells.begin(), around.cells.end());
    return holdingCell(complex, around.cells, x);
}

void settleInCells(InterfaceMesh& mesh, const CellComplex& complex, label first)
{
    for (label pointi = first; pointi < mesh.cells.size(); ++pointi)
    {
        label& celli = mesh.cells[pointi];
        if (celli >= 0)
        {
            celli = settledCell(complex, celli, mesh.points[pointi]);
            mesh.cellSizes[pointi] = complex.cellSizes()[celli];
        }
    }
}

} // namespace Foam::stability
