// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/cells/CellFrame.H"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace Foam::stability
{

namespace
{

using Points = std::vector<point>;

Points pointsOf(const CellComplex& complex, label celli)
{
    static thread_local std::vector<label> labels;
    labels.clear();
    for (const label facei : complex.cellFaces()[celli])
    {
        const face& f = complex.faces()[facei];
        labels.insert(labels.end(), f.begin(), f.end());
    }
    std::sort(labels.begin(), labels.end());
    labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
    Points points;
    for (const label pointi : labels)
    {
        points.push_back(complex.points()[pointi]);
    }
    return points;
}

UList<point> asList(Points& points)
{
    return UList<point>(points.data(), points.size());
}

// `across` is the normal of a section, or zero.
vector inPlane(const vector& v, const vector& across)
{
    return v - (v & across) * across;
}

// The mean of (x - centre)(x - centre) over the points [m2]; in a section without what
// is across.
symmTensor
scatterOf(const UList<point>& points, const point& centre, const vector& across)
{
    symmTensor sum(Zero);
    for (const point& x : points)
    {
        sum += sqr(inPlane(x - centre, across));
    }
    return sum / scalar(points.size());
}

// In a section: with the geometric mean of the scatters within it across.
symmTensor completed(const symmTensor& scatter, const vector& across)
{
    const scalar product = 0.5 * (sqr(tr(scatter)) - magSqr(scatter));
    return scatter + std::sqrt(std::max(product, scalar(0))) * sqr(across);
}

// The scatter around a cell that is no hexahedron, scaled to the size of the cell.
symmTensor scatterAround(const CellComplex& complex, label celli)
{
    const vector across = complex.whole().across();
    symmTensor sum(Zero);
    scalar sizes = 0;
    for (const label other : complex.pointNeighbours(celli))
    {
        Points points(pointsOf(complex, other));
        sum += scatterOf(asList(points), complex.cellCentres()[other], across);
        sizes += sqr(complex.cellSizes()[other]);
    }
    return completed(sqr(complex.cellSizes()[celli]) / sizes * sum, across);
}

constexpr label ofHexahedron = 6;    // faces
constexpr scalar roundBox = 0.7;     // extents differ by a factor of about 1.7
constexpr scalar roundOther = 0.4;   // of about 2.4: a cube cut around a diagonal has 2
constexpr scalar roundSection = 0.4; // of about 2.7: sharp discs stay sharper so

// 1 for a sphere, 0 for a disc or a needle.
scalar roundness(const symmTensor& scatter)
{
    return 27 * det(scatter) / pow3(tr(scatter));
}

CellFrame frameWith(const symmTensor& extents)
{
    CellFrame frame;
    frame.extents = extents;
    frame.inverse = inv(extents);
    frame.volume = det(extents);
    return frame;
}

// Twice the square root of the scatter, and its inverse, by the iteration of Denman and
// Beavers (Appl. Math. Comput. 2 (1976)).
CellFrame stretchedFrame(const symmTensor& scatter)
{
    constexpr label mostSteps = 50;
    constexpr scalar flattest = 1e-12, roundOff = 1e-14;
    const scalar scale = tr(scatter) / 3;
    symmTensor root(scatter / scale + flattest * symmTensor(I)), inverse(I);
    for (label step = 0; step < mostSteps; ++step)
    {
        const symmTensor next(0.5 * (root + inv(inverse)));
        inverse = 0.5 * (inverse + inv(root));
        const bool settled = magSqr(next - root) <= sqr(roundOff) * magSqr(next);
        root = next;
        if (settled)
        {
            break;
        }
    }
    return frameWith(2 * std::sqrt(scale) * root);
}

// The smallest and the largest eigenvalue, by the formula for three of them (Smith,
// Commun. ACM 4 (1961)).
std::pair<scalar, scalar> extremes(const symmTensor& s)
{
    const scalar mean = tr(s) / 3;
    const symmTensor deviation(dev(s));
    const scalar size = std::sqrt(magSqr(deviation) / 6);
    constexpr scalar roundOff = 1e-6;
    if (!(size > roundOff * mean))
    {
        return {mean, mean};
    }
    const scalar cosine = det(deviation / size) / 2;
    const scalar angle =
        std::acos(std::min(std::max(cosine, scalar(-1)), scalar(1))) / 3;
    return {
        mean + 2 * size * std::cos(angle + 2 * M_PI / 3),
        mean + 2 * size * std::cos(angle)};
}

scalar spanOf(const UList<point>& points, const point& centre, const vector& across)
{
    scalar farthest = 0;
    for (const point& x : points)
    {
        farthest = std::max(farthest, magSqr(inPlane(x - centre, across)));
    }
    return 2 * std::sqrt(farthest / (across == vector(Zero) ? 3 : 2));
}

} // namespace

scalar CellFrame::alignment(const vector& a, const vector& b) const
{
    const vector fa = extents & a, fb = extents & b;
    const scalar lengths = std::sqrt(magSqr(fa) * magSqr(fb));
    return std::max(a & b, lengths > 0 ? (fa & fb) / lengths : scalar(-1));
}

CellFrame rounded(const CellFrame& frame)
{
    constexpr scalar round = 8, flat = 16; // ratios of extents
    const auto [smallest, largest] = extremes(frame.extents);
    const scalar flatness =
        std::log(largest / (round * smallest)) / std::log(flat / round);
    if (smallest == largest || flatness >= 1)
    {
        return frame;
    }
    const scalar share = std::max(flatness, scalar(0));
    return frameWith(share * frame.extents + (1 - share) * largest * symmTensor(I));
}

CellFrame frameOf(const CellComplex& complex, label celli)
{
    Points points(pointsOf(complex, celli));
    const point& centre = complex.cellCentres()[celli];
    const vector across = complex.whole().across();
    if (complex.cellFaces()[celli].size() != ofHexahedron
        && roundness(completed(scatterOf(asList(points), centre, across), across))
               < roundOther)
    {
        const symmTensor scatter(scatterAround(complex, celli));
        if (roundness(scatter) < roundOther)
        {
            return stretchedFrame(scatter);
        }
    }
    return frameOf(asList(points), centre, complex.cellFaces()[celli].size(), across);
}

CellFrame frameOf(
    const UList<point>& points, const point& centre, label nFaces, const vector& across
)
{
    if (nFaces == ofHexahedron)
    {
        const symmTensor scatter(completed(scatterOf(points, centre, across), across));
        if (roundness(scatter) < (across == vector(Zero) ? roundBox : roundSection))
        {
            return stretchedFrame(scatter);
        }
    }
    const scalar span = spanOf(points, centre, across);
    CellFrame frame;
    frame.extents = span * symmTensor(I);
    frame.inverse = 1 / span * symmTensor(I);
    frame.volume = pow3(span);
    return frame;
}

vector gradientOver(
    const CellComplex& complex, const UList<label>& cells, const scalarField& values,
    const CellFrame& frame
)
{
    const point& origin = complex.cellCentres()[cells[0]];
    vector meanX(Zero);
    scalar meanValue = 0;
    for (const label celli : cells)
    {
        meanX += complex.cellCentres()[celli] - origin;
        meanValue += values[celli];
    }
    meanX /= cells.size();
    meanValue /= cells.size();
    symmTensor matrix(Zero);
    vector moment(Zero);
    for (const label celli : cells)
    {
        const vector d = frame.local(complex.cellCentres()[celli] - origin - meanX);
        matrix += sqr(d);
        moment += (values[celli] - meanValue) * d;
    }
    matrix += 1e-6 * symmTensor(I);
    return frame.inverse & (inv(matrix) & moment);
}

} // namespace Foam::stability
