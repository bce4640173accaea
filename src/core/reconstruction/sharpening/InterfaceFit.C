// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/reconstruction/sharpening/InterfaceFit.H"

#include <cmath>

namespace Foam::stability
{

void InterfaceFit::setPlane(const point& c, const vector& n)
{
    centre = c;
    normal = n;
    const vector aside = across != vector(Zero)  ? across
                         : std::abs(n.x()) < 0.6 ? vector(1, 0, 0)
                                                 : vector(0, 1, 0);
    t1 = n ^ aside;
    t1 /= mag(t1);
    t2 = n ^ t1;
    a = scalar(0);
}

SignedDistance InterfaceFit::distance(const point& x) const
{
    const vector p = local(x);
    const scalar u = p.x(), v = p.y();
    const scalar fu = a[1] + 2 * a[3] * u + a[4] * v;
    const scalar fv = a[2] + a[4] * u + 2 * a[5] * v;
    const scalar shrink = 1 / std::sqrt(1 + fu * fu + fv * fv);
    return {
        (p.z() - height(u, v)) * size * shrink, shrink * (normal - fu * t1 - fv * t2)};
}

} // namespace Foam::stability
