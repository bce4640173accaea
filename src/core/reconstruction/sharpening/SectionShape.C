// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/reconstruction/sharpening/SectionShape.H"

#include "core/reconstruction/sharpening/OffsetSearch.H"

#include <algorithm>

namespace Foam::stability
{

SectionShape::SectionShape(const CellComplex& complex, label celli)
    : section_(*complex.whole().section), origin_(complex.cellCentres()[celli])
{
    for (const label facei : complex.cellFaces()[celli])
    {
        if (!complex.isEnd(facei))
        {
            const labelPair ends(
                section_.edgeOf(complex.faces()[facei], complex.points())
            );
            const point a = section_.inMiddle(complex.points()[ends.first()]) - origin_;
            const point b =
                section_.inMiddle(complex.points()[ends.second()]) - origin_;
            edges_.push_back(complex.owner()[facei] == celli ? Edge{a, b} : Edge{b, a});
            area_ += 0.5 * ((a ^ b) & section_.normal) * weight((a + b) / 3)
                     * (complex.owner()[facei] == celli ? 1 : -1);
        }
    }
}

// In a wedge the distance from the axis, linear also beyond it.
scalar SectionShape::weight(const point& x) const
{
    if (!section_.wedge)
    {
        return 1;
    }
    const vector outwards = section_.axis ^ section_.normal;
    const scalar side = (origin_ - section_.axisPoint) & outwards;
    return ((origin_ + x - section_.axisPoint) & outwards) * (side < 0 ? -1 : 1);
}

// Triangles from a point on the plane, to which the plane itself adds nothing.
scalar SectionShape::cut(
    const vector& normal, scalar offset, std::vector<scalar>& crossings
) const
{
    crossings.clear();
    const point apex = offset * normal;
    scalar kept = 0;
    for (const Edge& edge : edges_)
    {
        const scalar da = (edge.a & normal) - offset, db = (edge.b & normal) - offset;
        point a = edge.a, b = edge.b;
        if ((da > 0) != (db > 0))
        {
            const point x = a + da / (da - db) * (b - a);
            crossings.push_back(x & along(normal));
            (da > 0 ? b : a) = x;
        }
        if (da > 0 || db > 0)
        {
            kept += 0.5 * (((a - apex) ^ (b - apex)) & section_.normal)
                    * weight((apex + a + b) / 3);
        }
    }
    std::sort(crossings.begin(), crossings.end());
    return kept;
}

PlicPlane SectionShape::planeOf(const vector& normal, scalar alpha) const
{
    PlicPlane plane;
    plane.normal = normal;
    scalar low = GREAT, high = -GREAT;
    for (const Edge& edge : edges_)
    {
        low = std::min(low, edge.a & normal);
        high = std::max(high, edge.a & normal);
    }
    const vector t = along(normal);
    std::vector<scalar> crossings;
    const auto shareBeyond = [&](scalar offset, PlicPlane& plane)
    {
        const scalar kept = cut(normal, offset, crossings);
        scalar length = 0, weighted = 0, first = 0, second = 0;
        for (std::size_t i = 0; i + 1 < crossings.size(); i += 2)
        {
            const scalar a = crossings[i], b = crossings[i + 1];
            length += b - a;
            // Simpson's rule, exact for a weight that is linear.
            const scalar places[3] = {a, 0.5 * (a + b), b}, shares[3] = {1, 4, 1};
            for (label k = 0; k < 3; ++k)
            {
                const scalar w =
                    shares[k] / 6 * (b - a) * weight(offset * normal + places[k] * t);
                weighted += w;
                first += w * places[k];
                second += w * sqr(places[k]);
            }
        }
        plane.area = length * section_.thickness;
        if (weighted > 0)
        {
            const scalar mean = first / weighted;
            plane.centre = section_.inMiddle(origin_ + offset * normal + mean * t);
            plane.secondMoment = (second / weighted - sqr(mean)) * sqr(t);
        }
        return ShareBeyond{kept / area_, weighted / area_};
    };
    searchOffset(low, high, alpha, plane, shareBeyond);
    return plane;
}

std::vector<point> SectionShape::polygonOf(const PlicPlane& plane) const
{
    std::vector<scalar> crossings;
    const scalar offset = (plane.centre - origin_) & plane.normal;
    cut(plane.normal, offset, crossings);
    scalar a = 0, b = 0;
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2)
    {
        if (crossings[i + 1] - crossings[i] > b - a)
        {
            a = crossings[i];
            b = crossings[i + 1];
        }
    }
    if (!(b > a))
    {
        return {};
    }
    const vector t = along(plane.normal);
    const point x = origin_ + offset * plane.normal + a * t;
    const point y = origin_ + offset * plane.normal + b * t;
    return {
        section_.inLow(x), section_.inLow(y), section_.inHigh(y), section_.inHigh(x)};
}

PlicPlane
planeIn(const CellComplex& complex, label celli, const vector& normal, scalar alpha)
{
    return complex.whole().section ? SectionShape(complex, celli).planeOf(normal, alpha)
                                   : CellShape(complex, celli).planeOf(normal, alpha);
}

std::vector<point>
polygonIn(const CellComplex& complex, label celli, const PlicPlane& plane)
{
    return complex.whole().section ? SectionShape(complex, celli).polygonOf(plane)
                                   : CellShape(complex, celli).polygonOf(plane);
}

} // namespace Foam::stability
