// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/ranks/CellLayer.H"

#include "core/base/Errors.H"
#include "foam/ranks/LayerGeometry.H"
#include "cyclicPolyPatch.H"
#include "emptyPolyPatch.H"
#include "processorPolyPatch.H"
#include "symmetryPlanePolyPatch.H"
#include "symmetryPolyPatch.H"
#include "wedgePolyPatch.H"

namespace Foam::stability
{

namespace
{

constexpr scalar planar = 1e-6; // shares of lengths: symmetry planes are as flat

using IsEnd = bool (*)(const polyPatch&, label i); // i: face of the patch

bool isEmpty(const polyPatch& patch, label)
{
    return isA<emptyPolyPatch>(patch);
}

bool isWedge(const polyPatch& patch, label)
{
    return isA<wedgePolyPatch>(patch);
}

// Behind the face lies the cell that has it.
bool leadsBack(const polyPatch& patch, label i)
{
    const auto* cyclic = isA<cyclicPolyPatch>(patch);
    return cyclic && patch.faceCells()[i] == cyclic->neighbPatch().faceCells()[i];
}

// The same, shifted; a cell at the axis of a rotation may have itself behind it.
bool leadsStraightBack(const polyPatch& patch, label i)
{
    return leadsBack(patch, i) && refCast<const cyclicPolyPatch>(patch).parallel();
}

bool isPlane(const polyPatch& patch, label i)
{
    return isSymmetry(patch) || leadsStraightBack(patch, i);
}

// The axis to which the area vector is nearest.
direction across(const vector& area)
{
    const vector a(cmptMag(area));
    return a.x() >= a.y() && a.x() >= a.z() ? 0 : a.y() >= a.z() ? 1 : 2;
}

class LayerSearch
{
public:
    LayerSearch(const polyMesh& mesh, const Exchange& exchange)
        : mesh_(mesh), exchange_(exchange)
    {
    }

    std::optional<CellLayer> run() const
    {
        const label nEmpty = nFaces(isEmpty), nWedge = nFaces(isWedge);
        if (nEmpty > 0 && nWedge > 0)
        {
            throw BadInput(
                "The patches " + names(isEmpty) + " (empty) and " + names(isWedge)
                + " (wedge) both have faces, which leaves one dimension; allowed is "
                  "one "
                  "layer of cells between empty planes or between wedge planes."
            );
        }
        return nEmpty > 0   ? declared(isEmpty, "empty")
               : nWedge > 0 ? declared(isWedge, "wedge")
                            : betweenPlanes();
    }

private:
    struct Ends
    {
        LayerEnds faces;
        label nWrong = 0; // cells of all ranks that do not end in one face on each side
    };

    template<class Visit>
    void forEachEnd(IsEnd isEnd, const Visit& visit) const
    {
        for (const polyPatch& patch : mesh_.boundaryMesh())
        {
            forAll(patch, i)
            {
                if (isEnd(patch, i))
                {
                    visit(patch.start() + i);
                }
            }
        }
    }

    label nFaces(IsEnd isEnd) const
    {
        label n = 0;
        forEachEnd(isEnd, [&](label) { ++n; });
        return exchange_.total(n);
    }

    // The patches that have such faces on this rank.
    labelHashSet patches(IsEnd isEnd) const
    {
        labelHashSet found;
        forEachEnd(
            isEnd,
            [&](label facei) { found.insert(mesh_.boundaryMesh().whichPatch(facei)); }
        );
        return found;
    }

    // The patches that have such faces on any rank.
    std::string names(IsEnd isEnd) const
    {
        const labelHashSet here(patches(isEnd));
        std::string list;
        for (const polyPatch& patch : mesh_.boundaryMesh())
        {
            if (!isA<processorPolyPatch>(patch)
                && exchange_.total(here.found(patch.index())) > 0)
            {
                list += (list.empty() ? "" : ", ") + patch.name();
            }
        }
        return list;
    }

