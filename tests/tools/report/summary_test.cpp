#include "tools/report/summary.hpp"

#include <limits>
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace eyepoint::tools {
namespace {

using testing::ElementsAre;
using testing::IsNan;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(Percentiles, OfOneToAHundredAreTheirOwnRanks) {
    std::vector<double> values(100);
    std::iota(values.rbegin(), values.rend(), 1.0);
    const auto found = percentiles(values);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->p50, 50.0);
    EXPECT_EQ(found->p95, 95.0);
    EXPECT_EQ(found->p99, 99.0);
    EXPECT_EQ(found->maximum, 100.0);
}

TEST(Percentiles, OfFewValuesAreValuesThatOccur) {
    const auto one = percentiles(std::vector{7.0});
    EXPECT_EQ(one->p50, 7.0);
    EXPECT_EQ(one->p99, 7.0);
    const auto two = percentiles(std::vector{2.0, 1.0});
    EXPECT_EQ(two->p50, 1.0);
    EXPECT_EQ(two->p95, 2.0);
}

TEST(Percentiles, LeaveOutWhatIsAbsent) {
    EXPECT_EQ(percentiles(std::vector{kNan, 3.0, kNan})->p50, 3.0);
    EXPECT_FALSE(percentiles(std::vector{kNan}));
    EXPECT_FALSE(percentiles({}));
}

TEST(Thin, KeepsThePeakOfEveryGroupSoThatNoSpikeIsLost) {
    EXPECT_THAT(thin(std::vector{1.0, 9.0, 2.0, 3.0, 4.0}, 2, Thinning::Largest), ElementsAre(9.0, 3.0, 4.0));
    EXPECT_THAT(thin(std::vector{1.0, 9.0, 2.0, 3.0, 4.0}, 2, Thinning::First), ElementsAre(1.0, 2.0, 4.0));
    EXPECT_THAT(thin(std::vector{kNan, 5.0, kNan, kNan}, 2, Thinning::Largest), ElementsAre(5.0, IsNan()));
}

}  // namespace
}  // namespace eyepoint::tools
