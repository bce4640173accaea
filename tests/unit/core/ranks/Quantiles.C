// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/ranks/Quantiles.H"
#include "shapes/ThreadRanks.H"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

using namespace Foam;
using namespace Foam::stability;

namespace
{

const SerialExchange alone;

struct Sample
{
    scalarField values, weights;
};

// By sorting and whole numbers: weights are multiples of 1/8, fractions of 1/16.
scalar sortedQuantile(const Sample& sample, label sixteenths)
{
    std::vector<std::pair<scalar, label>> entries;
    label total = 0;
    forAll(sample.values, i)
    {
        const label eighths = label(8 * sample.weights[i]);
        entries.emplace_back(sample.values[i], eighths);
        total += eighths;
    }
    std::sort(entries.begin(), entries.end());
    label reached = 0;
    for (const auto& [value, eighths] : entries)
    {
        reached += eighths;
        if (eighths > 0 && 16 * reached >= sixteenths * total)
        {
            return value;
        }
    }
    return 0;
}

// Values of all sizes, many of them equal, some without weight.
Sample wildSample(label n)
{
    std::mt19937 random(n);
    std::uniform_real_distribution<scalar> exponent(-12, 3);
    Sample sample{scalarField(n), scalarField(n)};
    forAll(sample.values, i)
    {
        const scalar value = std::pow(10, exponent(random));
        sample.values[i] = random() % 4 == 0 ? scalar(random() % 3) : value;
        sample.weights[i] = (random() % 9) / 8.0;
    }
    return sample;
}

// Every n-th is on this rank; the last rank has nothing.
Sample partOf(const Sample& sample, const Exchange& exchange)
{
    const label n = std::max(exchange.nRanks() - 1, label(1));
    Sample part;
    forAll(sample.values, i)
    {
        if (i % n == exchange.rank())
        {
            part.values.append(sample.values[i]);
            part.weights.append(sample.weights[i]);
        }
    }
    return part;
}

} // namespace

TEST(Quantiles, areThoseOfSortingOnAnyNumberOfRanks)
{
    std::vector<scalar> fractions;
    for (label i = 1; i <= 16; ++i)
    {
        fractions.push_back(i / 16.0);
    }
    for (const label n : {1, 2, 7, 100, 3001})
    {
        const Sample sample(wildSample(n));
        for (const label nRanks : {1, 2, 3, 5})
        {
            std::vector<std::vector<scalar>> found(nRanks);
            shapes::onRanks(
                nRanks,
                [&](const Exchange& exchange)
                {
                    const Sample mine(partOf(sample, exchange));
                    found[exchange.rank()] = weightedQuantiles(
                        mine.values, mine.weights, fractions, exchange
                    );
                }
            );
            for (label i = 1; i <= 16; ++i)
            {
                const scalar truth = sortedQuantile(sample, i);
                for (const std::vector<scalar>& ofRank : found)
                {
                    EXPECT_EQ(ofRank.at(i - 1), truth) << n << " on " << nRanks;
                }
            }
        }
    }
}

// Up to 3/16, 12/16 and all of the weight; in any order of the fractions.
TEST(Quantiles, areTheLeastThatReach)
{
    const scalarField values(List<scalar>{5, 0.25, 9, 2});
    const scalarField weights(List<scalar>{0.25, 0.1875, 0, 0.5625});
    EXPECT_EQ(
        weightedQuantiles(values, weights, {1, 0.1875, 0.1876, 0.75, 0.7501}, alone),
        (std::vector<scalar>{5, 0.25, 2, 2, 5})
    );
}

TEST(Quantiles, ofEqualValuesAreThatValue)
{
    const scalar largest = std::numeric_limits<scalar>::max();
    for (const scalar value : {0.0, -0.0, 1e-320, 0.3, largest})
    {
        const scalarField values(1000, value), weights(1000, 0.7);
        EXPECT_EQ(
            weightedQuantiles(values, weights, {1e-9, 0.5, 1}, alone),
            std::vector<scalar>(3, value)
        );
    }
}

TEST(Quantiles, withoutWeightAreZero)
{
    const scalarField values(3, 2.0);
    const std::vector<scalar> fractions{0.5, 1}, none(2, 0);
    EXPECT_EQ(weightedQuantiles(values, scalarField(3, 0.0), fractions, alone), none);
    EXPECT_EQ(weightedQuantiles(scalarField(), scalarField(), fractions, alone), none);
}
