// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/surface/pieces/KeyOrder.H"

#include <algorithm>

namespace Foam::stability
{

labelList placesInOrder(const UList<TriangleKey>& keys, const Exchange& exchange)
{
    const std::vector<List<TriangleKey>> all(exchange.listsToMaster(keys));
    std::vector<DynamicList<label>> places(exchange.nRanks());
    runOnAllRanks(
        exchange,
        [&]
        {
            std::vector<labelPair> order; // the rank, the key there
            for (std::size_t ranki = 0; ranki < all.size(); ++ranki)
            {
                places[ranki].setSize(all[ranki].size());
                forAll(all[ranki], i)
                {
                    order.push_back(labelPair(ranki, i));
                }
            }
            std::sort(
                order.begin(), order.end(),
                [&](const labelPair& a, const labelPair& b)
                { return all[a.first()][a.second()] < all[b.first()][b.second()]; }
            );
            for (std::size_t i = 0; i < order.size(); ++i)
            {
                places[order[i].first()][order[i].second()] = label(i);
            }
        }
    );
    return exchange.exchangeLists(places)[0];
}

} // namespace Foam::stability
