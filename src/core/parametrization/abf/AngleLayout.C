// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/parametrization/abf/AngleLayout.H"

#include "core/base/Errors.H"
#include "core/parametrization/abf/EliminationOrder.H"

#include <Eigen/SparseCholesky>

#include <cmath>
#include <complex>

namespace Foam::stability
{

namespace
{

using Complex = std::complex<double>;

// The edges opposite to the corners of a triangle with these angles, over the root of
// twice its area: z is a similar triangle where sum sides[c] z[c] = 0.
std::array<Complex, 3> sidesOf(const CornerAngles& a)
{
    const scalar sines[3] = {std::sin(a[0]), std::sin(a[1]), std::sin(a[2])};
    const Complex x1(sines[2], 0);
    const Complex x2(sines[1] * std::cos(a[0]), sines[1] * sines[0]);
    const scalar unit = std::sqrt(sines[0] * sines[1] * sines[2]);
    return {(x2 - x1) / unit, -x2 / unit, x1 / unit};
}

} // namespace

List<vector2D> layOut(
    const PlainSurface& surface, const List<CornerAngles>& angles,
    const labelList& places, const labelPair& pins
)
{
    using Matrix = Eigen::SparseMatrix<Complex>;
    List<bool> pinned(places.size(), false);
    pinned[pins.first()] = pinned[pins.second()] = true;
    const labelList unknowns(unknownsOf(places, pinned));
    Matrix matrix(emptyMatrix<Complex, 1>(surface, unknowns));
    Eigen::VectorXcd right(Eigen::VectorXcd::Zero(matrix.rows()));
    forAll(angles, t)
    {
        const triFace& f = surface.triangles[t];
        const std::array<Complex, 3> sides(sidesOf(angles[t]));
        for (label i = 0; i < 3; ++i)
        {
            const label row = unknowns[f[i]];
            for (label j = 0; j < 3 && row >= 0; ++j)
            {
                const Complex value = std::conj(sides[i]) * sides[j];
                const label column = unknowns[f[j]];
                if (f[j] == pins.second()) // at 1; the other one is at 0
                {
                    right[row] -= value;
                }
                else if (column >= 0 && column <= row)
                {
                    matrix.coeffRef(row, column) += value;
                }
            }
        }
    }
    Eigen::SimplicialLDLT<Matrix, Eigen::Lower, Eigen::NaturalOrdering<int>> factor(
        matrix
    );
    if (factor.info() != Eigen::Success)
    {
        throw NumericalFailure("its angles cannot be laid out in the plane");
    }
    const Eigen::VectorXcd z = factor.solve(right);
    List<vector2D> parameters(places.size(), vector2D(0, 0));
    parameters[pins.second()] = vector2D(1, 0);
    forAll(parameters, pointi)
    {
        if (unknowns[pointi] >= 0)
        {
            parameters[pointi] =
                vector2D(z[unknowns[pointi]].real(), z[unknowns[pointi]].imag());
        }
    }
    return parameters;
}

} // namespace Foam::stability
