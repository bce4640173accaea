// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/surface/pieces/SharedPoints.H"

#include "core/surface/pieces/PointNumbers.H"

#include <algorithm>
#include <map>
#include <unordered_map>

namespace Foam::stability
{

namespace
{

struct HashOfName
{
    std::size_t operator()(const PointName& name) const
    {
        std::uint64_t sum = 0;
        for (const label part : name)
        {
            sum = 0x9e3779b97f4a7c15 * (sum ^ std::uint64_t(part));
            sum ^= sum >> 32;
        }
        return sum;
    }
};

// What the ranks agree on.
struct Agreed
{
    label number, cell;
    point x;
    scalar cellSize, spread;
};

struct Claim
{
    PointName name;
    Agreed value;
};

// For each point: bit 1 where an own triangle has it, bit 2 where one of another rank
// has it.
template<class IsOwn>
std::vector<char>
holdersOf(label nPoints, const UList<triFace>& triangles, const IsOwn& isOwn)
{
    std::vector<char> holders(nPoints, 0);
    forAll(triangles, trianglei)
    {
        const char holder = isOwn(trianglei) ? 1 : 2;
        for (const label pointi : triangles[trianglei])
        {
            holders[pointi] |= holder;
        }
    }
    return holders;
}

constexpr char both = 3;

// The corners that all parents of a new point have: the edge that it lies on.
using Corners = std::vector<label>;

std::map<label, Corners> edgesOfNewPoints(
    const InterfaceMesh& mesh, const labelList& parents, const SurfacePiece& piece,
    const std::vector<char>& holders
)
{
    std::map<label, Corners> edges;
    forAll(mesh.triangles, trianglei)
    {
        const triFace& parent = piece.mesh.triangles[parents[trianglei]];
        for (const label pointi : mesh.triangles[trianglei])
        {
            if (pointi < piece.mesh.points.size() || holders[pointi] != both)
            {
                continue;
            }
            const auto known = edges.insert({pointi, {parent.begin(), parent.end()}});
            Corners& common = known.first->second;
            common.erase(
                std::remove_if(
                    common.begin(), common.end(),
                    [&](label corner) { return !parent.found(corner); }
                ),
                common.end()
            );
        }
    }
    return edges;
}

// The names of new points, by their place along their edge from its lower end.
std::map<label, PointName> namesOfNewPoints(
    const std::map<label, Corners>& edges, const InterfaceMesh& mesh,
    const SurfacePiece& piece
)
{
    std::map<std::pair<label, label>, std::vector<label>> onEdges;
    for (const auto& [pointi, corners] : edges)
    {
        if (corners.size() != 2)
        {
            throw NumericalFailure("A point that ranks share is not on one edge.");
        }
        label a = corners[0], b = corners[1];
        if (piece.pointKeys[b] < piece.pointKeys[a])
        {
            std::swap(a, b);
        }
        onEdges[{a, b}].push_back(pointi);
    }
    std::map<label, PointName> names;
    for (auto& [edge, points] : onEdges)
    {
        const point& start = mesh.points[edge.first];
        std::sort(
            points.begin(), points.end(),
            [&](label i, label j)
            { return magSqr(mesh.points[i] - start) < magSqr(mesh.points[j] - start); }
        );
        const PointKey a = piece.pointKeys[edge.first],
                       b = piece.pointKeys[edge.second];
        for (std::size_t i = 0; i < points.size(); ++i)
        {
            names[points[i]] = {label(i), a.number, a.image, b.number, b.image, 0};
        }
    }
    return names;
}

// The answers to claims, from the ranks that they are sent to. `next` is the number of
// points that this rank does not share; it becomes the first number for these.
// Collective.
std::vector<List<Agreed>> settled(
    const std::vector<DynamicList<Claim>>& claims, label& next, const Exchange& exchange
)
{
    const std::vector<List<Claim>> toMe(exchange.exchangeLists(claims));
    std::unordered_map<PointName, Agreed, HashOfName> agreed;
    for (const List<Claim>& some : toMe) // the lowest rank's first
    {
        for (const Claim& claim : some)
        {
            Agreed value(claim.value);
            value.number = label(agreed.size());
            agreed.insert({claim.name, value});
        }
    }
    const label first = sumBefore(label(agreed.size()) + next, exchange);
    next = first + label(agreed.size());
    std::vector<DynamicList<Agreed>> answers(toMe.size());
    for (std::size_t ranki = 0; ranki < toMe.size(); ++ranki)
    {
        for (const Claim& claim : toMe[ranki])
        {
            answers[ranki].append(agreed.at(claim.name));
            answers[ranki].last().number += first;
        }
    }
    return exchange.exchangeLists(answers);
}

} // namespace

List<NamedPoint> sharedPoints(
    const InterfaceMesh& extracted, const labelList& kept, const CellComplex& complex
)
{
    DynamicList<NamedPoint> shared;
    if (!extracted.names.empty())
    {
        const std::vector<char> holders(holdersOf(
            extracted.points.size(), extracted.triangles,
            [&](label i) { return complex.own(extracted.triangleCells[i]); }
        ));
        forAll(kept, i)
        {
            if (holders[kept[i]] == both)
            {
                shared.append({i, extracted.names[kept[i]]});
            }
        }
    }
    return List<NamedPoint>(std::move(shared));
}

List<NamedPoint> sharedPoints(
    const JoinedSurface& own, const InterfaceMesh& mesh, const labelList& parents,
    const SurfacePiece& piece, const UList<bool>& isOwn
)
{
    DynamicList<NamedPoint> shared;
    if (own.piece.sharesPoints)
    {
        const std::vector<char> holders(holdersOf(
            mesh.points.size(), mesh.triangles,
            [&](label i) { return isOwn[parents[i]]; }
        ));
        const std::map<label, PointName> names(namesOfNewPoints(
            edgesOfNewPoints(mesh, parents, piece, holders), mesh, piece
        ));
        forAll(own.pointSources, i)
        {
            const label pointi = own.pointSources[i];
            if (holders[pointi] != both)
            {
                continue;
            }
            const PointKey& key = own.piece.pointKeys[i];
            const auto isNew = names.find(pointi);
            shared.append(
                {i, isNew != names.end()
                        ? isNew->second
                        : PointName{-1, key.number, key.image, 0, 0, 0}}
            );
        }
    }
    return List<NamedPoint>(std::move(shared));
}

void agreeOnPoints(
    SurfacePiece& piece, scalarField& spread, const List<NamedPoint>& shared,
    const Exchange& exchange
)
{
    const std::size_t nRanks = exchange.nRanks();
    InterfaceMesh& mesh = piece.mesh;
    std::vector<DynamicList<Claim>> claims(nRanks);
    std::vector<DynamicList<label>> claimed(nRanks);
    for (const NamedPoint& named : shared)
    {
        const label i = named.pointi;
        const std::size_t ranki = HashOfName()(named.name) % nRanks;
        claims[ranki].append(
            {named.name,
             {-1, mesh.cells[i], mesh.points[i], mesh.cellSizes[i], spread[i]}}
        );
        claimed[ranki].append(i);
    }
    label next = mesh.points.size() - shared.size();
    const std::vector<List<Agreed>> answers(settled(claims, next, exchange));
    piece.pointKeys = PointKey();
    for (std::size_t ranki = 0; ranki < nRanks; ++ranki)
    {
        forAll(claimed[ranki], k)
        {
            const label i = claimed[ranki][k];
            const Agreed& value = answers[ranki][k];
            piece.pointKeys[i].number = value.number;
            mesh.points[i] = piece.startPositions[i] = value.x;
            mesh.cells[i] = value.cell;
            mesh.cellSizes[i] = value.cellSize;
            spread[i] = value.spread;
        }
    }
    for (PointKey& key : piece.pointKeys)
    {
        key.number = key.number < 0 ? next++ : key.number;
    }
}

void agreeOnPoints(
    SurfacePiece& piece, const List<NamedPoint>& shared, const Exchange& exchange
)
{
    scalarField none(piece.mesh.points.size(), 0);
    agreeOnPoints(piece, none, shared, exchange);
}

} // namespace Foam::stability
