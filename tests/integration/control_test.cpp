/// Tolerance control in the running program.
#include "config/settings.hpp"
#include "tests/integration/run.hpp"

namespace eyepoint::testing {
namespace {

using nlohmann::json;

TEST_F(Run, WithoutAWindowTheToleranceStandsUnlessItIsAskedToMove) {
    start({"--frames", "20"});
    send_flight(40);
    (void)end_with(std::nullopt);
    const std::vector<json> lines = read_lines(record());
    ASSERT_EQ(lines.size(), 21U);
    for (std::size_t frame = 1; frame < lines.size(); ++frame) {
        EXPECT_EQ(lines[frame]["control"], "off");
        EXPECT_EQ(lines[frame]["tau_px"], config::Settings{}.terrain.tau_px);
    }
    EXPECT_EQ(log_.find("timer queries"), std::string::npos) << log_;
}

TEST_F(Run, ATargetThatNoPictureMeetsIsSaidOnceWithTheRemedyAndTheToleranceKeepsToItsBounds) {
    // A tenth of a millisecond.
    start({"--rate", "1000", "--set", "control.tolerance=on", "--set", "control.target_share=0.1", "--set",
           "control.tau_max_px=8"});
    send_flight(250);
    (void)end_with(SIGINT);
    const auto said = log_.find("frame.rate_hz");
    ASSERT_NE(said, std::string::npos) << log_;
    EXPECT_EQ(log_.find("frame.rate_hz", said + 1), std::string::npos) << log_;
    EXPECT_NE(log_.find("more than the 0.1 ms they may"), std::string::npos) << log_;
    EXPECT_NE(log_.find("timer queries"), std::string::npos) << log_;
    const std::vector<json> lines = read_lines(record());
    ASSERT_GT(lines.size(), 20U);
    for (std::size_t frame = 1; frame < lines.size(); ++frame) {
        EXPECT_LE(lines[frame]["tau_px"].get<double>(), 8.0);
        EXPECT_GE(lines[frame]["tau_px"].get<double>(), 0.5);
    }
    const std::string state = lines.back()["control"];
    EXPECT_TRUE(state == "coarsest" || state == "held") << state;
    EXPECT_GT(lines.back()["unreachable_share"].get<double>(), 0.0);
}

TEST_F(Run, AnEasyTargetIsMetAtTheFinestTolerance) {
    start(
        {"--rate", "20", "--frames", "60", "--set", "control.tolerance=on", "--set", "control.tau_min_px=1"});
    send_flight(350);
    (void)end_with(std::nullopt);
    const json last = read_lines(record()).back();
    EXPECT_EQ(last["control"], "finest");
    EXPECT_EQ(last["tau_px"], 1.0);
}

}  // namespace
}  // namespace eyepoint::testing
