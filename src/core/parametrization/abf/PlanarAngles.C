// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/parametrization/abf/PlanarAngles.H"

#include "core/base/Errors.H"
#include "core/parametrization/abf/EliminationOrder.H"
#include "core/parametrization/abf/NearbyFactor.H"

#include <cmath>

namespace Foam::stability
{

namespace
{

using Vector = Eigen::VectorXd;
using PointRows = Eigen::Matrix<double, 6, 3>; // two equations of each corner's point

constexpr scalar degree = M_PI / 180;
constexpr scalar solvedTo = 1e-9;  // [rad] of the equations
constexpr scalar settledTo = 1e-5; // [rad] of the angles, whose error is its square

// Angles never come nearer to 0 and pi than by this share of their distance.
constexpr scalar leastShare = 0.1;

// The second derivatives stay above this share of those of F.
constexpr scalar leastCurvature = 0.2;

scalar angleAt(const point& a, const point& b, const point& c)
{
    const vector ab = b - a, ac = c - a;
    return std::atan2(mag(ab ^ ac), ab & ac);
}

class Newton
{
public:
    Newton(
        const PlainSurface& surface, const List<bool>& onBoundary,
        const labelList& places
    )
        : surface_(surface), unknowns_(unknownsOf(places, onBoundary)),
          wanted_(rescaledAngles(surface, onBoundary)), angles_(wanted_),
          matrix_(emptyMatrix<double, 2>(surface, unknowns_)),
          multipliers_(Vector::Zero(matrix_.rows()))
    {
    }

    PlanarAngles run(label maxIterations)
    {
        PlanarAngles result;
        result.residual = residual();
        result.converged = result.residual < 1e-3 * solvedTo;
        while (!result.converged && result.iterations < maxIterations)
        {
            const scalar change = step();
            ++result.iterations;
            result.residual = residual();
            result.converged = result.residual < solvedTo && change < settledTo;
        }
        result.angles = angles_;
        return result;
    }

private:
    // One triangle's part of the linearised equations: the quadratic form is
    // restricted to changes that keep its sum of angles.
    struct Part
    {
        Eigen::Vector3d inverse; // of the second derivatives
        Eigen::Vector3d own;     // change without the equations of points
        Eigen::Matrix3d reduced; // inverse on changes of sum 0
        PointRows rows;
    };

    scalar weight(label t, label c) const { return 1 / sqr(wanted_[t][c]); }

    label unknown(label t, label c) const
    {
        return unknowns_[surface_.triangles[t][c % 3]];
    }

    // The multiplier of the equation of lengths of a corner's point.
    scalar ofLengths(label t, label c) const
    {
        const label i = unknown(t, c);
        return i < 0 ? 0 : multipliers_[2 * i + 1];
    }

    Part partOf(label t) const
    {
        Part part;
        part.rows.setZero();
        Eigen::Vector3d gradient;
        scalar excess = -M_PI;
        for (label c = 0; c < 3; ++c)
        {
            const scalar a = angles_[t][c], sine = std::sin(a);
            const scalar ofF = 2 * weight(t, c);
            const scalar bend =
                (ofLengths(t, c + 1) - ofLengths(t, c + 2)) / (sine * sine);
            part.inverse[c] = 1 / max(ofF + bend, leastCurvature * ofF);
            gradient[c] = ofF * (a - wanted_[t][c]);
            excess += a;
            part.rows(c + c, c) = 1;
            const scalar cotangent = std::cos(a) / sine;
            part.rows(2 * ((c + 2) % 3) + 1, c) = cotangent;
            part.rows(2 * ((c + 1) % 3) + 1, c) = -cotangent;
        }
        const scalar sum = part.inverse.sum();
        part.reduced = -part.inverse * part.inverse.transpose() / sum;
        part.reduced.diagonal() += part.inverse;
        part.own = -part.reduced * gradient - part.inverse * (excess / sum);
        return part;
    }

    // The values of the equations of the points.
    Vector equations() const
    {
        Vector values(Vector::Zero(matrix_.rows()));
        for (Eigen::Index i = 0; i < values.size(); i += 2)
        {
            values[i] = -2 * M_PI;
        }
        forAll(angles_, t)
        {
            for (label c = 0; c < 3; ++c)
            {
                const scalar logSine = std::log(std::sin(angles_[t][c]));
                add(values, unknown(t, c), 0, angles_[t][c]);
                add(values, unknown(t, c + 2), 1, logSine);
                add(values, unknown(t, c + 1), 1, -logSine);
            }
        }
        return values;
    }

