/// The finest level of every tile's nested mesh: where its own mesh takes over from its children's.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <unordered_map>

#include <tl/expected.hpp>

#include "terrain/database/database.hpp"

namespace eyepoint::tools {

/// By tile. Rises by at least two from a tile to its parent; bare_level(tile) where a tile has no children.
using FirstLevels = std::unordered_map<terrain::TileId, std::uint8_t, terrain::TileHash>;

/// Any levels that rise towards the root are right; these make a tile take over when about a tile's worth of
/// triangles is left: when the error allowed reaches kRoughness times what all but a few of the children's
/// posts deviate from the tile's own grid. A lone spike does not raise it: its post stays a vertex, at
/// whatever depth. Reads every block once. On failure: one sentence.
[[nodiscard]] tl::expected<FirstLevels, std::string> first_levels(const terrain::Database& heights);

}  // namespace eyepoint::tools
