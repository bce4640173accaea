// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/reconstruction/sharpening/InterfaceFit.H"

#include <cmath>

namespace Foam::stability
{

void InterfaceFit::setPlane(const point& c, const vector& n)
{
    centre = c;
    normal = n;
    vector upright = metric.extents & n; // in the frame
    upright /= mag(upright);
    const vector aside = across != vector(Zero)        ? across
                         : std::abs(upright.x()) < 0.6 ? vector(1, 0, 0)
                                                       : vector(0, 1, 0);
    vector t1 = upright ^ aside;
    t1 /= mag(t1);
    const vector t2 = upright ^ t1;
    axes = tensor(metric.inverse & t1, metric.inverse & t2, metric.inverse & upright);
    a = scalar(0);
}

SignedDistance InterfaceFit::distance(const point& x) const
{
    const vector p = local(x);
    const scalar u = p.x(), v = p.y();
    const scalar fu = a[1] + 2 * a[3] * u + a[4] * v;
    const scalar fv = a[2] + a[4] * u + 2 * a[5] * v;
    const vector g = gradient(-fu, -fv, 1);
    const scalar steepness = mag(g);
    return {(p.z() - height(u, v)) / steepness, g / steepness};
}

} // namespace Foam::stability
