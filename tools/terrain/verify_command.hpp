/// `eyepoint-terrain verify`: whether a terrain database is whole and true.
#pragma once

#include <CLI/CLI.hpp>

namespace eyepoint::tools {

/// Adds the subcommand. When chosen it runs while the application parses; faults end as CLI::RuntimeError(1)
/// after a line on stderr for each.
void add_verify_command(CLI::App& application);

}  // namespace eyepoint::tools
