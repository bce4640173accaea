// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/surface/pieces/SurfaceImages.H"

#include "core/surface/SurfaceTopology.H"

#include <algorithm>
#include <set>

namespace Foam::stability
{

namespace
{

constexpr scalar samePlace = 1e-5; // [cells]
constexpr scalar sameP = 1e-6;     // of the unit square

// A point at the rim of a part: at an edge with one triangle.
struct RimPoint
{
    std::size_t part;
    label pointi;
    scalar along; // [m], what they are sorted by
};

// No patch is likely to be normal to this direction.
const vector oblique(0.5437, 0.6181, 0.5677);

std::vector<RimPoint> rimOf(const SurfacePiece& piece, std::size_t part)
{
    const SurfaceTopology topology(piece.mesh.points.size(), piece.mesh.triangles);
    std::set<label> points;
    for (const SurfaceEdge& edge : topology.edges())
    {
        if (edge.nTriangles == 1)
        {
            points.insert({edge.a, edge.b});
        }
    }
    std::vector<RimPoint> rim;
    rim.reserve(points.size());
    for (const label pointi : points)
    {
        rim.push_back({part, pointi, piece.startPositions[pointi] & oblique});
    }
    return rim;
}

// The indices of the values at the corners around each point.
std::vector<std::vector<label>>
valuesAtPoints(const InterfaceMesh& mesh, const List<CornerIndices>& corners)
{
    std::vector<std::vector<label>> result(mesh.points.size());
    forAll(mesh.triangles, trianglei)
    {
        for (label k = 0; k < 3; ++k)
        {
            const label index = corners[trianglei][k];
            std::vector<label>& known = result[mesh.triangles[trianglei][k]];
            if (index >= 0
                && std::find(known.begin(), known.end(), index) == known.end())
            {
                known.push_back(index);
            }
        }
    }
    return result;
}

class Fitting
{
public:
    explicit Fitting(std::vector<SurfacePiece>& parts) : parts_(parts)
    {
        for (std::size_t part = 0; part < parts.size(); ++part)
        {
            const std::vector<RimPoint> rim(rimOf(parts[part], part));
            rim_.insert(rim_.end(), rim.begin(), rim.end());
            const InterfaceMesh& mesh = parts[part].mesh;
            parameters_.push_back(valuesAtPoints(mesh, mesh.corners));
            origins_.push_back(valuesAtPoints(mesh, mesh.originCorners));
            order_.push_back(part);
        }
        // Parts with lower images come first, so that all ranks take the same values.
        std::stable_sort(
            order_.begin(), order_.end(),
            [&](std::size_t a, std::size_t b) { return imageIn(a) < imageIn(b); }
        );
        places_.resize(parts.size());
        for (std::size_t place = 0; place < order_.size(); ++place)
        {
            places_[order_[place]] = place;
        }
        std::sort(
            rim_.begin(), rim_.end(),
            [](const RimPoint& a, const RimPoint& b) { return a.along < b.along; }
        );
    }

    void run()
    {
        for (const std::size_t part : order_) // all take over from the first
        {
            for (const RimPoint& point : rim_)
            {
                const RimPoint* first = point.part == part ? firstAt(point) : nullptr;
                if (first)
                {
                    takeOver(point, *first);
                }
            }
        }
    }

private:
    label imageIn(std::size_t part) const
    {
        return parts_[part].keys.empty() ? 0 : parts_[part].keys[0].image;
    }

    // The point at the same place in the first of the earlier parts that have one
    // there.
    const RimPoint* firstAt(const RimPoint& point) const
    {
        const SurfacePiece& piece = parts_[point.part];
        const scalar tolerance = samePlace * piece.mesh.cellSizes[point.pointi];
        auto other = std::lower_bound(
            rim_.begin(), rim_.end(), point.along - 2 * tolerance,
            [](const RimPoint& a, scalar along) { return a.along < along; }
        );
        const RimPoint* first = nullptr;
        for (; other != rim_.end() && other->along <= point.along + 2 * tolerance;
             ++other)
        {
            const vector way = parts_[other->part].startPositions[other->pointi]
                               - piece.startPositions[point.pointi];
            if (places_[other->part] < places_[point.part]
                && magSqr(way) <= sqr(tolerance)
                && (!first || places_[other->part] < places_[first->part]))
            {
                first = &*other;
            }
        }
        return first;
    }

    void takeOver(const RimPoint& point, const RimPoint& first)
    {
        SurfacePiece& piece = parts_[point.part];
        const SurfacePiece& from = parts_[first.part];
        piece.startPositions[point.pointi] = from.startPositions[first.pointi];
        piece.pointKeys[point.pointi] = from.pointKeys[first.pointi];
        piece.mesh.points[point.pointi] = from.mesh.points[first.pointi];
        piece.mesh.cells[point.pointi] = from.mesh.cells[first.pointi];
        piece.mesh.cellSizes[point.pointi] = from.mesh.cellSizes[first.pointi];
        for (const label index : parameters_[point.part][point.pointi])
        {
            vector2D& p = piece.mesh.parameters[index];
            for (const label other : parameters_[first.part][first.pointi])
            {
                const vector2D& there = from.mesh.parameters[other];
                if (mag(there - p) <= sameP)
                {
                    p = there;
                    break;
                }
            }
        }
        for (const label index : origins_[point.part][point.pointi])
        {
            takeOverNearest(
                piece.mesh.origins[index], from.mesh.origins,
                origins_[first.part][first.pointi]
            );
        }
    }

    static void takeOverNearest(
        point& origin, const pointField& there, const std::vector<label>& indices
    )
    {
        const point before(origin);
        scalar least = VGREAT;
        for (const label other : indices)
        {
            if (magSqr(there[other] - before) < least)
            {
                least = magSqr(there[other] - before);
                origin = there[other];
            }
        }
    }

    std::vector<SurfacePiece>& parts_;
    std::vector<RimPoint> rim_;
    std::vector<std::size_t> order_, places_; // of the parts
    std::vector<std::vector<std::vector<label>>> parameters_,
        origins_; // per part and point: indices
};

} // namespace

SurfacePiece imageOf(SurfacePiece piece, label image, const PeriodicImages& images)
{
    const RigidMotion& motion = images.motion(image);
    for (pointField* points : {&piece.mesh.points, &piece.startPositions})
    {
        for (point& x : *points)
        {
            x = motion(x);
        }
    }
    for (label& cell : piece.mesh.cells)
    {
        cell = cell < 0 ? cell : images.movedCell(cell, image);
    }
    for (TriangleKey& key : piece.keys)
    {
        key.image = images.product(image, key.image);
    }
    for (PointKey& key : piece.pointKeys)
    {
        key.image = images.product(image, key.image);
    }
    return piece;
}

void fitTogether(std::vector<SurfacePiece>& parts)
{
    Fitting(parts).run();
}

} // namespace Foam::stability
