// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/parametrization/seams/SeamStraightening.H"

#include "core/surface/SurfaceLocator.H"
#include "core/surface/SurfaceTopology.H"
#include "triPointRef.H"

namespace Foam::stability
{

namespace
{

constexpr label nPasses = 20;
constexpr scalar leastStep = 0.125;
constexpr scalar leastArea = 0.25; // of what the triangle had

// True where no triangle around the point is flipped or shrunk too much at the new
// place.
bool admits(
    const PlainSurface& surface, const pointField& given, const UList<label>& around,
    label pointi, const point& place
)
{
    for (const label trianglei : around)
    {
        const triFace& t = surface.triangles[trianglei];
        FixedList<point, 3> x;
        for (label k = 0; k < 3; ++k)
        {
            x[k] = t[k] == pointi ? place : surface.points[t[k]];
        }
        const vector before = t.areaNormal(given);
        const vector after = triPointRef(x[0], x[1], x[2]).areaNormal();
        if ((after & before) < leastArea * magSqr(before))
        {
            return false;
        }
    }
    return true;
}

} // namespace

void straightenSeams(PlainSurface& surface, const UList<labelPair>& seams)
{
    const label nPoints = surface.points.size();
    const SurfaceTopology topology(nPoints, surface.triangles);
    List<bool> fixed(nPoints, false);
    for (const SurfaceEdge& edge : topology.edges())
    {
        if (edge.nTriangles != 2)
        {
            fixed[edge.a] = fixed[edge.b] = true;
        }
    }
    const Rows along(
        nPoints,
        [&](auto&& add)
        {
            for (const labelPair& edge : seams)
            {
                add(edge.first(), edge.second());
                add(edge.second(), edge.first());
            }
        }
    );
    const Rows around(trianglesAtPoints(nPoints, surface.triangles));
    const pointField given(surface.points);
    scalar length = 0;
    for (const labelPair& edge : seams)
    {
        length += mag(given[edge.first()] - given[edge.second()]) / seams.size();
    }
    if (!(length > 0))
    {
        return;
    }
    const SurfaceLocator locator(given, surface.triangles, length);
    for (label pass = 0; pass < nPasses; ++pass)
    {
        forAll(surface.points, pointi)
        {
            if (fixed[pointi] || along[pointi].size() != 2)
            {
                continue;
            }
            const point& x = surface.points[pointi];
            const point middle =
                0.5
                * (surface.points[along[pointi][0]] + surface.points[along[pointi][1]]);
            for (scalar share = 1; share >= leastStep; share *= 0.5)
            {
                const SurfacePoint foot =
                    locator.closest(x + share * (middle - x), length);
                if (foot.triangle >= 0
                    && admits(surface, given, around[pointi], pointi, foot.position))
                {
                    surface.points[pointi] = foot.position;
                    break;
                }
            }
        }
    }
}

} // namespace Foam::stability
