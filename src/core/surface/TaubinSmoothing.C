// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/surface/TaubinSmoothing.H"
#include "core/base/Rows.H"

#include <algorithm>
#include <utility>
#include <vector>

namespace Foam::stability
{

namespace
{

struct SortedEdge
{
    label a, b;
    bool rim; // of one triangle only
};

std::vector<SortedEdge> sortedEdges(const InterfaceMesh& mesh)
{
    std::vector<std::pair<label, label>> all;
    all.reserve(3 * std::size_t(mesh.triangles.size()));
    for (const triFace& t : mesh.triangles)
    {
        for (label k = 0; k < 3; ++k)
        {
            all.emplace_back(std::minmax(t[k], t[(k + 1) % 3]));
        }
    }
    std::sort(all.begin(), all.end());

    std::vector<SortedEdge> edges;
    for (std::size_t i = 0; i < all.size();)
    {
        std::size_t end = i + 1;
        while (end < all.size() && all[end] == all[i])
        {
            ++end;
        }
        edges.push_back({all[i].first, all[i].second, end == i + 1});
        i = end;
    }
    return edges;
}

// Those of a ribbon along its curve, none of which is a rim. The ends of the curve are
// marked.
std::vector<SortedEdge>
edgesOfCurve(const InterfaceMesh& mesh, const PlaneSection& section, List<bool>& isEnd)
{
    std::vector<SortedEdge> edges;
    for (const SortedEdge& e : sortedEdges(mesh))
    {
        if (section.isLow(mesh.points[e.a]) == section.isLow(mesh.points[e.b]))
        {
            edges.push_back({e.a, e.b, false});
        }
        else if (e.rim)
        {
            isEnd[e.a] = isEnd[e.b] = true;
        }
    }
    return edges;
}

// The neighbours that draw each point and the plane in which it moves; both stay the
// same while points move.
class Umbrella
{
public:
    Umbrella(
        const InterfaceMesh& mesh, const vectorField& boundaryNormals,
        const std::optional<PlaneSection>& section
    )
        : normals_(mesh.points.size(), Zero), fixed_(mesh.points.size(), false)
    {
        const auto edges =
            section ? edgesOfCurve(mesh, *section, fixed_) : sortedEdges(mesh);
        List<bool> onRim(mesh.points.size(), false);
        for (const SortedEdge& e : edges)
        {
            onRim[e.a] = onRim[e.a] || e.rim;
            onRim[e.b] = onRim[e.b] || e.rim;
        }
        neighbours_ = Rows(
            mesh.points.size(),
            [&](const auto& add)
            {
                for (const SortedEdge& e : edges)
                {
                    if (e.rim || !onRim[e.a])
                    {
                        add(e.a, e.b);
                    }
                    if (e.rim || !onRim[e.b])
                    {
                        add(e.b, e.a);
                    }
                }
            }
        );
        forAll(onRim, pointi)
        {
            if (onRim[pointi] && !fixed_[pointi])
            {
                bindToWall(mesh, boundaryNormals, pointi);
            }
        }
    }

    // One Laplacian step of all points at once.
    void step(scalar factor, pointField& x) const
    {
        const pointField old(x);
        forAll(x, pointi)
        {
            const UList<label> around = neighbours_[pointi];
            if (fixed_[pointi] || around.empty())
            {
                continue;
            }
            vector mean(Zero);
            for (const label otheri : around)
            {
                mean += old[otheri] - old[pointi];
            }
            mean /= around.size();
            const vector& n = normals_[pointi];
            x[pointi] += factor * (mean - (mean & n) * n);
        }
    }

private:
    void bindToWall(
        const InterfaceMesh& mesh, const vectorField& boundaryNormals, label pointi
    )
    {
        const label facei = mesh.boundaryFaces[pointi];
        const scalar area = facei < 0 ? 0 : mag(boundaryNormals[facei]);
        fixed_[pointi] = area <= 0;
        if (fixed_[pointi])
        {
            return;
        }
        normals_[pointi] = boundaryNormals[facei] / area;
        for (const label otheri : neighbours_[pointi])
        {
            const vector arm = mesh.points[otheri] - mesh.points[pointi];
            if (mag(arm & normals_[pointi]) > 1e-6 * mesh.cellSizes[pointi])
            {
                fixed_[pointi] = true;
            }
        }
    }

    Rows neighbours_;
    vectorField normals_; // of the wall at a point of the rim, else zero
    List<bool> fixed_;
};

} // namespace

vectorField taubinDisplacements(
    const InterfaceMesh& mesh, const vectorField& boundaryNormals,
    const TaubinOptions& options
)
{
    const Umbrella umbrella(mesh, boundaryNormals, options.section);
    pointField x(mesh.points);
    for (label pair = 0; pair < options.pairs; ++pair)
    {
        umbrella.step(options.lambda, x);
        umbrella.step(options.mu, x);
        forAll(x, pointi)
        {
            const vector move = x[pointi] - mesh.points[pointi];
            const scalar largest = options.largestMove * mesh.cellSizes[pointi];
            if (mag(move) > largest)
            {
                x[pointi] = mesh.points[pointi] + largest / mag(move) * move;
            }
        }
    }
    return vectorField(x - mesh.points);
}

scalarField sweptVolumes(const InterfaceMesh& mesh, const vectorField& displacements)
{
    scalarField volumes(mesh.triangles.size());
    forAll(volumes, trianglei)
    {
        const triFace& t = mesh.triangles[trianglei];
        const vector mean =
            (displacements[t[0]] + displacements[t[1]] + displacements[t[2]]) / 3;
        // The area vector is quadratic in time: Simpson's rule is exact.
        const auto area = [&](scalar time)
        {
            const point a = mesh.points[t[0]] + time * displacements[t[0]];
            const point b = mesh.points[t[1]] + time * displacements[t[1]];
            const point c = mesh.points[t[2]] + time * displacements[t[2]];
            return vector(0.5 * ((b - a) ^ (c - a)));
        };
        volumes[trianglei] = (mean & (area(0) + 4 * area(0.5) + area(1))) / 6;
    }
    return volumes;
}

} // namespace Foam::stability
