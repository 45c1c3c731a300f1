#include "ig/distribution.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace eyepoint::ig {
namespace {

TEST(Distribution, OfNothingIsZero) {
    const Distribution none;
    EXPECT_EQ(none.count(), 0U);
    EXPECT_EQ(none.percentile(0.5), 0.0);
    EXPECT_EQ(none.maximum(), 0.0);
}

TEST(Distribution, PercentilesOfOneToAThousandAreNearestRanks) {
    Distribution values;
    for (int i = 1000; i >= 1; --i) values.add(i);
    for (const double share : {0.01, 0.5, 0.95, 0.99}) {
        EXPECT_NEAR(values.percentile(share), 1000.0 * share, 1000.0 * share * Distribution::kRelativeError)
            << share;
    }
    EXPECT_EQ(values.maximum(), 1000.0);
    EXPECT_EQ(values.count(), 1000U);
}

TEST(Distribution, OneOutlierIsTheMaximumAndNotTheMedian) {
    Distribution values;
    for (int i = 0; i < 999; ++i) values.add(16.0);
    values.add(500.0);
    EXPECT_NEAR(values.percentile(0.5), 16.0, 16.0 * Distribution::kRelativeError);
    EXPECT_NEAR(values.percentile(0.99), 16.0, 16.0 * Distribution::kRelativeError);
    EXPECT_EQ(values.maximum(), 500.0);
}

TEST(Distribution, ErrorHoldsFromTenthsOfMicrosecondsToMillionsOfTriangles) {
    for (double value = Distribution::kLeast; value < Distribution::kMost; value *= 1.0737) {
        Distribution one;
        one.add(value);
        one.add(value * 1e3);  // so that the maximum does not bound the answer
        EXPECT_NEAR(one.percentile(0.5) / value, 1.0, Distribution::kRelativeError + 1e-9) << value;
    }
}

TEST(Distribution, TakesZeroNegativeHugeAndNotANumber) {
    Distribution values;
    values.add(0.0);
    values.add(-3.0);
    values.add(std::numeric_limits<double>::infinity());
    values.add(std::nan(""));
    EXPECT_EQ(values.count(), 3U);
    EXPECT_LE(values.percentile(0.5), Distribution::kLeast * 1.02);
}

}  // namespace
}  // namespace eyepoint::ig
