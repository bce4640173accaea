// SPDX-License-Identifier: GPL-3.0-or-later

#include "shapes/CellAssembly.H"
#include "DynamicList.H"

#include <algorithm>
#include <map>

namespace Foam::stability::shapes
{

namespace
{

class Assembly
{
public:
    Assembly(const BoxOptions& options, pointField points)
        : options_(options), points_(std::move(points))
    {
    }

    CellComplexInput build(const std::vector<Polyhedron>& cells)
    {
        for (std::size_t celli = 0; celli < cells.size(); ++celli)
        {
            for (const Polygon& polygon : cells[celli])
            {
                add(polygon, label(celli));
            }
        }
        appendBoundary();

        input_.nCells = label(cells.size());
        input_.faces.transfer(faces_);
        input_.owner.transfer(owner_);
        input_.neighbour.transfer(neighbour_);
        input_.patches.transfer(patches_);
        input_.kinds.transfer(kinds_);
        input_.points = points_;
        const char* names[6] = {"xMin", "xMax", "yMin", "yMax", "zMin", "zMax"};
        input_.patchNames.setSize(6);
        for (label side = 0; side < 6; ++side)
        {
            input_.patchNames[side] = names[side];
        }
        return std::move(input_);
    }

private:
    struct Single
    {
        Polygon polygon;
        label celli;
    };

    void add(const Polygon& polygon, label celli)
    {
        Polygon key(polygon);
        std::sort(key.begin(), key.end());
        const auto found = open_.find(key);
        if (found == open_.end())
        {
            open_[key] = {polygon, celli};
            return;
        }
        // The first of the two cells is the owner: its normals point outwards.
        append(found->second.polygon, found->second.celli);
        neighbour_.append(celli);
        open_.erase(found);
    }

    void append(const Polygon& polygon, label celli)
    {
        face f(label(polygon.size()));
        std::copy(polygon.begin(), polygon.end(), f.begin());
        faces_.append(f);
        owner_.append(celli);
    }

    void appendBoundary()
    {
        for (label side = 0; side < 6; ++side)
        {
            for (const auto& entry : open_)
            {
                if (sideOf(entry.second.polygon) == side)
                {
                    append(entry.second.polygon, entry.second.celli);
                    patches_.append(side);
                    kinds_.append(options_.kinds[side]);
                }
            }
        }
    }

    label sideOf(const Polygon& polygon) const
    {
        for (label side = 0; side < 6; ++side)
        {
            const direction d = side / 2;
            const scalar plane = side % 2 ? options_.max[d] : options_.min[d];
            const scalar tolerance = 1e-9 * mag(options_.max - options_.min);
            if (std::all_of(
                    polygon.begin(), polygon.end(),
                    [&](label pointi)
                    { return mag(points_[pointi][d] - plane) < tolerance; }
                ))
            {
                return side;
            }
        }
        return -1;
    }

    const BoxOptions& options_;
    pointField points_;
    CellComplexInput input_;
    DynamicList<face> faces_;
    DynamicList<label> owner_;
    DynamicList<label> neighbour_;
    DynamicList<label> patches_;
    DynamicList<BoundaryKind> kinds_;
    std::map<Polygon, Single> open_;
};

} // namespace

CellComplexInput assemble(
    const BoxOptions& options, const pointField& points,
    const std::vector<Polyhedron>& cells
)
{
    return Assembly(options, points).build(cells);
}

} // namespace Foam::stability::shapes
