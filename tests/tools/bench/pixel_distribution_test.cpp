#include "tools/bench/measure/pixel_distribution.hpp"

#include <gtest/gtest.h>

namespace eyepoint::tools {
namespace {

TEST(PixelDistribution, KnowsThePercentilesOfARamp) {
    PixelDistribution pixels;
    for (int i = 1; i <= 100000; ++i) pixels.add(static_cast<float>(i) * 1e-3F);
    EXPECT_EQ(pixels.count(), 100000U);
    EXPECT_NEAR(pixels.percentile(0.999), 99.9, 0.1);
    EXPECT_NEAR(pixels.percentile(0.5), 50.0, 0.05);
    EXPECT_FLOAT_EQ(static_cast<float>(pixels.maximum()), 100.0F);
    EXPECT_NEAR(pixels.rms(), 57.7355, 1e-3);  // sqrt((n + 1)(2n + 1) / 6) * 1e-3
}

TEST(PixelDistribution, OfPartsIsThatOfTheWhole) {
    PixelDistribution odd, even, all;
    for (int i = 0; i < 1000; ++i) {
        const auto px = static_cast<float>(i * i) * 1e-4F;
        (i % 2 == 1 ? odd : even).add(px);
        all.add(px);
    }
    odd.merge(even);
    EXPECT_EQ(odd.count(), all.count());
    EXPECT_EQ(odd.percentile(0.9), all.percentile(0.9));
    EXPECT_EQ(odd.maximum(), all.maximum());
    EXPECT_NEAR(odd.rms(), all.rms(), 1e-9);
}

TEST(PixelDistribution, HoldsNothingAtFirstAndZeroes) {
    PixelDistribution pixels;
    EXPECT_EQ(pixels.percentile(0.999), 0.0);
    pixels.add(0.0F);
    pixels.add(1e-9F);
    EXPECT_LT(pixels.percentile(1.0), 1e-6);
    EXPECT_EQ(pixels.count(), 2U);
}

TEST(PixelDistribution, ErrorsBeyondItsBinsAreStillInTheGreatest) {
    PixelDistribution pixels;
    pixels.add(1e9F);
    EXPECT_FLOAT_EQ(static_cast<float>(pixels.maximum()), 1e9F);
}

}  // namespace
}  // namespace eyepoint::tools
