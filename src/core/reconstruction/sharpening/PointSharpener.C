// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/reconstruction/sharpening/PointSharpener.H"

#include <algorithm>
#include <cmath>

namespace Foam::stability
{

namespace
{

// All in sizes of the cell.
constexpr scalar farthest = 0.6;    // a surface farther away is another one
constexpr scalar longestMove = 0.3; // in all
constexpr scalar noTrust = 0.2;     // spread at which a point does not move
constexpr scalar fullTrust = 0.05;  // and below which it moves all the way
constexpr scalar sharp = 0.005;     // spread of plic up to which it is right
constexpr scalar smeared = 0.015;   // and from which on profile is

// 0 at `zero`, 1 at `one`, linear between and constant beyond.
scalar ramp(scalar x, scalar zero, scalar one)
{
    return std::min(std::max((x - zero) / (one - zero), scalar(0)), scalar(1));
}

scalar trust(const BlendedDistance& d)
{
    return ramp(d.spread / d.size, noTrust, fullTrust);
}

vector along(const std::vector<vector>& walls, vector v)
{
    for (const vector& w : walls)
    {
        v -= (v & w) * w;
    }
    return v;
}

// To where the distance is zero, by the shortest way in the frame, along the walls.
vector towards(const BlendedDistance& d, const PointSharpener::Start& start)
{
    constexpr scalar flattest = 0.1;
    const symmTensor& s = start.frame.extents;
    const vector g = along(start.walls, d.gradient);
    const vector way = along(start.walls, s & (s & g));
    return magSqr(g) > flattest ? vector(-d.value / (g & way) * way) : vector(Zero);
}

} // namespace

BlendedDistance
PointSharpener::ask(const FitBlend* blend, const Start& start, const point& x) const
{
    BlendedDistance d;
    if (blend)
    {
        const CellFrame& frame = blend == plic_ ? start.metric : start.frame;
        d = blend->at(x, start.normal, start.cell, frame);
        d.known = d.known && std::abs(d.value) <= farthest * d.size;
    }
    return d;
}

BlendedDistance PointSharpener::plicAt(const Start& start) const
{
    return ask(plic_, start, start.x);
}

bool PointSharpener::isSharp(const BlendedDistance& plic)
{
    return plic.known && plic.spread <= sharp * plic.size;
}

// The weighted step; `sure` if all that count are trusted fully.
vector PointSharpener::combined(
    const Start& start, const Move& move, const BlendedDistance& plic,
    const BlendedDistance& profile, bool& sure
) const
{
    vector step(Zero);
    sure = true;
    if (move.share < 1)
    {
        const scalar t = trust(plic);
        step += (1 - move.share) * t * towards(plic, start);
        sure = sure && t == 1;
    }
    if (move.share > 0)
    {
        const scalar t = trust(profile);
        step += move.share * t * towards(profile, start);
        sure = sure && t == 1;
    }
    return step;
}

PointSharpener::Move
PointSharpener::move(const Start& start, const BlendedDistance& first) const
{
    Move move;
    BlendedDistance plic = first;
    BlendedDistance profile;
    if (!profile_ || isSharp(plic))
    {
        move.share = 0;
    }
    else
    {
        profile = ask(profile_, start, start.x);
        move.share = !plic.known      ? 1
                     : !profile.known ? 0
                                      : ramp(plic.spread / plic.size, sharp, smeared);
    }
    move.spread = (1 - move.share) * plic.spread + move.share * profile.spread;

    for (bool again = true; again;)
    {
        if ((move.share < 1 && !plic.known) || (move.share > 0 && !profile.known))
        {
            return move;
        }
        bool sure;
        const vector step = combined(start, move, plic, profile, sure);
        if (move.nSteps > 0 && !sure)
        {
            return move;
        }
        move.total += step;
        move.direction =
            (1 - move.share) * plic.gradient + move.share * profile.gradient;
        const scalar length = mag(start.frame.local(move.total));
        if (length > longestMove)
        {
            move.total *= longestMove / length;
        }
        again = ++move.nSteps < 2 && sure && length <= longestMove;
        if (again)
        {
            const point x = start.x + move.total;
            plic = move.share < 1 ? ask(plic_, start, x) : plic;
            profile = move.share > 0 ? ask(profile_, start, x) : profile;
        }
    }
    return move;
}

vector PointSharpener::pull(const Start& start, const Move& move) const
{
    const point x = start.x + move.total;
    const BlendedDistance plic =
        move.share < 1 ? ask(plic_, start, x) : BlendedDistance();
    const BlendedDistance profile =
        move.share > 0 ? ask(profile_, start, x) : BlendedDistance();
    if ((move.share < 1 && !plic.known) || (move.share > 0 && !profile.known))
    {
        return Zero;
    }
    bool sure;
    return combined(start, move, plic, profile, sure);
}

} // namespace Foam::stability
