/// `eyepoint-bench goals` as it is called: what it prints and its exit code.
#include <algorithm>
#include <chrono>
#include <fstream>
#include <iterator>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/analytic_terrain.hpp"
#include "tools/process/child_process.hpp"

namespace eyepoint::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

/// A bare Earth under two eyes of the benchmark field.
class GoalsCommand : public ::testing::Test {
  protected:
    GoalsCommand() {
        constexpr AnalyticTerrain kBareEarth{
            .half_size_deg = 0.01, .detail_depth = 1, .planet_depth = 0, .amplitude_m = 0.0};
        (void)make_database(kBareEarth, terrain());
        for (const char* name : {"cruise.csv", "sweep.csv"})
            std::ofstream(scratch_.path() / name) << "east_m,north_m,height_m,heading_rad,pitch_rad\n"
                                                     "46080,46080,2000,0,-0.17\n46087,46080,2000,0,-0.17\n";
    }
    [[nodiscard]] std::filesystem::path terrain() const { return scratch_.path() / "terrain"; }

    [[nodiscard]] tools::Ending run(std::vector<std::string> arguments) const {
        const std::vector<std::string> needed{EYEPOINT_BINARY_DIR "/bin/eyepoint-bench",
                                              "goals",
                                              "--terrain",
                                              terrain().string(),
                                              "--paths",
                                              scratch_.path().string(),
                                              "--every",
                                              "1"};
        arguments.insert(arguments.begin(), needed.begin(), needed.end());
        constexpr std::chrono::seconds kPatience{300};
        return tools::ChildProcess::start(arguments).value().wait(kPatience);
    }

    ScratchFolder scratch_;
};

TEST_F(GoalsCommand, PrintsTheChosenGoalsAndSaysWhatItDoes) {
    const auto ending = run({"--only", "7"});
    EXPECT_EQ(ending.exit_code, 0) << ending.standard_error;
    EXPECT_THAT(ending.standard_output, StartsWith(" 7  heap allocations in selection"));
    EXPECT_THAT(ending.standard_output, HasSubstr("at most 0             met\n"));
    EXPECT_EQ(ending.standard_output.find(" 4  "), std::string::npos) << ending.standard_output;
    EXPECT_THAT(ending.standard_error, HasSubstr("selecting along cruise"));
}

// Nothing hides anything on a bare Earth: 30% cannot be reached.
TEST_F(GoalsCommand, ExitCodeIsOneWhenAGoalIsMissed) {
    const auto ending = run({"--only", "9", "--json"});
    EXPECT_EQ(ending.exit_code, 1) << ending.standard_error;
    const auto json = nlohmann::json::parse(ending.standard_output);
    EXPECT_TRUE(
        std::ranges::any_of(json["goals"], [](const auto& goal) { return goal["verdict"] == "MISSED"; }));
    EXPECT_TRUE(std::ranges::all_of(json["goals"], [](const auto& goal) { return goal["goal"] == 9; }));
}

TEST_F(GoalsCommand, LeavesAPageWhereAskedTo) {
    const auto page = scratch_.path() / "goals.md";
    EXPECT_EQ(run({"--only", "7", "--page", page.string()}).exit_code, 0);
    std::ifstream stream(page);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    EXPECT_THAT(text, HasSubstr("| 7 | heap allocations in selection"));
}

TEST_F(GoalsCommand, AGoalThatIsNoneIsOneClearLine) {
    const auto ending = run({"--only", "3,x"});
    EXPECT_EQ(ending.exit_code, 1);
    EXPECT_EQ(ending.standard_error,
              "eyepoint-bench: --only: 'x' is no goal; goals are 1 to 19, written as 3,8\n");
}

}  // namespace
}  // namespace eyepoint::testing
