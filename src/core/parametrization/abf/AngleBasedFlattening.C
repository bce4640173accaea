// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/parametrization/abf/AngleBasedFlattening.H"

#include "core/parametrization/DiskBoundary.H"
#include "core/parametrization/abf/AngleLayout.H"
#include "core/parametrization/abf/EliminationOrder.H"

namespace Foam::stability
{

FlatteningResult AngleBasedFlattening::flatten(const PlainSurface& surface) const
{
    const labelList boundary(diskBoundary(surface));
    List<bool> onBoundary(surface.points.size(), false);
    for (const label pointi : boundary)
    {
        onBoundary[pointi] = true;
    }
    const labelList places(eliminationOrder(surface));
    const PlanarAngles planar =
        solveAngles(surface, onBoundary, places, maxIterations_);
    FlatteningResult result;
    result.parameters =
        layOut(surface, planar.angles, places, farPair(surface, boundary));
    result.residual = planar.residual;
    result.iterations = planar.iterations;
    if (!planar.converged && maxIterations_ > 1)
    {
        result.cause = "its angles did not converge";
    }
    return result;
}

} // namespace Foam::stability
