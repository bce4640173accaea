// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/functionObject/ClassifySchedule.H"

#include <cmath>

namespace Foam::stability
{

namespace
{

dictionary timeEntries(const ClassifyOptions& options)
{
    const bool asWritten = options.control == ClassifyControl::asWritten;
    const ClassifyControl control = asWritten ? ClassifyControl::none : options.control;
    const bool counted =
        control == ClassifyControl::timeStep || control == ClassifyControl::writeTime;
    dictionary entries;
    entries.add("classifyControl", classifyControlNames()[control]);
    if (counted)
    {
        entries.add("classifyInterval", label(options.interval));
    }
    else
    {
        entries.add("classifyInterval", options.interval);
    }
    return entries;
}

} // namespace

ClassifySchedule::ClassifySchedule(const Time& time, const ClassifyOptions& options)
    : control_(options.control), times_(time, timeEntries(options), "classify")
{
}

void ClassifySchedule::adjustTimeStep(Time& time) const
{
    if (control_ != ClassifyControl::adjustableRunTime)
    {
        return;
    }
    const scalar deltaT = time.deltaTValue(); // [s]
    const scalar next = (times_.executionIndex() + 1) * times_.interval();
    scalar left = next - (time.value() - time.startTime().value());
    if (left <= 0)
    {
        left = times_.interval();
    }
    const scalar nSteps = max(scalar(1), std::round(left / deltaT));
    const scalar wanted = left / nSteps;
    time.setDeltaT(min(max(wanted, 0.2 * deltaT), 2 * deltaT), false);
}

} // namespace Foam::stability
