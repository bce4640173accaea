// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/flow/VelocityHistory.H"

namespace Foam::stability
{

namespace
{

// The flow of an interval backwards: at the time -t it has the velocity -U(t).
class ReversedInterval : public Velocity
{
public:
    ReversedInterval(
        std::shared_ptr<const PointVelocity> earlier,
        std::shared_ptr<const PointVelocity> later
    )
        : forward_(std::move(earlier), std::move(later))
    {
    }

    scalar startTime() const override { return -forward_.endTime(); }
    scalar endTime() const override { return -forward_.startTime(); }
    bool sharesComplex() const override { return forward_.sharesComplex(); }

    // A pathline's hint is for the end of its interval, which is the earlier snapshot.
    VelocitySample sample(
        const point& x, scalar time, CellHint& hint, CellHint& earlierHint
    ) const override
    {
        VelocitySample result = sharesComplex()
                                    ? forward_.sample(x, -time, hint, earlierHint)
                                    : forward_.sample(x, -time, earlierHint, hint);
        result.U = -result.U;
        return result;
    }

    point exitPoint(
        const point& inside, const point& outside, const CellHint& hint, label& patch
    ) const override
    {
        return forward_.exitPoint(inside, outside, hint, patch);
    }

private:
    VelocityInterval forward_;
};

} // namespace

void VelocityHistory::begin(std::shared_ptr<const PointVelocity> first)
{
    kept_ = {std::move(first)};
    stride_ = 1;
    nSince_ = 1; // the first one stays
}

void VelocityHistory::add(std::shared_ptr<const PointVelocity> next)
{
    if (nSince_ < stride_)
    {
        kept_.back() = std::move(next);
    }
    else
    {
        kept_.push_back(std::move(next));
        nSince_ = 0;
    }
    ++nSince_;
    if (kept_.size() > maxKept)
    {
        // Every second one goes; the latest stays until the next.
        static_assert(maxKept % 2 == 1);
        for (std::size_t i = 1; i < kept_.size() - 1; ++i)
        {
            kept_.erase(kept_.begin() + std::ptrdiff_t(i));
        }
        stride_ *= 2;
    }
}

void VelocityHistory::replaceFirst(std::shared_ptr<const PointVelocity> first)
{
    kept_.front() = std::move(first);
}

std::vector<std::unique_ptr<const Velocity>> VelocityHistory::reversed() const
{
    std::vector<std::unique_ptr<const Velocity>> intervals;
    for (std::size_t i = kept_.size() - 1; i > 0; --i)
    {
        intervals.push_back(
            std::make_unique<const ReversedInterval>(kept_[i - 1], kept_[i])
        );
    }
    return intervals;
}

} // namespace Foam::stability
