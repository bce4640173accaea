// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

#include "core/surface/pieces/SurfacePiece.H"

#include "core/cells/CanonicalOrder.H"

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

template<class T>
List<T> selected(const UList<T>& values, const UList<label>& places)
{
    List<T> result(places.size());
    forAll(places, i)
    {
        result[i] = values[places[i]];
    }
    return result;
}

// Points and parameters in the order in which triangles come to them.
class CompactNumbering
{
public:
    explicit CompactNumbering(label n) : numbers_(n, -1) {}

    label number(label i)
    {
        if (numbers_[i] < 0)
        {
            numbers_[i] = sources_.size();
            sources_.append(i);
        }
        return numbers_[i];
    }

    const labelList& numbers() const { return numbers_; }
    const DynamicList<label>& sources() const { return sources_; }

private:
    labelList numbers_;
    DynamicList<label> sources_;
};

// All parts, one after the other.
struct ConcatenatedPieces
{
    DynamicList<point> points, origins, startPositions;
    DynamicList<label> cells, boundaryFaces;
    DynamicList<scalar> cellSizes;
    DynamicList<vector2D> parameters;
    DynamicList<triFace> triangles;
    DynamicList<labelPair> materials;
    DynamicList<CornerIndices> corners;
    DynamicList<TriangleKey> keys;

    explicit ConcatenatedPieces(const std::vector<SurfacePiece>& parts)
    {
        for (const SurfacePiece& part : parts)
        {
            add(part);
        }
    }

private:
    void add(const SurfacePiece& part)
    {
        const InterfaceMesh& mesh = part.mesh;
        const label firstPoint = points.size(), firstParameter = parameters.size();
        points.append(mesh.points);
        origins.append(mesh.origins);
        startPositions.append(part.startPositions);
        cells.append(mesh.cells);
        boundaryFaces.append(mesh.boundaryFaces);
        cellSizes.append(mesh.cellSizes);
        parameters.append(mesh.parameters);
        materials.append(mesh.materials);
        keys.append(part.keys);
        forAll(mesh.triangles, i)
        {
            triFace t(mesh.triangles[i]);
            CornerIndices c(mesh.corners[i]);
            for (label k = 0; k < 3; ++k)
            {
                t[k] += firstPoint;
                c[k] += c[k] < 0 ? 0 : firstParameter;
            }
            triangles.append(t);
            corners.append(c);
        }
    }
};

// Per point the first with the same seed.
labelList weld(const UList<point>& startPositions)
{
    labelList welded(identity(startPositions.size()));
    labelList order(welded);
    std::stable_sort(
        order.begin(), order.end(),
        [&](label a, label b)
        { return beforeByPosition(startPositions[a], startPositions[b]); }
    );
    for (label i = 1; i < order.size(); ++i)
    {
        if (startPositions[order[i]] == startPositions[order[i - 1]])
        {
            welded[order[i]] = welded[order[i - 1]];
        }
    }
    return welded;
}

// Per triangle the indices of p, those of a point that are equal made one.
List<CornerIndices> weldParameters(
    const List<triFace>& triangles, const List<CornerIndices>& corners,
    const UList<vector2D>& parameters, label nPoints
)
{
    List<CornerIndices> result(corners);
    labelList first(nPoints, -1), next(parameters.size(), -1);
    forAll(triangles, trianglei)
    {
        for (label k = 0; k < 3; ++k)
        {
            label& index = result[trianglei][k];
            if (index < 0)
            {
                continue;
            }
            label& start = first[triangles[trianglei][k]];
            label i = start;
            while (i >= 0 && parameters[i] != parameters[index])
            {
                i = next[i];
            }
            if (i < 0)
            {
                next[index] = start;
                start = index;
                i = index;
            }
            index = i;
        }
    }
    return result;
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
    InterfaceMesh& mesh = piece.mesh;
    mesh.triangles = selected(extracted.triangles, own);
    CompactNumbering order(extracted.points.size());
    for (triFace& t : mesh.triangles)
    {
        for (label& pointi : t)
        {
            pointi = order.number(pointi);
        }
    }
    const DynamicList<label>& kept = order.sources();
    mesh.points = pointField(extracted.points, kept);
    mesh.cells = selected(extracted.cells, kept);
    mesh.boundaryFaces = selected(extracted.boundaryFaces, kept);
    mesh.cellSizes = scalarField(extracted.cellSizes, kept);
    mesh.clearParametrization();
    useGlobalCells(mesh, complex);
    piece.startPositions = mesh.points;

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
    return labelList(kept);
}

