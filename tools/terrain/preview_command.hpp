/// `eyepoint-terrain preview`: a shaded relief picture as a PNG file.
#pragma once

#include <CLI/CLI.hpp>

namespace eyepoint::tools {

/// Adds the subcommand. When chosen it runs while the application parses; a failure ends as
/// CLI::RuntimeError(1) after one line on stderr.
void add_preview_command(CLI::App& application);

}  // namespace eyepoint::tools
