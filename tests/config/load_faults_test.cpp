#include <filesystem>
#include <ostream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/load.hpp"
#include "tests/config/settings_file.hpp"

namespace eyepoint::config {
namespace {

using test::SettingsFile;
using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

struct FileFault {
    const char* name;
    std::string content;
    int line;
    std::string says;  ///< the rest of the message, or a part of it
};

void PrintTo(const FileFault& fault, std::ostream* out) { *out << fault.content; }

class FaultInFile : public testing::TestWithParam<FileFault> {};

TEST_P(FaultInFile, IsOneLineWithFileLineKeyAndWhatWasExpected) {
    const SettingsFile file(GetParam().content);
    const auto loaded = load({.file = file.path()});
    ASSERT_FALSE(loaded);
    const auto where = file.path().string() + ":" + std::to_string(GetParam().line) + ": ";
    EXPECT_THAT(loaded.error(), AllOf(StartsWith(where), HasSubstr(GetParam().says), Not(HasSubstr("\n"))));
}

const FileFault kFaults[] = {
    {"UnknownKey", "[terrain]\n\ndatabse = \"x\"\n", 3,
     "unknown key 'terrain.databse'; did you mean 'terrain.database'?"},
    {"UnknownKeyLikeNothing", "[terrain]\nzzzzzzzz = 1\n", 2,
     "unknown key 'terrain.zzzzzzzz'; --print-config lists every key"},
    {"KeyInTheWrongSection", "[view]\ntau_px = 2\n", 2,
     "unknown key 'view.tau_px'; did you mean 'terrain.tau_px'?"},
    {"KeyOutsideEverySection", "tau_px = 2\n", 1, "unknown key 'tau_px'; did you mean 'terrain.tau_px'?"},
    {"UnknownSection", "[terain]\n", 1, "unknown section 'terain'; did you mean 'terrain'?"},
    {"UnknownSectionLikeNothing", "[weather]\n", 1, "the sections are terrain, host, view"},
    {"KeyInUnknownSection", "[terain]\ndatabase = \"x\"\n", 2,
     "unknown key 'terain.database'; did you mean 'terrain.database'?"},
    {"ValueForASection", "terrain = 3\n", 1, "'terrain' is a value; expected the section [terrain]"},
    {"TooLarge", "[terrain]\ntau_px = 500\n", 2, "terrain.tau_px is 500; expected a number from 0.1 to 100"},
    {"TooSmall", "[view]\nwidth_px = 15\n", 2,
     "view.width_px is 15; expected a whole number from 16 to 16384"},
    {"PastTheFieldsType", "[host]\nport = 65536\n", 2, "expected a whole number from 0 to 65535"},
    {"Negative", "[frame]\nframes = -1\n", 2, "frame.frames is -1"},
    {"FractionForAWholeNumber", "[view]\nwidth_px = 1280.5\n", 2,
     "view.width_px is 1280.5; expected a whole number"},
    {"NotANumber", "[frame]\nrate_hz = nan\n", 2, "frame.rate_hz is nan; expected a number from 1 to 1000"},
    {"Infinite", "[frame]\nrate_hz = inf\n", 2, "frame.rate_hz is inf"},
    {"TextForANumber", "[frame]\nrate_hz = \"60\"\n", 2, "frame.rate_hz is \"60\"; expected a number"},
    {"NumberForText", "[terrain]\ndatabase = 3\n", 2, "terrain.database is 3; expected text"},
    {"TruthValue", "[frame]\nrate_hz = true\n", 2, "frame.rate_hz is true or false; expected a number"},
    {"Date", "[frame]\nrate_hz = 2026-01-01\n", 2, "frame.rate_hz is a date or time; expected a number"},
    {"Array", "[frame]\nrate_hz = [60]\n", 2, "frame.rate_hz is an array; expected a number"},
    {"Table", "[frame.rate_hz]\nx = 1\n", 1, "frame.rate_hz is a table; expected a number"},
    {"UnknownChoice", "[output]\nkind = \"movie\"\n", 2,
     "output.kind is \"movie\"; expected \"window\", \"pictures\", \"video\" or \"none\""},
    {"HostWithoutPort", "[host]\nanswer_to = \"10.0.0.1\"\n", 2, "expected \"HOST:PORT\" or nothing"},
    {"PortOutOfRange", "[host]\nanswer_to = \"sim:65536\"\n", 2, "expected \"HOST:PORT\" or nothing"},
    {"TextOfTwoLines", "[terrain]\ndatabase = \"a\\nb\"\n", 2, "terrain.database is"},
    {"DuplicateKey", "[frame]\nrate_hz = 60\nrate_hz = 30\n", 3, "not valid TOML"},
    {"DuplicateSection", "[frame]\n[view]\n[frame]\n", 3, "not valid TOML"},
    {"OpenText", "[terrain]\ndatabase = \"x\n", 2, "not valid TOML"},
    {"NoValue", "[terrain]\n\n\ntau_px =\n", 4, "not valid TOML"},
    {"NotToml", "tau_px: 2\n", 1, "not valid TOML"},
    {"NotUtf8", "[terrain]\ndatabase = \"\xFF\"\n", 2, "not valid TOML"},
};

INSTANTIATE_TEST_SUITE_P(Settings, FaultInFile, testing::ValuesIn(kFaults),
                         [](const auto& fault) { return std::string(fault.param.name); });

TEST(LoadFaults, AMissingFileIsNamed) {
    const auto loaded = load({.file = "/nowhere/eyepoint.toml"});
    ASSERT_FALSE(loaded);
    EXPECT_EQ(loaded.error(),
              "/nowhere/eyepoint.toml: settings file cannot be read: No such file or directory");
}

TEST(LoadFaults, AFolderIsNoSettingsFile) {
    const auto loaded = load({.file = std::filesystem::temp_directory_path()});
    ASSERT_FALSE(loaded);
    EXPECT_THAT(loaded.error(), EndsWith("it is a folder"));
}

TEST(LoadFaults, AnEndlessFileIsRefusedWithoutReadingAllOfIt) {
    const auto loaded = load({.file = "/dev/zero"});
    ASSERT_FALSE(loaded);
    EXPECT_THAT(loaded.error(), HasSubstr("larger than 1 MiB"));
}

TEST(LoadFaults, TheFirstOfSeveralIsToldAndTheRestCounted) {
    const SettingsFile file("[view]\nwidth_px = 1\nheight_px = 1\n[frame]\nrate_hz = 0\n");
    auto loaded = load({.file = file.path()});
    ASSERT_FALSE(loaded);
    EXPECT_THAT(loaded.error(), AllOf(HasSubstr(":2: view.width_px is 1;"), EndsWith("(and 2 more faults)")));
    loaded = load({.overrides = {{"view.width_px", "1", "--size"}, {"view.height_px", "1", "--size"}}});
    ASSERT_FALSE(loaded);
    EXPECT_THAT(loaded.error(), EndsWith("(and 1 more fault)"));
}

TEST(LoadFaults, AnUnknownVariableWithOurPrefixIsAnError) {
    const auto loaded = load({.environment = {{"EYEPOINT_TERAIN_DATABASE", "x"}}});
    ASSERT_FALSE(loaded);
    EXPECT_EQ(
        loaded.error(),
        "unknown environment variable 'EYEPOINT_TERAIN_DATABASE'; did you mean 'EYEPOINT_TERRAIN_DATABASE'?");
}

TEST(LoadFaults, AWrongValueInAVariableNamesTheVariable) {
    const auto loaded = load({.environment = {{"EYEPOINT_VIEW_WIDTH_PX", "wide"}}});
    ASSERT_FALSE(loaded);
    EXPECT_EQ(loaded.error(),
              "EYEPOINT_VIEW_WIDTH_PX: view.width_px is \"wide\"; expected a whole number from 16 to 16384");
}

TEST(LoadFaults, TextThatOnlyBeginsWithANumberIsNoNumber) {
    for (const auto* text : {"60Hz", " 60", "60 ", "", "6e", "nan", "0x10", "1e999"}) {
        EXPECT_FALSE(load({.overrides = {{"frame.rate_hz", text, "--set"}}})) << '"' << text << '"';
    }
}

TEST(LoadFaults, AnUnknownKeyOfAFlagNamesTheFlagAndANearMatch) {
    const auto loaded = load({.overrides = {{"frame.rate", "60", "--set frame.rate=60"}}});
    ASSERT_FALSE(loaded);
    EXPECT_EQ(loaded.error(), "--set frame.rate=60: unknown key 'frame.rate'; did you mean 'frame.rate_hz'?");
}

TEST(LoadFaults, AMessageStaysOneShortLineWhateverWasTyped) {
    const auto loaded = load({.overrides = {{"a\nb" + std::string(5000, 'x'), "\xFF", "--set"}}});
    ASSERT_FALSE(loaded);
    EXPECT_THAT(loaded.error(), Not(HasSubstr("\n")));
    EXPECT_LT(loaded.error().size(), 400U);
}

}  // namespace
}  // namespace eyepoint::config
