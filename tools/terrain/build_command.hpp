/// `eyepoint-terrain build`: DEM and imagery files, read through GDAL, into a terrain database.
#pragma once

#include <CLI/CLI.hpp>

namespace eyepoint::tools {

/// Adds the subcommand `build` and its options. When chosen it runs while the application parses; a failed
/// build ends as CLI::RuntimeError(1) after one line on stderr, with nothing written.
void add_build_command(CLI::App& application);

}  // namespace eyepoint::tools
