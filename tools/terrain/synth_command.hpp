/// `eyepoint-terrain synth`: a procedural planet with a mountain region, as a terrain database.
#pragma once

#include <CLI/CLI.hpp>

namespace eyepoint::tools {

/// Adds the subcommand. When chosen it runs while the application parses; a failure ends as
/// CLI::RuntimeError(1) after one line on stderr, with nothing written.
void add_synth_command(CLI::App& application);

}  // namespace eyepoint::tools
