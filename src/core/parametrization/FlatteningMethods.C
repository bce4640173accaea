// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/parametrization/FlatteningMethods.H"

#include "core/parametrization/SphereMapping.H"
#include "core/parametrization/abf/AngleBasedFlattening.H"
#include "core/parametrization/cgal/CgalFlattening.H"
#include "core/parametrization/cgal/SimplePolygon.H"
#include "core/base/Errors.H"
#include "core/parametrization/SurfaceShape.H"

#include <cmath>
#include <functional>

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

struct Method
{
    std::string name;
    bool isFallback; // of others
    std::function<std::unique_ptr<Flattening>()> make;
};

// In the order in which they are fallbacks.
const std::vector<Method>& methods()
{
    static const std::vector<Method> all{
        {"abf", true, [] { return std::make_unique<AngleBasedFlattening>(60); }},
        {"linAbf", true, [] { return std::make_unique<AngleBasedFlattening>(1); }},
        {"lscm", true, [] { return std::make_unique<LscmFlattening>(); }},
        {"arap", false, [] { return std::make_unique<ArapFlattening>(); }},
        {"sphere", false, [] { return std::make_unique<SphereMapping>(); }},
        {"tutte", true, [] { return std::make_unique<TutteFlattening>(); }},
    };
    return all;
}

} // namespace

scalar PlainSurface::area() const
{
    scalar sum = 0;
    for (const triFace& t : triangles)
    {
        sum += t.mag(points);
    }
    return sum;
}

const std::vector<std::string>& Flattening::names()
{
    static const std::vector<std::string> known = []
    {
        std::vector<std::string> all;
        for (const Method& method : methods())
        {
            all.emplace_back(method.name);
        }
        return all;
    }();
    return known;
}

std::vector<std::string> Flattening::fallbacksOf(const std::string& method)
{
    std::vector<std::string> others;
    for (const Method& other : methods())
    {
        if (other.isFallback && other.name != method)
        {
            others.emplace_back(other.name);
        }
    }
    return others;
}

std::unique_ptr<Flattening> Flattening::New(const std::string& name)
{
    std::string known;
    for (const Method& method : methods())
    {
        if (method.name == name)
        {
            return method.make();
        }
        known += (known.empty() ? "" : ", ") + std::string(method.name);
    }
    throw BadInput("Unknown flattening \"" + name + "\"; known are " + known + ".");
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
