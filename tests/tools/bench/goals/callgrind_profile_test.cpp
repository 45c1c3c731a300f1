#include "tools/bench/goals/callgrind_profile.hpp"

#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace eyepoint::tools {
namespace {

using ::testing::Pair;
using ::testing::UnorderedElementsAre;

// The example of the Valgrind manual's chapter on the format, in shape: main calls two functions.
constexpr const char* kProfile =
    "# callgrind format\nversion: 1\nevents: Ir\nsummary: 820\n\n"
    "fl=(1) file1.c\nfn=(1) main\n16 20\ncfn=(2) first(int, Span<char>)\ncalls=1 50\n16 400\n"
    "cfi=(2) file2.c\ncfn=(3) second\ncalls=3 20\n+1 400\n\n"
    "fn=(2)\n51 100\n* 5\ncfn=(3)\ncalls=2 20\n-2 300\n\n"
    "fl=(2)\nfn=(3)\n20 700\n";

TEST(CallgrindProfile, CountsWhatAFunctionTookItselfAndFollowsShortNames) {
    std::istringstream profile(kProfile);
    EXPECT_THAT(
        instructions_by_function(profile),
        UnorderedElementsAre(Pair("main", 20), Pair("first(int, Span<char>)", 105), Pair("second", 700)));
}

TEST(CallgrindProfile, CountsCallsWithAllThatTheyCall) {
    const auto of_calls = [](const char* name) {
        std::istringstream profile(kProfile);
        return instructions_of_calls(profile, name);
    };
    EXPECT_EQ(of_calls("first("), 400U);
    EXPECT_EQ(of_calls("second"), 700U) << "by both of its callers";
    EXPECT_EQ(of_calls("main"), 0U) << "nothing calls it";
}

TEST(CallgrindProfile, AnEmptyFileHasNoFunctions) {
    std::istringstream empty;
    EXPECT_TRUE(instructions_by_function(empty).empty());
}

}  // namespace
}  // namespace eyepoint::tools
