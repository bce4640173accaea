// SPDX-License-Identifier: GPL-3.0-or-later

#include "shapes/RefinedBox.H"

#include "shapes/CellAssembly.H"
#include "shapes/Lattice.H"

namespace Foam::stability::shapes
{

namespace
{

class Refinement
{
public:
    using Index = Lattice::Index;

    Refinement(
        const BoxOptions& options, const std::function<label(const point&)>& levelAt,
        label maxLevel
    )
        : options_(options), levelAt_(levelAt), maxLevel_(maxLevel),
          parts_(1 << maxLevel), lattice_(options, parts_), places_(options, 2)
    {
    }

    // The smallest cells first: their points tell the larger ones where to divide
    // edges.
    CellComplexInput build()
    {
        std::vector<Polyhedron> cells;
        for (label level = maxLevel_; level >= 0; --level)
        {
            for (const Index& low : lattice_.cubes())
            {
                if (sizeAt(low) == parts_ >> level)
                {
                    addParts(low, parts_ >> level, cells);
                }
            }
        }
        return assemble(options_, lattice_.points(), cells);
    }

private:
    // In steps of the lattice, of the cells into which the cell of the box is split
    // that holds this step; 0 outside the box.
    label sizeAt(const Index& step) const
    {
        Index centre;
        for (label d = 0; d < 3; ++d)
        {
            if (step[d] < 0 || step[d] >= parts_ * options_.n[d])
            {
                return 0;
            }
            centre[d] = 2 * (step[d] / parts_) + 1;
        }
        return parts_ >> levelAt_(places_.position(centre));
    }

    void addParts(const Index& low, label size, std::vector<Polyhedron>& cells)
    {
        const label n = parts_ / size;
        for (label part = 0; part < n * n * n; ++part)
        {
            const Index at{
                low[0] + size * (part % n), low[1] + size * (part / n % n),
                low[2] + size * (part / n / n)};
            Polyhedron cell;
            for (label side = 0; side < 6; ++side)
            {
                addSide(at, size, side, cell);
            }
            cells.push_back(cell);
        }
    }

    // One face, or as many as the smaller cells behind it have there.
    void addSide(const Index& low, label size, label side, Polyhedron& cell)
    {
        const label d = side / 2;
        Index behind(low), corner(low);
        behind[d] += side % 2 ? size : -1;
        corner[d] += side % 2 ? size : 0;
        const label there = sizeAt(behind);
        const label step = there > 0 ? std::min(size, there) : size;
        for (label b = 0; b < size; b += step)
        {
            for (label a = 0; a < size; a += step)
            {
                Index at(corner);
                at[(d + 1) % 3] += a;
                at[(d + 2) % 3] += b;
                cell.push_back(square(at, step, side));
            }
        }
    }

    // Right-handed seen from outside.
    Polygon square(const Index& low, label size, label side)
    {
        const label d1 = (side / 2 + 1) % 3, d2 = (side / 2 + 2) % 3;
        std::array<Index, 4> corners;
        corners.fill(low);
        corners[1][d1] += size;
        corners[2][d1] += size;
        corners[2][d2] += size;
        corners[3][d2] += size;
        if (side % 2 == 0)
        {
            std::swap(corners[1], corners[3]);
        }
        Polygon polygon;
        for (label k = 0; k < 4; ++k)
        {
            addEdge(corners[k], corners[(k + 1) % 4], size, polygon);
        }
        return polygon;
    }

    // The first end, and the points that smaller cells put between the ends.
    void addEdge(const Index& from, const Index& to, label size, Polygon& polygon)
    {
        polygon.push_back(lattice_.id(from));
        for (label step = 1; step < size; ++step)
        {
            Index at;
            for (label d = 0; d < 3; ++d)
            {
                at[d] = from[d] + step * (to[d] - from[d]) / size;
            }
            if (lattice_.has(at))
            {
                polygon.push_back(lattice_.id(at));
            }
        }
    }

    const BoxOptions& options_;
    const std::function<label(const point&)>& levelAt_;
    const label maxLevel_, parts_;
    Lattice lattice_;
    Lattice places_; // in half cells of the box
};

} // namespace

CellComplexInput refinedBox(
    const BoxOptions& options, const std::function<label(const point&)>& levelAt,
    label maxLevel
)
{
    return Refinement(options, levelAt, maxLevel).build();
}

} // namespace Foam::stability::shapes
