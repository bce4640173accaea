// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/parametrization/DiskBoundary.H"

#include "core/base/Errors.H"
#include "core/parametrization/seams/EdgePaths.H"
#include "core/parametrization/SurfaceShape.H"

namespace Foam::stability
{

labelList diskBoundary(const PlainSurface& surface)
{
    List<labelList> loops = boundaryLoops(surface.points.size(), surface.triangles);
    if (loops.size() != 1)
    {
        throw NumericalFailure("it is not a disk");
    }
    return loops[0];
}

labelPair farPair(const PlainSurface& surface, const labelList& boundary)
{
    const SurfaceTopology topology(surface.points.size(), surface.triangles);
    label from = boundary[0];
    label to = from;
    for (label sweep = 0; sweep < 2; ++sweep)
    {
        const scalarField distances =
            EdgePaths(surface.points, topology, labelList(1, to)).distances();
        from = to;
        for (const label pointi : boundary)
        {
            to = distances[pointi] > distances[to] ? pointi : to;
        }
    }
    return labelPair(from, to);
}

} // namespace Foam::stability
