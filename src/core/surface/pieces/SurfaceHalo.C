// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/surface/pieces/SurfaceHalo.H"

#include "core/surface/pieces/SurfaceImages.H"

#include <map>

namespace Foam::stability
{

namespace
{

// The triangles of a mesh, or of its image, by the voxels that they may be in.
VoxelIndex
indexOf(const InterfaceMesh& mesh, scalar voxelSize, const RigidMotion* motion)
{
    pointField points(mesh.points);
    if (motion)
    {
        for (point& x : points)
        {
            x = (*motion)(x);
        }
    }
    VoxelIndex index(voxelSize);
    for (const triFace& t : mesh.triangles)
    {
        boundBox box(points[t[0]], points[t[0]]);
        box.add(points[t[1]]);
        box.add(points[t[2]]);
        index.add(box);
    }
    return index;
}

boundBox moved(const boundBox& box, const RigidMotion& motion)
{
    boundBox result;
    const pointField corners(box.points());
    for (const point& x : corners)
    {
        result.add(motion(x));
    }
    return result;
}

} // namespace

SurfaceHalo::SurfaceHalo(
    const SurfacePiece& owned, const VoxelMask& wanted, const Exchange& exchange,
    const PeriodicImages* images
)
    : exchange_(exchange), images_(images), nOwnedPoints_(owned.mesh.points.size()),
      nOwnedTriangles_(owned.mesh.triangles.size()), sent_(exchange.nRanks())
{
    std::vector<SurfacePiece> parts{owned};
    if (exchange.nRanks() > 1 || images)
    {
        const auto asked = askFor(boundBox(owned.mesh.points, false), wanted, images);
        std::vector<Packet> answers;
        runOnAllRanks(
            exchange, [&] { answers = answer(owned, asked, wanted.size(), images); }
        );
        answers = exchange.exchange(std::move(answers));
        runOnAllRanks(
            exchange,
            [&]
            {
                for (Packet& packet : answers)
                {
                    while (!packet.atEnd())
                    {
                        parts.push_back(unpackedSurface(packet));
                    }
                }
            }
        );
    }
    runOnAllRanks(
        exchange,
        [&]
        {
            if (images)
            {
                fitTogether(parts);
            }
            joined_ = join(parts);
        }
    );
}

std::vector<Packet> SurfaceHalo::answer(
    const SurfacePiece& owned, const std::vector<std::vector<Question>>& asked,
    scalar voxelSize, const PeriodicImages* images
)
{
    std::vector<Packet> answers(asked.size());
    std::map<label, VoxelIndex> indices; // by image
    for (std::size_t ranki = 0; ranki < asked.size(); ++ranki)
    {
        DynamicList<label> sent;
        for (const Question& question : asked[ranki])
        {
            const RigidMotion* motion =
                question.image ? &images->motion(question.image) : nullptr;
            if (!indices.count(question.image))
            {
                indices.emplace(question.image, indexOf(owned.mesh, voxelSize, motion));
            }
            const DynamicList<label> found(
                indices.at(question.image).meeting(question.voxels)
            );
            sent.append(found);
            if (!found.empty())
            {
                SurfacePiece part(partOf(owned, found));
                pack(
                    motion ? imageOf(part, question.image, *images) : part,
                    answers[ranki]
                );
            }
        }
        sent_[ranki] = sent;
    }
    return answers;
}

// Sends requests to the other ranks; returns those of each rank to this one.
std::vector<std::vector<SurfaceHalo::Question>> SurfaceHalo::askFor(
    const boundBox& owned, const VoxelMask& wanted, const PeriodicImages* images
) const
{
    Packet mine;
    mine.put(owned);
    std::vector<Packet> boxes = exchange_.toAll(mine);
    std::vector<Packet> questions(exchange_.nRanks());
    for (label ranki = 0; ranki < exchange_.nRanks(); ++ranki)
    {
        const boundBox box(boxes[ranki].get<boundBox>());
        const label n = !box.valid() ? 0 : images ? images->nNearby() : 1;
        for (label image = ranki == exchange_.rank(); image < n; ++image)
        {
            const DynamicList<VoxelMask::Voxel> voxels(
                wanted.within(image ? moved(box, images->motion(image)) : box)
            );
            if (!voxels.empty())
            {
                questions[ranki].put(image);
                questions[ranki].putList(voxels);
            }
        }
    }
    std::vector<std::vector<Question>> asked;
    for (Packet& packet : exchange_.exchange(std::move(questions)))
    {
        asked.emplace_back();
        while (!packet.atEnd())
        {
            const label image = packet.get<label>();
            asked.back().push_back({image, packet.getList<VoxelMask::Voxel>()});
        }
    }
    return asked;
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

// Triangles of a cell may meet a point in several of their images: then the point
// counts in the one that is the same for all images of the point.
List<bool> SurfaceHalo::primaryPoints() const
{
    const List<TriangleKey>& keys = piece().keys;
    labelList first(mesh().points.size(), -1);
    std::map<label, DynamicList<label>> several; // images, by points
    forAll(mesh().triangles, trianglei)
    {
        for (const label pointi : mesh().triangles[trianglei])
        {
            if (first[pointi] < 0)
            {
                first[pointi] = trianglei;
                continue;
            }
            const TriangleKey& lowest = keys[first[pointi]];
            const TriangleKey& key = keys[trianglei];
            if (images_ && key.where == lowest.where && key.image != lowest.image)
            {
                DynamicList<label>& images = several[pointi];
                for (const label image : {lowest.image, key.image})
                {
                    if (!images.found(image))
                    {
                        images.append(image);
                    }
                }
            }
        }
    }
    List<bool> result(first.size(), false);
    forAll(result, pointi)
    {
        result[pointi] = first[pointi] >= 0 && isOwn(first[pointi]);
    }
    for (const auto& [pointi, images] : several)
    {
        result[pointi] = result[pointi] && images_->representative(images) == 0;
    }
    return result;
}

} // namespace Foam::stability
