// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/flow/PathlineIntegrator.H"

#include "core/flow/DormandPrince.H"

#include <cmath>

namespace Foam::stability
{

namespace
{

using namespace dormandPrince;

constexpr scalar safety = 0.9;
constexpr scalar slowest = 0.2; // change of the step from one to the next
constexpr scalar fastest = 5;
constexpr scalar firstStep = 0.5;     // longest way of the first step, in cells
constexpr scalar longestStep = 2;     // of any step: else it jumps over a vortex
constexpr scalar shortestStep = 1e-6; // duration, in intervals
constexpr label maxForced = 100;      // shortest steps in a row that miss the tolerance
constexpr scalar onBoundary = 1e-3;   // cells that a start may lie beyond an opening

// Stage velocities times a row of the tableau.
vector combine(const Pathline& line, const scalar* row, label n)
{
    vector sum(Zero);
    for (label i = 0; i < n; ++i)
    {
        sum += row[i] * line.k[i];
    }
    return sum;
}

// Carries one pathline through one interval. All that must outlive a stop in the
// middle is in the pathline.
class Integration
{
public:
    Integration(
        Pathline& line, const Velocity& velocity, const IntegrationOptions& options,
        IntegrationCounts& counts
    )
        : line_(line), velocity_(velocity), options_(options), counts_(counts),
          duration_(velocity.endTime() - velocity.startTime())
    {
    }

    // False where another rank must go on.
    bool run()
    {
        if (line_.stage == 0 && line_.time <= velocity_.startTime())
        {
            beginInterval();
        }
        while (line_.state == PathlineState::moving && line_.time < velocity_.endTime())
        {
            if ((line_.stage == 0 && !beginStep()) || !evaluateStages())
            {
                ++counts_.nElsewhere;
                return false;
            }
            if (line_.stage == nStages)
            {
                endStep();
            }
        }
        return true;
    }

private:
    // A new interval. If its snapshots have different meshes, of the step only the
    // length is kept.
    void beginInterval()
    {
        line_.nSteps = 0;
        line_.nForced = 0;
        line_.rejected = false;
        line_.earlierHint = line_.hint;
        if (!velocity_.sharesComplex())
        {
            line_.firstSameAsLast = false;
            line_.hint = CellHint();
        }
    }

    // False if another rank must sample here.
    bool sample(const point& x, scalar time)
    {
        sample_ = velocity_.sample(x, time, line_.hint, line_.earlierHint);
        return sample_.where != VelocitySample::Where::elsewhere;
    }

    bool isNowhere() const { return sample_.where == VelocitySample::Where::nowhere; }

    void finish(PathlineState state, label& count)
    {
        line_.state = state;
        line_.stage = 0;
        ++count;
    }

    bool beginStep()
    {
        if (!line_.firstSameAsLast)
        {
            if (!sample(line_.x, line_.time))
            {
                return false;
            }
            if (isNowhere())
            {
                finish(PathlineState::lost, counts_.nLost);
                return true;
            }
            if (startsOutside())
            {
                return true;
            }
            line_.x = sample_.position;
            line_.k[0] = sample_.U;
            line_.cellSize = sample_.cellSize;
            line_.firstSameAsLast = true;
        }
        chooseStep();
        line_.stage = 1;
        return true;
    }

    // True where the pathline starts beyond an open boundary by more than the round-off
    // of the surface; it then has left.
    bool startsOutside()
    {
        const scalar distance = mag(line_.x - sample_.position);
        if (sample_.where != VelocitySample::Where::outside
            || distance <= onBoundary * sample_.cellSize)
        {
            return false;
        }
        line_.x =
            velocity_.exitPoint(sample_.position, line_.x, line_.hint, line_.patch);
        setExitVelocity(sample_.U);
        finish(PathlineState::left, counts_.nLeft);
        return true;
    }

    void chooseStep()
    {
        const scalar way = mag(line_.k[0]) * duration_;
        const scalar h = line_.cellSize;
        // Written without a division by a speed that may be nought.
        const scalar longest = way > longestStep * h ? longestStep * h / way : 1;
        scalar step = line_.step;
        if (step <= 0)
        {
            step = 0.25 * way > firstStep * h ? firstStep * h / way : 0.25;
            step = way > 0 ? step * duration_ : duration_;
        }
        step = max(min(step, longest * duration_), shortestStep * duration_);
        const scalar remaining = velocity_.endTime() - line_.time;
        // Never a sliver at the end of the interval.
        line_.step = step > (1 - 1e-6) * remaining ? remaining
                     : 2 * step > remaining        ? 0.5 * remaining
                                                   : step;
    }

