#include "config/near_match.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace eyepoint::config {
namespace {

// Distances of the textbook pairs: kitten/sitting is Levenshtein's own kind of example, "ca"/"abc" tells
// optimal string alignment (3) from the unrestricted Damerau distance (2).
TEST(EditDistance, CountsLettersToChange) {
    EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
    EXPECT_EQ(edit_distance("ca", "abc"), 3U);
    EXPECT_EQ(edit_distance("tau", "tau"), 0U);
    EXPECT_EQ(edit_distance("", "tau"), 3U);
    EXPECT_EQ(edit_distance("tau", ""), 3U);
    EXPECT_EQ(edit_distance("tua", "tau"), 1U);
}

TEST(NearMatch, IsTheNearestNameWhereItCanBeMeant) {
    const std::vector<std::string> names = {"terrain", "host", "view"};
    EXPECT_EQ(near_match("terain", names), "terrain");
    EXPECT_EQ(near_match("veiw", names), "view");
    EXPECT_EQ(near_match("hots", names), "host");
    EXPECT_EQ(near_match("output", names), std::nullopt);
    EXPECT_EQ(near_match("", names), std::nullopt);
    EXPECT_EQ(near_match("host", {}), std::nullopt);
}

}  // namespace
}  // namespace eyepoint::config
