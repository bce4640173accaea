// SPDX-License-Identifier: GPL-3.0-or-later

#include "shapes/PolyMeshes.H"
#include "shapes/CellAssembly.H"

#include "DynamicList.H"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <vector>

namespace Foam::stability::shapes
{

namespace
{

// Points numbered as they are asked for, on a lattice of half cells.
class Lattice
{
public:
    using Index = std::array<label, 3>; // in half cells

    explicit Lattice(const BoxOptions& options) : options_(options) {}

    point position(const Index& i) const
    {
        const vector span = options_.max - options_.min;
        point x = options_.min;
        for (direction d = 0; d < 3; ++d)
        {
            x[d] += span[d] * i[d] / (2 * options_.n[d]);
        }
        return x;
    }

    label id(const Index& i)
    {
        const auto found = ids_.find(i);
        if (found != ids_.end())
        {
            return found->second;
        }
        const label pointi = points_.size();
        ids_[i] = pointi;
        const point x = position(i);
        points_.append(options_.map ? options_.map(x) : x);
        return pointi;
    }

    bool has(const Index& i) const { return ids_.count(i); }
    pointField points() const { return pointField(points_); }

private:
    const BoxOptions& options_;
    std::map<Index, label> ids_;
    DynamicList<point> points_;
};

using Index = Lattice::Index;

// The square of a cube towards side s, in half cells: four corners, right-handed
// seen from outside.
std::array<Index, 4> square(const Index& low, label size, label side)
{
    const label d = side / 2;
    const label d1 = (d + 1) % 3;
    const label d2 = (d + 2) % 3;
    std::array<Index, 4> corners;
    corners.fill(low);
    for (Index& corner : corners)
    {
        corner[d] += side % 2 ? size : 0;
    }
    corners[1][d1] += size;
    corners[2][d1] += size;
    corners[2][d2] += size;
    corners[3][d2] += size;
    if (side % 2 == 0)
    {
        std::swap(corners[1], corners[3]);
    }
    return corners;
}

Index between(const Index& a, const Index& b)
{
    return {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
}

Polygon plainPolygon(const std::array<Index, 4>& corners, Lattice& lattice)
{
    Polygon polygon;
    for (const Index& corner : corners)
    {
        polygon.push_back(lattice.id(corner));
    }
    return polygon;
}

// A square of a coarse cell, with the points that finer neighbours put on its edges.
Polygon polygonOf(const std::array<Index, 4>& corners, Lattice& lattice)
{
    Polygon polygon;
    for (label k = 0; k < 4; ++k)
    {
        const Index& next = corners[(k + 1) % 4];
        polygon.push_back(lattice.id(corners[k]));
        const Index middle = between(corners[k], next);
        if (lattice.has(middle))
        {
            polygon.push_back(lattice.id(middle));
        }
    }
    return polygon;
}

// The low corners of the cells of the box.
std::vector<Index> cubes(const BoxOptions& options)
{
    std::vector<Index> all;
    for (label k = 0; k < options.n.z(); ++k)
    {
        for (label j = 0; j < options.n.y(); ++j)
        {
            for (label i = 0; i < options.n.x(); ++i)
            {
                all.push_back({2 * i, 2 * j, 2 * k});
            }
        }
    }
    return all;
}

// The corners passed on a way along the axes in the given order.
Polyhedron tetrahedron(Index corner, const std::array<label, 3>& axes, Lattice& lattice)
{
    std::array<label, 4> v;
    v[0] = lattice.id(corner);
    for (label k = 0; k < 3; ++k)
    {
        corner[axes[k]] += 2;
        v[k + 1] = lattice.id(corner);
    }
    if ((axes[1] - axes[0] + 3) % 3 == 2)
    {
        std::swap(v[2], v[3]); // odd orders are left-handed
    }
    return {
        {v[1], v[2], v[3]}, {v[0], v[3], v[2]}, {v[0], v[1], v[3]}, {v[0], v[2], v[1]}};
}

Polyhedron fineCell(const Index& low, label octant, Lattice& lattice)
{
    const Index fine{low[0] + octant % 2, low[1] + octant / 2 % 2, low[2] + octant / 4};
    Polyhedron cell;
    for (label side = 0; side < 6; ++side)
    {
        cell.push_back(plainPolygon(square(fine, 1, side), lattice));
    }
    return cell;
}

// Four faces instead of one towards a refined cell.
Polyhedron coarseCell(
    const Index& low, const std::function<bool(const Index&)>& refined, Lattice& lattice
)
{
    Polyhedron cell;
    for (label side = 0; side < 6; ++side)
    {
        const label d = side / 2;
        Index next = low;
        next[d] += side % 2 ? 2 : -2;
        if (!refined(next))
        {
            cell.push_back(polygonOf(square(low, 2, side), lattice));
            continue;
        }
        for (label quarter = 0; quarter < 4; ++quarter)
        {
            Index fine = low;
            fine[d] += side % 2;
            fine[(d + 1) % 3] += quarter % 2;
            fine[(d + 2) % 3] += quarter / 2;
            cell.push_back(plainPolygon(square(fine, 1, side), lattice));
        }
    }
    return cell;
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
    Lattice lattice(options);
    std::vector<Polyhedron> cells;
    for (const Index& low : cubes(options))
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
    Lattice lattice(options);
    const auto refined = [&](const Index& low)
    {
        for (label d = 0; d < 3; ++d)
        {
            if (low[d] < 0 || low[d] >= 2 * options.n[d])
            {
                return false;
            }
        }
        return refine(lattice.position({low[0] + 1, low[1] + 1, low[2] + 1}));
    };
    // The fine cells first: their points tell the coarse ones where to divide edges.
    std::vector<Polyhedron> cells;
    for (const Index& low : cubes(options))
    {
        for (label octant = 0; octant < 8 && refined(low); ++octant)
        {
            cells.push_back(fineCell(low, octant, lattice));
        }
    }
    for (const Index& low : cubes(options))
    {
        if (!refined(low))
        {
            cells.push_back(coarseCell(low, refined, lattice));
        }
    }
    return assemble(options, lattice.points(), cells);
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
