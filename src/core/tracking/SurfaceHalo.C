// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

#include "core/tracking/SurfaceHalo.H"

namespace Foam::stability
{

SurfaceHalo::SurfaceHalo(
    const SurfacePiece& held, const VoxelMask& wanted, const Exchange& exchange
)
    : exchange_(exchange), nHeldPoints_(held.mesh.points.size()),
      nHeldTriangles_(held.mesh.triangles.size()), sent_(exchange.nRanks())
{
    std::vector<SurfacePiece> parts{held};
    if (exchange.nRanks() > 1)
    {
        const boundBox bounds(held.mesh.points, false);
        const auto asked = askFor(bounds, wanted);
        std::vector<Packet> answers(exchange.nRanks());
        for (std::size_t ranki = 0; ranki < asked.size(); ++ranki)
        {
            if (asked[ranki].empty())
            {
                continue;
            }
            VoxelMask region(wanted.size());
            region.add(asked[ranki]);
            DynamicList<label> found;
            forAll(held.mesh.triangles, trianglei)
            {
                const triFace& t = held.mesh.triangles[trianglei];
                boundBox box(held.mesh.points[t[0]], held.mesh.points[t[0]]);
                box.add(held.mesh.points[t[1]]);
                box.add(held.mesh.points[t[2]]);
                if (region.meets(box))
                {
                    found.append(trianglei);
                }
            }
            sent_[ranki] = found;
            if (!found.empty())
            {
                pack(partOf(held, found), answers[ranki]);
            }
        }
        for (Packet& packet : exchange.exchange(std::move(answers)))
        {
            if (!packet.empty())
            {
                parts.push_back(unpackedSurface(packet));
            }
        }
    }
    together(exchange, [&] { joined_ = join(parts); });
}

// Per rank the voxels that it asks this one for.
std::vector<List<VoxelMask::Voxel>>
SurfaceHalo::askFor(const boundBox& held, const VoxelMask& wanted) const
{
    Packet mine;
    mine.put(held);
    std::vector<Packet> boxes = exchange_.toAll(mine);
    std::vector<DynamicList<VoxelMask::Voxel>> questions(exchange_.nRanks());
    for (label ranki = 0; ranki < exchange_.nRanks(); ++ranki)
    {
        const boundBox box(boxes[ranki].get<boundBox>());
        if (ranki != exchange_.rank() && box.valid())
        {
            questions[ranki] = wanted.within(box);
        }
    }
    return exchange_.exchangeLists(questions);
}

List<bool> SurfaceHalo::ownTriangles() const
{
    List<bool> own(mesh().triangles.size());
    forAll(own, trianglei)
    {
        own[trianglei] = isOwn(trianglei);
    }
    return own;
}

List<bool> SurfaceHalo::counted() const
{
    List<bool> result(mesh().points.size(), false);
    List<bool> met(mesh().points.size(), false);
    forAll(mesh().triangles, trianglei)
    {
        for (const label pointi : mesh().triangles[trianglei])
        {
            result[pointi] = met[pointi] ? result[pointi] : isOwn(trianglei);
            met[pointi] = true;
        }
    }
    return result;
}

} // namespace Foam::stability
