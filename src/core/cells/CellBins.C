// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/cells/CellBins.H"

#include "core/cells/CellComplex.H"

namespace Foam::stability
{

CellBins::CellBins(const CellComplex& complex) : box_(complex.bounds())
{
    if (complex.nCells() == 0)
    {
        return;
    }
    const scalar volume = max(sum(complex.cellVolumes()), VSMALL);
    const scalar spacing = 2 * std::cbrt(volume / complex.nCells());
    for (direction d = 0; d < 3; ++d)
    {
        size_[d] = max(label(1), min(label(256), label(box_.span()[d] / spacing)));
    }

    const auto visit = [&](const auto& add)
    {
        for (label celli = 0; celli < complex.nCells(); ++celli)
        {
            boundBox box;
            for (const label facei : complex.cellFaces()[celli])
            {
                for (const label pointi : complex.faces()[facei])
                {
                    box.add(complex.points()[pointi]);
                }
            }
            const Bin low = at(box.min()), high = at(box.max());
            for (label k = low.z(); k <= high.z(); ++k)
            {
                for (label j = low.y(); j <= high.y(); ++j)
                {
                    for (label i = low.x(); i <= high.x(); ++i)
                    {
                        add(index(Bin(i, j, k)), celli);
                    }
                }
            }
        }
    };
    cells_ = Rows(size_.x() * size_.y() * size_.z(), visit);
}

CellBins::Bin CellBins::at(const point& x) const
{
    Bin bin(0, 0, 0);
    for (direction d = 0; d < 3; ++d)
    {
        const scalar length = max(box_.span()[d], VSMALL);
        const scalar position = (x[d] - box_.min()[d]) / length;
        bin[d] = label(max(scalar(0), min(position, scalar(1))) * size_[d]);
        bin[d] = min(bin[d], size_[d] - 1);
    }
    return bin;
}

label CellBins::index(const Bin& bin) const
{
    return bin.x() + size_.x() * (bin.y() + size_.y() * bin.z());
}

label CellBins::find(const CellComplex& complex, const point& x) const
{
    if (complex.nCells() == 0)
    {
        return -1;
    }
    const Bin bin = at(x);
    for (const label celli : cells_[index(bin)])
    {
        if (complex.holds(celli, x))
        {
            return celli;
        }
    }
    // Ring by ring of bins; one more than the first that has cells.
    const pointField& centres = complex.cellCentres();
    label nearest = -1;
    label last = size_.x() + size_.y() + size_.z();
    for (label ring = 0; ring <= last; ++ring)
    {
        const label found = nearestInRing(complex, x, bin, ring);
        if (found >= 0)
        {
            last = nearest < 0 ? ring + 1 : last;
            const bool nearer =
                nearest < 0
                || magSqr(x - centres[found]) < magSqr(x - centres[nearest]);
            nearest = nearer ? found : nearest;
        }
    }
    return nearest;
}

// The cell with the nearest centre in the bins at this Chebyshev distance.
label CellBins::nearestInRing(
    const CellComplex& complex, const point& x, const Bin& bin, label ring
) const
{
    Bin low, high;
    for (direction d = 0; d < 3; ++d)
    {
        low[d] = max(label(0), bin[d] - ring);
        high[d] = min(size_[d] - 1, bin[d] + ring);
    }
    const pointField& centres = complex.cellCentres();
    label nearest = -1;
    Bin b;
    for (b.z() = low.z(); b.z() <= high.z(); ++b.z())
    {
        for (b.y() = low.y(); b.y() <= high.y(); ++b.y())
        {
            for (b.x() = low.x(); b.x() <= high.x(); ++b.x())
            {
                if (cmptMax(cmptMag(b - bin)) != ring)
                {
                    continue;
                }
                for (const label celli : cells_[index(b)])
                {
                    if (nearest < 0
                        || magSqr(x - centres[celli]) < magSqr(x - centres[nearest]))
                    {
                        nearest = celli;
                    }
                }
            }
        }
    }
    return nearest;
}

} // namespace Foam::stability
