// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/parametrization/ChartPacking.H"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace Foam::stability
{

namespace
{

struct Box
{
    vector2D low{VGREAT, VGREAT};
    vector2D high{-VGREAT, -VGREAT};

    vector2D size() const { return high - low; }
};

Box boxOf(const List<vector2D>& chart)
{
    Box box;
    for (const vector2D& p : chart)
    {
        box.low = min(box.low, p);
        box.high = max(box.high, p);
    }
    return box;
}

// The upper rim of what is filled, from left to right: `height` holds from x to the
// x of the next step. Rectangles go where their upper side ends lowest.
class Skyline
{
public:
    explicit Skyline(scalar gutter)
        : steps_{{gutter, gutter}, {1 - Swatches::size, Swatches::size + gutter}}
    {
    }

    // Finds the lower left corner of a rectangle (its gutters to the right and above
    // included) and fills it; false where none is left.
    bool place(const vector2D& size, vector2D& corner)
    {
        scalar lowest = VGREAT;
        std::size_t best = 0;
        for (std::size_t i = 0; i < steps_.size(); ++i)
        {
            const scalar right = steps_[i].x + size.x();
            if (right > 1)
            {
                break;
            }
            const scalar bottom = heightOver(i, right);
            if (bottom + size.y() <= 1 && bottom < lowest)
            {
                lowest = bottom;
                best = i;
            }
        }
        if (lowest > 1)
        {
            return false;
        }
        corner = vector2D(steps_[best].x, lowest);
        fill(best, corner.x() + size.x(), lowest + size.y());
        return true;
    }

private:
    struct Step
    {
        scalar x;
        scalar height;
    };

    scalar heightOver(std::size_t i, scalar right) const
    {
        scalar height = 0;
        for (; i < steps_.size() && steps_[i].x < right; ++i)
        {
            height = std::max(height, steps_[i].height);
        }
        return height;
    }

    void fill(std::size_t first, scalar right, scalar top)
    {
        std::size_t last = first;
        while (last + 1 < steps_.size() && steps_[last + 1].x <= right)
        {
            ++last;
        }
        const Step rest{right, steps_[last].height};
        steps_[first].height = top;
        steps_.erase(steps_.begin() + first + 1, steps_.begin() + last + 1);
        steps_.insert(steps_.begin() + first + 1, rest);
    }

    std::vector<Step> steps_;
};

// Lower left corners at a scale, the tallest first; false where they do not fit.
bool place(
    const List<vector2D>& sizes, const labelList& order, scalar scale, scalar gutter,
    List<vector2D>& corners
)
{
    Skyline skyline(gutter);
    for (const label i : order)
    {
        const vector2D size = scale * sizes[i] + vector2D(gutter, gutter);
        if (!skyline.place(size, corners[i]))
        {
            return false;
        }
    }
    return true;
}

labelList tallestFirst(const List<vector2D>& sizes)
{
    labelList order(sizes.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(
        order.begin(), order.end(),
        [&](label i, label j) { return sizes[i].y() > sizes[j].y(); }
    );
    return order;
}

} // namespace

List<vector2D> upright(const List<vector2D>& chart)
{
    const vector2D size = boxOf(chart).size();
    if (size.x() <= size.y())
    {
        return chart;
    }
    List<vector2D> turned(chart.size());
    forAll(chart, i)
    {
        turned[i] = vector2D(-chart[i].y(), chart[i].x());
    }
    return turned;
}

vector2D boxSize(const List<vector2D>& chart)
{
    return chart.empty() ? vector2D(0, 0) : boxOf(chart).size();
}

BoxPacking packBoxes(const List<vector2D>& sizes, scalar gutter)
{
    BoxPacking result;
    scalar area = 0;
    scalar longest = 0;
    for (const vector2D& size : sizes)
    {
        area += size.x() * size.y();
        longest = std::max(longest, size.y());
    }
    result.corners.setSize(sizes.size(), vector2D(0, 0));
    result.placed = longest > 0;
    if (!result.placed)
    {
        return result;
    }
    gutter = std::min(gutter, 0.25 / std::sqrt(scalar(sizes.size())));

    const labelList order = tallestFirst(sizes);
    List<vector2D> trial(sizes.size());
    scalar fits = 0;
    scalar tooLarge = 1 / longest;
    if (area > 0)
    {
        tooLarge = std::min(tooLarge, 1 / std::sqrt(area));
    }
    for (label i = 0; i < 40; ++i)
    {
        const scalar scale = 0.5 * (fits + tooLarge);
        if (place(sizes, order, scale, gutter, trial))
        {
            fits = scale;
            result.corners.swap(trial);
        }
        else
        {
            tooLarge = scale;
        }
    }
    result.scale = fits;
    return result;
}

List<vector2D>
moved(const List<vector2D>& chart, const vector2D& corner, const vector2D& scales)
{
    const vector2D low = boxOf(chart).low;
    List<vector2D> result(chart.size());
    forAll(chart, i)
    {
        result[i] = corner + cmptMultiply(scales, chart[i] - low);
    }
    return result;
}

} // namespace Foam::stability
