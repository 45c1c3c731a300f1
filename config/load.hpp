/// Loading the settings: built-in values, then a TOML file, then the environment, then flags; the later one
/// wins. Thread use: plain functions of their arguments.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <tl/expected.hpp>

#include "config/settings.hpp"

namespace eyepoint::config {

/// Where a value came from.
struct Origin {
    enum class Kind : std::uint8_t { BuiltIn, File, Environment, Flag };
    Kind kind = Kind::BuiltIn;
    /// "eyepoint.toml:12", "EYEPOINT_TERRAIN_TAU_PX", the flag as the caller named it; empty for a built-in
    /// value.
    std::string where;
};

/// A value given on the command line.
struct Override {
    std::string key;    ///< "section.name", as in the file
    std::string value;  ///< as in the environment: text without quotes
    std::string flag;   ///< what the user typed, for messages: "--headless", "--set terrain.tau_px=2"
};

using EnvironmentVariables = std::vector<std::pair<std::string, std::string>>;

struct LoadRequest {
    std::optional<std::filesystem::path> file{};  ///< none: no file is read
    /// The variables to look at. EYEPOINT_<SECTION>_<NAME> sets section.name; another name that begins with
    /// EYEPOINT_ is an error, except those of other_environment_variables(). Names without the prefix are
    /// ignored.
    EnvironmentVariables environment{};
    std::vector<Override> overrides{};  ///< a later one wins over an earlier one
};

struct LoadedSettings {
    Settings settings;
    std::map<std::string, Origin> origins;  ///< one for every key
};

/// On failure: one sentence with where it is (file and line, variable or flag), the key, what was found and
/// what was expected; where there are several faults the first, and how many more.
[[nodiscard]] tl::expected<LoadedSettings, std::string> load(const LoadRequest& request);

/// The settings in force as a TOML file that load() reads back to the same values, each line with a comment
/// that says where its value came from.
[[nodiscard]] std::string print(const LoadedSettings& loaded);

/// The variables of this process, for LoadRequest::environment.
[[nodiscard]] EnvironmentVariables process_environment();

/// Variables with the prefix EYEPOINT_ that are not settings, for people: they are let pass.
[[nodiscard]] std::span<const std::string_view> other_environment_variables();

}  // namespace eyepoint::config
