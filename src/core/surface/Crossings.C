// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/surface/Crossings.H"

#include "core/surface/Ribbon.H"

#include <algorithm>

namespace Foam::stability
{

namespace
{

// The share of the edge from a point that crossed to one that did not.
scalar crossedLength(label gone, label stayed, const Crossings& crossings)
{
    const scalar beyond = mag(crossings.beyond[gone]);
    if (!(beyond > 0))
    {
        return 0;
    }
    const vector outward = crossings.beyond[gone] / beyond;
    const scalar before = outward & (crossings.ends[gone] - crossings.ends[stayed]);
    return beyond / (beyond + std::max(before, scalar(0)));
}

} // namespace

scalar crossedShare(const triFace& triangle, const Crossings& crossings)
{
    const bool crossed[3] = {
        crossings.at(triangle[0]), crossings.at(triangle[1]),
        crossings.at(triangle[2])};
    const label nCrossed = crossed[0] + crossed[1] + crossed[2];
    if (nCrossed % 3 == 0)
    {
        return nCrossed == 3 ? 1 : 0;
    }
    // The corner that is alone on its side cuts off a triangle.
    const label alone = crossed[0] == crossed[1] ? 2 : crossed[0] == crossed[2] ? 1 : 0;
    scalar cutOff = 1;
    for (const label other : {(alone + 1) % 3, (alone + 2) % 3})
    {
        cutOff *= nCrossed == 1
                      ? crossedLength(triangle[alone], triangle[other], crossings)
                      : 1 - crossedLength(triangle[other], triangle[alone], crossings);
    }
    return nCrossed == 1 ? cutOff : 1 - cutOff;
}

List<CornerShares> cornerShares(
    const UList<triFace>& triangles, const Crossings& crossings, bool withoutCrossed
)
{
    List<CornerShares> shares(triangles.size(), CornerShares(scalar(0)));
    forAll(triangles, trianglei)
    {
        const triFace& t = triangles[trianglei];
        label nInside = 0;
        for (const label pointi : t)
        {
            nInside += !crossings.at(pointi);
        }
        const scalar inside = withoutCrossed ? 1 - crossedShare(t, crossings) : 1;
        for (label k = 0; k < 3; ++k)
        {
            shares[trianglei][k] = crossings.at(t[k]) ? 0 : inside / nInside;
        }
    }
    return shares;
}

scalarField pointAreas(
    const InterfaceMesh& mesh, const UList<CornerShares>& shares,
    const std::optional<PlaneSection>& section
)
{
    scalarField areas(mesh.points.size(), 0);
    forAll(mesh.triangles, trianglei)
    {
        const scalar area = areaInMesh(mesh, trianglei, section);
        for (label k = 0; k < 3; ++k)
        {
            areas[mesh.triangles[trianglei][k]] += shares[trianglei][k] * area;
        }
    }
    return areas;
}

} // namespace Foam::stability
