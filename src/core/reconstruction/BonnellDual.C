// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/reconstruction/BonnellDual.H"
#include "core/reconstruction/MarchingTets.H"
#include "core/reconstruction/SectionExtraction.H"
#include "core/cells/CanonicalOrder.H"
#include "core/flow/VolumeFractions.H"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

namespace Foam::stability
{

namespace
{

using Vertex = MarchingTets::Vertex;

// An edge of the mesh at a point and one of the faces that hold it.
struct Spoke
{
    label end; // the other point of the edge
    label facei;
    bool forward; // the face runs from the point to the end

    bool operator<(const Spoke& other) const
    {
        return std::tie(end, facei) < std::tie(other.end, other.facei);
    }
};

// The dual cell of a point is cut by pulling: all faces that do not hold its lowest
// vertex are joined to it, and each face is itself cut from its own lowest vertex.
// One order of all vertices, so neighbours cut shared faces alike: first the points
// of the boundary, then the middles of its edges, then the cells by position, which
// is Kuhn's division on a Cartesian mesh.
class DualExtraction
{
public:
    DualExtraction(
        const CellComplex& complex, const VolumeFractions& fractions, MarchingTets& tets
    )
        : complex_(complex), fractions_(fractions), tets_(tets),
          quantum_(1e-6 * complex.whole().bounds.mag()),
          active_(complex.nPoints(), false)
    {
    }

    void run()
    {
        for (label pointi = 0; pointi < complex_.nPoints(); ++pointi)
        {
            active_[pointi] = isKnown(pointi) && differs(pointi);
            if (active_[pointi])
            {
                cutDualCell(pointi);
            }
        }
        for (label facei = complex_.nInternalFaces(); facei < complex_.nFaces();
             ++facei)
        {
            if (complex_.hasAllNeighbours(complex_.owner()[facei]))
            {
                closeFace(facei);
            }
        }
    }

private:
    // True if all cells around the point are there.
    bool isKnown(label pointi) const
    {
        const UList<label> cells = complex_.pointCells()[pointi];
        return std::any_of(
            cells.begin(), cells.end(),
            [&](label celli) { return complex_.hasAllNeighbours(celli); }
        );
    }

    bool cellInside(label celli) const
    {
        return VolumeFractions::inside(fractions_.cells[celli]);
    }
    scalar boundaryValue(label facei) const
    {
        return fractions_.boundaryFaces[facei - complex_.nInternalFaces()];
    }

    // True if vertices of the dual cell are on both sides of alpha = 1/2.
    bool differs(label pointi) const
    {
        const UList<label> cells = complex_.pointCells()[pointi];
        for (const label celli : cells)
        {
            if (cellInside(celli) != cellInside(cells[0]))
            {
                return true;
            }
        }
        for (const label facei : complex_.pointBoundaryFaces()[pointi])
        {
            if (VolumeFractions::inside(boundaryValue(facei)) != cellInside(cells[0]))
            {
                return true;
            }
        }
        return false;
    }

    Vertex atCell(label celli) const
    {
        return {
            complex_.nPoints() + celli, fractions_.cells[celli],
            complex_.cellCentres()[celli]};
    }

    Vertex atBoundaryFace(label facei) const
    {
        return {
            complex_.nPoints() + complex_.nCells() + facei - complex_.nInternalFaces(),
            boundaryValue(facei), complex_.faceCentres()[facei]};
    }

    Vertex atBoundaryPoint(label pointi) const
    {
        return {
            pointi, meanOfFaces(labelList(complex_.pointBoundaryFaces()[pointi])),
            complex_.points()[pointi]};
    }

    Vertex atBoundaryEdge(label a, label b)
    {
        const edge e(min(a, b), max(a, b));
        DynamicList<label> faces;
        for (const label facei : complex_.pointBoundaryFaces()[e.first()])
        {
            if (complex_.faces()[facei].found(e.second()))
            {
                faces.append(facei);
            }
        }
        const pointField& x = complex_.points();
        return {
            tets_.vertices().ofMiddle(e), meanOfFaces(labelList(faces)),
            0.5 * (x[e.first()] + x[e.second()])};
    }

    // Summed in an order given by position, as everywhere.
    scalar meanOfFaces(labelList faces) const
    {
        const pointField& centres = complex_.faceCentres();
        std::sort(
            faces.begin(), faces.end(),
            [&](label a, label b) { return beforeByPosition(centres[a], centres[b]); }
        );
        scalar sum = 0;
        for (const label facei : faces)
        {
            sum += boundaryValue(facei);
        }
        return VolumeFractions::rounded(sum / faces.size());
    }

    // By rounded position, so that round-off does not order the cells of a layer.
    bool before(label a, label b) const
    {
        const point& x = complex_.cellCentres()[a];
        const point& y = complex_.cellCentres()[b];
        for (direction d = 0; d < 3; ++d)
        {
            const scalar origin = complex_.whole().bounds.min()[d];
            const scalar xi = std::round((x[d] - origin) / quantum_);
            const scalar yi = std::round((y[d] - origin) / quantum_);
            if (xi != yi)
            {
                return xi < yi;
            }
        }
        return a < b;
    }

