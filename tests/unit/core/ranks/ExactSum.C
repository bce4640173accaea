// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/ranks/ExactSum.H"
#include "shapes/ThreadRanks.H"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

using namespace Foam;
using namespace Foam::stability;

namespace
{

using Limits = std::numeric_limits<scalar>;

scalar sumOf(const std::vector<scalar>& values)
{
    ExactSum sum;
    for (const scalar value : values)
    {
        sum.add(value);
    }
    return sum.value();
}

// Of any sign and size, subnormal ones too.
std::vector<scalar> wildValues(label n)
{
    std::mt19937 random(7);
    std::uniform_int_distribution<int> exponent(-1074, 1000);
    std::uniform_real_distribution<scalar> mantissa(-1, 1);
    std::vector<scalar> values(n);
    for (scalar& value : values)
    {
        value = std::ldexp(mantissa(random), exponent(random));
    }
    return values;
}

} // namespace

// 53 bits at places up to 50 higher: the truth has up to 120 bits.
TEST(ExactSum, isThatOfIntegers)
{
    std::mt19937_64 random(3);
    __int128 truth = 0;
    ExactSum sum;
    label nNegative = 0;
    for (label i = 0; i < 20000; ++i)
    {
        const std::int64_t mantissa = std::int64_t(random()) >> 10;
        const int place = int(random() % 51);
        truth += __int128(mantissa) * (std::int64_t(1) << place);
        sum.add(std::ldexp(scalar(mantissa / 2 * 2), place));
        sum.add(std::ldexp(scalar(mantissa % 2), place));
        EXPECT_EQ(sum.value(), scalar(truth));
        nNegative += truth < 0 ? 1 : 0;
    }
    EXPECT_GT(nNegative, 100);
    EXPECT_LT(nNegative, 19900);
}

TEST(ExactSum, losesNothingWhatEverCancels)
{
    EXPECT_EQ(sumOf({1e300, 1, -1e300}), 1);
    EXPECT_EQ(sumOf({-1e300, 1e-300, 1e300}), 1e-300);
    const scalar tiny = Limits::denorm_min();
    EXPECT_EQ(sumOf({tiny, Limits::max(), tiny, tiny, -Limits::max()}), 3 * tiny);
    EXPECT_EQ(sumOf({Limits::max(), Limits::max(), -Limits::max()}), Limits::max());
    EXPECT_EQ(sumOf({-tiny, -Limits::min()}), -(Limits::min() + tiny));
    EXPECT_EQ(sumOf({0.1, 0.2, -0.1, -0.2}), 0);
    EXPECT_EQ(sumOf({-0.0, 0.0}), 0);
    EXPECT_EQ(sumOf({}), 0);

    std::vector<scalar> values(wildValues(5000));
    const std::size_t n = values.size();
    for (std::size_t i = 0; i < n; ++i)
    {
        values.push_back(-values[i]);
    }
    values.push_back(-0.7);
    for (unsigned seed = 0; seed < 5; ++seed)
    {
        std::shuffle(values.begin(), values.end(), std::mt19937(seed));
        EXPECT_EQ(sumOf(values), -0.7);
    }
}

// A tie goes to the even one, but the least bit far below breaks it.
TEST(ExactSum, isRoundedToTheNearest)
{
    const scalar unit = Limits::epsilon(), tiny = Limits::denorm_min();
    for (const scalar sign : {1, -1})
    {
        EXPECT_EQ(sumOf({sign, sign * unit / 2}), sign);
        EXPECT_EQ(sumOf({sign, sign * unit / 2, sign * tiny}), sign * (1 + unit));
        EXPECT_EQ(sumOf({sign, sign * unit / 2, -sign * tiny}), sign);
        EXPECT_EQ(sumOf({sign, sign * 1.5 * unit}), sign * (1 + 2 * unit));
        EXPECT_EQ(sumOf({sign, sign * 1.5 * unit, -sign * tiny}), sign * (1 + unit));
    }
    // Rounded at each place in a digit, with the tie broken in the digits below.
    for (int place = -300; place < 300; ++place)
    {
        const scalar one = std::ldexp(1.0, place);
        EXPECT_EQ(sumOf({one, one * unit / 2}), one);
        EXPECT_EQ(sumOf({one, one * unit / 2, 1e-200 * one}), one * (1 + unit));
    }
}

