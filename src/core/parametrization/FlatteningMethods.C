// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/parametrization/FlatteningMethods.H"

#include "core/parametrization/cgal/CgalFlattening.H"
#include "core/parametrization/cgal/SimplePolygon.H"
#include "core/base/Errors.H"
#include "core/parametrization/SurfaceShape.H"

#include <cmath>

namespace Foam::stability
{

namespace
{

// The thinnest triangle that is told from a flat one, as height over the extent of
// the chart: well above the round-off of doubles in the unit square.
constexpr scalar thinnest = 1e-12;

bool allFinite(const List<vector2D>& chart)
{
    for (const vector2D& p : chart)
    {
        if (!std::isfinite(p.x()) || !std::isfinite(p.y()))
        {
            return false;
        }
    }
    return true;
}

scalar extent(const List<vector2D>& chart)
{
    scalar largest = 0;
    for (const vector2D& p : chart)
    {
        largest = max(largest, mag(p - chart[0]));
    }
    return largest;
}

} // namespace

const std::vector<std::string>& Flattening::names()
{
    static const std::vector<std::string> known{"lscm", "tutte"};
    return known;
}

std::unique_ptr<Flattening> Flattening::New(const std::string& method)
{
    if (method == "lscm")
    {
        return std::make_unique<LscmFlattening>();
    }
    if (method == "tutte")
    {
        return std::make_unique<TutteFlattening>();
    }
    std::string known;
    for (const std::string& name : names())
    {
        known += (known.empty() ? "" : ", ") + name;
    }
    throw BadInput("Unknown flattening \"" + method + "\"; known are " + known + ".");
}

// With positive triangles the map covers each point as often as the boundary winds
// around it, which is once where the boundary does not cross itself.
bool isOneToOne(const PlainSurface& surface, const List<vector2D>& chart)
{
    if (chart.size() != surface.points.size() || !allFinite(chart))
    {
        return false;
    }
    const scalar smallest = thinnest * extent(chart);
    for (const triFace& t : surface.triangles)
    {
        const vector2D ab = chart[t[1]] - chart[t[0]];
        const vector2D bc = chart[t[2]] - chart[t[1]];
        const vector2D ca = chart[t[0]] - chart[t[2]];
        const scalar longest = max(mag(ab), max(mag(bc), mag(ca)));
        if (!(ab.perp(bc) > smallest * longest))
        {
            return false;
        }
    }
    const List<labelList> loops = boundaryLoops(chart.size(), surface.triangles);
    return loops.size() == 1 && isSimplePolygon(List<vector2D>(chart, loops[0]));
}

} // namespace Foam::stability
