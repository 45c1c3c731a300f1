/// The command line of `eyepoint`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "config/load.hpp"

namespace eyepoint::ig {

struct CommandLine {
    std::optional<std::filesystem::path> config_file;
    std::vector<config::Override> overrides;  ///< flags as settings, in the order in which they win
    bool headless = false;                    ///< no window; an output set elsewhere stays
    bool print_config = false;
    bool gl_debug = false;
    /// What --help or --version print: the program then ends with success.
    std::optional<std::string> answer;
};

/// On failure: one sentence.
[[nodiscard]] tl::expected<CommandLine, std::string> parse_command_line(int argc, const char* const* argv,
                                                                        const std::string& version);

/// The settings in force: built in, file, environment, flags. On failure: one sentence.
[[nodiscard]] tl::expected<config::LoadedSettings, std::string> load_settings(
    const CommandLine& command_line);

}  // namespace eyepoint::ig
