// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/reconstruction/sharpening/PlicPlane.H"

#include "core/reconstruction/sharpening/OffsetSearch.H"

#include <algorithm>

namespace Foam::stability
{

namespace
{

// True if the face is so flat and convex that it can be cut as one polygon.
bool isPlanar(const CellComplex& complex, label facei)
{
    constexpr scalar flat = 1e-9; // of its width
    const face& f = complex.faces()[facei];
    if (f.size() == 3)
    {
        return true;
    }
    const vector& S = complex.faceAreas()[facei];
    const scalar area = mag(S);
    const vector n = S / std::max(area, scalar(VSMALL));
    forAll(f, k)
    {
        const point& x = complex.points()[f[k]];
        const vector before = x - complex.points()[f.prevLabel(k)];
        const vector after = complex.points()[f.nextLabel(k)] - x;
        if (mag((x - complex.faceCentres()[facei]) & n) > flat * std::sqrt(area)
            || ((before ^ after) & n) < -flat * area)
        {
            return false;
        }
    }
    return true;
}

} // namespace

CellShape::CellShape(const CellComplex& complex, label celli)
    : origin_(complex.cellCentres()[celli])
{
    for (const label facei : complex.cellFaces()[celli])
    {
        addFace(complex, facei, complex.owner()[facei] == celli);
    }
    starts_.push_back(corners_.size());
    for (std::size_t i = 0; i + 1 < starts_.size(); ++i)
    {
        const point& a = points_[corners_[starts_[i]]];
        for (std::size_t j = starts_[i] + 1; j + 1 < starts_[i + 1]; ++j)
        {
            volume_ += (a & (points_[corners_[j]] ^ points_[corners_[j + 1]])) / 6;
        }
    }
}

label CellShape::localPoint(label pointi, const point& x)
{
    const auto found = std::find(names_.begin(), names_.end(), pointi);
    if (pointi >= 0 && found != names_.end())
    {
        return found - names_.begin();
    }
    names_.push_back(pointi);
    points_.push_back(x - origin_);
    return names_.size() - 1;
}

void CellShape::addFacet(const UList<label>& corners, bool outwards)
{
    starts_.push_back(corners_.size());
    corners_.insert(corners_.end(), corners.begin(), corners.end());
    if (!outwards)
    {
        std::reverse(corners_.begin() + starts_.back(), corners_.end());
    }
}

void CellShape::addFace(const CellComplex& complex, label facei, bool outwards)
{
    const face& f = complex.faces()[facei];
    labelList local(f.size());
    forAll(f, k)
    {
        local[k] = localPoint(f[k], complex.points()[f[k]]);
    }
    if (isPlanar(complex, facei))
    {
        addFacet(local, outwards);
        return;
    }
    const label centre = localPoint(-1, complex.faceCentres()[facei]);
    forAll(local, k)
    {
        addFacet(labelList({local[k], local[local.fcIndex(k)], centre}), outwards);
    }
}

// The flux of (x - referencePoint)/3 through the facets, cut off: with the
// referencePoint on the plane the polygon itself contributes nothing.
scalar
CellShape::cut(const vector& normal, scalar offset, std::vector<Segment>& outline) const
{
    outline.clear();
    const point referencePoint = offset * normal;
    scalar flux = 0;
    static thread_local std::vector<point> kept;
    for (std::size_t i = 0; i + 1 < starts_.size(); ++i)
    {
        kept.clear();
        Segment segment{};
        label nCrossings = 0;
        const std::size_t n = starts_[i + 1] - starts_[i];
        for (std::size_t k = 0; k < n; ++k)
        {
            const label p = corners_[starts_[i] + k];
            const label q = corners_[starts_[i] + (k + 1) % n];
            const scalar dp = (points_[p] & normal) - offset;
            const scalar dq = (points_[q] & normal) - offset;
            if (dp > 0)
            {
                kept.push_back(points_[p]);
            }
            if ((dp > 0) != (dq > 0))
            {
                // From the lower point, so that both facets of an edge agree.
                const label low = std::min(p, q), high = std::max(p, q);
                const scalar dl = low == p ? dp : dq, dh = low == p ? dq : dp;
                const point x =
                    points_[low] + dl / (dl - dh) * (points_[high] - points_[low]);
                kept.push_back(x);
                (dp > 0 ? segment.a : segment.b) = x;
                (dp > 0 ? segment.onA : segment.onB) = edge(low, high);
                ++nCrossings;
            }
        }
        for (std::size_t k = 1; k + 1 < kept.size(); ++k)
        {
            flux += (kept[0] - referencePoint)
                    & ((kept[k] - kept[0]) ^ (kept[k + 1] - kept[0]));
        }
        if (nCrossings == 2)
        {
            outline.push_back(segment);
        }
    }
    return flux / 6;
}

// A facet leaves the kept side at a and comes back at b; the polygon runs from a to b
// right-handed around the normal.
void CellShape::measure(PlicPlane& plane, const std::vector<Segment>& outline) const
{
    plane.area = 0;
    if (outline.empty())
    {
        return;
    }
    const point o = outline[0].a;
    vector moment(Zero);
    symmTensor second(Zero);
    for (const Segment& s : outline)
    {
        const vector a = s.a - o, b = s.b - o;
        const scalar area = 0.5 * ((a ^ b) & plane.normal);
        plane.area += area;
        moment += area / 3 * (a + b);
        second += area / 12 * (sqr(a) + sqr(b) + sqr(a + b));
    }
    if (plane.area > 0)
    {
        const vector centre = moment / plane.area;
        plane.secondMoment = second / plane.area - sqr(centre);
        plane.centre = origin_ + o + centre;
    }
}

PlicPlane CellShape::planeOf(const vector& normal, scalar alpha) const
{
    scalar low = GREAT, high = -GREAT;
    for (const point& x : points_)
    {
        low = std::min(low, x & normal);
        high = std::max(high, x & normal);
    }
    PlicPlane plane;
    plane.normal = normal;
    static thread_local std::vector<Segment> outline;
    const auto shareBeyond = [&](scalar offset, PlicPlane& plane)
    {
        const scalar kept = cut(normal, offset, outline);
        measure(plane, outline);
        return ShareBeyond{kept / volume_, plane.area / volume_};
    };
    searchOffset(low, high, alpha, plane, shareBeyond);
    return plane;
}

std::vector<point> CellShape::polygonOf(const PlicPlane& plane) const
{
    std::vector<Segment> outline;
    cut(plane.normal, (plane.centre - origin_) & plane.normal, outline);
    std::vector<point> largest;
    scalar largestArea = 0;
    std::vector<char> done(outline.size(), 0);
    for (std::size_t first = 0; first < outline.size(); ++first)
    {
        std::vector<point> loop;
        vector area(Zero);
        for (std::size_t i = first; i < outline.size() && !done[i];)
        {
            done[i] = 1;
            loop.push_back(origin_ + outline[i].a);
            area += outline[i].a ^ outline[i].b;
            const auto next = std::find_if(
                outline.begin(), outline.end(),
                [&](const Segment& s) { return s.onA == outline[i].onB; }
            );
            i = next - outline.begin();
        }
        if ((area & plane.normal) > largestArea)
        {
            largestArea = area & plane.normal;
            largest = loop;
        }
    }
    return largest;
}

} // namespace Foam::stability
