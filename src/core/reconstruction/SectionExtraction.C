// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/reconstruction/SectionExtraction.H"

#include "core/cells/CanonicalOrder.H"

#include <algorithm>
#include <cmath>

namespace Foam::stability
{

namespace
{

// Points of the section are named by those in its lower plane, its edges by the faces
// that they are extruded to.
class SectionCutter
{
public:
    using Vertex = MarchingTets::Vertex;

    SectionCutter(
        const CellComplex& complex, const VolumeFractions& fractions,
        SectionMethod method, label nRings
    )
        : complex_(complex), fractions_(fractions), section_(*complex.whole().section),
          method_(method), nRings_(nRings), apexes_(complex.nPoints()),
          known_(complex.nPoints(), false)
    {
    }

    void cutInto(MarchingTets& tets)
    {
        for (label facei = 0; facei < complex_.nFaces(); ++facei)
        {
            if (isWanted(facei))
            {
                cutEdge(facei, tets);
            }
        }
        for (label facei = complex_.nInternalFaces(); facei < complex_.nFaces();
             ++facei)
        {
            if (isWanted(facei))
            {
                for (const label pointi : endsOf(facei))
                {
                    tets.closePart({atMiddle(facei), atPoint(pointi)}, facei);
                }
            }
        }
    }

private:
    bool isBoundary(label facei) const { return facei >= complex_.nInternalFaces(); }

    // True if the edge is near and all cells are there that decide alpha at its ends.
    bool isWanted(label facei) const
    {
        const label owner = complex_.owner()[facei];
        const label neighbour = isBoundary(facei) ? owner : complex_.neighbour()[facei];
        return !complex_.isEnd(facei)
               && std::min(complex_.ring(owner), complex_.ring(neighbour)) <= nRings_
               && complex_.hasAllNeighbours(owner)
               && complex_.hasAllNeighbours(neighbour);
    }

    labelPair endsOf(label facei) const
    {
        return section_.edgeOf(complex_.faces()[facei], complex_.points());
    }

    void cutEdge(label facei, MarchingTets& tets)
    {
        const label owner = complex_.owner()[facei];
        const Vertex left = atCell(owner);
        const Vertex right =
            isBoundary(facei) ? atMiddle(facei) : atCell(complex_.neighbour()[facei]);
        const label cells[2] = {
            owner, isBoundary(facei) ? owner : complex_.neighbour()[facei]};
        const labelPair ends(endsOf(facei));
        for (label k = 0; k < 2; ++k)
        {
            const Vertex& apex = apexOf(ends[k]);
            if (joinsTwoCells(ends[k]) || apex.id == left.id || apex.id == right.id)
            {
                continue;
            }
            const UList<label> around(
                const_cast<label*>(cells), isBoundary(facei) ? 1 : 2
            );
            tets.cutTriangle(
                k == 0 ? FixedList<Vertex, 3>{left, apex, right}
                       : FixedList<Vertex, 3>{left, right, apex},
                method_ == SectionMethod::isoAlpha ? around
                                                   : complex_.pointCells()[ends[k]]
            );
        }
    }

    // A point inside with only two cells around it divides their common edge: what its
    // two parts add there cancels.
    bool joinsTwoCells(label pointi) const
    {
        return complex_.pointBoundaryFaces()[pointi].empty()
               && complex_.pointCells()[pointi].size() == 2;
    }

    Vertex atCell(label celli) const
    {
        return {
            complex_.nPoints() + celli, fractions_.cells[celli],
            complex_.cellCentres()[celli]};
    }

    Vertex atMiddle(label facei) const
    {
        const label i = facei - complex_.nInternalFaces();
        return {
            complex_.nPoints() + complex_.nCells() + i, fractions_.boundaryFaces[i],
            complex_.faceCentres()[facei]};
    }

    Vertex atPoint(label pointi) const
    {
        return {
            pointi, fractions_.atPoint(complex_, pointi),
            section_.inMiddle(complex_.points()[pointi])};
    }

    // The third vertex of the triangles at a point.
    const Vertex& apexOf(label pointi)
    {
        if (!known_[pointi])
        {
            known_[pointi] = true;
            const bool inside = complex_.pointBoundaryFaces()[pointi].empty();
            apexes_[pointi] = method_ == SectionMethod::bonnell && inside
                                  ? atCell(lowestAround(pointi))
                                  : atPoint(pointi);
        }
        return apexes_[pointi];
    }

    // By position, so that regular quadrangles are cut alike; what differs by round-off
    // is alike.
    label lowestAround(label pointi) const
    {
        const point& origin = complex_.whole().bounds.min();
        const scalar quantum = 1e-6 * complex_.whole().bounds.mag(); // [m]
        const auto place = [&](label celli)
        {
            point x = (complex_.cellCentres()[celli] - origin) / quantum;
            for (direction d = 0; d < 3; ++d)
            {
                x[d] = std::round(x[d]);
            }
            return x;
        };
        const UList<label> cells = complex_.pointCells()[pointi];
        return *std::min_element(
            cells.begin(), cells.end(),
            [&](label a, label b) { return beforeByPosition(place(a), place(b)); }
        );
    }

    const CellComplex& complex_;
    const VolumeFractions& fractions_;
    const PlaneSection& section_;
    SectionMethod method_;
    label nRings_;
    List<Vertex> apexes_; // of points in the lower plane
    List<bool> known_;
};

} // namespace

void cutSection(
    const CellComplex& complex, const VolumeFractions& fractions, SectionMethod method,
    label nRings, MarchingTets& tets
)
{
    SectionCutter(complex, fractions, method, nRings).cutInto(tets);
}

} // namespace Foam::stability
