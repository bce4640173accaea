// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

#include "core/reconstruction/VolumeFractions.H"
#include "core/Errors.H"

#include <cmath>
#include <string>

namespace Foam::stability
{

namespace
{

scalarField clamped(const scalarField& alpha)
{
    scalarField result(alpha.size());
    forAll(alpha, i)
    {
        result[i] = VolumeFractions::rounded(min(max(alpha[i], scalar(0)), scalar(1)));
    }
    return result;
}

} // namespace

VolumeFractions::VolumeFractions(const FlowSnapshot& snapshot)
{
    const label n = snapshot.alphas.size();
    if (n < 1 || n > 2 || snapshot.boundaryAlphas.size() != n)
    {
        throw BadInput(
            "The reconstruction of interfaces supports two materials, found "
            + std::to_string(n) + " volume fractions."
        );
    }
    cells = clamped(snapshot.alphas[0]);
    boundaryFaces = clamped(snapshot.boundaryAlphas[0]);

    const scalarField& V = snapshot.complex->cellVolumes();
    forAll(cells, celli)
    {
        volume += cells[celli] * V[celli];
    }
}

scalar VolumeFractions::rounded(scalar alpha)
{
    return std::round(alpha * 1e12) / 1e12; // 1/2 stays exact
}

bool beforeByPosition(const point& a, const point& b)
{
    for (direction d = 0; d < 3; ++d)
    {
        if (a[d] != b[d])
        {
            return a[d] < b[d];
        }
    }
    return false;
}

} // namespace Foam::stability
