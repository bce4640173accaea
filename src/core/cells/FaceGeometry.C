// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/cells/FaceGeometry.H"

#include "DynamicList.H"

#include <algorithm>

namespace Foam::stability
{

namespace
{

// The points of a face from the lowest towards the lower of its neighbours. Says
// whether that is against the direction of the face.
bool inCanonicalDirection(const face& f, DynamicList<label>& points)
{
    const label n = f.size();
    const label first = std::min_element(f.begin(), f.end()) - f.begin();
    const bool reversed = f[f.rcIndex(first)] < f[f.fcIndex(first)];
    points.setSize(n);
    for (label k = 0; k < n; ++k)
    {
        points[k] = f[(reversed ? first - k + n : first + k) % n];
    }
    return reversed;
}

} // namespace

void faceGeometry(const face& f, const pointField& points, point& centre, vector& area)
{
    DynamicList<label, 16> ring;
    const bool reversed = inCanonicalDirection(f, ring);
    point mean(Zero);
    for (const label pointi : ring)
    {
        mean += points[pointi];
    }
    mean /= ring.size();

    vector sum(Zero);
    const auto corner = [&](label i) -> const point&
    { return points[ring[i % ring.size()]]; };
    for (label i = 0; i < ring.size(); ++i)
    {
        sum += 0.5 * ((corner(i) - mean) ^ (corner(i + 1) - mean));
    }
    area = reversed ? -sum : sum;

    const vector direction = sum / max(mag(sum), VSMALL);
    scalar weight = 0;
    vector moment(Zero);
    for (label i = 0; i < ring.size(); ++i)
    {
        const point& a = corner(i);
        const point& b = corner(i + 1);
        const scalar part = 0.5 * (((a - mean) ^ (b - mean)) & direction);
        weight += part;
        moment += part * (a + b - 2 * mean) / 3;
    }
    centre = weight > VSMALL ? mean + moment / weight : mean;
}

} // namespace Foam::stability
