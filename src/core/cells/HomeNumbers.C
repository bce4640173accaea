// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/cells/HomeNumbers.H"

#include "core/cells/CanonicalOrder.H"

#include <algorithm>

namespace Foam::stability
{

namespace
{

// Summed in an order that does not depend on the numbering of the piece.
pointField meansOfCells(const CellComplexInput& mesh)
{
    const Rows cellFaces(facesOfCells(mesh));
    pointField means(cellFaces.size(), Zero);
    DynamicList<label> around;
    for (label celli = 0; celli < means.size(); ++celli)
    {
        around.clear();
        for (const label facei : cellFaces[celli])
        {
            around.append(mesh.faces[facei]);
        }
        std::sort(
            around.begin(), around.end(),
            [&](label a, label b)
            {
                return mesh.points[a] == mesh.points[b]
                           ? a < b
                           : beforeByPosition(mesh.points[a], mesh.points[b]);
            }
        );
        const auto end = std::unique(around.begin(), around.end());
        for (auto pointi = around.begin(); pointi != end; ++pointi)
        {
            means[celli] += mesh.points[*pointi];
        }
        means[celli] /= scalar(end - around.begin());
    }
    return means;
}

} // namespace

void numberFromHome(
    CellComplexInput& piece, const labelList& homePoints, const pointField& homes,
    const PeriodicImages& images
)
{
    piece.homes = homes;
    forAll(homePoints, pointi)
    {
        const bool atHome = homePoints[pointi] == piece.globalPoints[pointi];
        const point& home = homes[pointi];
        piece.globalPoints[pointi] = images.point(
            homePoints[pointi], home,
            atHome ? 0 : images.imageAt(piece.points[pointi], home)
        );
        piece.points[pointi] = images.place(piece.globalPoints[pointi], home);
    }
    piece.cellHomes = meansOfCells(piece);
}

} // namespace Foam::stability
