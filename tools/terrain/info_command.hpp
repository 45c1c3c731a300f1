/// `eyepoint-terrain info`: what a terrain database holds.
#pragma once

#include <CLI/CLI.hpp>

namespace eyepoint::tools {

/// Adds the subcommand. When chosen it runs while the application parses; a failure ends as
/// CLI::RuntimeError(1) after one line on stderr.
void add_info_command(CLI::App& application);

}  // namespace eyepoint::tools
