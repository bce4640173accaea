// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/transfer/StartChart.H"

namespace Foam::stability
{

StartChart::StartChart(
    const InterfaceMesh& piece, scalar meanCellSize, const List<SeamNode>& nodes
)
    : surface_(std::make_shared<const InterfaceMesh>(piece)),
      locator_(std::make_shared<const SurfaceLocator>(
          surface_->points, surface_->triangles, std::max(meanCellSize, scalar(VSMALL))
      )),
      meanCellSize_(meanCellSize), nodes_(nodes)
{
}

const SeamNode* StartChart::seamEndNear(const point& origin, scalar radius) const
{
    const SeamNode* nearest = nullptr;
    for (const SeamNode& node : nodes_)
    {
        if (node.isEnd && mag(node.x - origin) < radius)
        {
            radius = mag(node.x - origin);
            nearest = &node;
        }
    }
    return nearest;
}

StartChart::Reading
StartChart::read(label trianglei, const point& origin, const vector2D& carried) const
{
    const triFace& t = surface_->triangles[trianglei];
    const CornerIndices& c = surface_->corners[trianglei];
    const pointField& x = surface_->points;
    const List<vector2D>& p = surface_->parameters;
    const scalar area = 2 * mag(surface_->areaVector(trianglei));
    const vector2D d1 = p[c[1]] - p[c[0]], d2 = p[c[2]] - p[c[0]];
    const scalar parameterArea = d1.perp(d2); // twice it, as `area`
    Reading reading;
    if (area > 0 && parameterArea != 0)
    {
        const FixedList<scalar, 3> w = planeWeights(origin, x[t[0]], x[t[1]], x[t[2]]);
        reading.origin = w[0] * x[t[0]] + w[1] * x[t[1]] + w[2] * x[t[2]];
        reading.p = w[0] * p[c[0]] + w[1] * p[c[1]] + w[2] * p[c[2]];
        for (direction d = 0; d < 2; ++d) // beyond the edge of a chart
        {
            reading.p[d] = std::min(std::max(reading.p[d], scalar(0)), scalar(1));
        }
        // The way on the surface: in two dimensions u and v have scales of their own.
        const vector2D d = reading.p - carried;
        const vector way =
            (d.perp(d2) * (x[t[1]] - x[t[0]]) + d1.perp(d) * (x[t[2]] - x[t[0]]))
            / parameterArea;
        reading.gap = mag(way) / surface_->cellSizes[t[0]];
    }
    return reading;
}

SurfacePoint StartChart::foot(const point& origin) const
{
    return locator_->closest(
        origin, reach * meanCellSize_,
        [&](label trianglei) { return surface_->parametrized(trianglei); }
    );
}

bool StartChart::isNearer(const point& origin, const vector2D& a, const vector2D& b)
    const
{
    const SurfacePoint x = foot(origin);
    return x.triangle >= 0
           && read(x.triangle, origin, a).gap < read(x.triangle, origin, b).gap;
}

// Two triangles that touch are on one side where all points that they share have one p.
bool StartChart::acrossSeam(label a, label b) const
{
    bool touch = false;
    for (label i = 0; i < 3; ++i)
    {
        for (label j = 0; j < 3; ++j)
        {
            if (surface_->triangles[a][i] == surface_->triangles[b][j])
            {
                touch = true;
                if (surface_->corners[a][i] != surface_->corners[b][j])
                {
                    return true;
                }
            }
        }
    }
    return !touch;
}

StartChart::Reading StartChart::at(const point& origin, const vector2D& carried) const
{
    constexpr scalar doubtful = 0.02; // in cells: perhaps the other side of a seam
    constexpr scalar beyond = 0.1;    // in cells: how far a seam may have moved
    const scalar h = meanCellSize_;
    const SurfacePoint x = foot(origin);
    if (x.triangle < 0)
    {
        return Reading();
    }
    Reading best = read(x.triangle, origin, carried);
    if (best.gap > doubtful)
    {
        Reading other;
        label otheri = x.triangle;
        DynamicList<label> near;
        const scalar radius = std::sqrt(sqr(x.distance) + sqr(beyond * h));
        locator_->candidates(origin, radius, near);
        for (const label trianglei : near)
        {
            if (surface_->parametrized(trianglei)
                && locator_->closestOn(trianglei, origin).distance <= radius)
            {
                const Reading reading = read(trianglei, origin, carried);
                if (reading.gap < other.gap)
                {
                    other = reading;
                    otheri = trianglei;
                }
            }
        }
        if (2 * other.gap < best.gap && acrossSeam(otheri, x.triangle))
        {
            best = other;
        }
    }
    return best;
}

void StartChart::readOff(InterfaceMesh& mesh) const
{
    if (!surface_)
    {
        return;
    }
    constexpr scalar farthest = 0.5; // in cells
    const pointField carried(mesh.origins);
    List<bool> isRead(mesh.parameters.size(), false);
    forAll(mesh.triangles, trianglei)
    {
        for (label k = 0; k < 3; ++k)
        {
            const label origini = mesh.originCorners[trianglei][k];
            const label i = mesh.corners[trianglei][k];
            if (i < 0 || isRead[i])
            {
                continue;
            }
            isRead[i] = true;
            const Reading reading = at(carried[origini], mesh.parameters[i]);
            if (reading.gap <= farthest)
            {
                mesh.parameters[i] = reading.p;
                mesh.origins[origini] = reading.origin;
            }
        }
    }
}

} // namespace Foam::stability
