// SPDX-License-Identifier: GPL-3.0-or-later

#include "shapes/PolyMeshes.H"
#include "shapes/CellAssembly.H"
#include "shapes/Lattice.H"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace Foam::stability::shapes
{

namespace
{

using Index = Lattice::Index;

// The corners passed on a way along the axes in the given order.
Polyhedron tetrahedron(Index corner, const std::array<label, 3>& axes, Lattice& lattice)
{
    std::array<label, 4> v;
    v[0] = lattice.id(corner);
    for (label k = 0; k < 3; ++k)
    {
        ++corner[axes[k]];
        v[k + 1] = lattice.id(corner);
    }
    if ((axes[1] - axes[0] + 3) % 3 == 2)
    {
        std::swap(v[2], v[3]); // odd orders are left-handed
    }
    return {
        {v[1], v[2], v[3]}, {v[0], v[3], v[2]}, {v[0], v[1], v[3]}, {v[0], v[2], v[1]}};
}

scalar noise(const point& x, label d)
{
    const scalar s = std::sin((x & vector(12.9898, 78.233, 37.719)) + 4.1 * d);
    const scalar r = 43758.5453 * s;
    return 2 * (r - std::floor(r)) - 1;
}

labelList shuffled(label n, std::mt19937& random)
{
    labelList order(identity(n));
    std::shuffle(order.begin(), order.end(), random);
    return order;
}

// New number of each cell; the last goes to one without boundary faces.
labelList shuffledCells(const CellComplexInput& mesh, std::mt19937& random)
{
    labelList numbers(shuffled(mesh.nCells, random));
    List<bool> inside(mesh.nCells, true);
    for (label facei = mesh.neighbour.size(); facei < mesh.faces.size(); ++facei)
    {
        inside[mesh.owner[facei]] = false;
    }
    if (const label celli = inside.find(true); celli >= 0)
    {
        std::swap(numbers[celli], numbers[numbers.find(mesh.nCells - 1)]);
    }
    return numbers;
}

} // namespace

CellComplexInput renumbered(const CellComplexInput& mesh, unsigned seed)
{
    std::mt19937 random(seed);
    CellComplexInput result(mesh);
    const labelList points = shuffled(mesh.points.size(), random);
    forAll(points, i)
    {
        result.points[points[i]] = mesh.points[i];
    }
    const labelList cells = shuffledCells(mesh, random);
    const label nInternal = mesh.neighbour.size();
    const labelList internal = shuffled(nInternal, random);
    forAll(mesh.faces, facei)
    {
        face f(mesh.faces[facei]);
        for (label& pointi : f)
        {
            pointi = points[pointi];
        }
        std::rotate(f.begin(), f.begin() + random() % f.size(), f.end());
        const label to = facei < nInternal ? internal[facei] : facei;
        label owner = cells[mesh.owner[facei]];
        if (facei < nInternal)
        {
            label neighbour = cells[mesh.neighbour[facei]];
            if (owner > neighbour)
            {
                std::swap(owner, neighbour);
                f.flip();
            }
            result.neighbour[to] = neighbour;
        }
        result.owner[to] = owner;
        result.faces[to] = f;
    }
    for (label i = nInternal; i + 1 < result.faces.size(); ++i)
    {
        if (result.patches[i - nInternal] == result.patches[i + 1 - nInternal])
        {
            std::swap(result.faces[i], result.faces[i + 1]);
            std::swap(result.owner[i], result.owner[i + 1]);
        }
    }
    return result;
}

CellComplexInput perturbedBox(const BoxOptions& options, scalar amplitude)
{
    BoxOptions moved(options);
    const vector span = options.max - options.min;
    moved.map = [=](const point& x)
    {
        point y = x;
        for (direction d = 0; d < 3; ++d)
        {
            const scalar s = (x[d] - options.min[d]) / span[d];
            if (s > 1e-6 && s < 1 - 1e-6)
            {
                const point unit(cmptDivide(x - options.min, span));
                y[d] += amplitude * noise(unit, d) * span[d] / options.n[d];
            }
        }
        return y;
    };
    return boxInput(moved);
}

CellComplexInput tetrahedralBox(const BoxOptions& options)
{
    Lattice lattice(options, 1);
    std::vector<Polyhedron> cells;
    for (const Index& low : lattice.cubes())
    {
        std::array<label, 3> axes{0, 1, 2};
        do
        {
            cells.push_back(tetrahedron(low, axes, lattice));
        } while (std::next_permutation(axes.begin(), axes.end()));
    }
    return assemble(options, lattice.points(), cells);
}

CellComplexInput
refinedBox(const BoxOptions& options, const std::function<bool(const point&)>& refine)
{
    return refinedBox(
        options, [&](const point& x) { return label(refine(x)); }, 1
    );
}

CellComplexInput transformed(CellComplexInput input, scalar scale, const vector& shift)
{
    for (point& x : input.points)
    {
        x = scale * x + shift;
    }
    return input;
}

std::shared_ptr<const CellComplex> complexOf(CellComplexInput input)
{
    return std::make_shared<const CellComplex>(std::move(input));
}

} // namespace Foam::stability::shapes
