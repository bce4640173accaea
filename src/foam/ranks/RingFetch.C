// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

#include "foam/ranks/RingFetch.H"

#include "Map.H"
#include "boundBox.H"
#include "core/ranks/CellPackets.H"

namespace Foam::stability
{

namespace
{

// One ring after the other.
class RingFetch
{
public:
    RingFetch(const CellComplexInput& own, const RankMessages& messages)
        : own_(own), messages_(messages), cellFaces_(facesOfCells(own)),
          sent_(messages.nRanks())
    {
        forAll(own.globalPoints, pointi)
        {
            localPoints_.insert(own.globalPoints[pointi], pointi);
        }
        pointCells_ = Rows(
            own.points.size(),
            [&](const auto& add)
            {
                labelList last(own_.points.size(), -1);
                for (label celli = 0; celli < cellFaces_.size(); ++celli)
                {
                    for (const label facei : cellFaces_[celli])
                    {
                        for (const label pointi : own_.faces[facei])
                        {
                            if (last[pointi] != celli)
                            {
                                last[pointi] = celli;
                                add(pointi, celli);
                            }
                        }
                    }
                }
            }
        );
        Packet box;
        box.put(boundBox(own.points, false));
        for (Packet& packet : messages.toAll(box))
        {
            boxes_.push_back(packet.get<boundBox>());
            boxes_.back().inflate(1e-6);
        }
        known_.insert(own.globalCells);
    }

    std::vector<CellBlock> run(label nRings)
    {
        blocks_.push_back(blockOf(own_, cellFaces_, identity(own_.globalCells.size())));
        std::size_t first = 0;
        for (label ring = 0; ring < nRings; ++ring)
        {
            const std::size_t n = blocks_.size();
            ask(first);
            first = n;
        }
        return std::move(blocks_);
    }

private:
    // For the cells at the points of faces behind which nothing is known, in the blocks
    // from this one on.
    void ask(std::size_t first)
    {
        Map<point> points;
        for (std::size_t i = first; i < blocks_.size(); ++i)
        {
            addRim(blocks_[i], points);
        }
        std::vector<Packet> questions(messages_.nRanks());
        const labelList sorted(points.sortedToc());
        for (label ranki = 0; ranki < messages_.nRanks(); ++ranki)
        {
            DynamicList<label> wanted;
            for (const label pointi : sorted)
            {
                if (ranki != messages_.rank() && boxes_[ranki].contains(points[pointi]))
                {
                    wanted.append(pointi);
                }
            }
            if (!wanted.empty())
            {
                questions[ranki].putList(wanted);
            }
        }
        answer(messages_.exchange(std::move(questions)));
    }

    void addRim(const CellBlock& block, Map<point>& points) const
    {
        Map<label> places(2 * block.pointIds.size());
        forAll(block.pointIds, i)
        {
            places.insert(block.pointIds[i], i);
        }
        forAll(block.faces, k)
        {
            if (block.behind[k] >= 0 && !known_.found(block.behind[k]))
            {
                for (const label pointi : block.faces[k])
                {
                    points.insert(pointi, block.points[places[pointi]]);
                }
            }
        }
    }

    void answer(std::vector<Packet> questions)
    {
        std::vector<Packet> answers(messages_.nRanks());
        for (label ranki = 0; ranki < messages_.nRanks(); ++ranki)
        {
            if (questions[ranki].empty())
            {
                continue;
            }
            DynamicList<label> cells;
            for (const label pointi : questions[ranki].getList<label>())
            {
                const auto found = localPoints_.cfind(pointi);
                if (found.found())
                {
                    for (const label celli : pointCells_[found.val()])
                    {
                        if (sent_[ranki].insert(celli))
                        {
                            cells.append(celli);
                        }
                    }
                }
            }
            if (!cells.empty())
            {
                answers[ranki] = packed(blockOf(own_, cellFaces_, cells));
            }
        }
        for (Packet& packet : messages_.exchange(std::move(answers)))
        {
            if (!packet.empty())
            {
                blocks_.push_back(unpacked(packet));
                known_.insert(blocks_.back().cells);
            }
        }
    }

    const CellComplexInput& own_;
    const RankMessages& messages_;
    Rows cellFaces_, pointCells_;
    Map<label> localPoints_; // global to local
    std::vector<labelHashSet> sent_;
    std::vector<boundBox> boxes_;
    labelHashSet known_; // cells
    std::vector<CellBlock> blocks_;
};

} // namespace

std::vector<CellBlock>
fetchRings(const CellComplexInput& own, const RankMessages& messages, label nRings)
{
    return RingFetch(own, messages).run(nRings);
}

} // namespace Foam::stability
