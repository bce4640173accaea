// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/results/ParameterSpace.H"

#include <algorithm>

namespace Foam::stability
{

namespace
{

const std::vector<double>&
valuesOf(const ResultSurface& surface, const std::string& name)
{
    const auto array = std::find_if(
        surface.arrays.begin(), surface.arrays.end(),
        [&](const PointArray& a) { return a.name == name; }
    );
    return array->values;
}

// The number of each point among those whose place in the texture is their p: the
// others lie on a swatch. Negative for those.
labelList numbersOf(const ResultSurface& interface, label& nKept)
{
    const std::vector<double>& p = valuesOf(interface, "parameter");
    const std::vector<double>& texture = valuesOf(interface, "TCoords");
    labelList numbers(interface.points.size(), -1);
    nKept = 0;
    forAll(numbers, i)
    {
        const std::size_t j = 2 * std::size_t(i);
        if (p[j] == texture[j] && p[j + 1] == texture[j + 1])
        {
            numbers[i] = nKept++;
        }
    }
    return numbers;
}

} // namespace

// Of triangles on a swatch all corners lie there.
ResultSurface parameterSpace(const ResultSurface& interface)
{
    label nKept = 0;
    const labelList numbers(numbersOf(interface, nKept));
    const std::vector<double>& p = valuesOf(interface, "parameter");
    ResultSurface result;
    result.time = interface.time;
    result.inParameterSpace = true;
    result.points.setSize(nKept);
    for (const PointArray& array : interface.arrays)
    {
        PointArray part{
            array.name, array.nComponents, array.integer, {}, array.position};
        forAll(numbers, i)
        {
            if (numbers[i] >= 0)
            {
                const auto start =
                    array.values.begin() + std::ptrdiff_t(i) * array.nComponents;
                part.values.insert(part.values.end(), start, start + array.nComponents);
            }
        }
        result.arrays.push_back(std::move(part));
    }
    forAll(numbers, i)
    {
        if (numbers[i] >= 0)
        {
            const std::size_t j = 2 * std::size_t(i);
            result.points[numbers[i]] = point(p[j], p[j + 1], 0);
        }
    }
    DynamicList<triFace> triangles;
    for (const triFace& t : interface.triangles)
    {
        if (numbers[t[0]] >= 0)
        {
            triangles.append(triFace(numbers[t[0]], numbers[t[1]], numbers[t[2]]));
        }
    }
    result.triangles = std::move(triangles);
    return result;
}

} // namespace Foam::stability
