// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/cells/CellStencil.H"

#include <algorithm>

namespace Foam::stability
{

const UList<label>& CellStencil::rings(const UList<label>& seeds, label nRings)
{
    if (++present_ == 0)
    {
        std::fill(marks_.begin(), marks_.end(), 0);
        present_ = 1;
    }
    cells_ = seeds;
    for (const label celli : seeds)
    {
        marks_[celli] = present_;
    }
    label begin = 0;
    for (label ring = 0; ring < nRings; ++ring)
    {
        const label end = cells_.size();
        for (; begin < end; ++begin)
        {
            for (const label other : complex_.pointNeighbours(cells_[begin]))
            {
                if (marks_[other] != present_)
                {
                    marks_[other] = present_;
                    cells_.append(other);
                }
            }
        }
    }
    return cells_;
}

bool touchesBoundary(const CellComplex& complex, label celli)
{
    for (const label facei : complex.cellFaces()[celli])
    {
        for (const label pointi : complex.faces()[facei])
        {
            if (!complex.pointBoundaryFaces()[pointi].empty())
            {
                return true;
            }
        }
    }
    return false;
}

} // namespace Foam::stability
