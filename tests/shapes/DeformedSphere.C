// SPDX-License-Identifier: GPL-3.0-or-later

#include "shapes/DeformedSphere.H"

#include "shapes/PlaneVolume.H"
#include "boundBox.H"
#include "mathematicalConstants.H"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace Foam::stability::shapes
{

namespace
{

using constant::mathematical::pi;
constexpr int nNodes = 5;  // of the polynomial in a cell, per direction
constexpr int nParts = 16; // boxes that a cell is divided into, per direction

using Matrix = std::array<std::array<scalar, nNodes>, nParts>;

scalar node(int i)
{
    return scalar(i) / (nNodes - 1);
}

// Lagrange's polynomials through the nodes, at the centres of the parts.
struct Basis
{
    Matrix value, slope;

    Basis()
    {
        for (int part = 0; part < nParts; ++part)
        {
            for (int i = 0; i < nNodes; ++i)
            {
                const scalar x = (part + 0.5) / nParts;
                value[part][i] = product(i, i, x);
                slope[part][i] = 0;
                for (int left = 0; left < nNodes; ++left)
                {
                    slope[part][i] +=
                        left == i ? 0 : product(i, left, x) / (node(i) - node(left));
                }
            }
        }
    }

private:
    // The product of the factors of polynomial i, one left out.
    static scalar product(int i, int without, scalar x)
    {
        scalar result = 1;
        for (int j = 0; j < nNodes; ++j)
        {
            result *= j == i || j == without ? 1 : (x - node(j)) / (node(i) - node(j));
        }
        return result;
    }
};

// Values on a lattice, x fastest, from those on the nodes.
std::vector<scalar> evaluated(
    const std::vector<scalar>& nodes, const Matrix& x, const Matrix& y, const Matrix& z
)
{
    // Each pass does the first direction and makes it the last.
    const auto pass = [](const std::vector<scalar>& in, const Matrix& matrix)
    {
        const std::size_t rows = in.size() / nNodes;
        std::vector<scalar> out(rows * nParts);
        for (std::size_t row = 0; row < rows; ++row)
        {
            for (int part = 0; part < nParts; ++part)
            {
                scalar sum = 0;
                for (int i = 0; i < nNodes; ++i)
                {
                    sum += matrix[part][i] * in[row * nNodes + i];
                }
                out[part * rows + row] = sum;
            }
        }
        return out;
    };
    return pass(pass(pass(nodes, x), y), z);
}

// Range of the level among some nodes of a lattice; between them it may go beyond by
// half of it.
class Range
{
public:
    void add(scalar level)
    {
        low_ = std::min(low_, level);
        high_ = std::max(high_, level);
    }

    bool cut() const
    {
        const scalar margin = 0.5 * (high_ - low_);
        return low_ - margin < 0 && high_ + margin > 0;
    }

    bool inside() const { return high_ < 0; }

private:
    scalar low_ = GREAT;
    scalar high_ = -GREAT;
};

// A box and the level on a lattice of nodes in it, x fastest.
class Box
{
public:
    Box(const DeformedSphere& sphere, const boundBox& bounds, scalar time)
        : sphere_(sphere), bounds_(bounds), time_(time)
    {
        for (int i = 0; i < nNodes * nNodes * nNodes; ++i)
        {
            nodes_.push_back(level(vector(
                node(i % nNodes), node(i / nNodes % nNodes), node(i / (nNodes * nNodes))
            )));
        }
    }

    // By a polynomial, or by that of its eighths where that is not the level.
    scalar fraction(int depth) const
    {
        static const Basis basis;
        const Matrix& v = basis.value;
        const Matrix& s = basis.slope;
        const std::vector<scalar> levels = evaluated(nodes_, v, v, v);
        const std::vector<scalar> x = evaluated(nodes_, s, v, v);
        const std::vector<scalar> y = evaluated(nodes_, v, s, v);
        const std::vector<scalar> z = evaluated(nodes_, v, v, s);
        const auto slopes = [&](std::size_t i) { return vector(x[i], y[i], z[i]); };
        if (depth > 0 && !good(levels, slopes))
        {
            return ofEighths(depth - 1);
        }
        scalar sum = 0;
        for (std::size_t i = 0; i < levels.size(); ++i)
        {
            sum += boxShareBehind(levels[i], slopes(i) / nParts);
        }
        return sum / levels.size();
    }

private:
    // At a place relative to the box.
    scalar level(const vector& place) const
    {
        return sphere_.level(
            bounds_.min() + cmptMultiply(place, bounds_.span()), time_
        );
    }

    // Does the polynomial place the surface to 0.002 of the box, tried between the
    // nodes? Far from the surface it needs no more than the right sign.
    template<class Slopes>
    bool good(const std::vector<scalar>& levels, const Slopes& slopes) const
    {
        for (int corner = 0; corner < 8; ++corner)
        {
            std::size_t i = 0;
            vector place;
            for (direction d = 3; d-- > 0;)
            {
                const int part = corner >> d & 1 ? nParts - 2 : 1;
                place[d] = (part + 0.5) / nParts;
                i = i * nParts + part;
            }
            const scalar allowed =
                Foam::max(2e-3 * mag(slopes(i)), 0.05 * mag(levels[i]));
            if (mag(levels[i] - level(place)) > allowed)
            {
                return false;
            }
        }
        return true;
    }

    scalar ofEighths(int depth) const
    {
        scalar sum = 0;
        for (int child = 0; child < 8; ++child)
        {
            const vector half = 0.5 * bounds_.span();
            const vector first(child & 1, child >> 1 & 1, child >> 2);
            const point corner = bounds_.min() + cmptMultiply(first, half);
            const Range range = of(child);
            if (range.cut())
            {
                const boundBox bounds(corner, corner + half);
                sum += Box(sphere_, bounds, time_).fraction(depth);
            }
            else
            {
                sum += range.inside();
            }
        }
        return sum / 8;
    }

    // Over the nodes that lie in an eighth.
    Range of(int child) const
    {
        constexpr int middle = nNodes / 2;
        Range range;
        for (int k = 0; k <= middle; ++k)
        {
            for (int j = 0; j <= middle; ++j)
            {
                for (int i = 0; i <= middle; ++i)
                {
                    const int x = i + (child & 1) * middle;
                    const int y = j + (child >> 1 & 1) * middle;
                    const int z = k + (child >> 2) * middle;
                    range.add(nodes_[x + nNodes * (y + nNodes * z)]);
                }
            }
        }
        return range;
    }

    const DeformedSphere& sphere_;
    boundBox bounds_;
    scalar time_;
    std::vector<scalar> nodes_;
};

} // namespace

vector deformation(const point& x, scalar time, scalar period)
{
    vector s, s2; // sin^2(pi x) and sin(2 pi x), of each coordinate
    for (direction d = 0; d < 3; ++d)
    {
        const scalar sine = std::sin(pi * x[d]);
        s[d] = sqr(sine);
        s2[d] = 2 * sine * std::cos(pi * x[d]);
    }
    return std::cos(pi * time / period)
           * vector(
               2 * s.x() * s2.y() * s2.z(), -s2.x() * s.y() * s2.z(),
               -s2.x() * s2.y() * s.z()
           );
}

point DeformedSphere::origin(const point& x, scalar time) const
{
    // Runge-Kutta of fourth order; the flow turns over in about a second.
    const label n = std::max(label(std::ceil(40 * mag(time))), label(1));
    const scalar step = -time / n;
    const auto U = [this](const point& at, scalar t)
    { return deformation(at, t, period_); };
    point p = x;
    for (label i = 0; i < n; ++i)
    {
        const scalar t = time + i * step;
        const vector k1 = U(p, t);
        const vector k2 = U(p + 0.5 * step * k1, t + 0.5 * step);
        const vector k3 = U(p + 0.5 * step * k2, t + 0.5 * step);
        const vector k4 = U(p + step * k3, t + step);
        p += step / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    return p;
}

scalarField DeformedSphere::fractions(
    const UList<point>& points, const UList<labelList>& cellPoints, scalar time
) const
{
    scalarField levels(points.size());
#pragma omp parallel for schedule(dynamic, 1024)
    for (label i = 0; i < points.size(); ++i)
    {
        levels[i] = level(points[i], time);
    }
    scalarField result(cellPoints.size());
#pragma omp parallel for schedule(dynamic, 64)
    for (label celli = 0; celli < cellPoints.size(); ++celli)
    {
        Range range;
        boundBox bounds;
        for (const label pointi : cellPoints[celli])
        {
            range.add(levels[pointi]);
            bounds.add(points[pointi]);
        }
        result[celli] =
            range.cut() ? Box(*this, bounds, time).fraction(2) : range.inside();
    }
    return result;
}

} // namespace Foam::stability::shapes