    bool evaluateStages()
    {
        while (line_.state == PathlineState::moving && line_.stage < nStages)
        {
            const label i = line_.stage;
            const point x = line_.x + line_.step * combine(line_, a[i], i);
            if (!sample(x, line_.time + c[i] * line_.step))
            {
                return false;
            }
            if (isNowhere())
            {
                retryOrLose();
                return true;
            }
            line_.k[i] = sample_.U;
            ++line_.stage;
        }
        return true;
    }

    // Beside a wall the velocity changes so fast that a long step may look far outside
    // the domain for one of its stages.
    void retryOrLose()
    {
        line_.stage = 0;
        if (isShortest(line_.step))
        {
            finish(PathlineState::lost, counts_.nLost);
        }
        else
        {
            reject(slowest * line_.step);
        }
    }

    bool isShortest(scalar step) const
    {
        return step <= (1 + 1e-6) * shortestStep * duration_;
    }

    void endStep()
    {
        line_.stage = 0;
        const scalar step = line_.step;
        const scalar allowed = options_.tolerance * line_.cellSize;
        const scalar error =
            step * mag(combine(line_, e, nStages)) / (std::sqrt(3.0) * allowed);
        const bool shortest = isShortest(step);
        const scalar factor =
            error > 0 ? max(slowest, min(safety * std::pow(error, -0.2), fastest))
                      : fastest;
        if (!(error <= 1) && !shortest)
        {
            reject(factor * step);
            return;
        }
        if (sample_.where == VelocitySample::Where::outside)
        {
            // The exit is found on the chord of the last step, so that must be
            // straight.
            const scalar sagitta = mag(line_.k[nStages - 1] - line_.k[0]) * step / 8;
            if (sagitta > allowed && !shortest)
            {
                reject(0.5 * step);
                return;
            }
            leave();
            return;
        }
        accept(line_.rejected ? min(factor, scalar(1)) : factor);
        line_.nForced = error <= 1 ? 0 : line_.nForced + 1;
        if (line_.nForced > maxForced
            || (line_.nSteps >= options_.maxSteps && line_.time < velocity_.endTime()))
        {
            finish(PathlineState::stuck, counts_.nStuck);
        }
    }

    void reject(scalar step)
    {
        ++counts_.nRejected;
        line_.rejected = true;
        line_.step = max(step, shortestStep * duration_);
    }

    void accept(scalar factor)
    {
        const scalar remaining = velocity_.endTime() - line_.time;
        line_.time =
            line_.step >= remaining ? velocity_.endTime() : line_.time + line_.step;
        line_.x = sample_.position;
        line_.k[0] = line_.k[nStages - 1];
        line_.cellSize = sample_.cellSize;
        line_.step *= factor;
        line_.rejected = false;
        countStep();
    }

    void countStep()
    {
        ++line_.nSteps;
        ++counts_.nSteps;
    }

    // Takes the part of U [m/s] that leads out.
    void setExitVelocity(const vector& U)
    {
        line_.exitVelocity = max(U & sample_.outward, scalar(0)) * sample_.outward;
    }

    void leave()
    {
        const vector way = line_.step * combine(line_, a[nStages - 1], nStages - 1);
        const point exit =
            velocity_.exitPoint(line_.x, line_.x + way, line_.hint, line_.patch);
        const scalar length = mag(way);
        const scalar fraction =
            length > 0 ? min(mag(exit - line_.x) / length, scalar(1)) : 0;
        line_.time = min(line_.time + fraction * line_.step, velocity_.endTime());
        line_.x = exit;
        line_.firstSameAsLast = false;
        setExitVelocity(way / line_.step);
        countStep();
        finish(PathlineState::left, counts_.nLeft);
    }

    Pathline& line_;
    const Velocity& velocity_;
    const IntegrationOptions& options_;
    IntegrationCounts& counts_;
    scalar duration_;
    VelocitySample sample_;
};

} // namespace

bool advance(
    Pathline& line, const Velocity& velocity, const IntegrationOptions& options,
    IntegrationCounts& counts
)
{
    return Integration(line, velocity, options, counts).run();
}

IntegrationCounts advance(
    const UList<Pathline*>& lines, const Velocity& velocity,
    const IntegrationOptions& options
)
{
    List<IntegrationCounts> counts(lines.size());
    const label nThreads = max(label(1), options.nThreads);

#pragma omp parallel for schedule(dynamic, 64) num_threads(nThreads)
    for (label i = 0; i < lines.size(); ++i)
    {
        advance(*lines[i], velocity, options, counts[i]);
    }

    IntegrationCounts total;
    forAll(lines, i)
    {
        if (lines[i]->isPrimary)
        {
            total += counts[i];
        }
    }
    return total;
}

} // namespace Foam::stability
