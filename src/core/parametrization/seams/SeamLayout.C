// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/parametrization/seams/SeamLayout.H"

#include "core/parametrization/SurfaceShape.H"
#include "core/parametrization/seams/CurvaturePeaks.H"
#include "core/parametrization/seams/EdgePaths.H"
#include "core/parametrization/seams/SteinerTree.H"
#include "core/parametrization/seams/TreeCotree.H"
#include "core/parametrization/seams/Visibility.H"

namespace Foam::stability
{

namespace
{

// The weight of an edge that cannot be seen, over that of one in full sight.
constexpr scalar hidden = 0.1 / 1.1;

// Three starts of the loops that cut handles are tried.
constexpr label nRoots = 3;

class Search
{
public:
    explicit Search(const PlainSurface& surface)
        : surface_(surface), nPoints_(surface.points.size()),
          topology_(nPoints_, surface.triangles),
          onBoundary_(topology_.edges().size(), false),
          chosen_(topology_.edges().size(), false)
    {
        forAll(surface.triangles, trianglei)
        {
            for (label k = 0; k < 3; ++k)
            {
                if (coherentNeighbour(topology_, surface.triangles, trianglei, k) < 0)
                {
                    onBoundary_[topology_.triangleEdges()[trianglei][k]] = true;
                    closed_ = false;
                }
            }
        }
        euler_ = shapeOf(nPoints_, surface.triangles).euler;
    }

    bool isClosedSphere() const { return closed_ && euler_ == 2; }

    // Boundary and seams, as points.
    labelList cutPoints() const
    {
        DynamicList<label> points;
        forAll(chosen_, edgei)
        {
            if (chosen_[edgei] || onBoundary_[edgei])
            {
                points.append(topology_.edges()[edgei].a);
                points.append(topology_.edges()[edgei].b);
            }
        }
        return labelList(std::move(points));
    }

    SeamLayout result() const
    {
        DynamicList<label> edges;
        forAll(chosen_, edgei)
        {
            if (chosen_[edgei] && !onBoundary_[edgei])
            {
                edges.append(edgei);
            }
        }
        return {labelList(std::move(edges)), labelList()};
    }

    // A single edge opens nothing: the other two of its triangle are taken then.
    void openSphere(label nBranches)
    {
        const label start = surface_.triangles[0][0];
        const label one = fromPoint(start).farthest();
        const EdgePaths paths(fromPoint(one));
        labelList path = paths.edgesTo(paths.farthest());
        if (path.size() == 1)
        {
            const label only = path[0];
            path.clear();
            for (const label edgei :
                 topology_.triangleEdges()[topology_.edges()[only].triangles[0]])
            {
                if (edgei != only)
                {
                    path.append(edgei);
                }
            }
        }
        choose(path);
        // Along a single slit the chart of a sphere varies by 35 times in area, with
        // two branches by 5, and p drifts less.
        for (label i = 0; i < nBranches; ++i)
        {
            const EdgePaths branch(surface_.points, topology_, cutPoints());
            choose(branch.edgesTo(branch.farthest())); // none where all are on the cut
        }
    }

    // Cuts handles and joins boundary loops, where there are any.
    void openLoops()
    {
        if (euler_ == 1 && !closed_)
        {
            return;
        }
        weigh();
        labelList tried(1, surface_.triangles[0][0]);
        scalar least = VGREAT;
        List<bool> best;
        for (label i = 0; i < nRoots; ++i)
        {
            const List<bool> loops(
                openingLoops(surface_, topology_, onBoundary_, weights_, tried[i])
            );
            const scalar weight = weightOf(loops);
            if (weight < least)
            {
                least = weight;
                best = loops;
            }
            const label next = EdgePaths(surface_.points, topology_, tried).farthest();
            if (next < 0)
            {
                break;
            }
            tried.append(next);
        }
        forAll(best, edgei)
        {
            chosen_[edgei] = best[edgei];
        }
    }

    // A tree through the terminals and what is cut already; two are needed if nothing
    // is.
    void joinTerminals(labelList& terminals)
    {
        weigh();
        List<labelList> groups;
        const labelList before(cutPoints());
        if (!before.empty())
        {
            groups.append(before);
        }
        else if (terminals.size() == 1)
        {
            terminals.append(fromPoint(terminals[0]).farthest());
        }
        List<bool> isCut(nPoints_, false);
        for (const label pointi : before)
        {
            isCut[pointi] = true;
        }
        for (const label terminal : terminals)
        {
            if (!isCut[terminal])
            {
                groups.append(labelList(1, terminal));
            }
        }
        choose(steinerTree(nPoints_, topology_, weights_, groups));
    }

private:
    EdgePaths fromPoint(label pointi) const
    {
        return EdgePaths(surface_.points, topology_, labelList(1, pointi));
    }

    void choose(const labelList& edges)
    {
        for (const label edgei : edges)
        {
            chosen_[edgei] = true;
        }
    }

    // Lengths, shorter where hidden; nothing along the boundary, which is open anyway.
    void weigh()
    {
        if (!weights_.empty())
        {
            return;
        }
        weights_ = edgeLengths(surface_.points, topology_);
        const scalarField seen(visibility(surface_));
        forAll(weights_, edgei)
        {
            const SurfaceEdge& e = topology_.edges()[edgei];
            const scalar sight = 0.5 * (seen[e.a] + seen[e.b]);
            weights_[edgei] *= onBoundary_[edgei] ? 0 : hidden + (1 - hidden) * sight;
        }
    }

    scalar weightOf(const List<bool>& chosen) const
    {
        scalar sum = 0;
        forAll(chosen, edgei)
        {
            sum += chosen[edgei] ? weights_[edgei] : 0;
        }
        return sum;
    }

    const PlainSurface& surface_;
    label nPoints_;
    SurfaceTopology topology_;
    List<bool> onBoundary_; // nEdges: or not manifold, so no seam
    List<bool> chosen_;     // nEdges
    scalarField weights_;   // nEdges; empty until they are needed
    label euler_ = 0;
    bool closed_ = true;
};

} // namespace

SeamLayout topologicalSeams(const PlainSurface& surface, label nBranches)
{
    Search search(surface);
    if (search.isClosedSphere())
    {
        search.openSphere(nBranches);
    }
    else
    {
        search.openLoops();
    }
    return search.result();
}

SeamLayout seamsThroughPeaks(const PlainSurface& surface)
{
    labelList terminals(curvaturePeaks(surface));
    if (terminals.empty())
    {
        return SeamLayout();
    }
    Search search(surface);
    if (!search.isClosedSphere())
    {
        search.openLoops();
    }
    search.joinTerminals(terminals);
    SeamLayout layout(search.result());
    layout.terminals = terminals;
    return layout;
}

} // namespace Foam::stability
