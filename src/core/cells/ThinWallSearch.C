// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/cells/ThinWallSearch.H"

#include "core/cells/CanonicalOrder.H"

#include <algorithm>
#include <vector>

namespace Foam::stability
{

namespace
{

// Three points of a face that tell it from all others but the one behind it.
struct FacePlace
{
    point lowest[3]; // [m], ascending

    bool operator<(const FacePlace& other) const
    {
        return std::lexicographical_compare(
            lowest, lowest + 3, other.lowest, other.lowest + 3, beforeByPosition
        );
    }
    bool operator==(const FacePlace& other) const
    {
        return std::equal(lowest, lowest + 3, other.lowest);
    }
};

struct PlacedFace
{
    FacePlace place;
    label facei;

    bool operator<(const PlacedFace& other) const { return place < other.place; }
};

// The boundary faces, without those behind which the mesh goes on, by their places.
std::vector<PlacedFace> placedFaces(const CellComplexInput& mesh)
{
    std::vector<PlacedFace> faces;
    const label nInternal = mesh.neighbour.size();
    forAll(mesh.kinds, i)
    {
        if (mesh.kinds[i] == BoundaryKind::coupledUnknown)
        {
            continue;
        }
        const face& f = mesh.faces[nInternal + i];
        PlacedFace placed;
        placed.facei = nInternal + i;
        const pointField points(mesh.points, f);
        std::partial_sort_copy(
            points.begin(), points.end(), placed.place.lowest, placed.place.lowest + 3,
            beforeByPosition
        );
        faces.push_back(placed);
    }
    std::sort(faces.begin(), faces.end());
    return faces;
}

// Moves the faces that lie back to back from `faces` to the result, one of each pair.
std::vector<PlacedFace> takePairs(std::vector<PlacedFace>& faces)
{
    std::vector<PlacedFace> pairs, single;
    for (std::size_t i = 0; i < faces.size(); ++i)
    {
        if (i + 1 < faces.size() && faces[i].place == faces[i + 1].place)
        {
            pairs.push_back(faces[i++]);
        }
        else
        {
            single.push_back(faces[i]);
        }
    }
    faces = std::move(single);
    return pairs;
}

// Appends the faces whose other side is on a higher rank to the pairs.
void addPairsOfRanks(
    const CellComplexInput& mesh, const std::vector<PlacedFace>& single,
    const Exchange& exchange, std::vector<PlacedFace>& pairs
)
{
    Packet mine;
    mine.put(boundBox(mesh.points, false));
    std::vector<DynamicList<FacePlace>> toRanks(exchange.nRanks());
    label ranki = 0;
    for (Packet& packet : exchange.toAll(mine))
    {
        const boundBox box(packet.get<boundBox>());
        for (const PlacedFace& face : single)
        {
            if (ranki < exchange.rank() && box.contains(face.place.lowest[0]))
            {
                toRanks[ranki].append(face.place);
            }
        }
        ++ranki;
    }
    for (const List<FacePlace>& places : exchange.exchangeLists(toRanks))
    {
        for (const FacePlace& place : places)
        {
            const PlacedFace wanted{place, -1};
            const auto found = std::lower_bound(single.begin(), single.end(), wanted);
            if (found != single.end() && found->place == place)
            {
                pairs.push_back(*found);
            }
        }
    }
}

} // namespace

std::shared_ptr<const ThinWalls> findThinWalls(
    const CellComplexInput& own, const PeriodicImages* images, const Exchange& exchange
)
{
    std::vector<PlacedFace> single(placedFaces(own));
    std::vector<PlacedFace> pairs(takePairs(single));
    if (exchange.nRanks() > 1)
    {
        addPairsOfRanks(own, single, exchange, pairs);
    }
    DynamicList<ThinWalls::Triangle> here;
    for (const PlacedFace& pair : pairs)
    {
        const face& f = own.faces[pair.facei];
        for (label k = 1; k + 1 < f.size(); ++k)
        {
            here.append({own.points[f[0]], own.points[f[k]], own.points[f[k + 1]]});
        }
    }
    if (exchange.total(here.size()) == 0)
    {
        return nullptr;
    }
    Packet mine;
    mine.putList(here);
    std::vector<ThinWalls::Triangle> all;
    for (Packet& packet : exchange.toAll(mine))
    {
        const auto there = packet.getList<ThinWalls::Triangle>();
        all.insert(all.end(), there.begin(), there.end());
    }
    const std::size_t nReal = all.size();
    for (label image = 1; images && image < images->nNearby(); ++image)
    {
        const RigidMotion& motion = images->motion(image);
        for (std::size_t i = 0; i < nReal; ++i)
        {
            const ThinWalls::Triangle t(all[i]);
            all.push_back({motion(t[0]), motion(t[1]), motion(t[2])});
        }
    }
    return std::make_shared<const ThinWalls>(std::move(all));
}

} // namespace Foam::stability
