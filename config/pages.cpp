#include "config/pages.hpp"

#include <algorithm>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "config/keys.hpp"
#include "config/load.hpp"
#include "config/value.hpp"

namespace eyepoint::config {
namespace {

constexpr std::string_view kSampleHead =
    "# Settings of eyepoint, every one at its built-in value. Use it with: eyepoint --config eyepoint.toml\n"
    "# A key left out keeps its built-in value. Order: built-in, this file, environment, flag; the later one "
    "wins.\n"
    "# Relative paths start from the folder that eyepoint is started in.\n"
    "# Written from the table in config/keys.cpp by the build target settings-pages; change it there.\n";

constexpr std::string_view kReferenceHead =
    "# Settings\n\n"
    "Each setting has one name, `section.key`, and four places it can come from. The later one wins:\n\n"
    "1. the built-in value, below;\n"
    "2. the file given with `--config FILE` ([TOML](https://toml.io)); "
    "[config/eyepoint.toml](../config/eyepoint.toml)"
    " is one with every key in it;\n"
    "3. the environment: `EYEPOINT_<SECTION>_<KEY>`, such as `EYEPOINT_TERRAIN_TAU_PX=2`;\n"
    "4. a flag: `--set terrain.tau_px=2`, or one of the short flags in `eyepoint --help`.\n\n"
    "`eyepoint --print-config` shows what is in force and where each value came from. An unknown name or a "
    "wrong value\n"
    "ends the program with one line that says where it stands and what was expected. Relative paths start "
    "from the\n"
    "folder that `eyepoint` is started in.\n";

constexpr std::string_view kReferenceTail =
    "\nThis page is written from the table in `config/keys.cpp` by the build target `settings-pages`.\n";

/// Text that may stand in a cell of a Markdown table.
std::string cell(std::string_view text) {
    std::string result;
    for (const char c : text) {
        if (c == '|' || c == '<') result += '\\';
        result += c;
    }
    return result;
}

std::string sample_key(const Key& key) {
    const auto takes = key.kind == ValueKind::Text ? "" : fmt::format(" ({})", expected_of(key));
    return fmt::format("# {}{}.\n{} = {}\n", key.description, takes, key.name,
                       toml_text(key.get(Settings{})));
}

std::string other_variables() {
    std::vector<std::string> names;
    for (const std::string_view name : other_environment_variables())
        names.push_back(fmt::format("`{}`", name));
    return fmt::format(
        "\nVariables that begin with `EYEPOINT_` and are not settings are errors too, except {} (the data "
        "that tests on\n"
        "real data read).\n",
        fmt::join(names, ", "));
}

}  // namespace

std::string sample_file() {
    std::string text(kSampleHead);
    for (const Section& section : sections()) {
        text += fmt::format("\n# {}\n[{}]\n", section.description, section.name);
        for (const Key& key : keys()) {
            if (key.section == section.name) text += sample_key(key);
        }
    }
    return text;
}

std::string reference_page() {
    std::string text(kReferenceHead);
    text += other_variables();
    for (const Section& section : sections()) {
        text += fmt::format(
            "\n## `[{}]`\n\n{}.\n\n| key | takes | built-in | what it is |\n| --- | --- | --- | --- |\n",
            section.name, section.description);
        for (const Key& key : keys()) {
            if (key.section != section.name) continue;
            text += fmt::format("| `{}` | {} | `{}` | {} |\n", key.name, cell(expected_of(key)),
                                toml_text(key.get(Settings{})), cell(key.description));
        }
    }
    return text + std::string(kReferenceTail);
}

}  // namespace eyepoint::config
