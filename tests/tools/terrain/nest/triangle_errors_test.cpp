#include "tools/terrain/nest/triangle_errors.hpp"

#include <gtest/gtest.h>

namespace eyepoint::tools {
namespace {

TEST(TriangleErrors, MeasuresATriangleOnceWhereItsErrorIsWithinWhatIsEnough) {
    TriangleErrors errors;
    int measured = 0;
    const auto three_metres = [&](float) { return ++measured, 3.0F; };
    EXPECT_EQ(errors.find({1, 2, 3}, 5.0F, three_metres), 3.0F);
    EXPECT_EQ(errors.find({1, 2, 3}, 1.0F, three_metres), 3.0F);
    EXPECT_EQ(measured, 1);
}

TEST(TriangleErrors, MeasuresAgainWhereOnlyALesserErrorThanIsEnoughIsKnown) {
    TriangleErrors errors;
    int measured = 0;
    // Stops at the first sample beyond what is enough, as SampledSurface::error_m may.
    const auto stops_early = [&](float enough_m) { return ++measured, enough_m < 2.0F ? 2.0F : 9.0F; };
    EXPECT_EQ(errors.find({1, 2, 3}, 1.0F, stops_early), 2.0F);
    EXPECT_EQ(errors.find({1, 2, 3}, 1.5F, stops_early), 2.0F);
    EXPECT_EQ(measured, 1);
    EXPECT_EQ(errors.find({1, 2, 3}, 10.0F, stops_early), 9.0F);
    EXPECT_EQ(measured, 2);
}

TEST(TriangleErrors, NeverTakesOneTriangleForAnother) {
    TriangleErrors errors;
    const auto find = [&](std::uint16_t first) {
        const auto own_number = [&](float) { return static_cast<float>(first); };
        return errors.find({first, 7, 8}, 1e6F, own_number);
    };
    for (int round = 0; round < 2; ++round) {
        for (std::uint16_t first = 0; first < 20'000; ++first) ASSERT_EQ(find(first), first);
    }
}

}  // namespace
}  // namespace eyepoint::tools
