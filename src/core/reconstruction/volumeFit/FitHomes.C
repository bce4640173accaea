// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/reconstruction/volumeFit/FitHomes.H"

#include "core/base/DisjointSets.H"
#include "boundBox.H"

#include <algorithm>
#include <map>

namespace Foam::stability
{

namespace
{

// The part of a closed component that a rank has, or all of one.
struct FitSite
{
    label component;
    label home;
    boundBox box; // [m], widened by the reach of the fit
};

// The parts of this rank, by component.
std::map<label, FitSite>
sitesOf(const SurfacePiece& owned, const Components& components)
{
    const InterfaceMesh& mesh = owned.mesh;
    const labelList numbers(components.ofOwnedTriangles());
    std::map<label, FitSite> sites;
    forAll(mesh.triangles, trianglei)
    {
        if (!components.bodyOf(trianglei).closed)
        {
            continue;
        }
        const label number = numbers[trianglei];
        FitSite& site =
            sites.insert({number, {number, components.homeOf(trianglei), boundBox()}}
            ).first->second;
        for (const label pointi : mesh.triangles[trianglei])
        {
            const scalar reach = reachOfFit * mesh.cellSizes[pointi];
            const vector wide(reach, reach, reach);
            site.box.add(mesh.points[pointi] - wide);
            site.box.add(mesh.points[pointi] + wide);
        }
    }
    return sites;
}

// The home of each component, from the sites of all ranks.
std::map<label, label> homesOf(const std::vector<List<FitSite>>& ofRanks)
{
    std::map<label, FitSite> whole;
    for (const List<FitSite>& sites : ofRanks)
    {
        for (const FitSite& site : sites)
        {
            whole.insert({site.component, site}).first->second.box.add(site.box);
        }
    }
    std::vector<FitSite> all; // by component
    all.reserve(whole.size());
    for (const auto& [component, site] : whole)
    {
        all.push_back(site);
    }
    std::vector<label> order(all.size());
    for (std::size_t i = 0; i < order.size(); ++i)
    {
        order[i] = label(i);
    }
    const auto lowest = [&](label i) { return all[i].box.min().x(); };
    std::stable_sort(
        order.begin(), order.end(),
        [&](label a, label b) { return lowest(a) < lowest(b); }
    );
    DisjointSets sets(all.size());
    for (std::size_t i = 0; i < order.size(); ++i)
    {
        const boundBox& box = all[order[i]].box;
        for (std::size_t j = i + 1;
             j < order.size() && lowest(order[j]) <= box.max().x(); ++j)
        {
            if (box.overlaps(all[order[j]].box))
            {
                sets.unite(order[i], order[j]);
            }
        }
    }
    std::map<label, label> ofSets, homes;
    for (std::size_t i = 0; i < all.size(); ++i)
    {
        const label root = sets.root(label(i));
        homes[all[i].component] = ofSets.insert({root, all[i].home}).first->second;
    }
    return homes;
}

} // namespace

labelList fitHomes(
    const SurfacePiece& owned, const Components& components, const Exchange& exchange
)
{
    std::map<label, FitSite> sites;
    DynamicList<FitSite> mine;
    runOnAllRanks(
        exchange,
        [&]
        {
            sites = sitesOf(owned, components);
            for (const auto& [component, site] : sites)
            {
                mine.append(site);
            }
        }
    );
    const std::vector<List<FitSite>> ofRanks(exchange.listsToMaster(mine));
    std::vector<DynamicList<label>> answers(exchange.nRanks());
    runOnMaster(
        exchange,
        [&]
        {
            const std::map<label, label> homes(homesOf(ofRanks));
            for (std::size_t ranki = 0; ranki < ofRanks.size(); ++ranki)
            {
                for (const FitSite& site : ofRanks[ranki])
                {
                    answers[ranki].append(homes.at(site.component));
                }
            }
        }
    );
    const labelList homes(exchange.exchangeLists(answers)[0]);
    label i = 0;
    for (auto& [component, site] : sites)
    {
        site.home = homes[i++];
    }
    labelList result(components.ofOwnedTriangles());
    for (label& number : result)
    {
        const auto site = sites.find(number);
        number = site == sites.end() ? -1 : site->second.home;
    }
    return result;
}

} // namespace Foam::stability