    // The ends across an axis, of faces that are nearer to it than `tilt`.
    Ends endsAcross(direction d, IsEnd isEnd, scalar tilt) const
    {
        Ends ends;
        labelList nLow(mesh_.nCells(), 0), nHigh(mesh_.nCells(), 0);
        ends.faces.low.setSize(mesh_.nCells(), -1);
        ends.faces.high.setSize(mesh_.nCells(), -1);
        forEachEnd(
            isEnd,
            [&](label facei)
            {
                const vector& area = mesh_.faceAreas()[facei];
                if (mag(area[d]) < (1 - tilt) * mag(area))
                {
                    return;
                }
                const label celli = mesh_.faceOwner()[facei];
                const bool low = area[d] < 0;
                ++(low ? nLow : nHigh)[celli];
                (low ? ends.faces.low : ends.faces.high)[celli] = facei;
            }
        );
        forAll(nLow, celli)
        {
            ends.nWrong += nLow[celli] != 1 || nHigh[celli] != 1;
        }
        ends.nWrong = exchange_.total(ends.nWrong);
        return ends;
    }

    CellLayer declared(IsEnd isEnd, const std::string& type) const
    {
        FixedList<label, 3> n(label(0));
        forEachEnd(isEnd, [&](label facei) { ++n[across(mesh_.faceAreas()[facei])]; });
        std::string axes;
        direction last = 0;
        for (direction d = 0; d < 3; ++d)
        {
            n[d] = exchange_.total(n[d]);
            if (n[d] > 0)
            {
                last = d;
                axes += (axes.empty() ? "" : " and ") + std::to_string(n[d])
                        + " faces across " + "xyz"[d];
            }
        }
        const label nCells = exchange_.total(mesh_.nCells());
        const std::string found =
            "The patches of type " + type + " (" + names(isEnd) + ") have " + axes;
        const std::string allowed =
            "; allowed is one layer of cells, with one such face "
            "of each cell on either side.";
        if (n[0] + n[1] + n[2] != n[last])
        {
            throw BadInput(found + ", which leaves one dimension" + allowed);
        }
        Ends ends(endsAcross(last, isEnd, 1));
        if (ends.nWrong > 0)
        {
            throw BadInput(
                found + ", but " + std::to_string(ends.nWrong) + " of "
                + std::to_string(nCells) + " cells do not lie between two of them"
                + allowed
            );
        }
        const LayerGeometry geometry(mesh_, exchange_, last, ends.faces);
        const PlaneSection section(
            isWedge == isEnd ? geometry.wedge() : geometry.plane()
        );
        return {section, std::move(ends.faces), labelHashSet()};
    }

    std::optional<CellLayer> betweenPlanes() const
    {
        std::optional<CellLayer> found(findBetweenPlanes());
        const label nBack = nFaces(leadsBack);
        const bool oneLayer = nBack > 0 && nBack >= 2 * exchange_.total(mesh_.nCells());
        if (!found && (nFaces(leadsStraightBack) > 0 || oneLayer))
        {
            throw BadInput(
                "Cells are their own neighbours at " + std::to_string(nBack)
                + " faces of the cyclic patches " + names(leadsBack)
                + "; allowed are two or more layers of cells between such patches, or "
                  "one layer between two parallel planes that is the whole mesh (and "
                  "wedge patches around an axis)."
            );
        }
        return found;
    }

    std::optional<CellLayer> findBetweenPlanes() const
    {
        std::optional<CellLayer> found;
        for (direction d = 0; d < 3; ++d)
        {
            Ends ends(endsAcross(d, isPlane, planar));
            const LayerGeometry geometry(mesh_, exchange_, d, ends.faces);
            if (ends.nWrong > 0 || !geometry.isFlat(planar))
            {
                continue;
            }
            if (found)
            {
                return std::nullopt; // a row of cells
            }
            const PlaneSection section(geometry.plane());
            found =
                CellLayer{section, std::move(ends.faces), patches(leadsStraightBack)};
        }
        return found;
    }

    const polyMesh& mesh_;
    const Exchange& exchange_;
};

} // namespace

bool isSymmetry(const polyPatch& patch)
{
    return isA<symmetryPolyPatch>(patch) || isA<symmetryPlanePolyPatch>(patch);
}

std::optional<CellLayer> findLayer(const polyMesh& mesh, const Exchange& exchange)
{
    return LayerSearch(mesh, exchange).run();
}

} // namespace Foam::stability
