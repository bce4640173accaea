// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/cells/PeriodicImages.H"

#include "core/base/Errors.H"

#include "ListOps.H"
#include "DynamicList.H"
#include "pointFieldFwd.H"

#include <algorithm>
#include <cstdint>

namespace Foam::stability
{

namespace
{

constexpr scalar sameMotion = 1e-3; // of the shortest way that a generator moves
constexpr scalar roundOff = 1e-7;   // of the size of the mesh: points that are one
constexpr std::size_t mostMotions = 20000;
constexpr std::size_t mostSectors = 300;
constexpr std::size_t nextTo = 3; // factors of the motions between neighbours

// The axis of a rotation: its direction, of length 1, and a point on it.
struct Axis
{
    vector direction;
    point place;
};

// A point x on the axis stays in its plane: x - R x is the shift across the axis.
Axis axisOf(const RigidMotion& motion)
{
    const tensor& R = motion.rotation;
    vector a(R.zy() - R.yz(), R.xz() - R.zx(), R.yx() - R.xy());
    if (mag(a) < 1e-6) // half a turn: R + I is twice the projection onto the axis
    {
        for (const vector& column :
             {R.cx() + vector(1, 0, 0), R.cy() + vector(0, 1, 0),
              R.cz() + vector(0, 0, 1)})
        {
            a = mag(column) > mag(a) ? column : a;
        }
    }
    a /= mag(a);
    const vector across = motion.shift - (motion.shift & a) * a;
    return {a, inv(tensor::I - R + a * a) & across};
}

} // namespace

PeriodicImages::PeriodicImages(
    const std::vector<RigidMotion>& generators, const boundBox& bounds, label nCells,
    label nPoints
)
    : corners_(bounds.points()), nCells_(nCells), nPoints_(nPoints),
      tolerance_(sameMotion * bounds.mag()), roundOff_(roundOff * bounds.mag()),
      motions_(1), ends_(1, 1)
{
    for (const RigidMotion& generator : generators)
    {
        scalar way = 0;
        for (const Foam::point& x : corners_)
        {
            way = max(way, mag(generator(x) - x));
        }
        if (way <= roundOff_)
        {
            continue; // both halves are at one place
        }
        tolerance_ = min(tolerance_, sameMotion * way);
        turns_ = turns_ || mag(generator.rotation - tensor::I) > 1e-6;
        generators_.push_back(generator);
        generators_.push_back(generator.inverse());
    }
    // All sectors around an axis meet there.
    for (std::size_t n = 0; turns_ && n < motions_.size() && n < mostSectors;)
    {
        n = motions_.size();
        findMore();
    }
}

bool PeriodicImages::same(const RigidMotion& a, const RigidMotion& b) const
{
    for (const Foam::point& x : corners_)
    {
        if (magSqr(a(x) - b(x)) > sqr(tolerance_))
        {
            return false;
        }
    }
    return true;
}

// -1 if it is not among the motions from this one on.
label PeriodicImages::known(const RigidMotion& motion, label first) const
{
    for (std::size_t i = first; i < motions_.size(); ++i)
    {
        if (same(motions_[i], motion))
        {
            return label(i);
        }
    }
    return -1;
}

// Appends the motions of one factor more.
void PeriodicImages::findMore() const
{
    const std::size_t first = ends_.size() > 1 ? ends_[ends_.size() - 2] : 0;
    const std::size_t end = ends_.back();
    for (std::size_t i = first; i < end; ++i)
    {
        for (const RigidMotion& generator : generators_)
        {
            const RigidMotion next(motions_[i] * generator);
            if (known(next, 0) < 0)
            {
                motions_.push_back(next);
            }
        }
        if (motions_.size() > mostMotions)
        {
            throw BadInput("The cyclic patches lead to too many images of the mesh: do "
                           "the transformations of different pairs fit each other?");
        }
    }
    ends_.push_back(motions_.size());
}

label PeriodicImages::indexOf(const RigidMotion& motion) const
{
    label first = 0;
    while (true)
    {
        const label image = known(motion, first);
        if (image >= 0)
        {
            return image;
        }
        first = label(motions_.size());
        findMore();
        if (label(motions_.size()) == first)
        {
            throw BadInput("The transformations of the cyclic patches do not fit each "
                           "other.");
        }
    }
}

label PeriodicImages::product(label a, label b) const
{
    if (a == 0 || b == 0)
    {
        return a + b;
    }
    const auto found = products_.find({a, b});
    if (found != products_.end())
    {
        return found->second;
    }
    const label image = indexOf(motions_[a] * motions_[b]);
    products_[{a, b}] = image;
    return image;
}

label PeriodicImages::nNearby() const
{
    while (ends_.size() <= nextTo)
    {
        findMore();
    }
    return label(ends_[nextTo]);
}

label PeriodicImages::inverse(label image) const
{
    return image == 0 ? 0 : indexOf(motions_[image].inverse());
}

label PeriodicImages::representative(const UList<label>& images) const
{
    label chosen = images[0];
    labelList least;
    for (const label image : images)
    {
        labelList others(images.size()); // as seen from this one
        forAll(images, i)
        {
            others[i] = product(inverse(image), images[i]);
        }
        Foam::sort(others);
        if (least.empty()
            || std::lexicographical_compare(
                others.begin(), others.end(), least.begin(), least.end()
            ))
        {
            chosen = image;
            least = others;
        }
    }
    return chosen;
}

// F must not see shifts: A vanishes along them, and along what rotations make of them.
std::optional<PeriodicImages::LinearField> PeriodicImages::invariantField() const
{
    constexpr scalar same = 1e-6;
    const scalar length = 0.5 * mag(corners_.last() - corners_.first());
    std::optional<Axis> axis;
    DynamicList<vector> shifts; // as shares of `length`
    for (const RigidMotion& motion : generators_)
    {
        vector shift = motion.shift / length;
        if (mag(motion.rotation - tensor::I) > same)
        {
            const Axis other(axisOf(motion));
            axis = axis ? axis : other;
            if (mag(other.direction ^ axis->direction) > same
                || mag((other.place - axis->place) ^ axis->direction) > same * length)
            {
                return std::nullopt;
            }
            shift = (shift & other.direction) * other.direction;
        }
        shifts.append(shift);
    }
    DynamicList<vector> blind; // orthonormal
    const auto add = [&](vector v)
    {
        for (const vector& b : blind)
        {
            v -= (v & b) * b;
        }
        if (mag(v) > same)
        {
            blind.append(v / mag(v));
        }
    };
    for (const vector& shift : shifts)
    {
        add(shift);
        for (const RigidMotion& motion : generators_)
        {
            add(motion.turned(shift));
        }
    }
    if (blind.size() == 3)
    {
        return std::nullopt;
    }
    LinearField field;
    field.A = tensor::I;
    for (const vector& b : blind)
    {
        field.A -= b * b;
    }
    field.A /= tr(field.A);
    field.centre = axis ? axis->place : sum(corners_) / corners_.size();
    return field;
}

label PeriodicImages::number(label real, label image, label n)
{
    const std::int64_t result = std::int64_t(real) + std::int64_t(image) * n;
    if (result > std::int64_t(labelMax))
    {
        throw BadInput("The images of the mesh behind its cyclic patches are too many "
                       "for labels of this length.");
    }
    return label(result);
}

// Rotations leave the points of their axis where they are.
label PeriodicImages::lowest(label image, const Foam::point& home) const
{
    if (turns_)
    {
        const Foam::point x(motions_[image](home));
        for (label i = 0; i < image; ++i)
        {
            if (magSqr(motions_[i](home) - x) <= sqr(roundOff_))
            {
                return i;
            }
        }
    }
    return image;
}

labelList PeriodicImages::equals(label image, const Foam::point& home) const
{
    labelList result(1, image);
    if (turns_)
    {
        const Foam::point x(motions_[image](home));
        for (std::size_t i = 0; i < motions_.size(); ++i)
        {
            if (label(i) != image && magSqr(motions_[i](home) - x) <= sqr(roundOff_))
            {
                result.append(label(i));
            }
        }
    }
    return result;
}

label PeriodicImages::imageAt(const Foam::point& x, const Foam::point& home) const
{
    label nearest = 0;
    for (label i = 1; i < nNearby(); ++i)
    {
        const scalar before = mag(motions_[nearest](home) - x);
        if (mag(motions_[i](home) - x) + roundOff_ < before)
        {
            nearest = i;
        }
    }
    if (mag(motions_[nearest](home) - x) > tolerance_)
    {
        throw BadInput(
            "The point " + textOf(x)
            + " of a cyclic patch has no counterpart where the patch leads to: run "
              "checkMesh."
        );
    }
    return lowest(nearest, home);
}

} // namespace Foam::stability
