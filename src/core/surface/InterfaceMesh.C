// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/surface/InterfaceMesh.H"

namespace Foam::stability
{

vectorField InterfaceMesh::areaVectors() const
{
    vectorField areas(triangles.size());
    forAll(areas, trianglei)
    {
        areas[trianglei] = areaVector(trianglei);
    }
    return areas;
}

scalarField InterfaceMesh::pointAreas() const
{
    scalarField areas(points.size(), 0);
    forAll(triangles, trianglei)
    {
        const scalar third = mag(areaVector(trianglei)) / 3;
        for (const label pointi : triangles[trianglei])
        {
            areas[pointi] += third;
        }
    }
    return areas;
}

vectorField InterfaceMesh::pointNormals() const
{
    vectorField normals(points.size(), Zero);
    forAll(triangles, trianglei)
    {
        for (const label pointi : triangles[trianglei])
        {
            normals[pointi] += areaVector(trianglei);
        }
    }
    for (vector& n : normals)
    {
        const scalar length = mag(n);
        n = length > VSMALL ? n / length : vector(Zero);
    }
    return normals;
}

scalar InterfaceMesh::area() const
{
    scalar sum = 0;
    forAll(triangles, trianglei)
    {
        sum += mag(areaVector(trianglei));
    }
    return sum;
}

scalar InterfaceMesh::meanCellSize() const
{
    scalar mean = 0;
    for (const scalar h : cellSizes)
    {
        mean += h / cellSizes.size();
    }
    return mean;
}

void InterfaceMesh::clearParametrization()
{
    parameters.clear();
    corners.setSize(triangles.size());
    corners = CornerIndices(noParameter);
    materials.setSize(triangles.size(), labelPair(0, 1));
    setOrigins(pointField(points.size(), Zero));
}

void InterfaceMesh::setOrigins(const pointField& ofPoints)
{
    origins = ofPoints;
    originCorners.setSize(triangles.size());
    forAll(triangles, trianglei)
    {
        originCorners[trianglei] = triangles[trianglei];
    }
}

} // namespace Foam::stability
