#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "config/keys.hpp"
#include "config/load.hpp"
#include "tests/config/settings_file.hpp"

namespace eyepoint::config {
namespace {

using test::SettingsFile;
using testing::ContainsRegex;
using testing::HasSubstr;

TEST(Print, SaysTheValueInForceAndWhereItCameFrom) {
    const SettingsFile file("[terrain]\ntau_px = 2.5\n");
    const auto loaded = load({.file = file.path(),
                              .environment = {{"EYEPOINT_FRAME_RATE_HZ", "30"}},
                              .overrides = {{"output.kind", "none", "--none"}}});
    ASSERT_TRUE(loaded) << loaded.error();
    const auto text = print(*loaded);
    EXPECT_THAT(text, ContainsRegex("tau_px = 2\\.5 +# file .*eyepoint\\.toml:2\n"));
    EXPECT_THAT(text, ContainsRegex("rate_hz = 30\\.0 +# environment EYEPOINT_FRAME_RATE_HZ\n"));
    EXPECT_THAT(text, ContainsRegex("kind = \"none\" +# flag --none\n"));
    EXPECT_THAT(text, ContainsRegex("width_px = 1280 +# built-in\n"));
}

TEST(Print, AnOriginCannotBreakOutOfItsComment) {
    const auto loaded = load({.overrides = {{"frame.rate_hz", "30", "--set\n[frame]\nrate_hz = 1"}}});
    ASSERT_TRUE(loaded) << loaded.error();
    EXPECT_THAT(print(*loaded), HasSubstr("# flag --set?[frame]?rate_hz = 1\n"));
}

/// Text of letters, quotes, backslashes, brackets and characters of two to four bytes.
std::string any_text() {
    const auto pieces = *rc::gen::container<std::vector<std::string>>(rc::gen::element<std::string>(
        "a", "/", " ", "\"", "\\", "'", "#", "=", "[", "]", "\"\"\"", "\\u", "{", "}", "é", "山", "🏔"));
    std::string text;
    for (const auto& piece : pieces) text += piece;
    return text;
}

Value any_value(const Key& key) {
    switch (key.kind) {
        case ValueKind::Text:
            return key.accepts == nullptr ? any_text()
                                          : "host:" + std::to_string(*rc::gen::inRange(1, 65536));
        case ValueKind::Number: {
            const auto share = static_cast<double>(*rc::gen::arbitrary<std::uint32_t>()) / 4294967295.0;
            return std::lerp(key.minimum, key.maximum, share);
        }
        case ValueKind::Whole:
            return *rc::gen::inRange(static_cast<std::int64_t>(key.minimum),
                                     static_cast<std::int64_t>(key.maximum) + 1);
        case ValueKind::Choice:
            break;
    }
    return std::string(key.choices[*rc::gen::inRange<std::size_t>(0, key.choices.size())]);
}

RC_GTEST_PROP(Print, ReadsBackToTheSameValuesBitForBit, ()) {
    LoadedSettings written;
    for (const Key& key : keys()) key.set(written.settings, any_value(key));
    const SettingsFile file(print(written));
    const auto read = load({.file = file.path()});
    RC_ASSERT(read.has_value());
    for (const Key& key : keys()) RC_ASSERT(key.get(read->settings) == key.get(written.settings));
}

}  // namespace
}  // namespace eyepoint::config
