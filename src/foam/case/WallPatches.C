// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/case/WallPatches.H"

#include "core/ranks/ExactSum.H"
#include "HashSet.H"
#include "fvMesh.H"
#include "sigFpe.H"
#include "wallPolyPatch.H"

namespace Foam::stability
{

namespace
{

constexpr scalar along = 1e-4; // largest normal component, in the largest speed

const wordHashSet& wallConditions()
{
    static const wordHashSet names{
        "noSlip",
        "slip",
        "partialSlip",
        "movingWallVelocity",
        "rotatingWallVelocity",
        "translatingWallVelocity"};
    return names;
}

bool mayBeWall(const polyPatch& patch)
{
    return !patch.coupled() && !isA<wallPolyPatch>(patch)
           && !polyPatch::constraintType(patch.type());
}

// The largest component of the values along the normals, and the largest value.
struct Largest
{
    scalar normal = 0, size = 0; // [m/s]
};

Largest largestValues(const fvPatchVectorField& values)
{
    const sigFpe::ignore untrapped; // what is not finite is told later
    const vectorField normals(values.patch().nf());
    Largest largest;
    forAll(values, i)
    {
        largest.normal = max(largest.normal, mag(values[i] & normals[i]));
        largest.size = max(largest.size, mag(values[i]));
    }
    return largest;
}

} // namespace

DynamicList<WallPatch> wallPatches(const volVectorField& U, const Exchange& exchange)
{
    DynamicList<WallPatch> walls;
    for (const fvPatchVectorField& values : U.boundaryField())
    {
        const polyPatch& patch = values.patch().patch();
        const bool byName = wallConditions().found(values.type());
        // All ranks agree so far: the patches between ranks are coupled.
        if (!mayBeWall(patch) || (!byName && values.type() != "fixedValue")
            || exchange.total(patch.size()) == 0)
        {
            continue;
        }
        const Largest here(largestValues(values));
        const scalar normal = largest(here.normal, exchange);
        if (byName || normal <= along * largest(here.size, exchange))
        {
            walls.append(WallPatch{patch.name(), values.type()});
        }
    }
    return walls;
}

} // namespace Foam::stability
