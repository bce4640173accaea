// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/results/ResultSurfaces.H"

#include "core/parametrization/ChartPacking.H"

#include <algorithm>

namespace Foam::stability
{

namespace
{

// Points split along seams: one output point for each pair (point, parameter) that
// corners use. A point without triangles gets none.
struct SplitPoints
{
    labelList vertex;        // per output point: the welded point
    labelList origin;        // per output point: index, of its first corner
    labelList parameter;     // per output point: index, or noParameter
    List<triFace> triangles; // of output points
};

// The display corner on a swatch, from the index of p or none: negative, and even on
// that of what attached. So it is not welded to tracked triangles, yet p stays known.
label onSwatch(label corner, bool entered)
{
    return -2 - 2 * (max(corner, label(-1)) + 1) - entered;
}

// The parameter behind a display corner.
label trueCorner(label corner)
{
    return corner <= -2 ? (-2 - corner) / 2 - 1 : corner;
}

vector2D texturePlace(const InterfaceMesh& mesh, label corner)
{
    return corner >= 0       ? mesh.parameters[corner]
           : corner % 2 == 0 ? Swatches::attached()
                             : Swatches::entered();
}

SplitPoints split(const InterfaceMesh& mesh, const List<CornerIndices>& corners)
{
    SplitPoints result;
    result.triangles = mesh.triangles;
    DynamicList<label> vertex;
    DynamicList<label> parameter;
    DynamicList<label> origin;
    // The pairs of a point form a chain: few points have more than one.
    labelList first(mesh.points.size(), -1);
    DynamicList<label> next;
    forAll(mesh.triangles, trianglei)
    {
        for (label k = 0; k < 3; ++k)
        {
            const label pointi = mesh.triangles[trianglei][k];
            label outi = first[pointi];
            while (outi >= 0 && parameter[outi] != corners[trianglei][k])
            {
                outi = next[outi];
            }
            if (outi < 0)
            {
                outi = vertex.size();
                vertex.append(pointi);
                parameter.append(corners[trianglei][k]);
                origin.append(mesh.originCorners[trianglei][k]);
                next.append(first[pointi]);
                first[pointi] = outi;
            }
            result.triangles[trianglei][k] = outi;
        }
    }
    result.vertex.transfer(vertex);
    result.parameter.transfer(parameter);
    result.origin.transfer(origin);
    return result;
}

vector2D valueOf(const InterfaceMesh& mesh, label parameteri)
{
    return parameteri >= 0 ? mesh.parameters[parameteri] : vector2D(-1, -1);
}

// Triangles with a corner that is attached, entered or has no p lie wholly on a swatch
// (an interpolated sentinel would make a rainbow fringe): on that of what entered if a
// corner did, now or before, and none is attached.
List<CornerIndices> displayCorners(const ClassifiedSurface& surface)
{
    List<CornerIndices> corners(surface.mesh.corners);
    forAll(corners, trianglei)
    {
        bool tracked = surface.mesh.parametrized(trianglei);
        bool attached = false, entered = false;
        for (const label pointi : surface.mesh.triangles[trianglei])
        {
            tracked = tracked && surface.stability[pointi] == Stability::stable;
            attached = attached || surface.stability[pointi] == Stability::attached;
            entered = entered || surface.fromOutside[pointi];
        }
        if (!tracked)
        {
            for (label& corner : corners[trianglei])
            {
                corner = onSwatch(corner, entered && !attached);
            }
        }
    }
    return corners;
}

template<class Value>
PointArray scalars(
    const std::string& name, bool integer, const labelList& vertex, const Value& value
)
{
    PointArray array{name, 1, integer, {}, false};
    array.values.reserve(vertex.size());
    for (const label pointi : vertex)
    {
        array.values.push_back(scalar(value(pointi)));
    }
    return array;
}

PointArray
positions(const std::string& name, const labelList& places, const pointField& x)
{
    PointArray array{name, 3, false, {}, true};
    for (const label place : places)
    {
        array.values.insert(
            array.values.end(), {x[place].x(), x[place].y(), x[place].z()}
        );
    }
    return array;
}

void append(PointArray& array, const vector2D& p)
{
    array.values.push_back(p.x());
    array.values.push_back(p.y());
}

// The marks that are arrays of one kind of file.
void addMarks(
    const PointMarks& marks, bool MarkFiles::*file, const labelList& vertex,
    std::vector<PointArray>& arrays
)
{
    forEachMark(
        [&](const char* name, const MarkFiles& files, const auto& mark)
        {
            if (files.*file)
            {
                const auto& values = mark(marks);
                using Value = std::decay_t<decltype(values[0])>;
                constexpr bool integer = !std::is_same_v<Value, scalar>;
                arrays.push_back(scalars(
                    name, integer, vertex, [&](label i) { return scalar(values[i]); }
                ));
            }
        }
    );
}

// The points, triangles and arrays that both surfaces have.
ResultSurface surface(
    const ClassifiedSurface& from, const SplitPoints& split, scalar time,
    const labelList& numbers
)
{
    ResultSurface result;
    result.time = time;
    result.triangles = split.triangles;
    result.points.setSize(split.vertex.size());
    PointArray parameter{"parameter", 2, false, {}, false};
    forAll(split.vertex, i)
    {
        result.points[i] = from.mesh.points[split.vertex[i]];
        append(parameter, valueOf(from.mesh, trueCorner(split.parameter[i])));
    }
    const labelList& vertex = split.vertex;
    result.arrays = {
        parameter,
        scalars(
            "vertex", true, vertex,
            [&](label i) { return numbers.empty() ? i : numbers[i]; }
        ),
        scalars(
            "stability", true, vertex, [&](label i) { return label(from.stability[i]); }
        ),
        scalars(
            "cellSize", false, vertex, [&](label i) { return from.mesh.cellSizes[i]; }
        ),
        scalars("distance", false, vertex, [&](label i) { return from.distance[i]; }),
        scalars(
            "driftSpeed", false, vertex, [&](label i) { return from.driftSpeed[i]; }
        ),
        scalars(
            "confidence", false, vertex, [&](label i) { return from.confidence[i]; }
        ),
    };
    return result;
}

} // namespace

ResultSurface
interfaceSurface(const ClassifiedSurface& from, scalar time, const labelList& numbers)
{
    const SplitPoints points(split(from.mesh, displayCorners(from)));
    ResultSurface result(surface(from, points, time, numbers));
    const labelList& vertex = points.vertex;

    PointArray texture{"TCoords", 2, false, {}, false};
    for (const label corner : points.parameter)
    {
        append(texture, texturePlace(from.mesh, corner));
    }
    result.arrays.insert(result.arrays.begin(), texture);
    addMarks(from, &MarkFiles::interface, vertex, result.arrays);
    result.arrays.push_back(positions("origin", points.origin, from.mesh.origins));
    result.arrays.push_back(scalars(
        "preimageCount", true, vertex, [&](label i) { return from.preimages[i]; }
    ));
    result.arrays.push_back(
        scalars("component", true, vertex, [&](label i) { return from.components[i]; })
    );
    return result;
}

ResultSurface
timeSurface(const ClassifiedSurface& from, scalar time, const labelList& numbers)
{
    const SplitPoints points(split(from.mesh, from.mesh.corners));
    ResultSurface result(surface(from, points, time, numbers));
    addMarks(from, &MarkFiles::timeSurface, points.vertex, result.arrays);
    return result;
}

ResultSurface particleCloud(const UList<InstabilityParticle>& all, scalar time)
{
    ResultSurface result;
    result.time = time;
    labelList order(identity(all.size()));
    result.points.setSize(all.size());
    pointField origins(all.size());
    pointField detachments(all.size());
    PointArray parameter{"parameter", 2, false, {}, false};
    forAll(all, i)
    {
        result.points[i] = all[i].path.x;
        origins[i] = all[i].origin;
        detachments[i] = all[i].detachmentPosition;
        append(parameter, all[i].parameter);
    }
    const auto add = [&](const char* name, bool integer, const auto& value)
    {
        result.arrays.push_back(
            scalars(name, integer, order, [&](label i) { return value(all[i]); })
        );
    };
    using Particle = InstabilityParticle;
    add("id", true, [](const Particle& p) { return p.path.id; });
    add("detachmentTime", false, [](const Particle& p) { return p.detachmentTime; });
    add("age", false, [&](const Particle& p) { return time - p.detachmentTime; });
    add("component", true, [](const Particle& p) { return p.component; });
    add("weight", false, [](const Particle& p) { return p.weight; });
    forEachMark(
        [&](const char* name, const MarkFiles& files, const auto& mark)
        {
            if (files.particles)
            {
                using Value = std::decay_t<decltype(mark(all[0]))>;
                add(name, !std::is_same_v<Value, scalar>,
                    [&](const Particle& p) { return scalar(mark(p)); });
            }
        }
    );
    add("state", true, [](const Particle& p) { return label(p.path.state); });
    result.arrays.push_back(parameter);
    result.arrays.push_back(positions("origin", order, origins));
    result.arrays.push_back(positions("detachmentPosition", order, detachments));
    return result;
}

void moveIntoMesh(ResultSurface& surface, const PlaneSection& section)
{
    if (!surface.inParameterSpace)
    {
        surface.sectionNormal = section.normal;
        for (point& x : surface.points)
        {
            x = section.inMesh(x);
        }
    }
    for (PointArray& array : surface.arrays)
    {
        for (std::size_t i = 0; array.position && i < array.values.size(); i += 3)
        {
            double* x = &array.values[i];
            const point moved(section.inMesh(point(x[0], x[1], x[2])));
            std::copy(moved.begin(), moved.end(), x);
        }
    }
}

} // namespace Foam::stability
