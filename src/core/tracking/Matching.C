// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

#include "core/tracking/Matching.H"

#include <algorithm>
#include <numeric>

namespace Foam::stability
{

namespace
{

vectorField directions(const InterfaceMesh& mesh)
{
    vectorField result(mesh.triangles.size());
    forAll(result, trianglei)
    {
        result[trianglei] = mesh.areaVector(trianglei);
    }
    return result;
}

} // namespace

// Boxes of about epsilon (paper 4.5); the locator sees to it that they are not
// smaller than the triangles.
MatchTarget::MatchTarget(const InterfaceMesh& mesh, const MatchingOptions& options)
    : mesh_(mesh), options_(options), topology_(mesh.points.size(), mesh.triangles),
      locator_(mesh.points, mesh.triangles, options.epsilon.at(mesh.meanCellSize())),
      triangleNormals_(directions(mesh))
{
}

Match MatchTarget::nearest(const point& x, const vector& normal, scalar cellSize) const
{
    const scalar epsilon = options_.epsilon.at(cellSize);
    const scalar radius = std::max(epsilon, options_.searchRadius * cellSize);

    Match result;
    result.nearest = locator_.closest(
        x, radius, [&](label trianglei) { return admits(trianglei, normal); }
    );
    if (result.nearest.triangle < 0)
    {
        result.nearest.distance = radius;
    }
    else
    {
        result.stable = result.nearest.distance < epsilon; // paper 4.1
    }
    return result;
}

Match MatchTarget::match(const point& x, const vector& normal, scalar cellSize) const
{
    Match result = nearest(x, normal, cellSize);
    countPreimages(result, x, normal, cellSize);
    return result;
}

void MatchTarget::countPreimages(
    Match& match, const point& x, const vector& normal, scalar cellSize
) const
{
    match.nPreimages =
        match.stable ? countPatches(x, normal, options_.epsilon.at(cellSize)) : 0;
}

void MatchTarget::admittedWithin(
    const point& x, const vector& normal, scalar radius, DynamicList<label>& result
) const
{
    locator_.candidates(x, radius, result);
    label n = 0;
    for (const label trianglei : result)
    {
        if (admits(trianglei, normal)
            && locator_.closestOn(trianglei, x).distance < radius)
        {
            result[n++] = trianglei;
        }
    }
    result.setSize(n);
}

label MatchTarget::countPatches(const point& x, const vector& normal, scalar epsilon)
    const
{
    static thread_local DynamicList<label> near;
    static thread_local DynamicList<label> parents;
    admittedWithin(x, normal, epsilon, near);
    parents.setSize(near.size());
    std::iota(parents.begin(), parents.end(), label(0));
    const auto rootOf = [](label i)
    {
        while (parents[i] != i)
        {
            i = parents[i] = parents[parents[i]];
        }
        return i;
    };

    label nPatches = near.size();
    forAll(near, i)
    {
        for (const label edgei : topology_.triangleEdges()[near[i]])
        {
            for (const label other : topology_.edges()[edgei].triangles)
            {
                const auto found = std::lower_bound(near.begin(), near.end(), other);
                if (found == near.end() || *found != other)
                {
                    continue;
                }
                const label r = rootOf(i), s = rootOf(found - near.begin());
                nPatches -= r != s;
                parents[std::max(r, s)] = std::min(r, s);
            }
        }
    }
    return nPatches;
}

List<Match> matchPoints(
    const InterfaceMesh& mesh, const MatchTarget& target,
    const MatchingOptions& options, const UList<bool>& wanted
)
{
    const vectorField normals = mesh.pointNormals();
    List<Match> matches(mesh.points.size());
#pragma omp parallel for schedule(dynamic, 64) num_threads(options.nThreads)
    for (label pointi = 0; pointi < mesh.points.size(); ++pointi)
    {
        if (wanted.empty() || wanted[pointi])
        {
            matches[pointi] = target.match(
                mesh.points[pointi], normals[pointi], mesh.cellSizes[pointi]
            );
        }
    }
    return matches;
}

} // namespace Foam::stability
