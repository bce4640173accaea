// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

#include "core/reconstruction/InterfaceMotion.H"
#include "core/mesh/TaubinSmoothing.H"
#include "core/reconstruction/CellPlacement.H"

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

// Points keep half their distance to the walls around their cell. One that lies on a
// wall already is moved less far, so that it stays there.
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

scalar moveInterface(InterfaceMesh& mesh, const CellComplex& complex, vectorField moves)
{
    labelList cells(mesh.cells);
    forAll(moves, pointi)
    {
        const point& x = mesh.points[pointi];
        const label celli = mesh.cells[pointi];
        if (liesWithin(complex, celli, x + moves[pointi]))
        {
            continue;
        }
        const Surroundings around(complex, celli);
        const bool onWall = mesh.boundaryFaces[pointi] >= 0;
        keepInside(complex, around.boundaryFaces, x, onWall, moves[pointi]);
        cells[pointi] = holdingCell(complex, around.cells, x + moves[pointi]);
    }
    const scalar swept = sweptVolume(mesh, moves);
    mesh.points += moves;
    mesh.cells = cells;
    forAll(cells, pointi)
    {
        mesh.cellSizes[pointi] = complex.cellSizes()[cells[pointi]];
    }
    return swept;
}

} // namespace Foam::stability
