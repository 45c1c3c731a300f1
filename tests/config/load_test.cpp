#include "config/load.hpp"

#include <array>
#include <cstdlib>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "config/keys.hpp"
#include "config/value.hpp"
#include "tests/config/settings_file.hpp"

namespace eyepoint::config {
namespace {

using test::SettingsFile;

/// Three values that the key takes, different from each other and from its built-in value.
std::array<Value, 3> three_values(const Key& key) {
    const Value built_in = key.get(Settings{});
    std::vector<Value> candidates;
    if (key.kind == ValueKind::Text) {
        candidates = {std::string("one:1"), std::string("two:2"), std::string("three:3")};
    } else if (key.kind == ValueKind::Number) {
        for (const double part : {0.125, 0.25, 0.5, 0.75}) {
            candidates.emplace_back(key.minimum + part * (key.maximum - key.minimum));
        }
    } else if (key.kind == ValueKind::Whole) {
        for (const int more : {0, 1, 2, 3})
            candidates.emplace_back(static_cast<std::int64_t>(key.minimum) + more);
    } else {
        for (const auto choice : key.choices) candidates.emplace_back(std::string(choice));
    }
    std::erase(candidates, built_in);
    // A choice of two has one other value only: then flag and environment say the built-in one again.
    while (candidates.size() < 3)
        candidates.push_back(candidates.size() % 2 == 1 ? built_in : candidates.front());
    return {candidates[0], candidates[1], candidates[2]};
}

std::string plain(const Value& value) {
    const auto* text = std::get_if<std::string>(&value);
    return text != nullptr ? *text : toml_text(value);
}

/// One test a key: a later source wins over an earlier one, and the origin names it.
class EveryKey : public testing::TestWithParam<Key> {};

TEST_P(EveryKey, HasItsBuiltInValueWhereNothingElseIsSaid) {
    const Key& key = GetParam();
    const auto loaded = load({});
    ASSERT_TRUE(loaded) << loaded.error();
    EXPECT_EQ(key.get(loaded->settings), key.get(Settings{}));
    EXPECT_EQ(loaded->origins.at(key.full_name()).kind, Origin::Kind::BuiltIn);
    EXPECT_TRUE(check(key, key.get(Settings{}))) << "the built-in value is not one that the key takes";
}

TEST_P(EveryKey, FileWinsOverBuiltInEnvironmentOverFileFlagOverEnvironment) {
    const Key& key = GetParam();
    const auto [in_file, in_environment, in_flag] = three_values(key);
    const SettingsFile file(
        fmt::format("# comment\n[{}]\n{} = {}\n", key.section, key.name, toml_text(in_file)));

    LoadRequest request{.file = file.path()};
    auto loaded = load(request);
    ASSERT_TRUE(loaded) << loaded.error();
    EXPECT_EQ(key.get(loaded->settings), in_file);
    EXPECT_EQ(loaded->origins.at(key.full_name()).kind, Origin::Kind::File);
    EXPECT_EQ(loaded->origins.at(key.full_name()).where, file.path().string() + ":3");

    request.environment = {{key.variable(), plain(in_environment)}};
    loaded = load(request);
    ASSERT_TRUE(loaded) << loaded.error();
    EXPECT_EQ(key.get(loaded->settings), in_environment);
    EXPECT_EQ(loaded->origins.at(key.full_name()).kind, Origin::Kind::Environment);
    EXPECT_EQ(loaded->origins.at(key.full_name()).where, key.variable());

    request.overrides = {{key.full_name(), plain(in_flag), "--set"}};
    loaded = load(request);
    ASSERT_TRUE(loaded) << loaded.error();
    EXPECT_EQ(key.get(loaded->settings), in_flag);
    EXPECT_EQ(loaded->origins.at(key.full_name()).kind, Origin::Kind::Flag);
    EXPECT_EQ(loaded->origins.at(key.full_name()).where, "--set");
}

std::string test_name(const testing::TestParamInfo<Key>& info) {
    return fmt::format("{}_{}", info.param.section, info.param.name);
}

INSTANTIATE_TEST_SUITE_P(Settings, EveryKey, testing::ValuesIn(keys().begin(), keys().end()), test_name);

TEST(Load, TheTableReachesEveryFieldOfTheSettings) {
    // Fields as counted in settings.hpp; a new field needs a row in the table and a new number here.
    EXPECT_EQ(keys().size(), 53U);
    for (const Key& key : keys()) {
        for (const Key& other : keys()) {
            if (&key == &other) continue;
            Settings settings;
            key.set(settings, three_values(key)[0]);
            EXPECT_EQ(other.get(settings), other.get(Settings{}))
                << key.full_name() << " sets " << other.full_name();
        }
    }
}

TEST(Load, TheLastOfTwoFlagsForOneKeyWins) {
    const auto loaded =
        load({.overrides = {{"frame.rate_hz", "30", "--rate"}, {"frame.rate_hz", "50", "--set"}}});
    ASSERT_TRUE(loaded) << loaded.error();
    EXPECT_EQ(loaded->settings.frame.rate_hz, 50.0);
    EXPECT_EQ(loaded->origins.at("frame.rate_hz").where, "--set");
}

TEST(Load, ANumberMayBeWrittenWithoutAFractionInTheFile) {
    const SettingsFile file("frame.rate_hz = 30\n");
    const auto loaded = load({.file = file.path()});
    ASSERT_TRUE(loaded) << loaded.error();
    EXPECT_EQ(loaded->settings.frame.rate_hz, 30.0);
}

TEST(Load, AnEmptyFileAndEmptySectionsChangeNothing) {
    for (const auto* content : {"", "\n# nothing\n", "[terrain]\n[view]\n"}) {
        const SettingsFile file(content);
        EXPECT_TRUE(load({.file = file.path()})) << content;
    }
}

TEST(Load, OtherProgramsVariablesAndTheTestDataFolderAreLetPass) {
    EXPECT_TRUE(load({.environment = {{"HOME", "/"}, {"EYEPOINTER", "x"}, {"EYEPOINT_REAL_DATA", "/data"}}}));
}

TEST(Load, TheProcessEnvironmentIsRead) {
    ASSERT_EQ(setenv("EYEPOINT_FRAME_RATE_HZ", "25", 1), 0);
    const auto loaded = load({.environment = process_environment()});
    unsetenv("EYEPOINT_FRAME_RATE_HZ");
    ASSERT_TRUE(loaded) << loaded.error();
    EXPECT_EQ(loaded->settings.frame.rate_hz, 25.0);
}

}  // namespace
}  // namespace eyepoint::config
