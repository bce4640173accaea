// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/surface/pieces/SurfaceColumns.H"

namespace Foam::stability
{

namespace
{

// The indices of the values of corners, with one index for equal values at a point.
template<class Values>
List<CornerIndices> weldCorners(
    const List<triFace>& triangles, const List<CornerIndices>& corners,
    const Values& values, label nPoints
)
{
    List<CornerIndices> result(corners);
    labelList first(nPoints, -1), next(values.size(), -1);
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
            while (i >= 0 && values[i] != values[index])
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

// Adds a part to those before it; its indices follow theirs.
struct Appending
{
    SurfacePiece& all;
    const SurfacePiece& part;

    template<class Place, class Column>
    void operator()(Place, const Column& column) const
    {
        column(all).append(column(part));
    }

    template<class Values, class Indices>
    void operator()(OfCorners, const Values& values, const Indices& indices) const
    {
        const label first = values(all).size(), firstTriangle = indices(all).size();
        values(all).append(values(part));
        indices(all).append(indices(part));
        for (label i = firstTriangle; i < indices(all).size(); ++i)
        {
            for (label& index : indices(all)[i])
            {
                index += index < 0 ? 0 : first;
            }
        }
    }
};

// Takes these points and triangles, and of the values of corners those that are used.
// The piece that is filled has its triangles already.
struct Selecting
{
    const SurfacePiece& from;
    const UList<label>& points;
    const UList<label>& triangles;
    SurfacePiece& to;

    template<class Column>
    void operator()(OfPoints, const Column& column) const
    {
        column(to) = selected(column(from), points);
    }

    template<class Column>
    void operator()(OfTriangles, const Column& column) const
    {
        column(to) = selected(column(from), triangles);
    }

    template<class Values, class Indices>
    void operator()(OfCorners, const Values& values, const Indices& indices) const
    {
        indices(to) = weldCorners(
            to.mesh.triangles, selected(indices(from), triangles), values(from),
            points.size()
        );
        CompactNumbering used(values(from).size());
        for (CornerIndices& c : indices(to))
        {
            for (label& index : c)
            {
                index = index < 0 ? index : used.number(index);
            }
        }
        values(to) = selected(values(from), used.sources());
    }
};

struct Packing
{
    const SurfacePiece& piece;
    Packet& packet;

    template<class Place, class... Column>
    void operator()(Place, const Column&... column) const
    {
        (packet.putList(column(piece)), ...);
    }
};

struct Unpacking
{
    SurfacePiece& piece;
    Packet& packet;

    template<class Place, class... Column>
    void operator()(Place, const Column&... column) const
    {
        (read(column(piece)), ...);
    }

    template<class Values>
    void read(Values& values) const
    {
        values = packet.getList<std::decay_t<decltype(values[0])>>();
    }
};

} // namespace

void selectColumns(
    const SurfacePiece& from, const UList<label>& points, const UList<label>& triangles,
    SurfacePiece& to
)
{
    forEachColumn(Selecting{from, points, triangles, to});
}

SurfacePiece concatenated(const std::vector<SurfacePiece>& parts)
{
    SurfacePiece all;
    for (const SurfacePiece& part : parts)
    {
        const label firstPoint = all.mesh.points.size();
        const label firstTriangle = all.mesh.triangles.size();
        all.mesh.triangles.append(part.mesh.triangles);
        for (label i = firstTriangle; i < all.mesh.triangles.size(); ++i)
        {
            for (label& pointi : all.mesh.triangles[i])
            {
                pointi += firstPoint;
            }
        }
        forEachColumn(Appending{all, part});
    }
    all.sharesPoints = !parts.empty() && parts[0].sharesPoints;
    return all;
}

void pack(const SurfacePiece& piece, Packet& packet)
{
    packet.putList(piece.mesh.triangles);
    forEachColumn(Packing{piece, packet});
    packet.put(piece.sharesPoints);
}

SurfacePiece unpackedSurface(Packet& packet)
{
    SurfacePiece piece;
    piece.mesh.triangles = packet.getList<triFace>();
    forEachColumn(Unpacking{piece, packet});
    piece.sharesPoints = packet.get<bool>();
    return piece;
}

} // namespace Foam::stability
