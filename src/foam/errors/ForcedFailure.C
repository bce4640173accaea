// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/errors/ForcedFailure.H"

#include "core/base/Errors.H"
#include "OSspecific.H"
#include "Pstream.H"

#include <algorithm>
#include <sstream>

namespace Foam::stability
{

namespace
{

const char* const variable = "INTERFACE_STABILITY_FAIL";

[[noreturn]] void refuse(const std::string& found)
{
    std::string phases;
    for (const std::string& name : phaseNames())
    {
        phases += (phases.empty() ? "" : ", ") + name;
    }
    throw BadInput(
        std::string("The environment variable ") + variable + " is '" + found
        + "'; allowed is '<phase> <time>' or '<phase> <time> <rank>' with a phase of "
        + phases + "."
    );
}

} // namespace

ForcedFailure::ForcedFailure()
{
    const std::string text = getEnv(variable);
    if (text.empty())
    {
        return;
    }
    std::istringstream words(text);
    std::string phase, rest;
    scalar time = 0;
    label rank = -1;
    words >> phase >> time;
    const auto found = std::find(phaseNames().begin(), phaseNames().end(), phase);
    if (!words || found == phaseNames().end())
    {
        refuse(text);
    }
    const bool anyRank = (words >> std::ws).eof();
    if (!anyRank && (!(words >> rank) || rank < 0 || words >> rest))
    {
        refuse(text);
    }
    if (anyRank || rank == Pstream::myProcNo())
    {
        asked_ = Asked{Phase(found - phaseNames().begin()), time};
    }
}

void ForcedFailure::check(Phase phase, scalar time) const
{
    // The round-off of a solver's clock does not decide.
    if (asked_ && phase == asked_->phase
        && mag(time - asked_->time) <= 1e-9 * max(scalar(1), mag(time)))
    {
        throw NumericalFailure(
            std::string("A failure was asked for by ") + variable + "."
        );
    }
}

} // namespace Foam::stability
