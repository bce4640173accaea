// SPDX-License-Identifier: GPL-3.0-or-later

#include "shapes/CutOut.H"

#include "core/cells/ThinWallPoints.H"
#include "core/cells/ThinWallSearch.H"

namespace Foam::stability::shapes
{

namespace
{

// New number of each cell, -1 for those in the obstacle.
labelList
renumber(const CellComplex& complex, const std::function<bool(const point&)>& obstacle)
{
    labelList numbers(complex.nCells(), -1);
    label n = 0;
    forAll(numbers, celli)
    {
        if (!obstacle(complex.cellCentres()[celli]))
        {
            numbers[celli] = n++;
        }
    }
    return numbers;
}

void append(CellComplexInput& to, const face& f, label owner)
{
    to.faces.append(f);
    to.owner.append(owner);
}

void appendBoundary(
    CellComplexInput& to, const face& f, label owner, BoundaryKind kind, label patch
)
{
    append(to, f, owner);
    to.kinds.append(kind);
    to.patches.append(patch);
}

} // namespace

CellComplexInput cutOut(
    const CellComplexInput& from, const std::function<bool(const point&)>& obstacle,
    const std::function<bool(const point&)>& baffle
)
{
    const CellComplex complex(from);
    const labelList numbers = renumber(complex, obstacle);
    const label nInternal = from.neighbour.size();
    const label patch = from.patchNames.size();

    CellComplexInput to;
    to.nCells = max(numbers) + 1;
    to.points = from.points;
    to.patchNames = from.patchNames;
    to.patchNames.append("obstacle");

    const auto stays = [&](label facei)
    {
        return numbers[from.owner[facei]] >= 0 && numbers[from.neighbour[facei]] >= 0
               && !baffle(complex.faceCentres()[facei]);
    };
    for (label facei = 0; facei < nInternal; ++facei)
    {
        if (stays(facei))
        {
            append(to, from.faces[facei], numbers[from.owner[facei]]);
            to.neighbour.append(numbers[from.neighbour[facei]]);
        }
    }
    for (label facei = nInternal; facei < from.faces.size(); ++facei)
    {
        const label owner = numbers[from.owner[facei]];
        const label i = facei - nInternal;
        if (owner >= 0)
        {
            appendBoundary(
                to, from.faces[facei], owner, from.kinds[i], from.patches[i]
            );
        }
    }
    for (label facei = 0; facei < nInternal; ++facei)
    {
        const label owner = numbers[from.owner[facei]];
        const label neighbour = numbers[from.neighbour[facei]];
        const face& f = from.faces[facei];
        if (!stays(facei) && owner >= 0)
        {
            appendBoundary(to, f, owner, BoundaryKind::wall, patch);
        }
        if (!stays(facei) && neighbour >= 0)
        {
            appendBoundary(to, f.reverseFace(), neighbour, BoundaryKind::wall, patch);
        }
    }
    return to;
}

std::shared_ptr<const CellComplex> withThinWalls(CellComplexInput mesh)
{
    splitThinWallPoints(mesh);
    WholeMesh whole(CellComplex(mesh).whole());
    whole.thinWalls = findThinWalls(mesh, nullptr, SerialExchange());
    mesh.whole = whole;
    return std::make_shared<const CellComplex>(std::move(mesh));
}

} // namespace Foam::stability::shapes
