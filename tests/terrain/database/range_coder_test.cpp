#include "terrain/database/range_coder.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

namespace eyepoint::terrain {
namespace {

RC_GTEST_PROP(RangeCoder, GivesBackAnyNumbers, ()) {
    const auto small =
        *rc::gen::container<std::vector<std::uint64_t>>(rc::gen::inRange<std::uint64_t>(0, 300));
    const auto large = *rc::gen::container<std::vector<std::uint64_t>>(
        rc::gen::inRange<std::uint64_t>(0, std::uint64_t{1} << 62));
    RangeEncoder encoder;
    NumberModel models[2];
    for (const auto number : small) encoder.number(models[0], number);
    for (const auto number : large) encoder.number(models[1], number);
    const auto bytes = encoder.finish();
    RangeDecoder decoder{bytes};
    NumberModel read[2];
    for (const auto number : small) RC_ASSERT(decoder.number(read[0]) == number);
    for (const auto number : large) RC_ASSERT(decoder.number(read[1]) == number);
    RC_ASSERT(decoder.at_end());
}

// A carry runs through bytes of 255 that are out already.
TEST(RangeCoder, CarriesThroughLongRunsOfOneBit) {
    std::mt19937 random{3};
    for (int trial = 0; trial < 200; ++trial) {
        std::vector<bool> bits(4'000);
        for (std::size_t i = 0; i < bits.size(); ++i) bits[i] = random() % 1'000 == 0;
        RangeEncoder encoder;
        BitModel model;
        for (const bool bit : bits) encoder.bit(model, bit);
        const auto bytes = encoder.finish();
        RangeDecoder decoder{bytes};
        BitModel read;
        for (const bool bit : bits) ASSERT_EQ(decoder.bit(read), bit);
        ASSERT_TRUE(decoder.at_end());
    }
}

// Shannon's bound: bits of probability p cost -p log2 p - (1 - p) log2 (1 - p) each, and what is learnt on
// the way.
TEST(RangeCoder, CostsLittleMoreThanTheEntropy) {
    std::mt19937 random{4};
    for (const double p : {0.5, 0.2, 0.05}) {
        std::bernoulli_distribution one{p};
        RangeEncoder encoder;
        BitModel model;
        constexpr int kBits = 20'000;
        int ones = 0;
        for (int i = 0; i < kBits; ++i) {
            const bool bit = one(random);
            encoder.bit(model, bit);
            ones += bit ? 1 : 0;
        }
        const double share = static_cast<double>(ones) / kBits;
        const double entropy = -share * std::log2(share) - (1.0 - share) * std::log2(1.0 - share);
        const double bits = 8.0 * static_cast<double>(encoder.finish().size());
        EXPECT_LE(bits, 1.05 * entropy * kBits + 64.0) << p;
        EXPECT_GE(bits, 0.97 * entropy * kBits) << p;
    }
}

TEST(RangeCoder, SaysWhenMoreIsReadThanWasWritten) {
    RangeDecoder decoder{{}};
    EXPECT_TRUE(decoder.overrun());
    EXPECT_FALSE(decoder.at_end());
}

}  // namespace
}  // namespace eyepoint::terrain
