// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/ranks/ExactSum.H"

#include <algorithm>
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
    const std::uint64_t low = mantissa & lowDigit, high = mantissa >> digitBits;
    const std::uint64_t a = low << shift, b = high << shift;
    digits_[first] += sign * std::int64_t(a & lowDigit);
    digits_[first + 1] += sign * std::int64_t((a >> digitBits) + (b & lowDigit));
    digits_[first + 2] += sign * std::int64_t(b >> digitBits);
    constexpr std::int64_t mostWithoutCarry = 1 << 28; // each adds less than 2^33
    if (++nAdded_ >= mostWithoutCarry)
    {
        carry();
    }
}

void ExactSum::add(const ExactSum& other)
{
    addTimes(1, other);
}

void ExactSum::addTimes(int sign, const ExactSum& other)
{
    ExactSum settled(other);
    settled.carry();
    carry();
    for (std::size_t i = 0; i < nDigits; ++i)
    {
        digits_[i] += sign * settled.digits_[i];
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

bool ExactSum::dropSign()
{
    carry();
    const bool negative = digits_[nDigits - 1] < 0;
    if (negative)
    {
        for (std::int64_t& digit : digits_)
        {
            digit = -digit;
        }
        carry();
    }
    return negative;
}

std::size_t ExactSum::nUsed() const
{
    std::size_t n = nDigits;
    while (n > 0 && digits_[n - 1] == 0)
    {
        --n;
    }
    return n;
}

scalar ExactSum::value() const
{
    if (!finite_)
    {
        return std::numeric_limits<scalar>::quiet_NaN();
    }
    ExactSum size(*this);
    const bool negative = size.dropSign();
    const int top = int(size.nUsed()) - 1;
    if (top < 0)
    {
        return 0;
    }
    const auto digit = [&](int i)
    { return std::uint64_t(i < 0 ? 0 : size.digits_[i]); };
    int shift = 0; // of the highest bit to the top of its digit
    while ((digit(top) << shift) >> (digitBits - 1) == 0)
    {
        ++shift;
    }
    // The highest 64 bits are rounded once; what is below them may only break a tie.
    std::uint64_t bits = digit(top) << (digitBits + shift);
    bits |= digit(top - 1) << shift;
    bits |= digit(top - 2) >> (digitBits - shift);
    bool below = ((digit(top - 2) << shift) & lowDigit) > 0;
    for (int i = top - 3; i >= 0 && !below; --i)
    {
        below = digit(i) > 0;
    }
    bits |= below ? 1 : 0;
    constexpr int lowestBit = -1074;
    const scalar result =
        std::ldexp(scalar(bits), (top - 1) * digitBits - shift + lowestBit);
    return negative ? -result : result;
}

void ExactSum::pack(Packet& packet) const
{
    ExactSum size(*this);
    packet.put(finite_);
    packet.put(size.dropSign());
    const std::size_t n = size.nUsed();
    std::size_t first = 0;
    while (first < n && size.digits_[first] == 0)
    {
        ++first;
    }
    List<std::uint32_t> digits(label(n - first));
    std::copy_n(size.digits_.begin() + first, n - first, digits.begin());
    packet.put(first);
    packet.putList(digits);
}

void ExactSum::addFrom(Packet& packet)
{
    ExactSum other;
    other.finite_ = packet.get<bool>();
    const bool negative = packet.get<bool>();
    const std::size_t first = packet.get<std::size_t>();
    const List<std::uint32_t> digits(packet.getList<std::uint32_t>());
    std::copy(digits.begin(), digits.end(), other.digits_.begin() + first);
    addTimes(negative ? -1 : 1, other);
}

namespace
{

Packet packed(const UList<ExactSum>& sums)
{
    Packet packet;
    for (const ExactSum& some : sums)
    {
        some.pack(packet);
    }
    return packet;
}

void addFrom(Packet& packet, UList<ExactSum>& sums)
{
    for (ExactSum& some : sums)
    {
        some.addFrom(packet);
    }
}

} // namespace

void sum(UList<ExactSum>& sums, const Exchange& exchange)
{
    if (exchange.nRanks() == 1)
    {
        return;
    }
    std::vector<Packet> packets(exchange.toMaster(packed(sums)));
    sums = ExactSum();
    for (Packet& packet : packets)
    {
        if (!packet.empty())
        {
            addFrom(packet, sums);
        }
    }
    Packet all(exchange.fromMaster(packed(sums)));
    sums = ExactSum();
    if (!all.empty())
    {
        addFrom(all, sums);
    }
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
