// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/cells/RingFetch.H"

#include "core/cells/CellNeeds.H"
#include "core/cells/CellPackets.H"

#include "Map.H"
#include "boundBox.H"

#include <algorithm>
#include <optional>
#include <set>

namespace Foam::stability
{

namespace
{

// One ring after the other, then where more is needed.
class RingFetch
{
public:
    RingFetch(
        const CellComplexInput& own, const PeriodicImages* images,
        const Exchange& exchange
    )
        : own_(own), images_(images), exchange_(exchange),
          cellFaces_(facesOfCells(own)), sent_(exchange.nRanks())
    {
        findPointCells();
        Packet mine;
        mine.put(boundBox(own.points, false));
        mine.putList(labelList(imagesOfPoints()));
        std::set<label> passages;
        for (Packet& packet : exchange.toAll(mine))
        {
            boxes_.push_back(packet.get<boundBox>());
            boxes_.back().inflate(1e-6);
            for (const label image : packet.getList<label>())
            {
                passages.insert(image);
            }
        }
        passages_.assign(passages.begin(), passages.end());
    }

    std::vector<CellBlock> run(const FetchReach& reach)
    {
        const bool byDistance = reach.cells > 0;
        add(blockOf(own_, cellFaces_, identity(own_.globalCells.size())));
        if (byDistance)
        {
            needs_.emplace(own_, cellFaces_, reach);
        }
        for (label ring = 0;; ++ring)
        {
            const Map<point> wanted(wantedPoints());
            if (ring >= reach.nRings
                && (!byDistance || exchange_.total(wanted.size()) == 0))
            {
                return std::move(blocks_);
            }
            ask(wanted);
        }
    }

private:
    // A face of a block behind which no cell is known.
    struct RimFace
    {
        std::size_t block;
        label facei, cellBehind;
    };

    // The own points of one point at home, and which of its images they are.
    using Places = DynamicList<labelPair, 4>;

    label realPoint(label point) const
    {
        return images_ ? images_->realPoint(point) : point;
    }
    label imageOfPoint(label point) const
    {
        return images_ ? images_->imageOfPoint(point) : 0;
    }

