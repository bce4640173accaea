// SPDX-License-Identifier: GPL-3.0-or-later

#include "shapes/Zoo.H"

#include "shapes/CutOut.H"
#include "shapes/DualMesh.H"
#include "shapes/PolyMeshes.H"

#include <cmath>
#include <stdexcept>

namespace Foam::stability::shapes
{

namespace
{

constexpr scalar ratio = 4.8; // of the ball's radius and the cell size

// The zoo is asked for before main begins, so nothing here may be a global object.
point offGrid()
{
    return point(6.637, 6.432, 6.781);
}

using Map = std::function<point(const point&)>;

CellComplexInput mapped(CellComplexInput input, const Map& map)
{
    for (point& x : input.points)
    {
        x = map(x);
    }
    return input;
}

// 13^3 cells of 1 m.
BoxOptions cube()
{
    return boxOf(13);
}

// Level 1 right of a plane, level 2 in a block that the ball's surface meets.
label levelAt(const point& x)
{
    const vector off = x - point(10.5, 6.5, 7.5);
    return cmptMax(cmptMag(off)) < 1.7 ? 2 : x.x() > 7.8 && x.y() < 10 ? 1 : 0;
}

CellComplexInput twoLevels()
{
    return refinedBox(cube(), levelAt, 2);
}

// Where small cells meet larger ones, the points in the middle of the larger ones'
// faces and edges are pushed into these.
CellComplexInput dented()
{
    BoxOptions options = cube();
    options.map = [](const point& x)
    {
        const bool hangs = mag(x.x() - 7) < 0.01
                           && (mag(x.y() - std::round(x.y())) > 0.1
                               || mag(x.z() - std::round(x.z())) > 0.1);
        return hangs ? x - vector(0.15, 0, 0) : x;
    };
    return refinedBox(
        options, [](const point& x) { return mag(x.x() - 8) < 1 ? 1 : 0; }, 1
    );
}

std::vector<ZooMesh> hexahedra()
{
    const auto plain = [] { return boxInput(cube()); };
    const point far(1000, -700, 300);
    const auto scaled = [=](scalar size, const vector& shift)
    {
        ZooMesh mesh;
        mesh.make = [=] { return transformed(plain(), size, shift); };
        mesh.middle = size * offGrid() + shift;
        mesh.radius = ratio * size;
        return mesh;
    };
    std::vector<ZooMesh> meshes;
    const auto add = [&](const char* name, ZooMesh mesh)
    {
        mesh.name = name;
        meshes.push_back(mesh);
    };
    add("cube", scaled(1, Zero));
    add("oneKilometreAway", scaled(0.01, far));
    add("micrometres", scaled(1e-6, Zero));
    add("kilometres", scaled(1e3, Zero));
    ZooMesh shuffled = scaled(1, Zero);
    shuffled.make = [plain] { return renumbered(plain(), 7); };
    add("renumbered", shuffled);
    ZooMesh stray = scaled(1, Zero);
    stray.make = [plain]
    {
        CellComplexInput input(plain());
        input.points.append(point(2e6, -1e7, 3e6));
        return renumbered(input, 17);
    };
    add("strayPoint", stray);
    return meshes;
}

std::vector<ZooMesh> mixed()
{
    const auto mesh = [](const char* name,
                         const std::function<CellComplexInput()>& make,
                         ZooKind kind = ZooKind::mixed) {
        return ZooMesh{name, kind, make, offGrid(), ratio};
    };
    ZooMesh tetrahedra =
        mesh("tetrahedra", [] { return renumbered(tetrahedralBox(boxOf(8)), 3); });
    tetrahedra.middle = point(4.137, 3.932, 4.081);
    tetrahedra.radius = ratio * std::cbrt(1.0 / 6);
    // Slanted planes of 68 degrees; where cells of two sizes meet, 79 degrees.
    ZooMesh oblique = mesh(
        "refinedOblique",
        []
        {
            return mapped(
                twoLevels(),
                [](const point& x) { return x + vector(2.5 * x.z(), 0, 0); }
            );
        },
        ZooKind::oblique
    );
    oblique.middle.x() += 2.5 * offGrid().z();
    return {
        mesh("warped", [] { return perturbedBox(cube()); }),
        mesh("concave", [] { return renumbered(dented(), 5); }),
        mesh("refined", [] { return renumbered(twoLevels(), 11); }),
        oblique,
        tetrahedra,
        mesh("polyhedra", [] { return renumbered(dualBox(boxOf(13)), 9); }),
    };
}

// A wall at z = 0 under layers that grow by half from 1/aspect of a cell to a whole
// one. The ball stands on the wall.
ZooMesh layers(const char* name, scalar aspect, ZooKind kind)
{
    std::vector<scalar> heights{0};
    for (scalar step = 1 / aspect; step < 1; step *= 1.5)
    {
        heights.push_back(heights.back() + step);
    }
    const label nLayers = label(heights.size()) - 1;
    BoxOptions options = cube();
    options.n.z() = nLayers + 10;
    options.max.z() = options.n.z();
    options.map = [=](const point& x)
    {
        const label k = label(std::lround(x.z()));
        const scalar z = k <= nLayers ? heights[k] : heights.back() + (k - nLayers);
        return point(x.x(), x.y(), z);
    };
    ZooMesh mesh{name, kind, [options] { return boxInput(options); }};
    mesh.middle = point(offGrid().x(), offGrid().y(), 3.781);
    mesh.radius = ratio;
    mesh.normal = vector(0.05, 0.03, 1); // almost along the layers
    mesh.lowered = mesh.middle.z() - 0.6;
    return mesh;
}

// Cells 100 times as long at one end as at the other.
ZooMesh graded()
{
    BoxOptions options;
    options.n = Vector<label>(34, 13, 13);
    options.max = point(34, 13, 13);
    const scalar growth = std::pow(100.0, 1.0 / 33);
    options.map = [=](const point& x)
    {
        const scalar ends = std::pow(growth, 34) - 1;
        return point(21 * (std::pow(growth, x.x()) - 1) / ends, x.y(), x.z());
    };
    ZooMesh mesh{"graded", ZooKind::stretched, [options] { return boxInput(options); }};
    mesh.middle = point(5.3, 6.432, 6.781);
    mesh.radius = ratio;
    return mesh;
}

std::vector<ZooMesh> stretched()
{
    return {
        graded(), layers("layers10", 10, ZooKind::stretched),
        layers("layers100", 100, ZooKind::stretched),
        layers("layers1000", 1000, ZooKind::thinnest)};
}

// A wall of no thickness through the lower half of the ball; two rooms, each with a
// part of the ball; a cell by itself beside a large region.
std::vector<ZooMesh> parted()
{
    const auto nowhere = [](const point&) { return false; };
    ZooMesh baffle{
        "baffle", ZooKind::mixed,
        [=]
        {
            return cutOut(
                boxInput(cube()), nowhere,
                [](const point& x) { return mag(x.x() - 6) < 0.01 && x.z() < 7; }
            );
        },
        offGrid(), ratio};
    ZooMesh rooms = baffle;
    rooms.name = "twoRooms";
    rooms.make = []
    {
        return renumbered(
            cutOut(
                boxInput(cube()), [](const point& x) { return mag(x.x() - 5.5) < 1; }
            ),
            13
        );
    };
    ZooMesh loneCell = baffle;
    loneCell.name = "loneCell";
    loneCell.make = []
    {
        return cutOut(
            boxInput(cube()),
            [](const point& x)
            {
                const scalar off = cmptMax(cmptMag(x - point(11.5, 6.5, 6.5)));
                return off > 0.5 && off < 1.5;
            }
        );
    };
    return {baffle, rooms, loneCell};
}

std::vector<ZooMesh> tiny()
{
    ZooMesh cell{"oneCell", ZooKind::tiny, [] { return boxInput(boxOf(1)); }};
    cell.middle = point(0.4, 0.45, 0.52);
    cell.radius = 0.45;
    return {cell};
}

// One layer of cells.
std::vector<ZooMesh> flat()
{
    BoxOptions options = cube();
    options.n.z() = 1;
    options.max.z() = 1;
    options.kinds[4] = options.kinds[5] = BoundaryKind::symmetry;
    ZooMesh layer{
        "oneLayer", ZooKind::hexahedra, [options] { return boxInput(options); }};
    layer.middle = point(offGrid().x(), offGrid().y(), 0.5);
    layer.radius = ratio;
    layer.normal = vector(1, 0.7, 0);
    layer.axis = vector(0, 0, 1);
    return {layer};
}

std::vector<ZooMesh> all()
{
    std::vector<ZooMesh> meshes;
    for (const auto& some :
         {hexahedra(), mixed(), stretched(), parted(), tiny(), flat()})
    {
        meshes.insert(meshes.end(), some.begin(), some.end());
    }
    return meshes;
}

} // namespace

Shape ZooMesh::ball() const
{
    const point centre = middle;
    const vector along = axis;
    const scalar R = radius;
    return [=](const point& x)
    {
        const vector off = x - centre;
        return mag(off - (off & along) * along) - R;
    };
}

Shape ZooMesh::plane() const
{
    return halfSpace(middle - vector(0, 0, lowered), normal);
}

const std::vector<ZooMesh>& zoo()
{
    static const std::vector<ZooMesh> meshes(all());
    return meshes;
}

const ZooMesh& zooMesh(const std::string& name)
{
    for (const ZooMesh& mesh : zoo())
    {
        if (mesh.name == name)
        {
            return mesh;
        }
    }
    throw std::logic_error("There is no mesh " + name + " in the zoo.");
}

} // namespace Foam::stability::shapes
