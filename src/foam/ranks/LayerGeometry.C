// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/ranks/LayerGeometry.H"

#include "core/ranks/ExactSum.H"

#include <cmath>

namespace Foam::stability
{

namespace
{

constexpr scalar roundOff = 1e-9; // share of the thickness
constexpr scalar aligned = 1e-4;  // shares of lengths: the coordinates have round-off

vector axisOf(direction d)
{
    vector axis(Zero);
    axis[d] = 1;
    return axis;
}

// Along an axis, where it nearly is.
vector snapped(const vector& way)
{
    for (direction i = 0; i < 3; ++i)
    {
        const vector axis(sign(way[i]) * axisOf(i));
        if (mag(way - axis) < aligned)
        {
            return axis;
        }
    }
    return way;
}

} // namespace

std::pair<scalar, scalar> LayerGeometry::range(const labelList& faces) const
{
    scalar low = GREAT, high = -GREAT;
    for (const label facei : faces)
    {
        for (const label pointi : mesh_.faces()[facei])
        {
            low = min(low, mesh_.points()[pointi][across_]);
            high = max(high, mesh_.points()[pointi][across_]);
        }
    }
    low = -largest(-low, exchange_);
    return {low, largest(high, exchange_)};
}

bool LayerGeometry::isFlat(scalar tolerance) const
{
    const auto [lowest, low] = range(ends_.low);
    const auto [high, highest] = range(ends_.high);
    return highest > lowest
           && max(low - lowest, highest - high) <= tolerance * (highest - lowest);
}

PlaneSection LayerGeometry::plane() const
{
    const scalar low = range(ends_.low).first, high = range(ends_.high).second;
    List<ExactSum> area(1);
    for (const label facei : ends_.low)
    {
        area[0].add(mag(mesh_.faceAreas()[facei][across_]));
    }
    sum(area, exchange_);
    PlaneSection section;
    section.normal = Zero;
    section.normal[across_] = 1;
    section.middle = 0.5 * (low + high);
    if (mag(section.middle) < roundOff * (high - low))
    {
        section.middle = 0;
    }
    section.meshThickness = high - low;
    section.thickness = std::sqrt(area[0].value() / exchange_.total(mesh_.nCells()));
    return section;
}

PlaneSection LayerGeometry::wedge() const
{
    List<ExactSum> sums(12); // areas, and moments of sizes of areas, low and high
    label side = 0;
    for (const labelList* faces : {&ends_.low, &ends_.high})
    {
        for (const label facei : *faces)
        {
            const vector& area = mesh_.faceAreas()[facei];
            for (direction i = 0; i < 3; ++i)
            {
                sums[6 * side + i].add(area[i]);
                sums[6 * side + 3 + i].add(mag(area) * mesh_.faceCentres()[facei][i]);
            }
        }
        ++side;
    }
    sum(sums, exchange_);
    const auto value = [&](label i)
    { return vector(sums[i].value(), sums[i + 1].value(), sums[i + 2].value()); };
    const vector low(value(0)), high(value(6));
    const point lowCentre(value(3) / mag(low)), highCentre(value(9) / mag(high));

    PlaneSection section(plane());
    section.wedge = true;
    const vector& normal = section.normal;
    vector outward(-section.inPlane(low + high)); // from the axis
    outward = snapped(outward / mag(outward));
    section.axis = normal ^ outward;
    section.axis *= sign(cmptSum(section.axis));
    section.axis += vector::zero; // no -0, which a log would show
    const auto slope = [&](const vector& area)
    { return mag((area & outward) / (area & normal)); };
    section.meshThickness = slope(low) + slope(high);
    const scalar centre = 0.5 * ((lowCentre + highCentre) & outward);
    const scalar width = (highCentre - lowCentre) & normal;
    scalar radius = nearestOfBoth(outward);
    if (radius >= GREAT)
    {
        radius = centre - width / section.meshThickness;
        radius = mag(radius) < aligned * mag(centre) ? 0 : radius;
    }
    section.axisPoint = radius * outward + section.middle * normal;
    return section;
}

scalar LayerGeometry::nearestOfBoth(const vector& outward) const
{
    List<bool> isLow(mesh_.nPoints(), false);
    for (const label facei : ends_.low)
    {
        for (const label pointi : mesh_.faces()[facei])
        {
            isLow[pointi] = true;
        }
    }
    scalar nearest = GREAT;
    for (const label facei : ends_.high)
    {
        for (const label pointi : mesh_.faces()[facei])
        {
            if (isLow[pointi])
            {
                nearest = min(nearest, mesh_.points()[pointi] & outward);
            }
        }
    }
    return -largest(-nearest, exchange_);
}

} // namespace Foam::stability
