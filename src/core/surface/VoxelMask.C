// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/surface/VoxelMask.H"

#include <algorithm>
#include <cmath>

namespace Foam::stability
{

namespace
{

constexpr int bits = 21; // per direction
constexpr std::int64_t middle = std::int64_t(1) << (bits - 1);

std::int64_t placeOf(scalar x, scalar size)
{
    const scalar place = std::floor(x / size) + middle;
    return std::int64_t(std::min(std::max(place, scalar(0)), scalar(2 * middle - 1)));
}

} // namespace

VoxelMask::Voxel VoxelMask::voxelAt(const point& x) const
{
    Voxel voxel = 0;
    for (direction d = 0; d < 3; ++d)
    {
        voxel = (voxel << bits) | Voxel(placeOf(x[d], size_));
    }
    return voxel;
}

template<class Visit>
void VoxelMask::visit(const boundBox& box, scalar size, const Visit& visitor)
{
    std::int64_t low[3], high[3];
    for (direction d = 0; d < 3; ++d)
    {
        low[d] = placeOf(box.min()[d], size);
        high[d] = placeOf(box.max()[d], size);
    }
    visit(low, high, visitor);
}

template<class Visit>
void VoxelMask::visit(
    const std::int64_t (&low)[3], const std::int64_t (&high)[3], const Visit& visitor
)
{
    for (std::int64_t i = low[0]; i <= high[0]; ++i)
    {
        for (std::int64_t j = low[1]; j <= high[1]; ++j)
        {
            for (std::int64_t k = low[2]; k <= high[2]; ++k)
            {
                visitor((Voxel(i) << (2 * bits)) | (Voxel(j) << bits) | Voxel(k));
            }
        }
    }
}

// A reach of several voxels is added for all points of a voxel at once.
void VoxelMask::add(const point& x, scalar reach)
{
    const vector wide(reach, reach, reach);
    if (reach < size_)
    {
        add(boundBox(x - wide, x + wide));
        return;
    }
    const std::int64_t n = std::ceil(reach / size_);
    std::int64_t& added = centres_[voxelAt(x)];
    if (added >= n)
    {
        return;
    }
    added = n;
    std::int64_t low[3], high[3];
    for (direction d = 0; d < 3; ++d)
    {
        const std::int64_t place = placeOf(x[d], size_);
        low[d] = std::max(place - n, std::int64_t(0));
        high[d] = std::min(place + n, 2 * middle - 1);
    }
    addVoxels(low, high);
}

bool VoxelMask::meets(const boundBox& box) const
{
    bool any = false;
    visit(box, size_, [&](Voxel voxel) { any = any || voxels_.count(voxel) > 0; });
    return any;
}

void VoxelMask::add(const boundBox& box)
{
    std::int64_t low[3], high[3];
    for (direction d = 0; d < 3; ++d)
    {
        low[d] = placeOf(box.min()[d], size_);
        high[d] = placeOf(box.max()[d], size_);
    }
    addVoxels(low, high);
}

void VoxelMask::addVoxels(const std::int64_t (&low)[3], const std::int64_t (&high)[3])
{
    const bool first = voxels_.empty();
    for (direction d = 0; d < 3; ++d)
    {
        low_[d] = first ? low[d] : std::min(low_[d], low[d]);
        high_[d] = first ? high[d] : std::max(high_[d], high[d]);
    }
    visit(low, high, [&](Voxel voxel) { voxels_.insert(voxel); });
}

void VoxelMask::add(
    const point& a, const point& b, const point& c, scalar reach, const boundBox& within
)
{
    if (!within.overlaps(boundBox(min(a, min(b, c)), max(a, max(b, c)))))
    {
        return;
    }
    const scalar ab = magSqr(b - a), bc = magSqr(c - b), ca = magSqr(a - c);
    if (std::max(ab, std::max(bc, ca)) <= sqr(size_))
    {
        add(a, reach);
        add(b, reach);
        add(c, reach);
    }
    else if (ab >= bc && ab >= ca)
    {
        const point m = 0.5 * (a + b);
        add(a, m, c, reach, within);
        add(m, b, c, reach, within);
    }
    else if (bc >= ca)
    {
        add(b, c, a, reach, within);
    }
    else
    {
        add(c, a, b, reach, within);
    }
}

DynamicList<VoxelMask::Voxel> VoxelMask::within(const boundBox& box) const
{
    std::int64_t low[3], high[3];
    for (direction d = 0; d < 3; ++d)
    {
        low[d] = placeOf(box.min()[d], size_);
        high[d] = placeOf(box.max()[d], size_);
        if (voxels_.empty() || high[d] < low_[d] || high_[d] < low[d])
        {
            return {};
        }
    }
    DynamicList<Voxel> result;
    for (const Voxel voxel : voxels_)
    {
        bool inside = true;
        for (direction d = 0; d < 3; ++d)
        {
            const std::int64_t place =
                std::int64_t(voxel >> (bits * (2 - d))) & (2 * middle - 1);
            inside = inside && low[d] <= place && place <= high[d];
        }
        if (inside)
        {
            result.append(voxel);
        }
    }
    std::sort(result.begin(), result.end());
    return result;
}

void VoxelIndex::add(const boundBox& box)
{
    VoxelMask::visit(
        box, size_, [&](VoxelMask::Voxel voxel) { boxes_[voxel].push_back(nBoxes_); }
    );
    ++nBoxes_;
}

DynamicList<label> VoxelIndex::meeting(const UList<VoxelMask::Voxel>& voxels) const
{
    DynamicList<label> found;
    for (const VoxelMask::Voxel voxel : voxels)
    {
        const auto here = boxes_.find(voxel);
        if (here != boxes_.end())
        {
            for (const label boxi : here->second)
            {
                found.append(boxi);
            }
        }
    }
    std::sort(found.begin(), found.end());
    found.setSize(label(std::unique(found.begin(), found.end()) - found.begin()));
    return found;
}

} // namespace Foam::stability
