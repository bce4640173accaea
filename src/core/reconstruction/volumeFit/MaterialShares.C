// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/reconstruction/volumeFit/MaterialShares.H"

#include "core/surface/SurfaceLocator.H"
#include "core/reconstruction/volumeFit/ComponentCells.H"

#include <algorithm>
#include <optional>

namespace Foam::stability
{

namespace
{

// The part of a component in a cell.
struct Part
{
    label component;
    scalar area = 0;  // [m2]
    scalar bulge = 0; // [m3] between its triangles and the smooth surface, on the
                      // side of their normals
};

struct RegionCell
{
    label cell;
    std::vector<Part> parts; // by component, ascending; none: nothing to share out
    bool open = false;       // true: one of them is not closed
};

class ShareFinder
{
public:
    ShareFinder(
        const InterfaceMesh& mesh, const SurfaceComponents& components,
        const CellComplex& complex, const VolumeFractions& fractions, label nThreads
    )
        : mesh_(mesh), components_(components), complex_(complex),
          alpha_(fractions.cells), nThreads_(nThreads),
          locator_(mesh.points, mesh.triangles, mesh.meanCellSize()),
          normals_(mesh.pointNormals()), places_(complex.nCells(), -1),
          columns_(components.all.size())
    {
    }

    std::vector<MaterialShare> run()
    {
        std::vector<MaterialShare> shares(components_.all.size());
        ComponentCells cells(mesh_, complex_);
        for (std::size_t i = 0; i < components_.all.size(); ++i)
        {
            if (components_.all[i].closed)
            {
                columns_[i].emplace(mesh_, components_.all[i]);
                for (const label celli : cells.of(components_.all[i]))
                {
                    addCell(celli);
                }
            }
        }
        findNear();
        findParts(0);
        grow();
        shareOut(shares);
        weighBorders(shares);
        return shares;
    }

private:
    // A volume fraction nearer to 0 or 1 than this is round-off of the solver.
    static constexpr scalar trace = 1e-6;

    scalar impurity(label celli) const
    {
        return std::min(alpha_[celli], 1 - alpha_[celli]);
    }

    bool closed(label component) const { return components_.all[component].closed; }

    // The cells around those of the region, which are still the cut ones alone.
    void findNear()
    {
        std::vector<label> cut;
        for (const RegionCell& here : region_)
        {
            cut.push_back(here.cell);
        }
        near_ = markRings(complex_, std::move(cut), reachOfShares);
    }

    void addCell(label celli)
    {
        if (places_[celli] < 0)
        {
            places_[celli] = label(region_.size());
            region_.push_back({celli, {}, false});
        }
    }

    // Finds the parts in the cells of the region from this one on.
    void findParts(std::size_t first)
    {
        const label n = label(region_.size());
#pragma omp parallel for schedule(dynamic, 16) num_threads(nThreads_)
        for (label i = label(first); i < n; ++i)
        {
            findParts(region_[i]);
        }
    }

    void findParts(RegionCell& here) const
    {
        const CellSolid cell(complex_, here.cell);
        const scalar h = complex_.cellSizes()[here.cell];
        const point middle = cell.bounds().midpoint();
        DynamicList<label> near;
        locator_.candidates(middle, 0.5 * cmptMax(cell.bounds().span()), near);
        for (const label trianglei : near)
        {
            const triFace& t = mesh_.triangles[trianglei];
            const scalar area = cell.areaWithin(
                {mesh_.points[t[0]], mesh_.points[t[1]], mesh_.points[t[2]]}
            );
            if (area > 0)
            {
                add(here.parts, components_.ofTriangles[trianglei], area, bulge(t));
            }
        }
        constexpr scalar graze = 1e-9; // of the cell
        const auto grazes = [&](const Part& p) { return p.area < graze * sqr(h); };
        here.parts.erase(
            std::remove_if(here.parts.begin(), here.parts.end(), grazes),
            here.parts.end()
        );
        if (here.parts.empty())
        {
            const SurfacePoint nearest =
                locator_.closest(complex_.cellCentres()[here.cell], GREAT);
            const label pointi = mesh_.triangles[nearest.triangle][0];
            if (nearest.distance < reachOfShares * mesh_.cellSizes[pointi])
            {
                here.parts.push_back({components_.ofTriangles[nearest.triangle]});
            }
        }
        for (const Part& part : here.parts)
        {
            here.open = here.open || !closed(part.component);
        }
    }

    static void
    add(std::vector<Part>& parts, label component, scalar area, scalar bulge)
    {
        auto at = std::lower_bound(
            parts.begin(), parts.end(), component,
            [](const Part& part, label other) { return part.component < other; }
        );
        if (at == parts.end() || at->component != component)
        {
            at = parts.insert(at, Part{component});
        }
        at->area += area;
        at->bulge += area * bulge;
    }

