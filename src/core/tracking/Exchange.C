// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

#include "core/tracking/Exchange.H"

#include "core/Errors.H"

namespace Foam::stability
{

ReconstructionResult
SerialExchange::gather(const ReconstructionResult& local, const CellComplex&) const
{
    ReconstructionResult whole(local);
    whole.mesh.triangleCells.clear();
    return whole;
}

void SerialExchange::agree(const std::string& failure) const
{
    if (!failure.empty())
    {
        throw NumericalFailure(failure);
    }
}

} // namespace Foam::stability
