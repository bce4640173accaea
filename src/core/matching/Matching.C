// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/matching/Matching.H"

#include "core/base/DisjointSets.H"

#include <algorithm>
#include <vector>

namespace Foam::stability
{

namespace
{

// A point that may lie on a wall, moved a little towards one that does not.
point offWalls(const point& x, const point& inside)
{
    return x + 0.01 * (inside - x);
}

// The mean of the centres of the triangles around each point.
pointField middlesAround(const InterfaceMesh& mesh)
{
    pointField sums(mesh.points.size(), Zero);
    labelList n(mesh.points.size(), 0);
    forAll(mesh.triangles, trianglei)
    {
        for (const label pointi : mesh.triangles[trianglei])
        {
            sums[pointi] += mesh.centre(trianglei);
            ++n[pointi];
        }
    }
    forAll(sums, pointi)
    {
        sums[pointi] = n[pointi] > 0 ? sums[pointi] / n[pointi] : mesh.points[pointi];
    }
    return sums;
}

// True for a surface of polygons whose points are not welded: a droplet has more
// triangles.
bool isLoose(const MatchTarget& target)
{
    constexpr label fewest = 8;
    return target.mesh().triangles.size() < fewest * target.topology().nComponents();
}

// True where an end of a rim of triangle a lies beside triangle b, which faces the same
// way: the polygons of a surface whose points are not welded hang together so.
bool liesBeside(const MatchTarget& target, label a, label b, scalar gap)
{
    constexpr scalar sameWay = 0.5; // cosine
    const vector areaA = target.mesh().areaVector(a),
                 areaB = target.mesh().areaVector(b);
    if ((areaA & areaB) < sameWay * mag(areaA) * mag(areaB))
    {
        return false;
    }
    const triFace& corners = target.mesh().triangles[a];
    for (label k = 0; k < 3; ++k)
    {
        const label edgei = target.topology().triangleEdges()[a][k];
        if (target.topology().edges()[edgei].nTriangles == 1)
        {
            for (const label pointi : {corners[k], corners[(k + 1) % 3]})
            {
                const point& x = target.mesh().points[pointi];
                if (target.locator().closestOn(b, x).distance < gap)
                {
                    return true;
                }
            }
        }
    }
    return false;
}

// The number of patches among the triangles, each with its patch by edges, if those
// that lie beside each other within the gap [m] are one.
label nPatchesBeside(
    const MatchTarget& target, const std::vector<label>& triangles,
    const std::vector<label>& patches, label nPatches, scalar gap
)
{
    DisjointSets sets(nPatches);
    for (std::size_t i = 0; i < triangles.size(); ++i)
    {
        for (std::size_t j = 0; j < triangles.size(); ++j)
        {
            if (sets.root(patches[i]) != sets.root(patches[j])
                && liesBeside(target, triangles[i], triangles[j], gap))
            {
                sets.unite(patches[i], patches[j]);
            }
        }
    }
    label n = 0;
    for (label patchi = 0; patchi < nPatches; ++patchi)
    {
        n += sets.root(patchi) == patchi;
    }
    return n;
}

} // namespace

// Boxes of about epsilon (paper 4.5); the locator sees to it that they are not
// smaller than the triangles.
MatchTarget::MatchTarget(
    const InterfaceMesh& mesh, const MatchingOptions& options, const ThinWalls* walls
)
    : mesh_(mesh), walls_(walls), options_(options),
      topology_(mesh.points.size(), mesh.triangles),
      locator_(mesh.points, mesh.triangles, options.epsilon.at(mesh.meanCellSize())),
      triangleNormals_(mesh.areaVectors())
{
}

// A point on a wall belongs to the side on which its triangle lies.
bool MatchTarget::isInSight(const Seeker& seeker, const SurfacePoint& found) const
{
    return !walls_
           || !walls_->part(
               seeker.seenFrom, offWalls(found.position, mesh_.centre(found.triangle))
           );
}

Match MatchTarget::nearest(const Seeker& seeker) const
{
    const scalar epsilon = options_.epsilon.at(seeker.cellSize);
    const scalar radius = std::max(epsilon, options_.searchRadius * seeker.cellSize);

    Match result;
    result.nearest = locator_.closest(
        seeker.x, radius,
        [&](label trianglei) { return admits(trianglei, seeker.normal); },
        [&](const SurfacePoint& found) { return isInSight(seeker, found); }
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

Match MatchTarget::match(const Seeker& seeker) const
{
    Match result = nearest(seeker);
    countPreimages(result, seeker);
    return result;
}

void MatchTarget::countPreimages(Match& match, const Seeker& seeker) const
{
    match.nPreimages =
        match.stable ? countPatches(seeker, options_.epsilon.at(seeker.cellSize)) : 0;
}

void MatchTarget::admittedWithin(
    const Seeker& seeker, scalar radius, DynamicList<label>& result
) const
{
    locator_.candidates(seeker.x, radius, result);
    label n = 0;
    for (const label trianglei : result)
    {
        if (admits(trianglei, seeker.normal) && isWithin(trianglei, seeker, radius))
        {
            result[n++] = trianglei;
        }
    }
    result.setSize(n);
}

bool MatchTarget::isWithin(label trianglei, const Seeker& seeker, scalar radius) const
{
    return isNearer(trianglei, seeker.x, radius)
           && (!walls_ || isInSight(seeker, locator_.closestOn(trianglei, seeker.x)));
}

// As closestOn(...).distance < radius, mostly without it.
bool MatchTarget::isNearer(label trianglei, const point& x, scalar radius) const
{
    const triFace& t = mesh_.triangles[trianglei];
    const point &a = mesh_.points[t[0]], &b = mesh_.points[t[1]],
                &c = mesh_.points[t[2]];
    for (const point* corner : {&a, &b, &c})
    {
        if (magSqr(*corner - x) < sqr(radius))
        {
            return true;
        }
    }
    for (direction d = 0; d < 3; ++d)
    {
        const scalar low = std::min(a[d], std::min(b[d], c[d]));
        const scalar high = std::max(a[d], std::max(b[d], c[d]));
        if (low > x[d] + radius || high < x[d] - radius)
        {
            return false;
        }
    }
    return locator_.closestOn(trianglei, x).distance < radius;
}

label MatchTarget::countPatches(const Seeker& seeker, scalar epsilon) const
{
    constexpr scalar besideEachOther = 0.3; // [cells]
    static thread_local std::vector<label> near, front, found, patches;
    static thread_local std::vector<bool> waits; // per triangle: near, in no patch yet
    near.clear();
    found.clear();
    patches.clear();
    waits.resize(std::max(waits.size(), std::size_t(mesh_.triangles.size())), false);
    const vector halfWidth(epsilon, epsilon, epsilon);
    locator_.visitWithin(
        seeker.x - halfWidth, seeker.x + halfWidth,
        [&](label trianglei)
        {
            if (admits(trianglei, seeker.normal)
                && isWithin(trianglei, seeker, epsilon))
            {
                near.push_back(trianglei);
                waits[trianglei] = true;
            }
        }
    );
    label nPatches = 0;
    for (const label start : near)
    {
        if (!waits[start])
        {
            continue;
        }
        waits[start] = false;
        front.assign(1, start);
        while (!front.empty())
        {
            const label trianglei = front.back();
            front.pop_back();
            found.push_back(trianglei);
            patches.push_back(nPatches);
            for (const label edgei : topology_.triangleEdges()[trianglei])
            {
                for (const label other : topology_.edges()[edgei].triangles)
                {
                    if (other >= 0 && waits[other])
                    {
                        waits[other] = false;
                        front.push_back(other);
                    }
                }
            }
        }
        ++nPatches;
    }
    if (nPatches > 1 && isLoose(*this))
    {
        const label pointi = mesh_.triangles[near.front()][0];
        nPatches = nPatchesBeside(
            *this, found, patches, nPatches, besideEachOther * mesh_.cellSizes[pointi]
        );
    }
    return nPatches;
}

List<Match> matchPoints(
    const InterfaceMesh& mesh, const MatchTarget& target,
    const MatchingOptions& options, const UList<bool>& wanted
)
{
    const vectorField normals = mesh.pointNormals();
    const pointField middles(target.hasWalls() ? middlesAround(mesh) : mesh.points);
    List<Match> matches(mesh.points.size());
#pragma omp parallel for schedule(dynamic, 64) num_threads(options.nThreads)
    for (label pointi = 0; pointi < mesh.points.size(); ++pointi)
    {
        if (wanted.empty() || wanted[pointi])
        {
            matches[pointi] = target.match(
                {mesh.points[pointi], normals[pointi], mesh.cellSizes[pointi],
                 offWalls(mesh.points[pointi], middles[pointi])}
            );
        }
    }
    return matches;
}

} // namespace Foam::stability
