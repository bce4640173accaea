// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/parametrization/seams/DiskCut.H"

#include "core/base/Errors.H"
#include "core/parametrization/seams/EdgePaths.H"
#include "DynamicList.H"

#include <string>

namespace Foam::stability
{

DiskCut::DiskCut(const PlainSurface& surface)
    : DiskCut(surface, topologicalSeams(surface))
{
}

DiskCut::DiskCut(const PlainSurface& surface, const SeamLayout& layout)
    : surface_(surface), topology_(surface.points.size(), surface.triangles),
      cut_(topology_.edges().size(), false), border_(topology_.edges().size(), false)
{
    forAll(surface_.triangles, trianglei)
    {
        for (label k = 0; k < 3; ++k)
        {
            if (coherentNeighbour(topology_, surface_.triangles, trianglei, k) < 0)
            {
                border_[topology_.triangleEdges()[trianglei][k]] = true;
            }
        }
    }
    cut_ = border_;
    for (const label edgei : layout.edges)
    {
        cut_[edgei] = true;
    }
    fans_ = splitFans(topology_, surface_.triangles, cut_);
    const SurfaceShape shape(shapeOf(fans_.points.size(), disk().triangles));
    if (!shape.isDisk())
    {
        throw NumericalFailure(
            "it could not be cut to a disk: its Euler characteristic is "
            + std::to_string(shape.euler) + " then, with "
            + std::to_string(shape.nLoops) + " boundary loops"
        );
    }
}

bool DiskCut::extendTo(label pointi)
{
    List<bool> onBoundary(surface_.points.size(), false);
    forAll(cut_, edgei)
    {
        if (cut_[edgei])
        {
            onBoundary[topology_.edges()[edgei].a] = true;
            onBoundary[topology_.edges()[edgei].b] = true;
        }
    }
    if (onBoundary[pointi])
    {
        return false;
    }
    DynamicList<label> sources;
    forAll(onBoundary, i)
    {
        if (onBoundary[i])
        {
            sources.append(i);
        }
    }
    for (const label edgei :
         EdgePaths(surface_.points, topology_, sources).edgesTo(pointi))
    {
        cut_[edgei] = true;
    }
    fans_ = splitFans(topology_, surface_.triangles, cut_);
    return true;
}

List<labelPair> DiskCut::seams() const
{
    DynamicList<labelPair> seams;
    forAll(cut_, edgei)
    {
        if (cut_[edgei] && !border_[edgei])
        {
            seams.append(
                labelPair(topology_.edges()[edgei].a, topology_.edges()[edgei].b)
            );
        }
    }
    return List<labelPair>(std::move(seams));
}

PlainSurface DiskCut::disk() const
{
    PlainSurface result{
        pointField(surface_.points, fans_.points), List<triFace>(fans_.corners.size())};
    forAll(fans_.corners, trianglei)
    {
        const CornerIndices& c = fans_.corners[trianglei];
        result.triangles[trianglei] = triFace(c[0], c[1], c[2]);
    }
    return result;
}

} // namespace Foam::stability
