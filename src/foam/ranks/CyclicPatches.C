// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/ranks/CyclicPatches.H"

#include "core/base/Errors.H"
#include "foam/errors/Failures.H"
#include "cyclicPolyPatch.H"
#include "processorCyclicPolyPatch.H"

#include <cmath>

namespace Foam::stability
{

namespace
{

constexpr int bits = 42; // of a motion, beyond which ranks may differ

const cyclicPolyPatch& cyclicOf(const polyPatch& patch)
{
    return isA<processorCyclicPolyPatch>(patch) ? refCast<const cyclicPolyPatch>(
               refCast<const processorCyclicPolyPatch>(patch).referPatch()
           )
                                                : refCast<const cyclicPolyPatch>(patch);
}

// Both halves of a cyclic pair return the index of the half that OpenFOAM calls the
// owner.
label pairOf(const cyclicPolyPatch& patch)
{
    return patch.owner() ? patch.index() : patch.neighbPatchID();
}

scalar rounded(scalar value, scalar size)
{
    const scalar unit = std::ldexp(scalar(1), std::ilogb(size) + 1 - bits);
    return unit * std::round(value / unit);
}

// OpenFOAM finds it by the means of faces, which are others on each rank, by round-off.
RigidMotion motionOf(const cyclicPolyPatch& patch, scalar size)
{
    if (patch.forwardT().size() > 1 || patch.separation().size() > 1)
    {
        throw BadInput(
            "The cyclic patch " + patch.name()
            + " has another transformation at each face, which interfaceStability does "
              "not support."
        );
    }
    RigidMotion motion;
    if (!patch.parallel())
    {
        for (direction i = 0; i < tensor::nComponents; ++i)
        {
            motion.rotation[i] = rounded(patch.forwardT()[0][i], 1);
        }
    }
    pointField origin(1, Zero);
    patch.transformPosition(origin);
    for (direction i = 0; i < vector::nComponents; ++i)
    {
        motion.shift[i] = rounded(origin[0][i], size);
    }
    return motion;
}

} // namespace

bool CyclicPatches::contain(const polyPatch& patch) const
{
    return (isA<cyclicPolyPatch>(patch) || isA<processorCyclicPolyPatch>(patch))
           && !ends_.found(patch.index());
}

CyclicPatches::CyclicPatches(
    const polyMesh& mesh, const Exchange& exchange, const labelHashSet& ends
)
    : ends_(ends), places_(mesh.boundaryMesh().size(), -1)
{
    const scalar size = mesh.bounds().mag(); // of all ranks
    DynamicList<label> pairs;
    DynamicList<RigidMotion> here;
    exchange.throwIfAny<BadInput>(failureOf(
        [&]
        {
            for (const polyPatch& patch : mesh.boundaryMesh())
            {
                if (contain(patch) && !patch.empty()
                    && !pairs.found(pairOf(cyclicOf(patch))))
                {
                    pairs.append(pairOf(cyclicOf(patch)));
                    here.append(stability::motionOf(
                        refCast<const cyclicPolyPatch>(mesh.boundaryMesh()[pairs.last()]
                        ),
                        size
                    ));
                }
            }
        }
    ));
    Packet mine;
    mine.putList(pairs);
    mine.putList(here);
    std::map<label, RigidMotion> all; // that of the lowest rank
    for (Packet& packet : exchange.toAll(mine))
    {
        const List<label> there(packet.getList<label>());
        const List<RigidMotion> motions(packet.getList<RigidMotion>());
        forAll(there, i)
        {
            all.insert({there[i], motions[i]});
        }
    }
    for (const auto& [pair, motion] : all)
    {
        places_[pair] = label(motions_.size());
        motions_.push_back(motion);
    }
}

RigidMotion CyclicPatches::motionOf(const polyPatch& patch) const
{
    const cyclicPolyPatch& cyclic = cyclicOf(patch);
    const RigidMotion& motion = motions_[places_[pairOf(cyclic)]];
    return cyclic.owner() ? motion : motion.inverse();
}

} // namespace Foam::stability
