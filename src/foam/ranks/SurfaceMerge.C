// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

#include "foam/ranks/SurfaceMerge.H"

#include "core/flow/CanonicalOrder.H"
#include "core/reconstruction/InterfaceOrder.H"

#include <algorithm>

namespace Foam::stability
{

namespace
{

// The surfaces of the ranks, one after the other.
class Merge
{
public:
    void add(Packet& packet)
    {
        const label first = points_.size();
        points_.append(packet.getList<point>());
        cells_.append(packet.getList<label>());
        boundaryFaces_.append(packet.getList<label>());
        cellSizes_.append(packet.getList<scalar>());
        spread_.append(packet.getList<scalar>());
        means_.append(packet.getList<point>());
        for (triFace& t : packet.getList<triFace>())
        {
            triangles_.append(triFace(t[0] + first, t[1] + first, t[2] + first));
        }
        result_.volume += packet.get<scalar>();
        result_.alphaVolume += packet.get<scalar>();
        result_.nFailed += packet.get<label>();
        joined_ = packet.get<bool>();
        sharpened_ = packet.get<bool>();
    }

    ReconstructionResult run()
    {
        const labelList order(triangleOrder());
        const labelList welded(weld());
        labelList numbers(points_.size(), -1);
        DynamicList<label> kept;
        InterfaceMesh& mesh = result_.mesh;
        mesh.triangles.setSize(order.size());
        forAll(order, i)
        {
            triFace t(triangles_[order[i]]);
            for (label& pointi : t)
            {
                pointi = welded[pointi];
                if (numbers[pointi] < 0)
                {
                    numbers[pointi] = kept.size();
                    kept.append(pointi);
                }
                pointi = numbers[pointi];
            }
            mesh.triangles[i] = t;
        }
        mesh.points = pointField(points_, kept);
        mesh.cells = labelList(labelUList(cells_), labelUList(kept));
        mesh.boundaryFaces = labelList(labelUList(boundaryFaces_), labelUList(kept));
        mesh.cellSizes = scalarField(cellSizes_, kept);
        mesh.clearParametrization();
        if (sharpened_)
        {
            result_.sharpening.emplace();
            result_.sharpening->spread = scalarField(spread_, kept);
        }
        return std::move(result_);
    }

private:
    // By the means of their cells.
    labelList triangleOrder() const
    {
        labelList order(identity(triangles_.size()));
        std::stable_sort(
            order.begin(), order.end(),
            [&](label a, label b) { return beforeByPosition(means_[a], means_[b]); }
        );
        return order;
    }

    // Per point the first that lies at the same place.
    labelList weld() const
    {
        labelList welded(identity(points_.size()));
        if (joined_)
        {
            labelList order(welded);
            std::stable_sort(
                order.begin(), order.end(),
                [&](label a, label b)
                { return beforeByPosition(points_[a], points_[b]); }
            );
            for (label i = 1; i < order.size(); ++i)
            {
                if (points_[order[i]] == points_[order[i - 1]])
                {
                    welded[order[i]] = welded[order[i - 1]];
                }
            }
        }
        return welded;
    }

    DynamicList<point> points_, means_;
    DynamicList<label> cells_, boundaryFaces_;
    DynamicList<scalar> cellSizes_, spread_;
    DynamicList<triFace> triangles_;
    bool joined_ = true, sharpened_ = false;
    ReconstructionResult result_;
};

// By which cells are ordered [m].
pointField cellMeans(const CellComplex& complex, const labelList& cells)
{
    pointField means(cells.size());
    forAll(cells, i)
    {
        means[i] =
            i > 0 && cells[i] == cells[i - 1]
                ? means[i - 1]
                : cellMean(
                    complex.cellFaces()[cells[i]], complex.faces(), complex.points()
                );
    }
    return means;
}

} // namespace

Packet surfacePiece(const ReconstructionResult& local, const CellComplex& complex)
{
    InterfaceMesh mesh(local.mesh);
    const labelList kept(keepOwn(mesh, complex));
    labelList cells(mesh.cells);
    for (label& celli : cells)
    {
        celli = complex.globalCell(celli);
    }
    Packet packet;
    packet.putList(mesh.points);
    packet.putList(cells);
    packet.putList(mesh.boundaryFaces);
    packet.putList(mesh.cellSizes);
    packet.putList(
        local.sharpening && !kept.empty() ? scalarField(local.sharpening->spread, kept)
                                          : scalarField(kept.size(), 0)
    );
    packet.putList(cellMeans(complex, mesh.triangleCells));
    packet.putList(mesh.triangles);
    packet.put(local.volume);
    packet.put(local.alphaVolume);
    packet.put(local.nFailed);
    packet.put(local.joined);
    packet.put(local.sharpening.has_value());
    return packet;
}

ReconstructionResult mergedSurface(std::vector<Packet>& pieces)
{
    Merge merge;
    for (Packet& piece : pieces)
    {
        merge.add(piece);
    }
    return merge.run();
}

} // namespace Foam::stability
