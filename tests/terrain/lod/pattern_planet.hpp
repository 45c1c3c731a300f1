/// A small planet of nested meshes made by rule, not by the compiler: for tests of what draws them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "terrain/database/database.hpp"

namespace eyepoint::testing {

/// Every tile down to a depth is stored as a whole grid; virtual tiles follow below. A tile's odd posts (row
/// or column odd) go, each at a level of its own between the tile's first and last that depends on the post
/// alone, to the even post before them; the even ones stay. Hills of 300 m, heights in sixteenths of a metre.
struct PatternPlanet {
    std::uint32_t depth = 3;
    bool one_level = false;  ///< all odd posts of a tile go at its last level
};

inline constexpr double kPatternHeightStepM = 1.0 / 16.0;

[[nodiscard]] terrain::NodeInfo pattern_node(const PatternPlanet& planet, std::uint32_t depth);
[[nodiscard]] terrain::BlockData pattern_block(terrain::TileId tile);
[[nodiscard]] terrain::NestedMesh pattern_mesh(const PatternPlanet& planet, terrain::TileId tile);

/// Writes it into a folder, which must not exist, and opens it. Throws std::runtime_error with the sentence.
[[nodiscard]] std::shared_ptr<const terrain::Database> make_pattern_database(
    const PatternPlanet& planet, const std::filesystem::path& folder);

}  // namespace eyepoint::testing
