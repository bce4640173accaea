// SPDX-License-Identifier: GPL-3.0-or-later

#include "shapes/DualMesh.H"

#include "shapes/CellAssembly.H"
#include "shapes/PolyMeshes.H"

#include <algorithm>
#include <map>
#include <set>

namespace Foam::stability::shapes
{

namespace
{

class Dual
{
public:
    explicit Dual(const CellComplexInput& tets)
        : tets_(tets), corners_(tets.nCells), cells_(tets.points.size())
    {
        forAll(tets.faces, facei)
        {
            add(tets.owner[facei], tets.faces[facei]);
            if (facei < tets.neighbour.size())
            {
                add(tets.neighbour[facei], tets.faces[facei]);
            }
        }
    }

    CellComplexInput build(const BoxOptions& options)
    {
        cutBoundary();
        for (const auto& [edge, arcs] : arcsAroundEdges())
        {
            const Polygon around = polygonAround(edge.first, edge.second, arcs);
            cells_[edge.first].push_back(around);
            cells_[edge.second].emplace_back(around.rbegin(), around.rend());
        }
        return assemble(options, pointField(points_), cells_);
    }

private:
    using Edge = std::pair<label, label>;

    // A tetrahedron on its way around an edge, from one of its other points to the
    // last.
    struct Arc
    {
        label to, tet;
    };
    using Arcs = std::map<label, Arc>; // by the point where they begin

    void add(label tet, const face& f) { corners_[tet].insert(f.begin(), f.end()); }

    // The middle of some points of the tetrahedra; one point of the dual for each set.
    label middle(const std::set<label>& points)
    {
        const auto known = ids_.insert({points, points_.size()});
        if (known.second)
        {
            point sum(Zero);
            for (const label pointi : points)
            {
                sum += tets_.points[pointi];
            }
            points_.append(sum / scalar(points.size()));
        }
        return known.first->second;
    }

    // A part of each triangle of the boundary goes to each of its corners.
    void cutBoundary()
    {
        for (label facei = tets_.neighbour.size(); facei < tets_.faces.size(); ++facei)
        {
            const face& t = tets_.faces[facei];
            for (label k = 0; k < 3; ++k)
            {
                const label p = t[k], q = t[(k + 1) % 3], r = t[(k + 2) % 3];
                cells_[p].push_back(
                    {middle({p}), middle({p, q}), middle({p, q, r}), middle({r, p})}
                );
            }
        }
    }

    std::map<Edge, Arcs> arcsAroundEdges() const
    {
        std::map<Edge, Arcs> around;
        for (std::size_t tet = 0; tet < corners_.size(); ++tet)
        {
            for (const label a : corners_[tet])
            {
                for (const label b : corners_[tet])
                {
                    if (a < b)
                    {
                        addArc(a, b, label(tet), around[{a, b}]);
                    }
                }
            }
        }
        return around;
    }

    // Right-handed about the way from a to b.
    void addArc(label a, label b, label tet, Arcs& arcs) const
    {
        std::vector<label> others;
        for (const label pointi : corners_[tet])
        {
            if (pointi != a && pointi != b)
            {
                others.push_back(pointi);
            }
        }
        const pointField& x = tets_.points;
        const vector c = x[others[0]] - x[a], d = x[others[1]] - x[a];
        if (((c ^ d) & (x[b] - x[a])) < 0)
        {
            std::swap(others[0], others[1]);
        }
        arcs[others[0]] = {others[1], tet};
    }

    Polygon polygonAround(label a, label b, const Arcs& arcs)
    {
        std::set<label> ends;
        for (const auto& arc : arcs)
        {
            ends.insert(arc.second.to);
        }
        label start = arcs.begin()->first;
        bool atBoundary = false;
        for (const auto& arc : arcs)
        {
            if (!ends.count(arc.first))
            {
                start = arc.first;
                atBoundary = true;
            }
        }
        Polygon polygon;
        if (atBoundary)
        {
            polygon = {middle({a, b}), middle({a, b, start})};
        }
        label at = start;
        for (std::size_t i = 0; i < arcs.size(); ++i)
        {
            const Arc& arc = arcs.at(at);
            polygon.push_back(middle(corners_[arc.tet]));
            at = arc.to;
        }
        if (atBoundary)
        {
            polygon.push_back(middle({a, b, at}));
        }
        return polygon;
    }

    const CellComplexInput& tets_;
    std::vector<std::set<label>> corners_; // per tetrahedron
    std::vector<Polyhedron> cells_;        // per point of the tetrahedra
    std::map<std::set<label>, label> ids_;
    DynamicList<point> points_;
};

} // namespace

CellComplexInput dualBox(const BoxOptions& options)
{
    const CellComplexInput tets = tetrahedralBox(options);
    return Dual(tets).build(options);
}

} // namespace Foam::stability::shapes
