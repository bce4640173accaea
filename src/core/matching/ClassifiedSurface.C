// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/matching/ClassifiedSurface.H"

namespace Foam::stability
{

namespace
{

// [m/s], as the header defines it. Normals point from the first fluid to the second.
scalarField driftSpeeds(
    const InterfaceMesh& mesh, const UList<Match>& matches, bool onInterface,
    scalar interval
)
{
    scalarField speeds(mesh.points.size(), 0);
    if (interval <= 0)
    {
        return speeds;
    }
    const vectorField normals = mesh.pointNormals();
    forAll(speeds, i)
    {
        const SurfacePoint& nearest = matches[i].nearest;
        speeds[i] = nearest.distance / interval;
        if (nearest.triangle >= 0)
        {
            const vector toOther = nearest.position - mesh.points[i];
            const vector fromTtoM = onInterface ? -toOther : toOther;
            if ((fromTtoM & normals[i]) > 0)
            {
                speeds[i] = -speeds[i];
            }
        }
    }
    return speeds;
}

} // namespace

ClassifiedSurface describe(
    const InterfaceMesh& mesh, const UList<Match>& matches, Stability unmatched,
    const UList<bool>& nearWall, scalar interval
)
{
    const label n = mesh.points.size();
    ClassifiedSurface surface;
    surface.mesh = mesh;
    surface.stability.setSize(n);
    surface.distance.setSize(n);
    surface.preimages.setSize(n);
    surface.nearWall = nearWall;
    surface.areas = mesh.pointAreas();
    surface.driftSpeed =
        driftSpeeds(mesh, matches, unmatched == Stability::attached, interval);
    for (label i = 0; i < n; ++i)
    {
        surface.stability[i] = matches[i].stable ? Stability::stable : unmatched;
        surface.distance[i] = matches[i].nearest.distance;
        surface.preimages[i] = matches[i].nPreimages;
    }
    return surface;
}

namespace
{

// Calls `visit` for each list of values per point.
template<class Surface, class Visit>
void visitValues(Surface& surface, const Visit& visit)
{
    visit(surface.stability);
    visit(surface.distance);
    visit(surface.driftSpeed);
    visit(surface.confidence);
    visit(surface.preimages);
    visit(surface.components);
    visit(surface.crossings.crossed);
    visit(surface.crossings.ends);
    visit(surface.crossings.beyond);
    forEachMark([&](const char*, const MarkFiles&, const auto& mark)
                { visit(mark(surface)); });
}

} // namespace

void select(ClassifiedSurface& surface, const labelList& points)
{
    visitValues(
        surface,
        [&](auto& values)
        {
            if (!values.empty())
            {
                auto chosen(values);
                chosen.setSize(points.size());
                forAll(points, i)
                {
                    chosen[i] = values[points[i]];
                }
                values.transfer(chosen);
            }
        }
    );
}

ClassifiedSurface gathered(const ClassifiedSurface& mine, const Exchange& exchange)
{
    if (exchange.nRanks() == 1)
    {
        return mine;
    }
    Packet packet;
    runOnAllRanks(
        exchange,
        [&]
        {
            SurfacePiece piece;
            static_cast<SurfaceOrder&>(piece) = mine.order;
            piece.mesh = mine.mesh;
            pack(piece, packet);
            visitValues(mine, [&](const auto& values) { packet.putList(values); });
        }
    );
    std::vector<SurfacePiece> parts;
    std::vector<Packet> packets(exchange.toMaster(std::move(packet)));
    ClassifiedSurface whole;
    runOnAllRanks(
        exchange,
        [&]
        {
            for (Packet& some : packets)
            {
                if (!some.empty())
                {
                    parts.push_back(unpackedSurface(some));
                    visitValues(
                        whole,
                        [&](auto& values)
                        {
                            using Value = std::decay_t<decltype(*values.begin())>;
                            values.append(some.getList<Value>());
                        }
                    );
                }
            }
            JoinedSurface joined(join(parts));
            whole.order = joined.piece;
            whole.mesh = std::move(joined.piece.mesh);
            select(whole, joined.pointSources);
        }
    );
    return whole;
}

scalarField
confidences(const ClassifiedSurface& surface, const Epsilon& epsilon, scalar noiseFloor)
{
    constexpr scalar largest = 1000;
    scalarField result(surface.distance.size(), largest);
    forAll(result, pointi)
    {
        const scalar h = surface.mesh.cellSizes[pointi];
        const scalar off = mag(surface.distance[pointi] - epsilon.at(h)); // [m]
        if (off < largest * noiseFloor * h)
        {
            result[pointi] = off / (noiseFloor * h);
        }
    }
    return result;
}

} // namespace Foam::stability