SurfacePiece
partOf(const SurfacePiece& whole, const UList<label>& triangles, labelList* pointsOf)
{
    const InterfaceMesh& mesh = whole.mesh;
    SurfacePiece part;
    part.sharesPoints = whole.sharesPoints;
    part.keys = selected(whole.keys, triangles);
    part.mesh.triangles = selected(mesh.triangles, triangles);
    part.mesh.materials = selected(mesh.materials, triangles);
    part.mesh.corners = selected(mesh.corners, triangles);
    CompactNumbering points(mesh.points.size()), parameters(mesh.parameters.size());
    forAll(triangles, i)
    {
        for (label k = 0; k < 3; ++k)
        {
            label& pointi = part.mesh.triangles[i][k];
            pointi = points.number(pointi);
            label& index = part.mesh.corners[i][k];
            index = index < 0 ? index : parameters.number(index);
        }
    }
    const DynamicList<label>& kept = points.sources();
    part.mesh.points = pointField(mesh.points, kept);
    part.mesh.origins = pointField(mesh.origins, kept);
    part.mesh.cells = selected(mesh.cells, kept);
    part.mesh.boundaryFaces = selected(mesh.boundaryFaces, kept);
    part.mesh.cellSizes = scalarField(mesh.cellSizes, kept);
    part.mesh.parameters = selected(mesh.parameters, parameters.sources());
    part.startPositions = pointField(whole.startPositions, kept);
    if (pointsOf)
    {
        *pointsOf = kept;
    }
    return part;
}

void pack(const SurfacePiece& piece, Packet& packet)
{
    const InterfaceMesh& mesh = piece.mesh;
    packet.putList(mesh.points);
    packet.putList(mesh.origins);
    packet.putList(mesh.cells);
    packet.putList(mesh.boundaryFaces);
    packet.putList(mesh.cellSizes);
    packet.putList(mesh.parameters);
    packet.putList(mesh.triangles);
    packet.putList(mesh.materials);
    packet.putList(mesh.corners);
    packet.putList(piece.keys);
    packet.putList(piece.startPositions);
    packet.put(piece.sharesPoints);
}

SurfacePiece unpackedSurface(Packet& packet)
{
    SurfacePiece piece;
    InterfaceMesh& mesh = piece.mesh;
    mesh.points = packet.getList<point>();
    mesh.origins = packet.getList<point>();
    mesh.cells = packet.getList<label>();
    mesh.boundaryFaces = packet.getList<label>();
    mesh.cellSizes = packet.getList<scalar>();
    mesh.parameters = packet.getList<vector2D>();
    mesh.triangles = packet.getList<triFace>();
    mesh.materials = packet.getList<labelPair>();
    mesh.corners = packet.getList<CornerIndices>();
    piece.keys = packet.getList<TriangleKey>();
    piece.startPositions = packet.getList<point>();
    piece.sharesPoints = packet.get<bool>();
    return piece;
}

JoinedSurface join(const std::vector<SurfacePiece>& parts)
{
    const ConcatenatedPieces heap(parts);
    JoinedSurface result;
    SurfacePiece& piece = result.piece;
    piece.sharesPoints = !parts.empty() && parts[0].sharesPoints;
    const labelList welded(
        piece.sharesPoints && parts.size() > 1 ? weld(heap.startPositions)
                                               : identity(heap.points.size())
    );
    labelList& order = result.triangleSources;
    order = identity(heap.triangles.size());
    std::stable_sort(
        order.begin(), order.end(),
        [&](label a, label b) { return heap.keys[a] < heap.keys[b]; }
    );

    InterfaceMesh& mesh = piece.mesh;
    mesh.triangles = selected(heap.triangles, order);
    mesh.materials = selected(heap.materials, order);
    piece.keys = selected(heap.keys, order);
    CompactNumbering points(heap.points.size());
    for (triFace& t : mesh.triangles)
    {
        for (label& pointi : t)
        {
            pointi = points.number(welded[pointi]);
        }
    }
    const DynamicList<label>& kept = points.sources();
    mesh.corners = weldParameters(
        mesh.triangles, selected(heap.corners, order), heap.parameters, kept.size()
    );
    CompactNumbering parameters(heap.parameters.size());
    for (CornerIndices& c : mesh.corners)
    {
        for (label& index : c)
        {
            index = index < 0 ? index : parameters.number(index);
        }
    }
    mesh.points = pointField(heap.points, kept);
    mesh.origins = pointField(heap.origins, kept);
    mesh.cells = selected(heap.cells, kept);
    mesh.boundaryFaces = selected(heap.boundaryFaces, kept);
    mesh.cellSizes = scalarField(heap.cellSizes, kept);
    mesh.parameters = selected(heap.parameters, parameters.sources());
    piece.startPositions = pointField(heap.startPositions, kept);
    result.pointSources = kept;
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
