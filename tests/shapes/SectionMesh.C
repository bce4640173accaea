// SPDX-License-Identifier: GPL-3.0-or-later

#include "shapes/SectionMesh.H"

#include <cmath>
#include <map>

namespace Foam::stability::shapes
{

namespace
{

// Places are counted in halves of a quadrangle.
class SectionBuilder
{
public:
    explicit SectionBuilder(const SectionOptions& options) : options_(options) {}

    CellComplexInput build()
    {
        for (label j = 0; j < options_.ny; ++j)
        {
            for (label i = 0; i < options_.nx; ++i)
            {
                addCells(2 * i, 2 * j);
            }
        }
        divideEdges();
        PlaneSection section;
        section.normal = Zero;
        section.normal[options_.normal] = 1;
        section.middle = options_.middle;
        section.meshThickness = options_.meshThickness;
        section.wedge = options_.wedge;
        section.axisPoint = placed(options_, options_.min);
        section.axis[(options_.normal + 1) % 3] = 1;
        const vector span = options_.max - options_.min;
        section.thickness = std::sqrt(span.x() * span.y() / cells_.size());

        BoxOptions box;
        const scalar half = 0.5 * section.thickness;
        box.min =
            placed(options_, options_.min - vector(0, 0, options_.min.z() + half));
        box.max =
            placed(options_, options_.max + vector(0, 0, half - options_.max.z()));
        box.kinds = BoundaryKind::symmetry;
        for (label side = 0; side < 4; ++side)
        {
            const direction d = (options_.normal + 1 + side / 2) % 3;
            box.kinds[2 * d + side % 2] = options_.kinds[side];
        }
        CellComplexInput input(assemble(box, extrudedPoints(half), extrudedCells()));
        input.whole.emplace();
        input.whole->bounds = boundBox(input.points, false);
        input.whole->section = section;
        return input;
    }

private:
    using Place = std::pair<label, label>;

    label pointAt(label i, label j)
    {
        const auto [found, isNew] = points_.insert({{i, j}, label(places_.size())});
        if (isNew)
        {
            places_.push_back({i, j});
        }
        return found->second;
    }

    point at(const Place& place) const
    {
        const vector span = options_.max - options_.min;
        return options_.min
               + vector(
                   place.first * span.x() / (2 * options_.nx),
                   place.second * span.y() / (2 * options_.ny), 0
               );
    }

    void addQuadrangle(label i, label j, label width)
    {
        const label a = pointAt(i, j), b = pointAt(i + width, j),
                    c = pointAt(i + width, j + width), d = pointAt(i, j + width);
        if (!options_.triangles)
        {
            cells_.push_back({a, b, c, d});
            return;
        }
        const bool rising = (i / width + j / width) % 2 == 0;
        cells_.push_back(rising ? Polygon{a, b, c} : Polygon{a, b, d});
        cells_.push_back(rising ? Polygon{a, c, d} : Polygon{b, c, d});
    }

    void addCells(label i, label j)
    {
        if (!options_.refine || !options_.refine(at({i + 1, j + 1})))
        {
            addQuadrangle(i, j, 2);
            return;
        }
        for (label k = 0; k < 4; ++k)
        {
            addQuadrangle(i + k % 2, j + k / 2, 1);
        }
    }

    // Points of refined cells in the middle of an edge become its points.
    void divideEdges()
    {
        for (Polygon& cell : cells_)
        {
            Polygon divided;
            for (std::size_t k = 0; k < cell.size(); ++k)
            {
                const Place a = places_[cell[k]];
                const Place b = places_[cell[(k + 1) % cell.size()]];
                divided.push_back(cell[k]);
                const label i = a.first + b.first, j = a.second + b.second;
                const auto middle = points_.find({i / 2, j / 2});
                if (i % 2 == 0 && j % 2 == 0 && middle != points_.end())
                {
                    divided.push_back(middle->second);
                }
            }
            cell = divided;
        }
    }