    label lowest(label a, label b) const { return before(a, b) ? a : b; }

    // Edges of the mesh at the point, each with its faces, sorted.
    void findSpokes(label pointi, DynamicList<Spoke>& spokes) const
    {
        spokes.clear();
        for (const label celli : complex_.pointCells()[pointi])
        {
            for (const label facei : complex_.cellFaces()[celli])
            {
                const face& f = complex_.faces()[facei];
                const label k = complex_.owner()[facei] == celli ? f.find(pointi) : -1;
                if (k >= 0)
                {
                    spokes.append(Spoke{f.nextLabel(k), facei, true});
                    spokes.append(Spoke{f.prevLabel(k), facei, false});
                }
            }
        }
        std::sort(spokes.begin(), spokes.end());
    }

    Vertex apexOf(label pointi) const
    {
        if (complex_.pointBoundaryFaces()[pointi].size())
        {
            return atBoundaryPoint(pointi);
        }
        const UList<label> cells = complex_.pointCells()[pointi];
        label celli = cells[0];
        for (const label otheri : cells)
        {
            celli = lowest(celli, otheri);
        }
        return atCell(celli);
    }

    // The lowest vertex of the dual face of an edge: `ring` are its spokes.
    Vertex pivotOf(label pointi, const UList<Spoke>& ring)
    {
        label celli = complex_.owner()[ring[0].facei];
        for (const Spoke& spoke : ring)
        {
            if (spoke.facei >= complex_.nInternalFaces())
            {
                return atBoundaryEdge(pointi, spoke.end);
            }
            celli = lowest(celli, complex_.owner()[spoke.facei]);
            celli = lowest(celli, complex_.neighbour()[spoke.facei]);
        }
        return atCell(celli);
    }

    void cutDualCell(label pointi)
    {
        const Vertex apex = apexOf(pointi);
        findSpokes(pointi, spokes_);
        label begin = 0;
        while (begin < spokes_.size())
        {
            label end = begin + 1;
            while (end < spokes_.size() && spokes_[end].end == spokes_[begin].end)
            {
                ++end;
            }
            const UList<Spoke> ring(&spokes_[begin], end - begin);
            const Vertex pivot = pivotOf(pointi, ring);
            if (pivot.id != apex.id)
            {
                for (const Spoke& spoke : ring)
                {
                    cutTet(apex, pivot, spoke, complex_.pointCells()[pointi]);
                }
            }
            begin = end;
        }
    }

    // Around an edge that runs away from the point, a face that holds it in this
    // direction is crossed right-handed from its owner to its neighbour.
    void cutTet(
        const Vertex& apex, const Vertex& pivot, const Spoke& spoke,
        const UList<label>& cells
    )
    {
        const bool internal = spoke.facei < complex_.nInternalFaces();
        Vertex x = atCell(complex_.owner()[spoke.facei]);
        Vertex y = internal ? atCell(complex_.neighbour()[spoke.facei])
                            : atBoundaryFace(spoke.facei);
        if (pivot.id != x.id && pivot.id != y.id)
        {
            if (!spoke.forward)
            {
                std::swap(x, y);
            }
            tets_.cut({apex, pivot, x, y}, cells);
        }
    }

    void closeFace(label facei)
    {
        const face& f = complex_.faces()[facei];
        if (std::none_of(f.begin(), f.end(), [&](label p) { return active_[p]; }))
        {
            if (cellInside(complex_.owner()[facei]))
            {
                tets_.closeWhole(facei);
            }
            return;
        }
        const Vertex centre = atBoundaryFace(facei);
        forAll(f, k)
        {
            const Vertex corner = atBoundaryPoint(f[k]);
            tets_.close({corner, atBoundaryEdge(f[k], f.nextLabel(k)), centre}, facei);
            tets_.close({corner, centre, atBoundaryEdge(f[k], f.prevLabel(k))}, facei);
        }
    }

    const CellComplex& complex_;
    const VolumeFractions& fractions_;
    MarchingTets& tets_;
    scalar quantum_; // [m]
    std::vector<bool> active_;
    DynamicList<Spoke> spokes_;
};

} // namespace

ReconstructionResult BonnellDual::extract(const FlowSnapshot& snapshot) const
{
    const VolumeFractions fractions(snapshot);
    const CellComplex& complex = *snapshot.complex;
    MarchingTets tets(complex);
    if (complex.whole().section)
    {
        cutSection(complex, fractions, SectionMethod::bonnell, labelMax, tets);
    }
    else
    {
        DualExtraction(complex, fractions, tets).run();
    }
    return finish(tets, complex, fractions, options_);
}

} // namespace Foam::stability