    // [m] mean distance from the triangle to the surface that is curved between its
    // points as their normals turn.
    scalar bulge(const triFace& t) const
    {
        scalar sum = 0;
        for (label k = 0; k < 3; ++k)
        {
            const label i = t[k], j = t[(k + 1) % 3];
            sum += (normals_[j] - normals_[i]) & (mesh_.points[j] - mesh_.points[i]);
        }
        return sum / 24; // the mean of the product of two barycentric weights: 1/12
    }

    template<class Visit>
    void visitMixedNeighbours(label celli, const Visit& visit) const
    {
        for (const label facei : complex_.cellFaces()[celli])
        {
            if (facei < complex_.nInternalFaces())
            {
                const label other = complex_.owner()[facei] == celli
                                        ? complex_.neighbour()[facei]
                                        : complex_.owner()[facei];
                if (impurity(other) > trace)
                {
                    visit(other);
                }
            }
        }
    }

    // On into the tails of alpha, not beyond what is nearer to an open component.
    void grow()
    {
        for (std::size_t first = 0; first < region_.size();)
        {
            const std::size_t last = region_.size();
            for (std::size_t i = first; i < last; ++i)
            {
                if (!region_[i].open && !region_[i].parts.empty())
                {
                    visitMixedNeighbours(
                        region_[i].cell,
                        [&](label other)
                        {
                            if (near_[other])
                            {
                                addCell(other);
                            }
                        }
                    );
                }
            }
            findParts(last);
            first = last;
        }
    }

    // [m3] of the first material that each part gains in this cell.
    std::vector<scalar> gains(const RegionCell& here) const
    {
        const CellSolid cell(complex_, here.cell);
        const std::vector<Part>& parts = here.parts;
        scalar surplus = alpha_[here.cell] * cell.volume();
        scalar largest = 0, weights = 0;
        for (const Part& part : parts)
        {
            const scalar volume = components_.all[part.component].volume;
            largest = mag(volume) > mag(largest) ? volume : largest;
            surplus -= columns_[part.component]->volumeIn(cell);
            weights += sqr(part.area);
        }
        // If the largest is a bubble, the first material lies around all of them.
        surplus -= largest < 0 ? cell.volume() : 0;
        if (parts.size() == 1)
        {
            return {surplus};
        }
        // Each component is about as far off as the others, so the surplus is that of
        // the areas, and most likely in the ratio of their squares.
        std::vector<scalar> result;
        for (const Part& part : parts)
        {
            result.push_back(part.bulge);
            surplus -= part.bulge;
        }
        for (std::size_t i = 0; i < parts.size(); ++i)
        {
            result[i] += sqr(parts[i].area) / weights * surplus;
        }
        return result;
    }

    void shareOut(std::vector<MaterialShare>& shares) const
    {
        const label n = label(region_.size());
        std::vector<std::vector<scalar>> all(n);
#pragma omp parallel for schedule(dynamic, 16) num_threads(nThreads_)
        for (label i = 0; i < n; ++i)
        {
            if (!region_[i].open && !region_[i].parts.empty())
            {
                all[i] = gains(region_[i]);
            }
        }
        for (label i = 0; i < n; ++i)
        {
            for (std::size_t k = 0; k < all[i].size(); ++k)
            {
                shares[region_[i].parts[k].component].gain.add(all[i][k]);
            }
        }
    }

    // Adds up the volumes at borders between closed components and those that are not
    // closed.
    void weighBorders(std::vector<MaterialShare>& shares) const
    {
        const scalarField& V = complex_.cellVolumes();
        for (const RegionCell& here : region_)
        {
            scalar unclear = 0;
            if (here.open)
            {
                unclear = here.parts.size() > 1 ? V[here.cell] : 0;
            }
            else
            {
                visitMixedNeighbours(
                    here.cell,
                    [&](label other)
                    {
                        if (places_[other] >= 0 && region_[places_[other]].open)
                        {
                            unclear += std::min(
                                impurity(here.cell) * V[here.cell],
                                impurity(other) * V[other]
                            );
                        }
                    }
                );
            }
            for (const Part& part : here.parts)
            {
                if (closed(part.component))
                {
                    shares[part.component].openVolume.add(unclear);
                }
            }
        }
    }

    const InterfaceMesh& mesh_;
    const SurfaceComponents& components_;
    const CellComplex& complex_;
    const scalarField& alpha_;
    label nThreads_;
    SurfaceLocator locator_;
    vectorField normals_; // per point
    std::vector<RegionCell> region_;
    std::vector<label> places_; // per cell: where in the region
    std::vector<char> near_;    // per cell: 1 within the reach of the cut cells
    std::vector<std::optional<ComponentColumns>> columns_;
};

} // namespace

std::vector<MaterialShare> materialShares(
    const InterfaceMesh& mesh, const SurfaceComponents& components,
    const CellComplex& complex, const VolumeFractions& fractions, label nThreads
)
{
    return ShareFinder(mesh, components, complex, fractions, nThreads).run();
}

} // namespace Foam::stability
