// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/surface/Ribbon.H"

#include "EdgeMap.H"

namespace Foam::stability
{

labelList pairsAcross(const InterfaceMesh& mesh, const PlaneSection& section)
{
    labelList pairs(mesh.points.size());
    forAll(pairs, pointi)
    {
        pairs[pointi] = pointi;
    }
    for (const triFace& t : mesh.triangles)
    {
        for (label k = 0; k < 3; ++k)
        {
            const label a = t[k], b = t[(k + 1) % 3];
            const point &x = mesh.points[a], &y = mesh.points[b];
            if (section.isLow(x) != section.isLow(y)
                && section.inPlane(x) == section.inPlane(y))
            {
                pairs[a] = b;
                pairs[b] = a;
            }
        }
    }
    return pairs;
}

vectorField
pointNormals(const InterfaceMesh& mesh, const std::optional<PlaneSection>& section)
{
    vectorField normals(mesh.pointNormals());
    if (section)
    {
        averageOverPairs(pairsAcross(mesh, *section), normals);
        for (vector& n : normals)
        {
            n = section->inPlane(n);
            const scalar length = mag(n);
            n = length > VSMALL ? n / length : vector(Zero);
        }
    }
    return normals;
}

void alignAcross(InterfaceMesh& mesh, const PlaneSection& section)
{
    const labelList pairs(pairsAcross(mesh, section));
    forAll(mesh.triangles, trianglei)
    {
        const triFace& t = mesh.triangles[trianglei];
        for (label k = 0; k < 3; ++k)
        {
            const label l = (k + 1) % 3;
            if (pairs[t[k]] != t[l])
            {
                continue;
            }
            point& x = mesh.origins[mesh.originCorners[trianglei][k]];
            point& y = mesh.origins[mesh.originCorners[trianglei][l]];
            const vector mean = 0.5 * (section.inPlane(x) + section.inPlane(y));
            x = mean + (x & section.normal) * section.normal;
            y = mean + (y & section.normal) * section.normal;
            const label p = mesh.corners[trianglei][k], q = mesh.corners[trianglei][l];
            if (p >= 0 && q >= 0)
            {
                scalar &u = mesh.parameters[p].x(), &v = mesh.parameters[q].x();
                u = v = 0.5 * (u + v);
            }
        }
    }
}

labelList stripMates(
    const InterfaceMesh& mesh, const labelList& pairs, const PlaneSection& section
)
{
    labelList mates(identity(mesh.triangles.size()));
    EdgeMap<label> first; // diagonal -> triangle
    forAll(mesh.triangles, trianglei)
    {
        const triFace& t = mesh.triangles[trianglei];
        for (label k = 0; k < 3; ++k)
        {
            const label a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
            if (pairs[a] != b || pairs[c] == c)
            {
                continue;
            }
            const bool isLow = section.isLow(mesh.points[c]);
            const label opposite = section.isLow(mesh.points[a]) == isLow ? b : a;
            const edge diagonal(opposite, c);
            const auto found = first.cfind(diagonal);
            if (found.found())
            {
                mates[trianglei] = found.val();
                mates[found.val()] = trianglei;
            }
            else
            {
                first.insert(diagonal, trianglei);
            }
        }
    }
    return mates;
}

scalar areaInMesh(
    const InterfaceMesh& mesh, label trianglei,
    const std::optional<PlaneSection>& section
)
{
    const scalar area = mag(mesh.areaVector(trianglei));
    return section ? area * section->factor(mesh.centre(trianglei)) : area;
}

scalarField
pointAreasInMesh(const InterfaceMesh& mesh, const std::optional<PlaneSection>& section)
{
    scalarField areas(mesh.points.size(), 0);
    forAll(mesh.triangles, trianglei)
    {
        const scalar third = areaInMesh(mesh, trianglei, section) / 3;
        for (const label pointi : mesh.triangles[trianglei])
        {
            areas[pointi] += third;
        }
    }
    return areas;
}

PlaneSection::Cone coneTo(
    const InterfaceMesh& mesh, label trianglei, const point& apex,
    const std::optional<PlaneSection>& section
)
{
    if (section)
    {
        return section->coneTo(
            mesh.centre(trianglei), mesh.areaVector(trianglei), apex
        );
    }
    const triFace& t = mesh.triangles[trianglei];
    const vector a = mesh.points[t[0]] - apex, b = mesh.points[t[1]] - apex,
                 c = mesh.points[t[2]] - apex;
    PlaneSection::Cone cone;
    cone.volume = cone.measure = (a & (b ^ c)) / 6;
    cone.centroid = apex + (a + b + c) / 4;
    return cone;
}

} // namespace Foam::stability
