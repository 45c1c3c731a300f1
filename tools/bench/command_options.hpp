/// What the bench's commands have in common on their command lines.
#pragma once

#include <filesystem>
#include <string>

#include <CLI/CLI.hpp>

#include "terrain/lod/hyperblock/hyperblock_options.hpp"
#include "terrain/lod/selective/selective_options.hpp"
#include "terrain/lod/tile/tile_options.hpp"
#include "tools/bench/bench_run.hpp"

namespace eyepoint::tools {

/// Ends the program with exit code 1 and one line on the standard error.
[[noreturn]] void fail(const std::string& sentence);

/// Writes text beside its place and renames it when whole; ends the program where it cannot.
void write_or_fail(const std::filesystem::path& file, const std::string& text);

/// --size WIDTHxHEIGHT. `size` outlives the parsing.
void add_size_option(CLI::App& command, ig::PictureSize& size);

/// --cache, --screen-error. `options` outlives the parsing.
void add_selective_options(CLI::App& command, terrain::selective::Options& options);

/// --tile-posts, --morph-by, --rebuilds. `options` outlives the parsing.
void add_tile_options(CLI::App& command, terrain::tiles::Options& options);

/// --hyper-select, --hyper-level, --hyper-blocks-tau. `options` outlives the parsing.
void add_hyperblock_options(CLI::App& command, terrain::hyperblock::Options& options);

/// --terrain, --size, --tau, --lod, --triangles, those of selective, tile and hyperblock, --pictures,
/// --every, --record, --sentinel. `options` outlives the parsing.
void add_drawing_options(CLI::App& command, BenchOptions& options, bool terrain_required);

void add_flight_command(CLI::App& program);
void add_field_command(CLI::App& program);
void add_measure_command(CLI::App& program);
void add_goals_command(CLI::App& program);
void add_compare_command(CLI::App& program);
void add_control_command(CLI::App& program);
void add_papers_command(CLI::App& program);

}  // namespace eyepoint::tools
