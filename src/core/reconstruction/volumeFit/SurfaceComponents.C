// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/reconstruction/volumeFit/SurfaceComponents.H"

#include "core/surface/SurfaceTopology.H"

#include <algorithm>
#include <cmath>

namespace Foam::stability
{

SurfaceComponents::SurfaceComponents(
    const InterfaceMesh& mesh, const UList<bool>& whole
)
{
    const SurfaceTopology topology(mesh.points.size(), mesh.triangles);
    ofTriangles = topology.components();
    all.resize(topology.nComponents());
    std::vector<label> ofPoints(mesh.points.size(), -1);
    forAll(mesh.triangles, trianglei)
    {
        SurfaceComponent& component = all[ofTriangles[trianglei]];
        component.triangles.push_back(trianglei);
        component.closed = component.closed && (whole.empty() || whole[trianglei]);
        for (const label pointi : mesh.triangles[trianglei])
        {
            label& other = ofPoints[pointi];
            if (other >= 0 && other != ofTriangles[trianglei])
            {
                all[other].closed = component.closed = false;
            }
            other = ofTriangles[trianglei];
        }
    }
    forAll(mesh.points, pointi)
    {
        if (ofPoints[pointi] >= 0)
        {
            SurfaceComponent& component = all[ofPoints[pointi]];
            component.points.push_back(pointi);
            component.closed = component.closed && mesh.boundaryFaces[pointi] < 0;
        }
    }
    for (const SurfaceEdge& edge : topology.edges())
    {
        SurfaceComponent& component = all[ofTriangles[edge.triangles[0]]];
        component.closed = component.closed && edge.nTriangles == 2;
    }
    for (SurfaceComponent& component : all)
    {
        component.volume =
            component.closed ? volumeWithin(component, mesh.triangles, mesh.points) : 0;
    }
}

// Tetrahedra from one of its points, against round-off far from the origin.
scalar volumeWithin(
    const SurfaceComponent& component, const UList<triFace>& triangles,
    const pointField& points
)
{
    const point& referencePoint = points[component.points[0]];
    scalar sum = 0;
    for (const label trianglei : component.triangles)
    {
        const triFace& t = triangles[trianglei];
        const vector a = points[t[0]] - referencePoint,
                     b = points[t[1]] - referencePoint,
                     c = points[t[2]] - referencePoint;
        sum += a & (b ^ c);
    }
    return sum / 6;
}

ComponentColumns::ComponentColumns(
    const InterfaceMesh& mesh, const SurfaceComponent& component
)
    : mesh_(mesh), component_(component)
{
    constexpr scalar trianglesPerBin = 2;
    boxes_.resize(component.triangles.size());
    for (std::size_t i = 0; i < boxes_.size(); ++i)
    {
        for (const label pointi : mesh.triangles[component.triangles[i]])
        {
            boxes_[i].add(mesh.points[pointi]);
        }
        bounds_.add(boxes_[i]);
    }
    const vector span = bounds_.span();
    const scalar wanted = std::sqrt(boxes_.size() / trianglesPerBin);
    width_ = std::max(std::max(span.x(), span.y()) / std::ceil(wanted), scalar(VSMALL));
    nBins_ = Bin{label(span.x() / width_) + 1, label(span.y() / width_) + 1};
    bins_ = Rows(
        nBins_[0] * nBins_[1],
        [&](auto&& add)
        {
            for (std::size_t k = 0; k < boxes_.size(); ++k)
            {
                const Bin low = binOf(boxes_[k].min()), high = binOf(boxes_[k].max());
                for (label i = low[0]; i <= high[0]; ++i)
                {
                    for (label j = low[1]; j <= high[1]; ++j)
                    {
                        add(i * nBins_[1] + j, label(k));
                    }
                }
            }
        }
    );
}

// The nearest bin where the point is beside all of them.
ComponentColumns::Bin ComponentColumns::binOf(const point& x) const
{
    Bin bin;
    for (direction d = 0; d < 2; ++d)
    {
        const scalar place = (x[d] - bounds_.min()[d]) / width_;
        const scalar last = nBins_[d] - 1;
        bin[d] = label(std::min(std::max(place, scalar(0)), last));
    }
    return bin;
}

scalar ComponentColumns::volumeIn(const CellSolid& cell) const
{
    const boundBox& box = cell.bounds();
    const Bin low = binOf(box.min()), high = binOf(box.max());
    scalar sum = 0;
    for (label i = low[0]; i <= high[0]; ++i)
    {
        for (label j = low[1]; j <= high[1]; ++j)
        {
            for (const label k : bins_[i * nBins_[1] + j])
            {
                // Each triangle once: in the first bin that it shares with the cell.
                const Bin first = binOf(boxes_[k].min());
                if (i == std::max(first[0], low[0]) && j == std::max(first[1], low[1]))
                {
                    const triFace& t = mesh_.triangles[component_.triangles[k]];
                    sum += cell.volumeBelow(
                        {mesh_.points[t[0]], mesh_.points[t[1]], mesh_.points[t[2]]}
                    );
                }
            }
        }
    }
    return sum;
}

} // namespace Foam::stability
