// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/parametrization/abf/NearbyFactor.H"

#include "core/base/Errors.H"

namespace Foam::stability
{

namespace
{

// A factorization costs as much as some thirty solutions with it.
constexpr int mostIterations = 20;
constexpr double tolerance = 1e-7; // of the residual, relative

} // namespace

NearbyFactor::Vector NearbyFactor::solve(const Matrix& matrix, const Vector& right)
{
    if (right.size() == 0)
    {
        return right;
    }
    if (factorized_)
    {
        Eigen::ConjugateGradient<Matrix, Eigen::Lower, Preconditioner> gradients;
        gradients.preconditioner().factor = &factor_;
        gradients.setTolerance(tolerance).setMaxIterations(mostIterations);
        gradients.compute(matrix);
        Vector x = gradients.solve(right);
        if (gradients.info() == Eigen::Success)
        {
            return x;
        }
    }
    else
    {
        factor_.analyzePattern(matrix);
    }
    factor_.factorize(matrix);
    factorized_ = factor_.info() == Eigen::Success;
    if (!factorized_)
    {
        throw NumericalFailure("the equations of its angles cannot be solved");
    }
    return factor_.solve(right);
}

} // namespace Foam::stability
