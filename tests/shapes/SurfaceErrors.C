// SPDX-License-Identifier: GPL-3.0-or-later

#include "shapes/SurfaceErrors.H"

#include "core/cells/CellFrame.H"

#include <algorithm>
#include <cmath>

namespace Foam::stability::shapes
{

namespace
{

bool atWall(const CellComplex& complex, label celli)
{
    const UList<label> faces = complex.cellFaces()[celli];
    return std::any_of(
        faces.begin(), faces.end(),
        [&](label facei)
        {
            const label i = facei - complex.nInternalFaces();
            return i >= 0 && complex.kinds()[i] != BoundaryKind::symmetry;
        }
    );
}

bool wallNear(const CellComplex& complex, label celli)
{
    for (const label next : complex.pointNeighbours(celli))
    {
        const labelList& around = complex.pointNeighbours(next);
        if (std::any_of(
                around.begin(), around.end(),
                [&](label other) { return atWall(complex, other); }
            ))
        {
            return true;
        }
    }
    return false;
}

} // namespace

vector gradient(const Shape& shape, const point& x, scalar h)
{
    vector g(Zero);
    for (direction d = 0; d < 3; ++d)
    {
        point a(x), b(x);
        a[d] += 1e-4 * h;
        b[d] -= 1e-4 * h;
        g[d] = (shape(a) - shape(b)) / (2e-4 * h);
    }
    return g;
}

scalar extentOf(const CellComplex& complex, label celli, const vector& along)
{
    scalar low = GREAT, high = -GREAT;
    for (const label facei : complex.cellFaces()[celli])
    {
        for (const label pointi : complex.faces()[facei])
        {
            const scalar s = complex.points()[pointi] & along;
            low = std::min(low, s);
            high = std::max(high, s);
        }
    }
    return high - low;
}

SurfaceErrors errorsOf(
    const InterfaceMesh& mesh, const Shape& shape, const CellComplex& complex,
    CellLength unit
)
{
    SurfaceErrors e;
    const scalarField areas(mesh.pointAreas());
    scalar insideArea = 0;
    forAll(mesh.points, pointi)
    {
        const point& x = mesh.points[pointi];
        const scalar h = mesh.cellSizes[pointi];
        const vector g = gradient(shape, x, h);
        const scalar length = unit == CellLength::size
                                  ? h
                                  : extentOf(complex, mesh.cells[pointi], g / mag(g));
        const scalar off = std::abs(shape(x)) / length;
        e.rms += areas[pointi] * sqr(off);
        e.largest = std::max(e.largest, off);
        if (!wallNear(complex, mesh.cells[pointi]))
        {
            insideArea += areas[pointi];
            e.rmsInside += areas[pointi] * sqr(off);
            e.largestInside = std::max(e.largestInside, off);
        }
    }
    e.rms = std::sqrt(e.rms / std::max(sum(areas), VSMALL));
    e.rmsInside = std::sqrt(e.rmsInside / std::max(insideArea, VSMALL));
    scalar area = 0;
    forAll(mesh.triangles, trianglei)
    {
        const vector S = mesh.areaVector(trianglei);
        const label first = mesh.triangles[trianglei][0];
        const vector g = gradient(shape, mesh.centre(trianglei), mesh.cellSizes[first]);
        const scalar cosine = (S & g) / (mag(S) * mag(g) + VSMALL);
        const CellFrame frame(frameOf(complex, mesh.cells[first]));
        e.nFlipped += ((frame.extents & S) & (frame.extents & g)) <= 0;
        e.normals += mag(S) * sqr(std::acos(std::min(cosine, scalar(1))) * 180 / M_PI);
        area += mag(S);
    }
    e.normals = std::sqrt(e.normals / std::max(area, VSMALL));
    return e;
}

} // namespace Foam::stability::shapes
