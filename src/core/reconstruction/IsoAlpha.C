// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/reconstruction/IsoAlpha.H"
#include "core/base/Errors.H"
#include "core/reconstruction/MarchingTets.H"
#include "core/reconstruction/SectionExtraction.H"
#include "core/flow/VolumeFractions.H"

#include <algorithm>

namespace Foam::stability
{

namespace
{

using Vertex = MarchingTets::Vertex;

class IsoAlphaExtraction
{
public:
    // In this rank's cells and so many rings around them.
    IsoAlphaExtraction(
        const CellComplex& complex, const VolumeFractions& fractions, label nRings
    )
        : complex_(complex), fractions_(fractions), nRings_(nRings),
          pointValues_(complex.nPoints(), unknown), active_(complex.nPoints(), false),
          slender_(complex.nPoints(), false)
    {
        for (label celli = 0; celli < complex.nCells(); ++celli)
        {
            if (isTetrahedron(celli))
            {
                for (const label facei : complex.cellFaces()[celli])
                {
                    UIndirectList<bool>(slender_, complex.faces()[facei]) = true;
                }
            }
        }
    }

    // A tetrahedron can only be cut where one of its points is active: where the
    // cells around it, or the faces of the boundary, are not all on one side.
    void cutInto(MarchingTets& tets)
    {
        markPoints();
        const List<bool> near = cellsAtActivePoints();
        for (label facei = 0; facei < complex_.nFaces(); ++facei)
        {
            if (near[complex_.owner()[facei]] && isWanted(facei) && isActive(facei))
            {
                cutFace(facei, tets);
            }
        }
        for (label facei = complex_.nInternalFaces(); facei < complex_.nFaces();
             ++facei)
        {
            if (isWanted(facei))
            {
                closeFace(facei, tets);
            }
        }
    }

private:
    static constexpr scalar unknown = -1;

    // True if the face is near and all cells are there that decide alpha at its points.
    bool isWanted(label facei) const
    {
        const label owner = complex_.owner()[facei];
        const label neighbour =
            facei < complex_.nInternalFaces() ? complex_.neighbour()[facei] : owner;
        return std::min(complex_.ring(owner), complex_.ring(neighbour)) <= nRings_
               && complex_.hasAllNeighbours(owner)
               && complex_.hasAllNeighbours(neighbour);
    }

    bool inside(label celli) const
    {
        return VolumeFractions::inside(fractions_.cells[celli]);
    }

    bool isTetrahedron(label celli) const
    {
        return complex_.cellFaces()[celli].size() == 4;
    }

    void markPoints()
    {
        for (label pointi = 0; pointi < complex_.nPoints(); ++pointi)
        {
            const UList<label> cells = complex_.pointCells()[pointi];
            for (const label celli : cells)
            {
                if (inside(celli) != inside(cells[0]))
                {
                    active_[pointi] = true;
                    break;
                }
            }
        }
        forAll(fractions_.boundaryFaces, i)
        {
            const label facei = complex_.nInternalFaces() + i;
            if (VolumeFractions::inside(fractions_.boundaryFaces[i])
                != inside(complex_.owner()[facei]))
            {
                for (const label pointi : complex_.faces()[facei])
                {
                    active_[pointi] = true;
                }
            }
        }
    }

    List<bool> cellsAtActivePoints() const
    {
        List<bool> near(complex_.nCells(), false);
        forAll(active_, pointi)
        {
            if (active_[pointi])
            {
                for (const label celli : complex_.pointCells()[pointi])
                {
                    near[celli] = true;
                }
            }
        }
        return near;
    }

    bool isActive(label facei) const
    {
        const face& f = complex_.faces()[facei];
        return std::any_of(
            f.begin(), f.end(), [&](label pointi) { return active_[pointi]; }
        );
    }

    Vertex atCell(label celli) const
    {
        return {
            complex_.nPoints() + celli, fractions_.cells[celli],
            complex_.cellCentres()[celli], isTetrahedron(celli)};
    }

    Vertex atBoundaryFace(label facei) const
    {
        const label i = facei - complex_.nInternalFaces();
        return {
            complex_.nPoints() + complex_.nCells() + i, fractions_.boundaryFaces[i],
            complex_.faceCentres()[facei], isTetrahedron(complex_.owner()[facei])};
    }