    static void add(Vector& values, label unknown, label row, scalar value)
    {
        if (unknown >= 0)
        {
            values[2 * Eigen::Index(unknown) + row] += value;
        }
    }

    scalar residual() const
    {
        const Vector values(equations());
        scalar largest = values.size() > 0 ? values.cwiseAbs().maxCoeff() : 0;
        for (const CornerAngles& a : angles_)
        {
            largest = max(largest, mag(a[0] + a[1] + a[2] - M_PI));
        }
        return largest;
    }

    void assemble(const List<Part>& parts, Vector& right)
    {
        std::fill(matrix_.valuePtr(), matrix_.valuePtr() + matrix_.nonZeros(), 0);
        right = equations();
        forAll(parts, t)
        {
            const Part& part = parts[t];
            const Eigen::Matrix<double, 6, 6> block =
                part.rows * part.reduced * part.rows.transpose();
            const Eigen::Matrix<double, 6, 1> change = part.rows * part.own;
            for (label i = 0; i < 6; ++i)
            {
                if (unknown(t, i / 2) < 0)
                {
                    continue;
                }
                const label row = 2 * unknown(t, i / 2) + i % 2;
                right[row] += change[i];
                for (label j = 0; j < 6; ++j)
                {
                    const label column = 2 * unknown(t, j / 2) + j % 2;
                    if (column >= 0 && column <= row)
                    {
                        matrix_.coeffRef(row, column) += block(i, j);
                    }
                }
            }
        }
    }

    // Returns the largest change of an angle.
    scalar step()
    {
        List<Part> parts(angles_.size());
        forAll(parts, t)
        {
            parts[t] = partOf(t);
        }
        Vector right;
        assemble(parts, right);
        right -= matrix_.selfadjointView<Eigen::Lower>() * multipliers_;
        multipliers_ += factor_.solve(matrix_, right);

        List<CornerAngles> changes(angles_.size());
        scalar share = 1;
        forAll(changes, t)
        {
            Eigen::Matrix<double, 6, 1> ofPoints;
            for (label i = 0; i < 6; ++i)
            {
                const label u = unknown(t, i / 2);
                ofPoints[i] = u < 0 ? 0 : multipliers_[2 * u + i % 2];
            }
            const Eigen::Vector3d change =
                parts[t].own
                - parts[t].reduced * (parts[t].rows.transpose() * ofPoints);
            for (label c = 0; c < 3; ++c)
            {
                changes[t][c] = change[c];
                const scalar room =
                    change[c] < 0 ? angles_[t][c] : M_PI - angles_[t][c];
                const scalar most = (1 - leastShare) * room;
                share =
                    mag(change[c]) > most ? min(share, most / mag(change[c])) : share;
            }
        }
        scalar largest = 0;
        forAll(changes, t)
        {
            for (label c = 0; c < 3; ++c)
            {
                angles_[t][c] += share * changes[t][c];
                largest = max(largest, share * mag(changes[t][c]));
            }
        }
        return largest;
    }

    const PlainSurface& surface_;
    labelList unknowns_; // the number of each inner point, -1 on the boundary
    List<CornerAngles> wanted_;
    List<CornerAngles> angles_;
    Eigen::SparseMatrix<double> matrix_; // of the points' multipliers
    Vector multipliers_;                 // per inner point: of its sum, of its lengths
    NearbyFactor factor_;
};

} // namespace

List<CornerAngles>
rescaledAngles(const PlainSurface& surface, const List<bool>& onBoundary)
{
    List<CornerAngles> angles(surface.triangles.size());
    scalarField sums(surface.points.size(), 0);
    forAll(angles, t)
    {
        const triFace& f = surface.triangles[t];
        for (label c = 0; c < 3; ++c)
        {
            angles[t][c] = angleAt(
                surface.points[f[c]], surface.points[f[(c + 1) % 3]],
                surface.points[f[(c + 2) % 3]]
            );
            sums[f[c]] += angles[t][c];
        }
    }
    forAll(angles, t)
    {
        for (label c = 0; c < 3; ++c)
        {
            const label pointi = surface.triangles[t][c];
            if (!onBoundary[pointi] && sums[pointi] > 0)
            {
                angles[t][c] *= 2 * M_PI / sums[pointi];
            }
            angles[t][c] = max(3 * degree, min(175 * degree, angles[t][c]));
        }
    }
    return angles;
}

PlanarAngles solveAngles(
    const PlainSurface& surface, const List<bool>& onBoundary, const labelList& places,
    label maxIterations
)
{
    return Newton(surface, onBoundary, places).run(maxIterations);
}

} // namespace Foam::stability
