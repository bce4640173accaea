// SPDX-License-Identifier: GPL-3.0-or-later

#include "shapes/SurfaceChecks.H"

#include <map>
#include <utility>
#include <vector>

namespace Foam::stability::shapes
{

SurfaceReport inspect(const InterfaceMesh& mesh)
{
    struct Uses
    {
        label up = 0, down = 0;
    };
    std::map<std::pair<label, label>, Uses> edges;
    std::vector<bool> used(mesh.points.size(), false);
    for (const triFace& t : mesh.triangles)
    {
        for (label k = 0; k < 3; ++k)
        {
            const label a = t[k];
            const label b = t[(k + 1) % 3];
            Uses& uses = edges[{std::min(a, b), std::max(a, b)}];
            ++(a < b ? uses.up : uses.down);
            used[a] = true;
        }
    }
    SurfaceReport report;
    for (const auto& [ends, uses] : edges)
    {
        const label n = uses.up + uses.down;
        report.nCrowded += n > 2;
        report.nRim += n == 1;
        report.nRimInside += n == 1
                             && (mesh.boundaryFaces[ends.first] < 0
                                 || mesh.boundaryFaces[ends.second] < 0);
        report.nMisoriented += n == 2 && uses.up != 1;
    }
    report.euler = mesh.points.size() - label(edges.size()) + mesh.triangles.size();
    for (const bool isUsed : used)
    {
        report.nUnused += !isUsed;
    }
    return report;
}

scalar enclosedVolume(const InterfaceMesh& mesh)
{
    scalar flux = 0;
    forAll(mesh.triangles, trianglei)
    {
        const vector arm = mesh.centre(trianglei) - mesh.points[0];
        flux += arm & mesh.areaVector(trianglei);
    }
    return flux / 3;
}

} // namespace Foam::stability::shapes
