// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/surface/Ribbon.H"

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

} // namespace Foam::stability
