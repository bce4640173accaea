// SPDX-License-Identifier: GPL-3.0-or-later

// CGAL comes before OpenFOAM's headers, which make sqrt(double) ambiguous.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2_algorithms.h>

#include "core/parametrization/cgal/CgalScope.H"
#include "core/parametrization/cgal/SimplePolygon.H"

#include <vector>

namespace Foam::stability
{

bool isSimplePolygon(const UList<vector2D>& polygon)
{
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    if (polygon.size() < 3)
    {
        return false;
    }
    return withCgal(
        [&]
        {
            std::vector<Kernel::Point_2> points;
            points.reserve(polygon.size());
            for (const vector2D& p : polygon)
            {
                points.emplace_back(p.x(), p.y());
            }
            return CGAL::is_simple_2(points.begin(), points.end(), Kernel());
        }
    );
}

} // namespace Foam::stability