    void findPointCells()
    {
        forAll(own_.globalPoints, pointi)
        {
            const label point = own_.globalPoints[pointi];
            localPoints_(realPoint(point))
                .append(labelPair(pointi, imageOfPoint(point)));
        }
        pointCells_ = Rows(
            own_.points.size(),
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
    }

    // The images that occur among the own points: a few.
    labelList imagesOfPoints() const
    {
        labelHashSet found;
        for (const label point : own_.globalPoints)
        {
            found.insert(imageOfPoint(point));
        }
        return found.sortedToc();
    }

    // True where the rank may have a point with the same home.
    bool mayHave(label ranki, const point& home) const
    {
        return std::any_of(
            passages_.begin(), passages_.end(),
            [&](label image) {
                return boxes_[ranki].contains(
                    images_ ? images_->motion(image)(home) : home
                );
            }
        );
    }

    // The points of faces behind which no cell is known, where cells are needed, and
    // their homes.
    Map<point> wantedPoints()
    {
        Map<point> wanted;
        DynamicList<RimFace> left;
        for (const RimFace& f : rim_)
        {
            if (!known_.found(f.cellBehind))
            {
                left.append(f);
                for (const label pointi : blocks_[f.block].faces[f.facei])
                {
                    if (!needs_ || needs_->at(pointi) > 0)
                    {
                        wanted.insert(pointi, homes_[pointi]);
                    }
                }
            }
        }
        rim_.transfer(left);
        return wanted;
    }

    // Asks the ranks for the cells at these points.
    void ask(const Map<point>& homes)
    {
        std::vector<DynamicList<label>> questions(exchange_.nRanks());
        for (const label pointi : homes.sortedToc())
        {
            for (label ranki = 0; ranki < exchange_.nRanks(); ++ranki)
            {
                if ((images_ || ranki != exchange_.rank())
                    && mayHave(ranki, homes[pointi]))
                {
                    questions[ranki].append(pointi);
                }
            }
        }
        answer(exchange_.exchangeLists(questions));
        if (needs_)
        {
            needs_->spread();
        }
    }

    void add(CellBlock block)
    {
        known_.insert(block.cells);
        Map<label> places(2 * block.pointIds.size());
        forAll(block.pointIds, i)
        {
            places.insert(block.pointIds[i], i);
        }
        const pointField& at = images_ ? block.homes : block.points;
        forAll(block.faces, k)
        {
            if (block.cellBehind[k] >= 0 && !known_.found(block.cellBehind[k]))
            {
                rim_.append({blocks_.size(), k, block.cellBehind[k]});
                for (const label pointi : block.faces[k])
                {
                    homes_.insert(pointi, at[places[pointi]]);
                }
            }
        }
        if (needs_)
        {
            needs_->add(block);
        }
        blocks_.push_back(std::move(block));
    }

    void answer(const std::vector<List<label>>& questions)
    {
        std::vector<Packet> answers(exchange_.nRanks());
        for (label ranki = 0; ranki < exchange_.nRanks(); ++ranki)
        {
            std::map<label, DynamicList<label>> cells; // by their image
            for (const label pointi : questions[ranki])
            {
                addCells(pointi, ranki, cells);
            }
            if (!cells.empty())
            {
                answers[ranki].put(label(cells.size()));
            }
            for (const auto& [image, some] : cells)
            {
                const CellBlock block(blockOf(own_, cellFaces_, some));
                pack(image ? moved(block, image, *images_) : block, answers[ranki]);
            }
        }
        for (Packet& packet : exchange_.exchange(std::move(answers)))
        {
            const label n = packet.empty() ? 0 : packet.get<label>();
            for (label i = 0; i < n; ++i)
            {
                add(unpacked(packet));
            }
        }
    }

    // The images of own cells around a point that were not sent yet.
    void addCells(label point, label ranki, std::map<label, DynamicList<label>>& cells)
    {
        const auto found = localPoints_.cfind(realPoint(point));
        if (!found.found())
        {
            return;
        }
        for (const labelPair& place : found.val())
        {
            const label pointi = place.first();
            for (const label image : imagesAt(point, pointi, place.second()))
            {
                for (const label celli : pointCells_[pointi])
                {
                    if ((image || ranki != exchange_.rank())
                        && sent_[ranki].insert({celli, image}).second)
                    {
                        cells[image].append(celli);
                    }
                }
            }
        }
    }

    // The images of the mesh in which the own point, image `own` of its home, is the
    // wanted one.
    labelList imagesAt(label wanted, label pointi, label own) const
    {
        if (!images_)
        {
            return {0};
        }
        labelList result;
        for (const label at : images_->equals(imageOfPoint(wanted), own_.homes[pointi]))
        {
            result.append(images_->product(at, images_->inverse(own)));
        }
        return result;
    }

    const CellComplexInput& own_;
    const PeriodicImages* images_;
    const Exchange& exchange_;
    Rows cellFaces_, pointCells_;
    Map<Places> localPoints_;     // by the number at home
    std::vector<label> passages_; // images of points that occur on the ranks
    std::vector<std::set<std::pair<label, label>>> sent_; // cells and images
    std::vector<boundBox> boxes_;
    labelHashSet known_; // cells
    std::vector<CellBlock> blocks_;
    DynamicList<RimFace> rim_;
    Map<point> homes_;               // of the points of rim_
    std::optional<CellNeeds> needs_; // where the fetch goes on by distance
};

} // namespace

std::vector<CellBlock> fetchRings(
    const CellComplexInput& own, const PeriodicImages* images, const Exchange& exchange,
    const FetchReach& reach
)
{
    return RingFetch(own, images, exchange).run(reach);
}

} // namespace Foam::stability
