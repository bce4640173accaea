// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/surface/pieces/Redistribution.H"

namespace Foam::stability
{

JoinedSurface redistributed(
    const SurfacePiece& owned, const std::vector<DynamicList<label>>& trianglesOfRanks,
    const Exchange& exchange
)
{
    std::vector<Packet> packets(exchange.nRanks());
    runOnAllRanks(
        exchange,
        [&]
        {
            for (std::size_t ranki = 0; ranki < packets.size(); ++ranki)
            {
                if (!trianglesOfRanks[ranki].empty())
                {
                    pack(partOf(owned, trianglesOfRanks[ranki]), packets[ranki]);
                }
            }
        }
    );
    packets = exchange.exchange(std::move(packets));
    JoinedSurface joined;
    runOnAllRanks(
        exchange,
        [&]
        {
            std::vector<SurfacePiece> parts;
            for (Packet& packet : packets)
            {
                if (!packet.empty())
                {
                    parts.push_back(unpackedSurface(packet));
                }
            }
            if (parts.empty())
            {
                parts.emplace_back();
                parts[0].sharesPoints = owned.sharesPoints;
            }
            joined = join(parts);
        }
    );
    return joined;
}

} // namespace Foam::stability
