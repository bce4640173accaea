// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/surface/pieces/SurfacePiece.H"

#include "core/cells/CanonicalOrder.H"
#include "core/surface/pieces/SurfaceColumns.H"

#include <algorithm>

namespace Foam::stability
{

bool TriangleKey::operator<(const TriangleKey& k) const
{
    return where != k.where   ? beforeByPosition(where, k.where)
           : image != k.image ? image < k.image
                              : place < k.place;
}

namespace
{

// The first point with the same key, for each point.
labelList weld(const UList<PointKey>& keys)
{
    labelList welded(identity(keys.size()));
    labelList order(welded);
    std::stable_sort(
        order.begin(), order.end(), [&](label a, label b) { return keys[a] < keys[b]; }
    );
    for (label i = 1; i < order.size(); ++i)
    {
        if (keys[order[i]] == keys[order[i - 1]])
        {
            welded[order[i]] = welded[order[i - 1]];
        }
    }
    return welded;
}

} // namespace

SurfacePiece wholeSurface(const InterfaceMesh& mesh)
{
    SurfacePiece piece;
    piece.mesh = mesh;
    piece.startPositions = mesh.points;
    piece.keys.setSize(mesh.triangles.size());
    forAll(piece.keys, i)
    {
        piece.keys[i].place = i;
    }
    piece.pointKeys.setSize(mesh.points.size());
    forAll(piece.pointKeys, i)
    {
        piece.pointKeys[i].number = i;
    }
    return piece;
}

labelList
keepOwn(SurfacePiece& piece, const InterfaceMesh& extracted, const CellComplex& complex)
{
    if (extracted.triangleCells.empty())
    {
        piece = wholeSurface(extracted); // made elsewhere, in its own order
        return identity(extracted.points.size());
    }
    DynamicList<label> own;
    forAll(extracted.triangles, i)
    {
        if (complex.own(extracted.triangleCells[i]))
        {
            own.append(i);
        }
    }
    labelList kept;
    {
        SurfacePiece all(wholeSurface(extracted));
        all.sharesPoints = piece.sharesPoints; // as the method says
        all.mesh.clearParametrization();
        piece = partOf(all, own, &kept);
    }
    useGlobalCells(piece.mesh, complex);

    piece.keys.setSize(own.size());
    forAll(own, i)
    {
        const label celli = extracted.triangleCells[own[i]];
        const bool another = i == 0 || celli != extracted.triangleCells[own[i - 1]];
        piece.keys[i] = another ? TriangleKey{cellMean(
                                                  complex.cellFaces()[celli],
                                                  complex.faces(), complex.points()
                                              ),
                                              0}
                                : TriangleKey{piece.keys[i - 1].where,
                                              piece.keys[i - 1].place + 1};
    }
    return kept;
}

SurfacePiece
partOf(const SurfacePiece& whole, const UList<label>& triangles, labelList* pointsOf)
{
    SurfacePiece part;
    part.sharesPoints = whole.sharesPoints;
    part.mesh.triangles = selected(whole.mesh.triangles, triangles);
    CompactNumbering points(whole.mesh.points.size());
    for (triFace& t : part.mesh.triangles)
    {
        for (label& pointi : t)
        {
            pointi = points.number(pointi);
        }
    }
    selectColumns(whole, points.sources(), triangles, part);
    if (pointsOf)
    {
        *pointsOf = points.sources();
    }
    return part;
}

JoinedSurface join(const std::vector<SurfacePiece>& parts)
{
    const SurfacePiece all(concatenated(parts));
    JoinedSurface result;
    SurfacePiece& piece = result.piece;
    piece.sharesPoints = all.sharesPoints;
    const labelList welded(
        piece.sharesPoints && parts.size() > 1 ? weld(all.pointKeys)
                                               : identity(all.mesh.points.size())
    );
    labelList& order = result.triangleSources;
    order = identity(all.mesh.triangles.size());
    std::stable_sort(
        order.begin(), order.end(),
        [&](label a, label b) { return all.keys[a] < all.keys[b]; }
    );
    piece.mesh.triangles = selected(all.mesh.triangles, order);
    CompactNumbering points(all.mesh.points.size());
    for (triFace& t : piece.mesh.triangles)
    {
        for (label& pointi : t)
        {
            pointi = points.number(welded[pointi]);
        }
    }
    selectColumns(all, points.sources(), order, piece);
    result.pointSources = points.sources();
    result.pointPlaces = selected(points.numbers(), welded);
    return result;
}

JoinedSurface ownParts(
    const InterfaceMesh& mesh, const labelList& parents, const SurfacePiece& piece,
    const UList<bool>& own
)
{
    DynamicList<label> kept;
    forAll(parents, trianglei)
    {
        if (own[parents[trianglei]])
        {
            kept.append(trianglei);
        }
    }
    std::stable_sort(
        kept.begin(), kept.end(),
        [&](label a, label b) { return parents[a] < parents[b]; }
    );
    SurfacePiece all;
    all.sharesPoints = piece.sharesPoints;
    all.mesh = mesh;
    all.startPositions = mesh.points;
    all.pointKeys = piece.pointKeys;
    all.pointKeys.setSize(mesh.points.size(), PointKey());
    all.keys.setSize(parents.size());
    forAll(kept, i)
    {
        TriangleKey& key = all.keys[kept[i]];
        key.where = piece.keys[parents[kept[i]]].where;
        key.place = 0;
        if (i > 0 && all.keys[kept[i - 1]].where == key.where)
        {
            key.place = all.keys[kept[i - 1]].place + 1;
        }
    }
    labelList points;
    JoinedSurface result(join({partOf(all, kept, &points)}));
    result.pointSources = selected(points, result.pointSources);
    result.triangleSources = selected(kept, result.triangleSources);
    return result;
}

void useLocalCells(InterfaceMesh& mesh, const CellComplex& complex)
{
    for (label& celli : mesh.cells)
    {
        celli = celli < 0 ? celli : complex.localCell(celli);
    }
}

void useGlobalCells(InterfaceMesh& mesh, const CellComplex& complex)
{
    for (label& celli : mesh.cells)
    {
        celli = celli < 0 ? celli : complex.globalCell(celli);
    }
}

} // namespace Foam::stability
