// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/cells/SectionExtrusion.H"

#include "core/base/Errors.H"

#include <algorithm>
#include <utility>
#include <vector>

namespace Foam::stability
{

namespace
{

class Extrusion
{
public:
    Extrusion(
        const CellComplexInput& mesh, const LayerEnds& ends, const PlaneSection& section
    )
        : mesh_(mesh), ends_(ends), section_(section), edges_(mesh.faces.size())
    {
    }

    ExtrudedSection run()
    {
        result_.prisms.nCells = mesh_.nCells;
        result_.prisms.globalCells = mesh_.globalCells;
        result_.prisms.patchNames = mesh_.patchNames;
        addPoints();
        const Rows cellFaces(facesOfCells(mesh_));
        for (label celli = 0; celli < mesh_.nCells; ++celli)
        {
            findEdges(celli, cellFaces[celli]);
        }
        addSides();
        addEnds();
        addAxis();
        store();
        return std::move(result_);
    }

private:
    using Edge = std::pair<label, label>; // points of the mesh; first is -1: none

    void addPoints()
    {
        lowPoints_ = labelList(mesh_.points.size(), -1);
        for (const label facei : ends_.low)
        {
            for (const label pointi : mesh_.faces[facei])
            {
                lowPoints_[pointi] = 0;
            }
        }
        DynamicList<point> points;
        DynamicList<label> from, numbers;
        forAll(lowPoints_, pointi)
        {
            if (lowPoints_[pointi] < 0)
            {
                continue;
            }
            lowPoints_[pointi] = points.size();
            points.append(section_.inLow(mesh_.points[pointi]));
            points.append(section_.inHigh(mesh_.points[pointi]));
            for (const label side : {0, 1})
            {
                from.append(pointi);
                numbers.append(2 * mesh_.globalPoints[pointi] + side);
            }
        }
        result_.prisms.points = pointField(std::move(points));
        result_.prisms.globalPoints = labelList(std::move(numbers));
        result_.meshPoints = labelList(std::move(from));
    }

    // The edge of the low end that each face at the side of the cell stands on, and
    // the edges on which no face stands. Edges run as the low end of the face's owner.
    void findEdges(label celli, const UList<label>& cellFaces)
    {
        const face& low = mesh_.faces[ends_.low[celli]];
        label nFound = 0;
        forAll(low, k)
        {
            const Edge edge{low[k], low.nextLabel(k)};
            const auto standsOn = [&](label facei)
            {
                const face& f = mesh_.faces[facei];
                return !isEnd(celli, facei) && f.found(edge.first)
                       && f.found(edge.second);
            };
            const auto side =
                std::find_if(cellFaces.begin(), cellFaces.end(), standsOn);
            if (side == cellFaces.end())
            {
                axis_.push_back({celli, edge});
                continue;
            }
            ++nFound;
            if (mesh_.owner[*side] == celli)
            {
                edges_[*side] = edge;
            }
        }
        const bool complete =
            nFound == cellFaces.size() - 2 && (nFound == low.size() || section_.wedge);
        if (!complete)
        {
            throw BadInput(
                "The cell at " + textOf(low.centre(mesh_.points))
                + " of the two-dimensional mesh is no prism: "
                + std::to_string(cellFaces.size() - 2) + " faces at its side, but "
                + std::to_string(low.size()) + " edges in the plane."
            );
        }
    }

    bool isEnd(label celli, label facei) const
    {
        return facei == ends_.low[celli] || facei == ends_.high[celli];
    }

    // The area vector points out of the cell in whose low end the edge runs so.
    face standingOn(const Edge& edge) const
    {
        const label a = lowPoints_[edge.first], b = lowPoints_[edge.second];
        face f(4);
        f[0] = b;
        f[1] = a;
        f[2] = a + 1;
        f[3] = b + 1;
        return f;
    }

    void add(face&& f, label celli, label meshFacei)
    {
        faces_.append(std::move(f));
        owner_.append(celli);
        meshFaces_.append(meshFacei);
    }

    void addBoundary(
        face&& f, label celli, label meshFacei, BoundaryKind kind, label patchi,
        label cellBehind = -1
    )
    {
        add(std::move(f), celli, meshFacei);
        kinds_.append(kind);
        patches_.append(patchi);
        behind_.append(cellBehind);
    }

    // In the order of the mesh: first the internal faces.
    void addSides()
    {
        forAll(mesh_.faces, facei)
        {
            const label celli = mesh_.owner[facei];
            if (isEnd(celli, facei))
            {
                continue;
            }
            const label i = facei - mesh_.neighbour.size();
            if (i < 0)
            {
                add(standingOn(edges_[facei]), celli, facei);
                neighbour_.append(mesh_.neighbour[facei]);
            }
            else
            {
                addBoundary(
                    standingOn(edges_[facei]), celli, facei, mesh_.kinds[i],
                    mesh_.patches[i], mesh_.cellBehind[i]
                );
            }
        }
    }

    label patchOf(label facei) const
    {
        return mesh_.patches[facei - mesh_.neighbour.size()];
    }

    void addEnds()
    {
        forAll(ends_.low, celli)
        {
            face low(mesh_.faces[ends_.low[celli]]);
            for (label& pointi : low)
            {
                pointi = lowPoints_[pointi];
            }
            face high(low.reverseFace());
            for (label& pointi : high)
            {
                ++pointi;
            }
            const label lowFacei = ends_.low[celli], highFacei = ends_.high[celli];
            const BoundaryKind kind = BoundaryKind::symmetry;
            addBoundary(std::move(low), celli, lowFacei, kind, patchOf(lowFacei));
            addBoundary(std::move(high), celli, highFacei, kind, patchOf(highFacei));
        }
    }

    void addAxis()
    {
        for (const auto& [celli, edge] : axis_)
        {
            addBoundary(
                standingOn(edge), celli, -1, BoundaryKind::symmetry,
                patchOf(ends_.low[celli])
            );
        }
    }

    void store()
    {
        CellComplexInput& prisms = result_.prisms;
        prisms.faces = faceList(std::move(faces_));
        prisms.owner = labelList(std::move(owner_));
        prisms.neighbour = labelList(std::move(neighbour_));
        prisms.kinds = List<BoundaryKind>(std::move(kinds_));
        prisms.patches = labelList(std::move(patches_));
        prisms.cellBehind = labelList(std::move(behind_));
        result_.meshFaces = labelList(std::move(meshFaces_));
    }

    const CellComplexInput& mesh_;
    const LayerEnds& ends_;
    const PlaneSection& section_;
    labelList lowPoints_;     // for each point of the mesh: the low point, or -1
    std::vector<Edge> edges_; // for each face of the mesh at a side of a cell
    std::vector<std::pair<label, Edge>> axis_; // with the cell
    DynamicList<face> faces_;
    DynamicList<label> owner_, neighbour_, patches_, behind_, meshFaces_;
    DynamicList<BoundaryKind> kinds_;
    ExtrudedSection result_;
};

} // namespace

ExtrudedSection extrudedSection(
    const CellComplexInput& mesh, const LayerEnds& ends, const PlaneSection& section
)
{
    return Extrusion(mesh, ends, section).run();
}

} // namespace Foam::stability