TEST(ExactSum, sumsAddAndCancel)
{
    ExactSum a, b;
    a.add(1e20);
    a.add(-3);
    b.add(-1e20);
    b.add(0.5);
    ExactSum both(a);
    both.add(b);
    EXPECT_EQ(both.value(), -2.5);
    ExactSum minusBoth;
    minusBoth.add(3);
    minusBoth.add(-0.5);
    both.add(minusBoth);
    EXPECT_EQ(both.value(), 0);

    ExactSum doubled;
    doubled.add(-0.75);
    for (int i = 0; i < 1000; ++i)
    {
        doubled.add(ExactSum(doubled));
    }
    EXPECT_EQ(doubled.value(), std::ldexp(-0.75, 1000));
}

TEST(ExactSum, isNoNumberOnceOneWasNotFinite)
{
    for (const scalar bad :
         {Limits::infinity(), -Limits::infinity(), Limits::quiet_NaN()})
    {
        ExactSum sum, other;
        other.add(1);
        sum.add(bad);
        sum.add(1);
        other.add(sum);
        EXPECT_TRUE(std::isnan(sum.value()));
        EXPECT_TRUE(std::isnan(other.value()));
    }
}

// Each rank has every n-th value of each of the sums, the last rank none of two.
TEST(ExactSum, sumsOfRanksAreThoseOfOne)
{
    const std::vector<scalar> wild(wildValues(3001));
    const scalar truth = sumOf(wild);
    for (const label n : {1, 2, 3, 5})
    {
        std::vector<scalarField> found(n, scalarField(5, -1));
        shapes::onRanks(
            n,
            [&](const Exchange& exchange)
            {
                const label rank = exchange.rank();
                List<ExactSum> sums(5);
                for (label i = rank; i < 3001; i += n)
                {
                    sums[0].add(wild[i]);
                    sums[1].add(-wild[i]);
                }
                sums[2].add(rank % 2 == 0 ? 1e300 : -1e300);
                sums[2].add(rank == n - 1 && n % 2 == 1 ? -1e300 : 0);
                sums[2].add(-1e-5);
                sums[4].add(rank == n / 2 ? Limits::infinity() : 3);
                sum(sums, exchange);
                forAll(sums, i)
                {
                    found[rank][i] = sums[i].value();
                }
            }
        );
        for (const scalarField& sums : found)
        {
            EXPECT_EQ(sums[0], truth);
            EXPECT_EQ(sums[1], -truth);
            ExactSum small;
            for (label i = 0; i < n; ++i)
            {
                small.add(-1e-5);
            }
            EXPECT_EQ(sums[2], small.value());
            EXPECT_EQ(sums[3], 0);
            EXPECT_TRUE(std::isnan(sums[4]));
        }
    }
}

// A sum of areas, of either sign, takes a few digits.
TEST(ExactSum, packetsAreSmall)
{
    for (const scalar sign : {1, -1})
    {
        ExactSum sum;
        for (label i = 1; i < 1000; ++i)
        {
            sum.add(sign * 1e-6 / i);
        }
        Packet packet;
        sum.pack(packet);
        EXPECT_LT(packet.bytes().size(), 40);
        ExactSum again;
        again.add(1);
        again.addFrom(packet);
        again.add(-1);
        EXPECT_EQ(again.value(), sum.value());
        EXPECT_NE(sum.value(), 0);
    }
}

TEST(ExactSum, theLargestOfRanksIsOnAll)
{
    for (const label n : {1, 2, 5})
    {
        scalarField found(n, 0);
        shapes::onRanks(
            n,
            [&](const Exchange& exchange)
            {
                const label rank = exchange.rank();
                found[rank] = largest(rank == n / 2 ? -1 : -2.5 - rank, exchange);
            }
        );
        EXPECT_EQ(found, scalarField(n, -1));
    }
}
