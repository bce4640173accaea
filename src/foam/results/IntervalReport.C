// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/results/IntervalReport.H"

#include "foam/results/TwoDigits.H"
#include "messageStream.H"

#include <iomanip>
#include <sstream>

namespace Foam::stability
{

namespace
{

// Beyond so many cells (rms) between classified times p is resampled from afar.
constexpr scalar largestDisplacement = 2.5;

} // namespace

void IntervalReport::classified(const Statistics& s, const word& timeName)
{
    if (s.interval > 0 && s.displacement > 0)
    {
        const scalar changed = s.detachedArea() + s.attachedArea;
        const bool isLong = s.displacement > largestDisplacement;
        ++nIntervals_;
        changed_ += changed;
        if (isLong)
        {
            warnOfLong(s, timeName);
            ++nLong_;
            changedLong_ += changed;
        }
        longest_ = max(longest_, s.displacement);
        wanted_ = min(wanted_, s.interval / s.displacement);
    }
    warnOfShort(s, timeName);
}

void IntervalReport::warnOfLong(const Statistics& s, const word& timeName)
{
    if (nLong_ == 0)
    {
        Warning << "interfaceStability: at time " << timeName
                << " s the interface had moved " << s.displacement
                << " cells (rms) since the last classified time. Above "
                << largestDisplacement
                << " the results lose accuracy: write more times. Told once; see the "
                   "column displacement of stability.dat."
                << endl;
    }
}

// An interface that stands still is within epsilon of one that moved less than that. A
// flow that hardly moves it is no fault of the interval, so the way must add up.
void IntervalReport::warnOfShort(const Statistics& s, const word& timeName)
{
    unseen_ = s.displacement < s.epsilonCells ? unseen_ + s.displacement : 0;
    if (warnedShort_ || !(unseen_ > s.epsilonCells))
    {
        return;
    }
    warnedShort_ = true;
    const scalar better =
        max(min(2 * s.epsilonCells, largestDisplacement), 1.2 * s.epsilonCells);
    Warning << "interfaceStability: at time " << timeName
            << " s the interval lies below epsilon: the interface had moved "
            << s.displacement << " cells (rms) since the last classified time, and "
            << "epsilon is " << s.epsilonCells << " cells, so that even an interface "
            << "that stands still in the flow counts as stable. Better is an interval "
            << "of " << roundedUp(s.interval * better / s.displacement)
            << " s, or a smaller epsilon. Told once; see the columns displacement and "
            << "epsilonPerInterval of stability.dat." << endl;
}

void IntervalReport::complete() const
{
    if (nLong_ == 0)
    {
        return;
    }
    std::ostringstream text;
    text << std::setprecision(3) << "interfaceStability: in " << nLong_ << " of "
         << nIntervals_ << " intervals the interface moved by more than "
         << largestDisplacement << " cells (rms; up to " << longest_ << ")";
    if (changed_ > 0)
    {
        text << "; " << 100 * changedLong_ / changed_
             << " % of all that detached and attached did so in these, and how much "
                "that is depends on the length of the interval";
    }
    text << ". Better: the function object in the solver, with classifyDisplacement 1; "
            "or times every "
         << roundedDown(wanted_) << " s, a cell where the interface was fastest.";
    Info << text.str().c_str() << nl << endl;
}

} // namespace Foam::stability
