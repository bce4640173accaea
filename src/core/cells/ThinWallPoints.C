// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/cells/ThinWallPoints.H"

#include "core/base/DisjointSets.H"

#include <algorithm>
#include <utility>
#include <vector>

namespace Foam::stability
{

namespace
{

// The corners of cells at the points of boundary faces, joined by internal faces.
class BoundaryCorners
{
public:
    explicit BoundaryCorners(const CellComplexInput& mesh)
        : mesh_(mesh), nInternal_(mesh.neighbour.size()),
          onBoundary_(mesh.points.size(), false), corners_(cornersOf()),
          groups_(label(corners_.size()))
    {
        for (label facei = 0; facei < nInternal_; ++facei)
        {
            for (const label pointi : mesh_.faces[facei])
            {
                if (onBoundary_[pointi])
                {
                    groups_.unite(
                        place(pointi, mesh_.owner[facei]),
                        place(pointi, mesh_.neighbour[facei])
                    );
                }
            }
        }
    }

    // Calls visit(corner, pointi, group) for each corner, those of a point together. A
    // corner and its group are numbers below size(); that of the group is the lowest of
    // its corners.
    template<class Visit>
    void visit(const Visit& visit)
    {
        for (label i = 0; i < size(); ++i)
        {
            visit(i, corners_[i].first, groups_.root(i));
        }
    }

    label size() const { return label(corners_.size()); }
    bool onBoundary(label pointi) const { return onBoundary_[pointi]; }

    label place(label pointi, label celli) const
    {
        return label(
            std::lower_bound(corners_.begin(), corners_.end(), Corner(pointi, celli))
            - corners_.begin()
        );
    }

private:
    using Corner = std::pair<label, label>; // point and cell

    std::vector<Corner> cornersOf()
    {
        for (label facei = nInternal_; facei < mesh_.faces.size(); ++facei)
        {
            for (const label pointi : mesh_.faces[facei])
            {
                onBoundary_[pointi] = true;
            }
        }
        std::vector<Corner> corners;
        forAll(mesh_.faces, facei)
        {
            for (const label pointi : mesh_.faces[facei])
            {
                if (onBoundary_[pointi])
                {
                    corners.emplace_back(pointi, mesh_.owner[facei]);
                    if (facei < nInternal_)
                    {
                        corners.emplace_back(pointi, mesh_.neighbour[facei]);
                    }
                }
            }
        }
        std::sort(corners.begin(), corners.end());
        corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
        return corners;
    }

    const CellComplexInput& mesh_;
    label nInternal_;
    List<bool> onBoundary_;
    std::vector<Corner> corners_;
    DisjointSets groups_;
};

} // namespace

void splitThinWallPoints(CellComplexInput& mesh)
{
    BoundaryCorners corners(mesh);
    labelList points(corners.size()); // of the groups of corners
    DynamicList<point> added;
    label before = -1;
    corners.visit(
        [&](label corner, label pointi, label group)
        {
            if (pointi != before)
            {
                points[corner] = pointi; // the first group keeps it
            }
            else if (corner == group)
            {
                points[corner] = mesh.points.size() + added.size();
                added.append(mesh.points[pointi]);
            }
            else
            {
                points[corner] = points[group];
            }
            before = pointi;
        }
    );
    if (added.empty())
    {
        return;
    }
    forAll(mesh.faces, facei)
    {
        for (label& pointi : mesh.faces[facei])
        {
            if (corners.onBoundary(pointi))
            {
                pointi = points[corners.place(pointi, mesh.owner[facei])];
            }
        }
    }
    mesh.points.append(added);
}

} // namespace Foam::stability
