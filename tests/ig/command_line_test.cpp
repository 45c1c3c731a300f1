#include "ig/command_line.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace eyepoint::ig {
namespace {

tl::expected<CommandLine, std::string> parse(std::vector<const char*> arguments) {
    arguments.insert(arguments.begin(), "eyepoint");
    return parse_command_line(static_cast<int>(arguments.size()), arguments.data(), "9.8.7");
}

config::Settings settings_of(const std::vector<const char*>& arguments) {
    const auto line = parse(arguments);
    EXPECT_TRUE(line.has_value()) << line.error();
    const auto loaded = load_settings(*line);
    EXPECT_TRUE(loaded.has_value()) << loaded.error();
    return loaded->settings;
}

TEST(CommandLine, FlagsBecomeSettings) {
    const config::Settings settings =
        settings_of({"--terrain", "world.db", "--headless", "--video",  "a.mp4", "--listen",
                     "127.0.0.1", "--port",   "6001",       "--rate",   "30",    "--size",
                     "640x480",   "--fov",    "55.5",       "--frames", "12",    "--end-after-silence",
                     "2.5",       "--record", "r.jsonl",    "--tau",    "3",     "--show",
                     "levels",    "--trace",  "t.json",     "--hud"});
    EXPECT_EQ(settings.terrain.database, "world.db");
    EXPECT_EQ(settings.output.kind, config::OutputKind::Video);
    EXPECT_EQ(settings.output.path, "a.mp4");
    EXPECT_EQ(settings.host.address, "127.0.0.1");
    EXPECT_EQ(settings.host.port, 6001);
    EXPECT_EQ(settings.frame.rate_hz, 30.0);
    EXPECT_EQ(settings.view.width_px, 640U);
    EXPECT_EQ(settings.view.height_px, 480U);
    EXPECT_EQ(settings.view.vertical_fov_deg, 55.5);
    EXPECT_EQ(settings.frame.frames, 12U);
    EXPECT_EQ(settings.host.end_after_silence_s, 2.5);
    EXPECT_EQ(settings.output.record, "r.jsonl");
    EXPECT_EQ(settings.terrain.tau_px, 3.0);
    EXPECT_EQ(settings.render.show, config::Show::Levels);
    EXPECT_EQ(settings.output.trace, "t.json");
    EXPECT_EQ(settings.render.hud, config::Switch::On);
}

TEST(CommandLine, SetTakesAnyKeyManyTimesAndANamedFlagWins) {
    const config::Settings settings =
        settings_of({"--set", "terrain.tau_px=4", "--set", "view.near_m=1", "--tau", "5"});
    EXPECT_EQ(settings.terrain.tau_px, 5.0);
    EXPECT_EQ(settings.view.near_m, 1.0);
}

TEST(CommandLine, HeadlessAloneOpensNoWindowAndKeepsAnotherOutput) {
    EXPECT_EQ(settings_of({}).output.kind, config::OutputKind::Window);
    EXPECT_EQ(settings_of({"--headless"}).output.kind, config::OutputKind::None);
    EXPECT_EQ(settings_of({"--headless", "--output", "p"}).output.kind, config::OutputKind::Pictures);
    EXPECT_EQ(settings_of({"--headless", "--set", "output.kind=video"}).output.kind,
              config::OutputKind::Video);
}

TEST(CommandLine, HelpAndVersionAreAnswers) {
    EXPECT_NE(parse({"--help"})->answer.value().find("Examples:"), std::string::npos);
    EXPECT_EQ(parse({"--version"})->answer.value(), "eyepoint 9.8.7\n");
}

class BadCommandLine : public testing::TestWithParam<std::vector<const char*>> {};

TEST_P(BadCommandLine, IsOneSentenceThatNamesTheFlag) {
    const auto line = parse(GetParam());
    const std::string fault = line ? load_settings(*line).error() : line.error();
    EXPECT_NE(fault.find(GetParam().front()), std::string::npos) << fault;
    EXPECT_EQ(fault.find('\n'), std::string::npos) << fault;
}

INSTANTIATE_TEST_SUITE_P(Faults, BadCommandLine,
                         testing::Values(std::vector<const char*>{"--bogus"},
                                         std::vector<const char*>{"--size", "640"},
                                         std::vector<const char*>{"--size", "640xtall"},
                                         std::vector<const char*>{"--set", "view.near_m"},
                                         std::vector<const char*>{"--port", "70000"},
                                         std::vector<const char*>{"--rate", "0"},
                                         std::vector<const char*>{"--show", "nothing"},
                                         std::vector<const char*>{"--window", "--none"},
                                         std::vector<const char*>{"--headless", "--window"},
                                         std::vector<const char*>{"--terrain"}));

}  // namespace
}  // namespace eyepoint::ig
