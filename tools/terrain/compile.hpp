/// Compiling a surface into a terrain database: the tree, each node's height range and error, shards.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include <tl/expected.hpp>

#include "terrain/database/database.hpp"
#include "terrain/geodesy/geoid.hpp"
#include "tools/terrain/surface_source.hpp"

namespace eyepoint::tools {

struct CompileRequest {
    const ElevationSource* elevation = nullptr;
    const ImagerySource* imagery = nullptr;  ///< may be null
    const terrain::Geoid* geoid = nullptr;
    terrain::Manifest manifest;  ///< name, sources, voids; the compiler fills in the rest
    std::filesystem::path output;
    double height_step_m = 1.0 / 16.0;
    /// Called from the compiling thread with tiles done and tiles to do; may be empty.
    std::function<void(std::uint64_t done, std::uint64_t total)> progress;
    /// Asked now and then; true ends the build, leaving nothing behind. May be empty.
    std::function<bool()> cancelled;
};

/// Returns the manifest as written. On failure: one sentence.
[[nodiscard]] tl::expected<terrain::Manifest, std::string> compile_database(const CompileRequest& request);

}  // namespace eyepoint::tools
