// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/surface/pieces/SurfaceColumns.H"

#include <algorithm>

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

// Puts the columns of all parts one after the other; indices follow their values.
struct Concatenating
{
    SurfacePiece& all;
    const std::vector<SurfacePiece>& parts;

    template<class Place, class Column>
    void operator()(Place, const Column& column) const
    {
        join(column);
    }

    template<class Values, class Indices>
    void operator()(OfCorners, const Values& values, const Indices& indices) const
    {
        join(values);
        join(indices);
        label firstValue = 0, next = 0;
        for (const SurfacePiece& part : parts)
        {
            shift(indices(all), next, indices(part).size(), firstValue);
            next += indices(part).size();
            firstValue += values(part).size();
        }
    }

    template<class Column>
    void join(const Column& column) const
    {
        label n = 0;
        for (const SurfacePiece& part : parts)
        {
            n += column(part).size();
        }
        column(all).setSize(n);
        auto next = column(all).begin();
        for (const SurfacePiece& part : parts)
        {
            next = std::copy(column(part).begin(), column(part).end(), next);
        }
    }

    // Adds `first` to the indices of n triangles from the `start`-th on.
    template<class Triangles>
    static void shift(Triangles& triangles, label start, label n, label first)
    {
        for (label i = start; i < start + n; ++i)
        {
            for (label& index : triangles[i])
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
    const Concatenating concatenating{all, parts};
    concatenating.join([](auto& piece) -> auto& { return piece.mesh.triangles; });
    label firstPoint = 0, next = 0;
    for (const SurfacePiece& part : parts)
    {
        const label n = part.mesh.triangles.size();
        Concatenating::shift(all.mesh.triangles, next, n, firstPoint);
        next += n;
        firstPoint += part.mesh.points.size();
    }
    forEachColumn(concatenating);
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