    Vertex atPoint(label pointi)
    {
        scalar& value = pointValues_[pointi];
        if (value == unknown)
        {
            value = fractions_.atPoint(complex_, pointi);
        }
        return {pointi, value, complex_.points()[pointi], slender_[pointi]};
    }

    // If several faces lie between two cells, an edge between two of these faces has
    // only the two cells around it: its tetrahedra cancel.
    bool betweenPieces(label facei, label a, label b) const
    {
        const label owner = complex_.owner()[facei];
        const label neighbour = complex_.neighbour()[facei];
        for (const label otheri : complex_.cellFaces()[owner])
        {
            if (otheri != facei && otheri < complex_.nInternalFaces()
                && complex_.owner()[otheri] + complex_.neighbour()[otheri]
                       == owner + neighbour)
            {
                const face& f = complex_.faces()[otheri];
                if (f.found(a) && f.found(b))
                {
                    return true;
                }
            }
        }
        return false;
    }

    void cutFace(label facei, MarchingTets& tets)
    {
        const bool internal = facei < complex_.nInternalFaces();
        const label owner = complex_.owner()[facei];
        const label neighbour = internal ? complex_.neighbour()[facei] : owner;
        const Vertex v0 = atCell(owner);
        const Vertex v1 = internal ? atCell(neighbour) : atBoundaryFace(facei);
        label cells[2] = {owner, neighbour};
        const face& f = complex_.faces()[facei];
        forAll(f, k)
        {
            const label a = f[k];
            const label b = f.nextLabel(k);
            if ((active_[a] || active_[b]
                 || VolumeFractions::inside(v0.value)
                        != VolumeFractions::inside(v1.value))
                && !(internal && betweenPieces(facei, a, b)))
            {
                tets.cut(
                    {v0, v1, atPoint(a), atPoint(b)},
                    UList<label>(cells, internal ? 2 : 1)
                );
            }
        }
    }

    void closeFace(label facei, MarchingTets& tets)
    {
        if (!isActive(facei))
        {
            if (inside(complex_.owner()[facei]))
            {
                tets.closeWhole(facei);
            }
            return;
        }
        const face& f = complex_.faces()[facei];
        forAll(f, k)
        {
            tets.close(
                {atBoundaryFace(facei), atPoint(f[k]), atPoint(f.nextLabel(k))}, facei
            );
        }
    }

    const CellComplex& complex_;
    const VolumeFractions& fractions_;
    label nRings_;
    scalarField pointValues_;
    List<bool> active_;
    List<bool> slender_; // nPoints: true where a cell around the point is a tetrahedron
};

// Points that will be moved anyhow keep off the ends of edges, against slivers; not so
// at tetrahedra, where triangles would fold.
MarchingTets tetsFor(const CellComplex& complex, const ReconstructionOptions& options)
{
    constexpr scalar wide = 0.15;
    return options.sharpening == Sharpening::none ? MarchingTets(complex)
                                                  : MarchingTets(complex, wide);
}

// The number of rings of cells around a rank's own whose triangles influence its own:
// two for each pair of smoothing, and some by sharpening, which holds triangles that
// would flip.
label ringsOf(const ReconstructionOptions& options)
{
    constexpr label untangling = 4;
    return untangling + 2 * options.smooth;
}

} // namespace

ReconstructionResult IsoAlpha::extract(const FlowSnapshot& snapshot) const
{
    const VolumeFractions fractions(snapshot);
    const CellComplex& complex = *snapshot.complex;
    MarchingTets tets(tetsFor(complex, options_));
    if (complex.whole().section)
    {
        if (options_.volumeFit != VolumeFit::none)
        {
            throw BadInput("Fitting volumes (volumeFit) is for three dimensions: on a "
                           "two-dimensional mesh or a wedge it must be none.");
        }
        cutSection(
            complex, fractions, SectionMethod::isoAlpha, ringsOf(options_), tets
        );
    }
    else
    {
        IsoAlphaExtraction(complex, fractions, ringsOf(options_)).cutInto(tets);
    }
    ReconstructionResult result(finish(tets, complex, fractions, options_));
    if (options_.sharpening != Sharpening::none)
    {
        result.sharpening = sharpen(
            result.mesh, complex, fractions, options_.sharpening, options_.nThreads
        );
        result.volume.add(result.sharpening->volume);
    }
    return result;
}

} // namespace Foam::stability
