/// The second half of compiling a database: from the heights of all tiles, their nested meshes (docs/lod.md).
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include <tl/expected.hpp>

#include "terrain/database/database.hpp"

namespace eyepoint::tools {

/// A tile whose mesh is done.
struct NestedTile {
    terrain::NodeInfo info;  ///< as stored, with the mesh's levels
    const terrain::BlockData& block;
    const terrain::NestedMesh& mesh;
};

/// Makes every tile's mesh, children before parents, and hands it on, from several threads at once; what
/// `put` fails with ends it. On failure: one sentence.
[[nodiscard]] tl::expected<void, std::string> make_nested_meshes(
    const terrain::Database& heights,
    const std::function<tl::expected<void, std::string>(const NestedTile& tile)>& put);

}  // namespace eyepoint::tools
