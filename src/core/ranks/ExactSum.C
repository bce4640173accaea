// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

#include "core/ranks/ExactSum.H"

#include <cmath>
#include <cstring>
#include <limits>

namespace Foam::stability
{

void ExactSum::add(scalar x)
{
    std::uint64_t bits;
    std::memcpy(&bits, &x, sizeof(bits));
    const int exponent = int(bits >> 52) & 0x7ff;
    if (exponent == 0x7ff)
    {
        finite_ = false;
        return;
    }
    std::uint64_t mantissa = bits & ((std::uint64_t(1) << 52) - 1);
    mantissa |= exponent > 0 ? std::uint64_t(1) << 52 : 0;
    const int place = exponent > 0 ? exponent - 1 : 0; // of its lowest bit
    const int first = place / digitBits, shift = place % digitBits;
    const std::int64_t sign = bits >> 63 ? -1 : 1;
    constexpr std::uint64_t mask = 0xffffffff;
    const std::uint64_t low = mantissa & mask, high = mantissa >> digitBits;
    const std::uint64_t a = low << shift, b = high << shift;
    digits_[first] += sign * std::int64_t(a & mask);
    digits_[first + 1] += sign * std::int64_t((a >> digitBits) + (b & mask));
    digits_[first + 2] += sign * std::int64_t(b >> digitBits);
    constexpr std::int64_t mostWithoutCarry = 1 << 28;
    if (++nAdded_ >= mostWithoutCarry)
    {
        carry();
    }
}

void ExactSum::add(const ExactSum& other)
{
    ExactSum settled(other);
    settled.carry();
    carry();
    for (std::size_t i = 0; i < nDigits; ++i)
    {
        digits_[i] += settled.digits_[i];
    }
    carry();
    finite_ = finite_ && other.finite_;
}

// All digits but the highest into [0, 2^32).
void ExactSum::carry()
{
    for (std::size_t i = 0; i + 1 < nDigits; ++i)
    {
        const std::int64_t over = digits_[i] >> digitBits; // rounded down
        digits_[i] -= over * (std::int64_t(1) << digitBits);
        digits_[i + 1] += over;
    }
    nAdded_ = 0;
}

scalar ExactSum::value() const
{
    if (!finite_)
    {
        return std::numeric_limits<scalar>::quiet_NaN();
    }
    ExactSum settled(*this);
    settled.carry();
    const bool negative = settled.digits_[nDigits - 1] < 0;
    if (negative)
    {
        for (std::int64_t& digit : settled.digits_)
        {
            digit = -digit;
        }
        settled.carry();
    }
    constexpr int lowestBit = -1074;
    std::size_t top = nDigits;
    while (top > 0 && settled.digits_[top - 1] == 0)
    {
        --top;
    }
    scalar result = 0;
    for (std::size_t i = top > 3 ? top - 3 : 0; i < top; ++i)
    {
        result +=
            std::ldexp(scalar(settled.digits_[i]), int(i) * digitBits + lowestBit);
    }
    return negative ? -result : result;
}

void sum(UList<ExactSum>& sums, const Exchange& exchange)
{
    if (exchange.nRanks() == 1)
    {
        return;
    }
    Packet mine;
    mine.putList(sums);
    sums = ExactSum();
    for (Packet& packet : exchange.toMaster(std::move(mine)))
    {
        if (!packet.empty())
        {
            const List<ExactSum> some(packet.getList<ExactSum>());
            forAll(sums, i)
            {
                sums[i].add(some[i]);
            }
        }
    }
    Packet all;
    all.putList(sums);
    sums.deepCopy(exchange.fromMaster(all).getList<ExactSum>());
}

scalar largest(scalar value, const Exchange& exchange)
{
    Packet mine;
    mine.put(value);
    for (Packet& packet : exchange.toAll(mine))
    {
        value = std::max(value, packet.get<scalar>());
    }
    return value;
}

} // namespace Foam::stability