    pointField extrudedPoints(scalar half) const
    {
        pointField points(2 * places_.size());
        for (std::size_t i = 0; i < places_.size(); ++i)
        {
            point x = at(places_[i]);
            x = options_.map ? options_.map(x) : x;
            points[2 * i] = placed(options_, point(x.x(), x.y(), -half));
            points[2 * i + 1] = placed(options_, point(x.x(), x.y(), half));
        }
        return points;
    }

    std::vector<Polyhedron> extrudedCells() const
    {
        std::vector<Polyhedron> prisms;
        for (const Polygon& cell : cells_)
        {
            Polyhedron prism(2);
            for (std::size_t k = 0; k < cell.size(); ++k)
            {
                const label a = 2 * cell[k], b = 2 * cell[(k + 1) % cell.size()];
                prism[0].insert(prism[0].begin(), a);
                prism[1].push_back(a + 1);
                prism.push_back({a, b, b + 1, a + 1});
            }
            prisms.push_back(prism);
        }
        return prisms;
    }

    const SectionOptions& options_;
    std::map<Place, label> points_;
    std::vector<Place> places_;
    std::vector<Polygon> cells_;
};

} // namespace

point placed(const SectionOptions& options, const point& x)
{
    point result;
    result[(options.normal + 1) % 3] = x.x();
    result[(options.normal + 2) % 3] = x.y();
    result[options.normal] = options.middle + x.z();
    return result;
}

namespace
{

// [m3] of the mesh per thickness, of the part of a triangle that is inside.
scalar insideOf(
    const PlaneSection& section, const std::function<scalar(const point&)>& shape,
    const point& a, const point& b, const point& c, label depth
)
{
    const scalar area = 0.5 * mag((b - a) ^ (c - a));
    const point middle = (a + b + c) / 3;
    const scalar reach =
        std::max(mag(a - middle), std::max(mag(b - middle), mag(c - middle)));
    const scalar distance = shape(middle);
    if (mag(distance) > 1.5 * reach)
    {
        return distance < 0 ? area * section.radius(middle) : 0;
    }
    if (depth > 0)
    {
        const point ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
        return insideOf(section, shape, a, ab, ca, depth - 1)
               + insideOf(section, shape, ab, b, bc, depth - 1)
               + insideOf(section, shape, ca, bc, c, depth - 1)
               + insideOf(section, shape, ab, bc, ca, depth - 1);
    }
    const scalar d[3] = {shape(a), shape(b), shape(c)};
    for (label k = 0; k < 3; ++k)
    {
        const label i = (k + 1) % 3, j = (k + 2) % 3;
        if ((d[k] < 0) != (d[i] < 0) && (d[k] < 0) != (d[j] < 0))
        {
            const scalar tip = area * d[k] / (d[k] - d[i]) * d[k] / (d[k] - d[j]);
            return (d[k] < 0 ? tip : area - tip) * section.radius(middle);
        }
    }
    return d[0] < 0 ? area * section.radius(middle) : 0;
}

} // namespace

scalarField sectionAlpha(
    const CellComplex& complex, const std::function<scalar(const point&)>& shape
)
{
    constexpr label depth = 8;
    const PlaneSection& section = *complex.whole().section;
    scalarField alpha(complex.nCells());
    forAll(alpha, celli)
    {
        scalar inside = 0, whole = 0;
        for (const label facei : complex.cellFaces()[celli])
        {
            if (!complex.isEnd(facei))
            {
                const labelPair ends(
                    section.edgeOf(complex.faces()[facei], complex.points())
                );
                const point a = section.inMiddle(complex.points()[ends.first()]);
                const point b = section.inMiddle(complex.points()[ends.second()]);
                const point& c = complex.cellCentres()[celli];
                inside += insideOf(section, shape, a, b, c, depth);
                whole += 0.5 * mag((a - c) ^ (b - c)) * section.radius((a + b + c) / 3);
            }
        }
        alpha[celli] = std::min(inside / whole, scalar(1));
    }
    return alpha;
}

CellComplexInput sectionInput(const SectionOptions& options)
{
    return SectionBuilder(options).build();
}

std::shared_ptr<const CellComplex> section(const SectionOptions& options)
{
    return std::make_shared<const CellComplex>(sectionInput(options));
}

} // namespace Foam::stability::shapes
