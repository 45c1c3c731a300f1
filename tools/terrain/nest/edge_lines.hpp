/// How the vertices on tiles' edges go when meshes get coarser: a function of the line alone, so that the
/// tiles on both sides agree at every level.
///
/// A line is an arm of the cross between a tile's four children, or a side of a root. On it the vertices go
/// one by one, each into a neighbour on the line that is still there, when the polyline without it stays
/// within the level's error of every post on the line (distance in space between points of equal latitude and
/// longitude). A vertex at the corner of a tile stays as long as a mesh with that corner may be drawn: until
/// the first level of the parents on both sides. A whole line ends when the tile whose cross it is takes
/// over: from there its vertices are inner ones.
///
/// Where an arm ends at its tile's edge, the vertex next to that end stays on the arm, and in the tile's mesh
/// until the end itself has gone: without this guard inner vertices would stand between the two neighbours
/// that the end slides along, and its triangles would fold over them.
///
/// Beside a tile without children, posts of deeper tiles lie on the line too, interpolated: those of depth m
/// go at virtual_post_level(m), into the neighbour before them, as those of virtual tiles do
/// (terrain/database/virtual_tile.hpp).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include <tl/expected.hpp>

#include "terrain/database/database.hpp"
#include "tools/terrain/nest/first_levels.hpp"

namespace eyepoint::tools {

/// Places along a line: kPlaceUnits a side of a root tile, from the south pole or from 180 W. So a tile of
/// depth d has a side of kPlaceUnits >> d.
struct LineVertex {
    std::uint32_t at = 0;
    float height_m = 0.0F;
    std::uint8_t gone_level = terrain::NestedMesh::kStays;  ///< kStays: there until the line ends
    std::uint32_t target_at = 0;
};

/// A vertex that must not go before another: places in a tile.
struct MeshGuard {
    std::int64_t x = 0;
    std::int64_t y = 0;
    std::int64_t end_x = 0;
    std::int64_t end_y = 0;
};

class EdgeLines {
  public:
    /// Makes all lines. `heights` and `levels` are not kept. On failure: one sentence.
    [[nodiscard]] static tl::expected<EdgeLines, std::string> make(const terrain::Database& heights,
                                                                   const FirstLevels& levels);

    /// The line that an edge of a tile lies on, all of it, rising.
    [[nodiscard]] std::span<const LineVertex> line(terrain::TileId tile, terrain::Edge edge) const;

    /// The guards of a tile with children, one an arm.
    [[nodiscard]] std::array<MeshGuard, 4> guards(terrain::TileId tile) const;

    /// What becomes of a place on the line of a tile's edge, found or interpolated (see above).
    [[nodiscard]] static LineVertex vertex_at(std::span<const LineVertex> line, terrain::TileId tile,
                                              terrain::Edge edge, std::uint32_t at);

  private:
    using Cross = std::array<std::vector<LineVertex>, 4>;
    std::unordered_map<terrain::TileId, Cross, terrain::TileHash> crosses_;
    /// By root: west side, south side, north side.
    std::array<std::array<std::vector<LineVertex>, 3>, 2> root_sides_;
};

/// Where a tile's edge lies along its line: places of its start and end.
[[nodiscard]] constexpr std::uint32_t edge_start(terrain::TileId tile, terrain::Edge edge) {
    const bool along_x = edge == terrain::Edge::South || edge == terrain::Edge::North;
    return (along_x ? tile.x : tile.y) * (terrain::kPlaceUnits >> tile.depth);
}

}  // namespace eyepoint::tools
