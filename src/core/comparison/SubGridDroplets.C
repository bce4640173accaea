// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/comparison/SubGridDroplets.H"

#include "core/comparison/ThinSheets.H"
#include "core/surface/Ribbon.H"
#include "core/flow/VolumeFractions.H"
#include "boundBox.H"
#include "mathematicalConstants.H"

#include <algorithm>
#include <cmath>
#include <optional>

namespace Foam::stability
{

namespace
{

struct Moments
{
    scalar volume = 0;  // [m3]
    scalar measure = 0; // [m3], of the complex: without the factor of a section
    vector first{Zero}; // [m4], the volume times its centroid
};

scalar radiusOf(scalar measure, const std::optional<PlaneSection>& section)
{
    using constant::mathematical::pi;
    return section ? std::sqrt(measure / (pi * section->thickness))
                   : std::cbrt(3 * measure / (4 * pi));
}

// A closed piece of the surface.
struct Piece
{
    bool closed = true;
    std::vector<label> points;
    Moments enclosed; // negative volume: a bubble
    boundBox bounds;
    scalar cellSize = 0; // [m], mean over the points

    bool bubble() const { return enclosed.volume < 0; }
};

using Pieces = std::vector<Piece>; // per component

// Cones from the first point of each piece, against round-off far from home.
void addEnclosed(
    const InterfaceMesh& mesh, const UList<label>& components,
    const std::optional<PlaneSection>& section, Pieces& pieces
)
{
    forAll(mesh.triangles, trianglei)
    {
        Piece& piece = pieces[components[mesh.triangles[trianglei][0]]];
        const PlaneSection::Cone cone(
            coneTo(mesh, trianglei, mesh.points[piece.points[0]], section)
        );
        piece.enclosed.volume += cone.volume;
        piece.enclosed.measure += cone.measure;
        piece.enclosed.first += cone.volume * cone.centroid;
    }
}

Pieces piecesOf(
    const InterfaceMesh& mesh, const UList<label>& components,
    const std::optional<PlaneSection>& section
)
{
    Pieces pieces;
    label nPieces = 0;
    for (const label component : components)
    {
        nPieces = std::max(nPieces, component + 1);
    }
    pieces.resize(nPieces);
    std::vector<char> used(mesh.points.size(), 0);
    for (const triFace& t : mesh.triangles)
    {
        used[t[0]] = used[t[1]] = used[t[2]] = 1;
    }
    forAll(components, pointi)
    {
        if (used[pointi])
        {
            Piece& piece = pieces[components[pointi]];
            piece.points.push_back(pointi);
            piece.bounds.add(mesh.points[pointi]);
            piece.cellSize += mesh.cellSizes[pointi];
        }
    }
    for (Piece& piece : pieces)
    {
        piece.cellSize /= std::max(piece.points.size(), std::size_t(1));
    }
    const SurfaceTopology topology(mesh.points.size(), mesh.triangles);
    for (const SurfaceEdge& edge : topology.edges())
    {
        if (edge.nTriangles != 2 && !isRimOfRibbon(edge, mesh.points, section))
        {
            pieces[components[edge.a]].closed = false;
        }
    }
    addEnclosed(mesh, components, section, pieces);
    return pieces;
}

class DropletSearch
{
public:
    DropletSearch(
        const Pieces& pieces, const InterfaceMesh& mesh, const UList<label>& components,
        const FlowSnapshot& snapshot
    )
        : pieces_(pieces), mesh_(mesh), components_(components),
          complex_(*snapshot.complex), snapshot_(snapshot)
    {
    }

    std::vector<Droplet> run()
    {
        std::vector<Droplet> found;
        for (std::size_t i = 0; i < pieces_.size(); ++i)
        {
            const Piece& piece = pieces_[i];
            if (piece.closed && !piece.points.empty()
                && mayBeSubGrid(piece.enclosed.measure, piece.cellSize, section()))
            {
                const Droplet droplet = dropletOf(piece, label(i));
                if (droplet.radius < thinnestResolved)
                {
                    found.push_back(droplet);
                }
            }
        }
        return found;
    }

private:
    const std::optional<PlaneSection>& section() const
    {
        return complex_.whole().section;
    }

    Droplet dropletOf(const Piece& piece, label component)
    {
        const std::optional<Moments> filled = fill(piece, component);
        const Moments moments = filled ? *filled : piece.enclosed;
        Droplet droplet;
        droplet.component = component;
        droplet.bubble = piece.bubble();
        droplet.fromAlpha = bool(filled);
        droplet.volume = mag(moments.volume);
        droplet.radius = radiusOf(mag(moments.measure), section()) / piece.cellSize;
        droplet.centroid = mag(moments.volume) > 0 ? moments.first / moments.volume
                                                   : piece.bounds.midpoint();
        droplet.nPoints = label(piece.points.size());
        return droplet;
    }

