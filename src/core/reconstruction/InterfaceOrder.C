// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/reconstruction/InterfaceOrder.H"

#include <algorithm>
#include <numeric>
#include <vector>

namespace Foam::stability
{

namespace
{

// The triangles of this list, in its order; points by their first triangle.
void keep(InterfaceMesh& mesh, const std::vector<label>& triangles)
{
    const label n = triangles.size();
    labelList numbers(mesh.points.size(), -1);
    DynamicList<label> points;
    List<triFace> kept(n);
    labelList cells(n);
    for (label i = 0; i < n; ++i)
    {
        kept[i] = mesh.triangles[triangles[i]];
        cells[i] = mesh.triangleCells[triangles[i]];
        for (label& pointi : kept[i])
        {
            if (numbers[pointi] < 0)
            {
                numbers[pointi] = points.size();
                points.append(pointi);
            }
            pointi = numbers[pointi];
        }
    }
    mesh.triangles.transfer(kept);
    mesh.triangleCells.transfer(cells);
    mesh.points = pointField(mesh.points, points);
    mesh.cells = labelList(mesh.cells, points);
    mesh.boundaryFaces = labelList(mesh.boundaryFaces, points);
    mesh.cellSizes = scalarField(mesh.cellSizes, points);
    if (!mesh.names.empty())
    {
        mesh.names = List<PointName>(mesh.names, points);
    }
    mesh.clearParametrization();
}

} // namespace

void orderByCells(InterfaceMesh& mesh)
{
    std::vector<label> order(mesh.triangles.size());
    std::iota(order.begin(), order.end(), label(0));
    std::stable_sort(
        order.begin(), order.end(),
        [&](label a, label b) { return mesh.triangleCells[a] < mesh.triangleCells[b]; }
    );
    keep(mesh, order);
}

} // namespace Foam::stability
