// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/surface/pieces/Components.H"

#include "core/surface/Ribbon.H"
#include "core/surface/pieces/Redistribution.H"

#include <algorithm>
#include <set>

namespace Foam::stability
{

Components::Components(
    const SurfaceHalo& halo, const point& referencePoint, const Exchange& exchange,
    const std::optional<PlaneSection>& section
)
{
    const InterfaceMesh& mesh = halo.mesh();
    const SurfaceTopology topology(mesh.points.size(), mesh.triangles);
    numberParts(halo, topology);
    List<OnRank> owned(ofTriangles_.size());
    forAll(owned, i)
    {
        owned[i] = OnRank(exchange.rank(), ofTriangles_[i]);
    }
    const List<OnRank> known(halo.triangleValues(owned));

    const auto parts =
        exchange.listsToMaster(measure(halo, topology, referencePoint, section));
    const auto touching = exchange.listsToMaster(contacts(halo, topology, known));
    std::vector<DynamicList<Verdict>> verdicts(exchange.nRanks());
    runOnAllRanks(
        exchange,
        [&]
        {
            const auto judged = judge(parts, touching);
            for (std::size_t ranki = 0; ranki < judged.size(); ++ranki)
            {
                verdicts[ranki] = judged[ranki];
            }
        }
    );
    const List<Verdict> mine(exchange.exchangeLists(verdicts)[0]);
    for (const Verdict& verdict : mine)
    {
        numbers_.append(verdict.number);
        homes_.append(verdict.home);
        bodies_.append(verdict.body);
    }
    const labelList ofPiece(halo.triangleValues(ofOwnedTriangles()));
    ofPoints_.setSize(mesh.points.size(), 0);
    forAll(mesh.triangles, trianglei)
    {
        for (const label pointi : mesh.triangles[trianglei])
        {
            ofPoints_[pointi] = ofPiece[trianglei];
        }
    }
}

labelList Components::ofOwnedTriangles() const
{
    labelList result(ofTriangles_.size());
    forAll(result, i)
    {
        result[i] = numbers_[ofTriangles_[i]];
    }
    return result;
}

namespace
{

// A component that goes through a cyclic patch counts as open, since its volume is not
// known here.
bool closedAt(
    const SurfaceEdge& edge, const SurfaceHalo& halo,
    const std::optional<PlaneSection>& section
)
{
    if (isRimOfRibbon(edge, halo.mesh().points, section))
    {
        return true;
    }
    return edge.nTriangles == 2 && halo.piece().keys[edge.triangles[0]].image == 0
           && halo.piece().keys[edge.triangles[1]].image == 0;
}

} // namespace

// Numbers the parts that are connected by owned triangles alone.
void Components::numberParts(const SurfaceHalo& halo, const SurfaceTopology& topology)
{
    const label n = halo.mesh().triangles.size();
    DisjointSets sets(n);
    labelList first(topology.edges().size(), -1); // own triangle at an edge
    label nOwn = 0;
    for (label trianglei = 0; trianglei < n; ++trianglei)
    {
        if (halo.isOwn(trianglei))
        {
            ++nOwn;
            for (const label edgei : topology.triangleEdges()[trianglei])
            {
                if (first[edgei] < 0)
                {
                    first[edgei] = trianglei;
                }
                sets.unite(first[edgei], trianglei);
            }
        }
    }
    ofTriangles_.setSize(nOwn);
    labelList numbers(n, -1);
    for (label trianglei = 0; trianglei < n; ++trianglei)
    {
        if (halo.isOwn(trianglei))
        {
            label& number = numbers[sets.root(trianglei)];
            number = number < 0 ? nParts_++ : number;
            ofTriangles_[halo.ownTriangle(trianglei)] = number;
        }
    }
}

List<Components::Part> Components::measure(
    const SurfaceHalo& halo, const SurfaceTopology& topology,
    const point& referencePoint, const std::optional<PlaneSection>& section
) const
{
    const InterfaceMesh& mesh = halo.mesh();
    List<Part> parts(nParts_, Part{TriangleKey(), true, 0, 0, 0});
    List<bool> met(nParts_, false);
    const List<bool> isPrimary(halo.primaryPoints());
    List<bool> pointMet(mesh.points.size(), false);
    forAll(mesh.triangles, trianglei)
    {
        if (!halo.isOwn(trianglei))
        {
            continue;
        }
        const label parti = ofTriangles_[halo.ownTriangle(trianglei)];
        Part& part = parts[parti];
        if (!met[parti])
        {
            met[parti] = true;
            part.lowest = halo.piece().keys[trianglei];
        }
        const triFace& t = mesh.triangles[trianglei];
        part.volume += coneTo(mesh, trianglei, referencePoint, section).measure;
        for (label k = 0; k < 3; ++k)
        {
            const label edgei = topology.triangleEdges()[trianglei][k];
            part.closed =
                part.closed && closedAt(topology.edges()[edgei], halo, section);
            if (isPrimary[t[k]] && !pointMet[t[k]])
            {
                pointMet[t[k]] = true;
                ++part.nPoints;
                part.cellSizes += mesh.cellSizes[t[k]];
            }
        }
    }
    return parts;
}

List<Components::Contact> Components::contacts(
    const SurfaceHalo& halo, const SurfaceTopology& topology, const List<OnRank>& known
) const
{
    // The ghost triangles at each edge.
    std::vector<std::vector<label>> others(topology.edges().size());
    forAll(known, trianglei)
    {
        if (!halo.isOwn(trianglei))
        {
            for (const label edgei : topology.triangleEdges()[trianglei])
            {
                others[edgei].push_back(trianglei);
            }
        }
    }
    std::set<std::pair<label, OnRank>> found;
    DynamicList<Contact> result;
    forAll(known, trianglei)
    {
        if (!halo.isOwn(trianglei))
        {
            continue;
        }
        const label own = ofTriangles_[halo.ownTriangle(trianglei)];
        for (const label edgei : topology.triangleEdges()[trianglei])
        {
            for (const label other : others[edgei])
            {
                if (found.insert({own, known[other]}).second)
                {
                    result.append(Contact{own, known[other]});
                }
            }
        }
    }
    return List<Contact>(std::move(result));
}

// Sums the parts of each whole component; `places` (in: all -1) gets the index of the
// sum at each root.
std::vector<Components::Whole> Components::sumUp(
    const std::vector<List<Part>>& parts, const labelList& starts, DisjointSets& sets,
    labelList& places
)
{
    std::vector<Whole> wholes;
    for (label ranki = 0; ranki < label(parts.size()); ++ranki)
    {
        forAll(parts[ranki], i)
        {
            const label root = sets.root(starts[ranki] + i);
            const Part& part = parts[ranki][i];
            if (places[root] < 0)
            {
                places[root] = wholes.size();
                wholes.push_back({root, ranki, part});
                continue;
            }
            Whole& whole = wholes[places[root]];
            if (part.lowest < whole.sum.lowest)
            {
                whole.sum.lowest = part.lowest;
                whole.home = ranki;
            }
            whole.sum.closed = whole.sum.closed && part.closed;
            whole.sum.volume += part.volume;
            whole.sum.nPoints += part.nPoints;
            whole.sum.cellSizes += part.cellSizes;
        }
    }
    return wholes;
}

// Unites the parts that touch, on the master; returns a verdict for each part of each
// rank.
std::vector<List<Components::Verdict>> Components::judge(
    const std::vector<List<Part>>& parts, const std::vector<List<Contact>>& contacts
)
{
    const label nRanks = parts.size();
    labelList starts(nRanks + 1, 0);
    for (label ranki = 0; ranki < nRanks; ++ranki)
    {
        starts[ranki + 1] = starts[ranki] + parts[ranki].size();
    }
    DisjointSets sets(starts[nRanks]);
    for (label ranki = 0; ranki < nRanks; ++ranki)
    {
        for (const Contact& contact : contacts[ranki])
        {
            sets.unite(
                starts[ranki] + contact.own,
                starts[contact.other.first()] + contact.other.second()
            );
        }
    }

    labelList places(starts[nRanks], -1);
    std::vector<Whole> wholes(sumUp(parts, starts, sets, places));
    std::sort(
        wholes.begin(), wholes.end(),
        [](const Whole& a, const Whole& b) { return a.sum.lowest < b.sum.lowest; }
    );
    for (std::size_t i = 0; i < wholes.size(); ++i)
    {
        places[wholes[i].root] = i;
    }
    std::vector<List<Verdict>> verdicts(nRanks);
    for (label ranki = 0; ranki < nRanks; ++ranki)
    {
        verdicts[ranki].setSize(parts[ranki].size());
        forAll(parts[ranki], i)
        {
            const label place = places[sets.root(starts[ranki] + i)];
            const Part& sum = wholes[place].sum;
            const scalar cellSize = sum.cellSizes / std::max(sum.nPoints, label(1));
            verdicts[ranki][i] = {
                place, wholes[place].home, {sum.closed, sum.volume, cellSize}};
        }
    }
    return verdicts;
}

WholeComponents wholeComponents(
    const SurfacePiece& owned, const Components& components, const UList<bool>& chosen,
    const Exchange& exchange
)
{
    std::vector<DynamicList<label>> triangles(exchange.nRanks());
    forAll(owned.mesh.triangles, trianglei)
    {
        if (chosen[trianglei])
        {
            triangles[components.homeOf(trianglei)].append(trianglei);
        }
    }
    const labelList numbers(components.ofOwnedTriangles());
    std::vector<DynamicList<label>> numbersOfRanks(triangles.size());
    for (std::size_t ranki = 0; ranki < triangles.size(); ++ranki)
    {
        for (const label trianglei : triangles[ranki])
        {
            numbersOfRanks[ranki].append(numbers[trianglei]);
        }
    }
    JoinedSurface joined(redistributed(owned, triangles, exchange));
    return {
        std::move(joined.piece),
        joinedValues(exchange.exchangeLists(numbersOfRanks), joined.triangleSources)};
}

} // namespace Foam::stability