    // The share of the piece's material in a cell.
    scalar share(const Piece& piece, label celli) const
    {
        return piece.bubble() ? 1 - fractions_->cells[celli] : fractions_->cells[celli];
    }

    // Once there is something to fill.
    void prepareFill()
    {
        fractions_.emplace(snapshot_);
        visits_.assign(complex_.nCells(), -1);
        homes_.assign(complex_.nCells(), free);
        forAll(mesh_.points, pointi)
        {
            if (mesh_.cells[pointi] < 0)
            {
                continue;
            }
            label& home = homes_[mesh_.cells[pointi]];
            const label component = components_[pointi];
            home = home == free || home == component ? component : shared;
        }
    }

    // Nothing where the cells are not those of this piece alone.
    std::optional<Moments> fill(const Piece& piece, label component)
    {
        constexpr scalar least = 1e-3, margin = 3; // [cells]
        if (!fractions_)
        {
            prepareFill();
        }
        const vector wide = margin * piece.cellSize * vector(1, 1, 1);
        const boundBox reach(piece.bounds.min() - wide, piece.bounds.max() + wide);
        std::vector<label> front;
        bool alone = true;
        const auto visit = [&](label celli)
        {
            if (visits_[celli] != component && share(piece, celli) > least)
            {
                visits_[celli] = component;
                front.push_back(celli);
                const label home = homes_[celli];
                alone = alone && (home == free || home == component)
                        && reach.contains(complex_.cellCentres()[celli]);
            }
        };
        for (const label pointi : piece.points)
        {
            if (mesh_.cells[pointi] >= 0)
            {
                visit(mesh_.cells[pointi]);
            }
        }
        Moments sum;
        for (std::size_t i = 0; alone && i < front.size(); ++i)
        {
            const label celli = front[i];
            const point& centre = complex_.cellCentres()[celli];
            const scalar measure = share(piece, celli) * complex_.cellVolumes()[celli];
            const scalar volume = share(piece, celli) * complex_.volumeInMesh(celli);
            sum.volume += volume;
            sum.measure += measure;
            sum.first += volume * centre;
            for (const label facei : complex_.cellFaces()[celli])
            {
                if (facei < complex_.nInternalFaces())
                {
                    visit(complex_.owner()[facei]);
                    visit(complex_.neighbour()[facei]);
                }
            }
        }
        return alone && sum.volume > 0 ? std::optional<Moments>(sum) : std::nullopt;
    }

    static constexpr label free = -1, shared = -2;

    const Pieces& pieces_;
    const InterfaceMesh& mesh_;
    const UList<label>& components_;
    const CellComplex& complex_;
    const FlowSnapshot& snapshot_;
    std::optional<VolumeFractions> fractions_;
    std::vector<label> homes_;  // per cell: the component of its points
    std::vector<label> visits_; // per cell: the component that came last
};

} // namespace

bool mayBeSubGrid(
    scalar volume, scalar cellSize, const std::optional<PlaneSection>& section
)
{
    constexpr scalar largest = 2 * thinnestResolved;
    return radiusOf(mag(volume), section) < largest * cellSize;
}

const TableLayout<DropletRow>& dropletTable()
{
    using D = DropletRow;
    static const TableLayout<D> table{
        "droplets.dat",
        "Droplets and bubbles below 1.5 cells: radius in cells, volume in m3, "
        "centroid in m",
        {
            {"Time", "s", "the classified time", &D::time},
            {"component", "-", "its number in the array `component` of the interface",
             &D::component},
            {"bubble", "-", "1: a bubble; 0: a droplet", &D::bubble},
            {"radius", "cells",
             "radius of the ball of the same volume, in two dimensions of the disc",
             &D::radius},
            {"volume", "m3", "volume", &D::volume},
            {"centroidX", "m", "centroid", [](const D& d) { return d.centroid.x(); }},
            {"centroidY", "m", "centroid", [](const D& d) { return d.centroid.y(); }},
            {"centroidZ", "m", "centroid", [](const D& d) { return d.centroid.z(); }},
            {"points", "-", "points of its surface", &D::nPoints},
            {"fromAlpha", "-",
             "1: volume and centroid are those of the volume fractions in the cells "
             "that hang together with its surface; 0: these are not its own, and the "
             "surface itself tells them",
             &D::fromAlpha},
        }};
    return table;
}

std::vector<Droplet> subGridDroplets(
    const InterfaceMesh& mesh, const UList<label>& components,
    const FlowSnapshot& snapshot
)
{
    const std::optional<PlaneSection>& section = snapshot.complex->whole().section;
    const Pieces pieces(piecesOf(mesh, components, section));
    return DropletSearch(pieces, mesh, components, snapshot).run();
}

} // namespace Foam::stability
