#include "config/pages.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "config/keys.hpp"
#include "config/load.hpp"

namespace eyepoint::config {
namespace {

const std::filesystem::path kSource = EYEPOINT_SOURCE_DIR;
constexpr const char* kRemedy = "behind the table: build the target settings-pages";

std::string content_of(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(SettingsPages, TheShippedSampleSaysEveryKeyAtItsBuiltInValue) {
    const auto loaded = load({.file = kSource / "config/eyepoint.toml"});
    ASSERT_TRUE(loaded) << loaded.error();
    for (const Key& key : keys()) {
        EXPECT_EQ(key.get(loaded->settings), key.get(Settings{})) << key.full_name();
        EXPECT_EQ(loaded->origins.at(key.full_name()).kind, Origin::Kind::File) << key.full_name();
    }
}

TEST(SettingsPages, TheSampleInTheTreeFollowsTheTable) {
    EXPECT_EQ(content_of(kSource / "config/eyepoint.toml"), sample_file()) << kRemedy;
}

TEST(SettingsPages, TheManualPageInTheTreeFollowsTheTable) {
    EXPECT_EQ(content_of(kSource / "docs/settings.md"), reference_page()) << kRemedy;
}

}  // namespace
}  // namespace eyepoint::config
