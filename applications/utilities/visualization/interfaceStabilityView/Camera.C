// SPDX-License-Identifier: GPL-3.0-or-later

#include "Camera.H"

#include "VectorOperators.H"

#include <vtkMath.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Foam::stability
{

namespace
{

constexpr double viewAngle = 28; // [degrees] of the picture's height
constexpr double margin = 1.06;

struct Frustum
{
    vtkVector3d right, up, back; // unit; `back` points from the scene to the camera
    double tangentX, tangentY;   // of half the view angles
};

vtkVector3d corner(const vtkBoundingBox& box, int i)
{
    vtkVector3d x;
    box.GetCorner(i, x.GetData());
    return x;
}

// Distance at which every corner of the box lies in the picture.
double fittingDistance(
    const vtkBoundingBox& box, const Frustum& frustum, const vtkVector3d& focus
)
{
    double distance = 0;
    for (int i = 0; i < 8; ++i)
    {
        const vtkVector3d x = corner(box, i) - focus;
        const double wide = std::abs(x.Dot(frustum.right)) / frustum.tangentX;
        const double high = std::abs(x.Dot(frustum.up)) / frustum.tangentY;
        distance = std::max(distance, x.Dot(frustum.back) + std::max(wide, high));
    }
    return distance;
}

// Middle of the corners as they appear in the picture, in the plane of the focus.
vtkVector3d apparentMiddle(
    const vtkBoundingBox& box, const Frustum& frustum, const vtkVector3d& focus,
    double distance
)
{
    constexpr double far = std::numeric_limits<double>::max();
    double low[2] = {far, far}, high[2] = {-far, -far};
    for (int i = 0; i < 8; ++i)
    {
        const vtkVector3d x = corner(box, i) - focus;
        const double scale = distance / (distance - x.Dot(frustum.back));
        const double seen[2] = {
            scale * x.Dot(frustum.right), scale * x.Dot(frustum.up)};
        for (int k = 0; k < 2; ++k)
        {
            low[k] = std::min(low[k], seen[k]);
            high[k] = std::max(high[k], seen[k]);
        }
    }
    return focus + 0.5 * (low[0] + high[0]) * frustum.right
           + 0.5 * (low[1] + high[1]) * frustum.up;
}

vtkVector3d axis(int i)
{
    vtkVector3d x(0, 0, 0);
    x[i] = 1;
    return x;
}

// Half the height of the picture in which every corner of the box lies.
double fittingHeight(
    const vtkBoundingBox& box, const Frustum& frustum, const vtkVector3d& focus,
    double aspect
)
{
    double height = 0;
    for (int i = 0; i < 8; ++i)
    {
        const vtkVector3d x = corner(box, i) - focus;
        const double wide = std::abs(x.Dot(frustum.right)) / aspect;
        height = std::max({height, wide, std::abs(x.Dot(frustum.up))});
    }
    return height;
}

} // namespace

vtkVector3d rightAxis(const vtkVector3d& up, const std::optional<vtkVector3d>& normal)
{
    int i = std::abs(up[0]) > 0.5 ? 1 : 0;
    while (normal && (std::abs((*normal)[i]) > 0.5 || std::abs(up[i]) > 0.5))
    {
        ++i;
    }
    return axis(i);
}

void aim(
    vtkCamera& camera, const vtkBoundingBox& box, const ViewDirection& view,
    double aspect
)
{
    const vtkVector3d& right = view.right;
    const vtkVector3d front = right.Cross(view.up);
    const double a = vtkMath::RadiansFromDegrees(view.azimuth);
    const double e = vtkMath::RadiansFromDegrees(view.elevation);

    Frustum frustum;
    frustum.right = std::cos(a) * right - std::sin(a) * front;
    const vtkVector3d level = std::cos(a) * front + std::sin(a) * right;
    frustum.back = std::cos(e) * level + std::sin(e) * view.up;
    frustum.up = frustum.back.Cross(frustum.right);
    frustum.tangentY = std::tan(vtkMath::RadiansFromDegrees(0.5 * viewAngle));
    frustum.tangentX = aspect * frustum.tangentY;

    vtkVector3d focus;
    box.GetCenter(focus.GetData());
    double distance = 0;
    for (int i = 0; i < 5; ++i) // perspective moves the middle; settles at once
    {
        distance = margin * fittingDistance(box, frustum, focus);
        focus = apparentMiddle(box, frustum, focus, distance);
    }
    const vtkVector3d eye = focus + distance * frustum.back;
    camera.SetFocalPoint(focus.GetData());
    camera.SetPosition(eye.GetData());
    camera.SetViewUp(frustum.up.GetData());
    camera.SetViewAngle(viewAngle);
    if (view.parallel)
    {
        camera.ParallelProjectionOn();
        camera.SetParallelScale(margin * fittingHeight(box, frustum, focus, aspect));
    }
    camera.Zoom(view.zoom);
}

} // namespace Foam::stability
