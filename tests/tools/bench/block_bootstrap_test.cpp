#include "tools/bench/regression/block_bootstrap.hpp"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace eyepoint::tools {
namespace {

/// A series whose every value remembers the one before: x' = memory x + noise; mean 0.
std::vector<double> remembering(std::uint64_t seed, std::size_t length, double memory) {
    std::mt19937_64 random{seed};
    std::normal_distribution<double> noise;
    std::vector<double> series(length);
    double value = noise(random) / std::sqrt(1.0 - memory * memory);
    for (double& one : series) one = value = memory * value + noise(random);
    return series;
}

Interval interval_of_mean(const std::vector<double>& series, double mean_run) {
    return bootstrap(series.size(), mean_run, [&](FrameChoice choice) {
        double sum = 0.0;
        for (const std::uint32_t i : choice) sum += series[i];
        return sum / static_cast<double>(choice.size());
    });
}

TEST(MeanRunLength, IsShortWithoutMemoryAndGrowsWithIt) {
    EXPECT_LT(mean_run_length(remembering(1, 2000, 0.0)), 6.0);
    EXPECT_GT(mean_run_length(remembering(1, 2000, 0.9)), 20.0);
    EXPECT_EQ(mean_run_length(std::vector<double>(100, 3.0)), 1.0);
    EXPECT_EQ(mean_run_length(std::vector<double>{1.0, 2.0}), 1.0);
}

/// For x' = memory x + noise, Politis and White's length is (2 memory / (1 - memory^2))^(2/3) length^(1/3).
TEST(MeanRunLength, IsThatOfAKnownProcess) {
    constexpr double kMemory = 0.7;
    constexpr std::size_t kLength = 4000;
    const double expected = std::pow(2.0 * kMemory / (1.0 - kMemory * kMemory), 2.0 / 3.0) *
                            std::cbrt(static_cast<double>(kLength));
    double sum = 0.0;
    constexpr int kSeries = 20;
    for (int i = 0; i < kSeries; ++i)
        sum += mean_run_length(remembering(static_cast<std::uint64_t>(i), kLength, kMemory));
    EXPECT_NEAR(sum / kSeries / expected, 1.0, 0.2);
}

/// How often the 95% interval holds the truth, of 100 series with memory.
int hits(bool by_runs) {
    int count = 0;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        const auto series = remembering(seed, 400, 0.8);
        const Interval interval = interval_of_mean(series, by_runs ? mean_run_length(series) : 1.0);
        count += interval.low <= 0.0 && 0.0 <= interval.high ? 1 : 0;
    }
    return count;
}

TEST(Bootstrap, IntervalsHoldTheTruthAsOftenAsTheySayAlsoWhereFramesRememberTheOnesBefore) {
    EXPECT_GE(hits(true), 85);   // a little under 95 is what the method gives for series so short
    EXPECT_LE(hits(false), 70);  // frame by frame it would be far too sure
}

TEST(Bootstrap, GivesTheSameIntervalAgainWithTheFigureInIt) {
    const auto series = remembering(7, 300, 0.5);
    const Interval one = interval_of_mean(series, 5.0), again = interval_of_mean(series, 5.0);
    EXPECT_EQ(one.low, again.low);
    EXPECT_EQ(one.high, again.high);
    EXPECT_LT(one.low, one.value);
    EXPECT_GT(one.high, one.value);
}

}  // namespace
}  // namespace eyepoint::tools
