// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/parametrization/abf/EliminationOrder.H"

#include <Eigen/OrderingMethods>

#include <numeric>

namespace Foam::stability
{

labelList eliminationOrder(const PlainSurface& surface)
{
    using Permutation = Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int>;
    labelList points(surface.points.size());
    std::iota(points.begin(), points.end(), 0);
    const Eigen::SparseMatrix<double> half = emptyMatrix<double, 1>(surface, points);
    const Eigen::SparseMatrix<double> pattern = half.selfadjointView<Eigen::Lower>();
    Permutation order; // order.indices()[i]: the point that comes as the i-th
    Eigen::AMDOrdering<int>()(pattern, order);
    labelList places(points.size());
    forAll(places, i)
    {
        places[order.indices()[i]] = i;
    }
    return places;
}

labelList unknownsOf(const labelList& places, const List<bool>& leftOut)
{
    labelList unknowns(places.size(), -1);
    labelList inOrder(places.size());
    forAll(places, pointi)
    {
        inOrder[places[pointi]] = pointi;
    }
    label n = 0;
    for (const label pointi : inOrder)
    {
        if (!leftOut[pointi])
        {
            unknowns[pointi] = n++;
        }
    }
    return unknowns;
}

} // namespace Foam::stability
