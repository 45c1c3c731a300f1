#include "ig/render/range_allocator.hpp"

#include <map>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace eyepoint::ig {
namespace {

TEST(RangeAllocator, GivesTheFirstRangeThatFits) {
    RangeAllocator ranges(10);
    EXPECT_EQ(ranges.take(4), 0U);
    EXPECT_EQ(ranges.take(3), 4U);
    ranges.give_back(0, 4);
    EXPECT_EQ(ranges.take(4), 0U);
    EXPECT_FALSE(ranges.take(4).has_value());
    EXPECT_EQ(ranges.take(3), 7U);
}

TEST(RangeAllocator, GrowthJoinsTheFreeEnd) {
    RangeAllocator ranges(10);
    ASSERT_TRUE(ranges.take(6).has_value());
    ranges.grow_to(20);
    EXPECT_EQ(ranges.largest_free(), 14U);
    EXPECT_EQ(ranges.take(14), 6U);
}

TEST(RangeAllocator, NothingTakesNoRoom) {
    RangeAllocator ranges(3);
    EXPECT_TRUE(ranges.take(0).has_value());
    ranges.give_back(0, 0);
    EXPECT_EQ(ranges.largest_free(), 3U);
}

/// However ranges come and go: none overlaps another, none leaves the row, and when all are back the row is
/// one.
RC_GTEST_PROP(RangeAllocator, NeverGivesAnElementTwice, (std::vector<std::uint8_t> steps)) {
    constexpr std::uint32_t kRangeSize = 200;
    RangeAllocator ranges(kRangeSize);
    std::map<std::uint32_t, std::uint32_t> taken;
    for (const std::uint8_t step : steps) {
        if (step % 3 == 0 && !taken.empty()) {
            const auto victim = std::next(taken.begin(), step % static_cast<int>(taken.size()));
            ranges.give_back(victim->first, victim->second);
            taken.erase(victim);
        } else if (const auto first = ranges.take(1U + step % 40U)) {
            const auto after = taken.lower_bound(*first);
            const std::uint32_t end = *first + 1U + step % 40U;
            const bool before_next = after == taken.end() || after->first >= end;
            const bool behind_last =
                after == taken.begin() || std::prev(after)->first + std::prev(after)->second <= *first;
            RC_ASSERT(end <= kRangeSize);
            RC_ASSERT(before_next);
            RC_ASSERT(behind_last);
            taken.emplace(*first, 1U + step % 40U);
        }
    }
    for (const auto& [first, count] : taken) ranges.give_back(first, count);
    RC_ASSERT(ranges.largest_free() == kRangeSize);
}

}  // namespace
}  // namespace eyepoint::ig
