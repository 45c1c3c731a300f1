/// Where the vertices of a tile are drawn while it goes from one level to the next: tables 3 and 4 of Larsen
/// & Christensen (2.3), and the vertex shader's computation (ig/render/shaders/tile_slide.glsl) on the CPU.
#pragma once

#include <array>
#include <cstdint>
#include <utility>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "terrain/block/block.hpp"
#include "terrain/lod/lod_method.hpp"
#include "terrain/lod/tile/tile_mesh.hpp"

namespace eyepoint::terrain::tiles {

/// Table 3. The two posts between which a post of level l that level l + 1 does not have lies in the mesh of
/// level l + 1, given and returned as (column, row) in steps of level l from the tile's south-west: on a side
/// or on the diagonal of a cell of level l + 1, which runs from its fan's middle to a corner. The post slides
/// to their mean. Only of posts with an odd coordinate.
[[nodiscard]] std::pair<glm::ivec2, glm::ivec2> ends_of(glm::ivec2 post);

/// How fine a tile is drawn, comparable over depths: `resolution` rises by one where posts are half as far
/// apart; the mesh is that of `resolution`, and its posts have slid by `slid` / kSlideSteps towards that of
/// resolution - 1.
struct Fineness {
    int resolution = 0;
    int slid = 0;  ///< 0..kSlideSteps
    bool operator==(const Fineness&) const = default;
};
/// Table 4, for both tiles beside an edge: what the edge between them is drawn as. A border morphs with the
/// coarser tile, with the one that slides at the coarser level, or with the one that has slid farther.
/// Resolutions differ by one at most.
[[nodiscard]] Fineness border(const Fineness& tile, const Fineness& beside);

/// What the posts of a tile do, from what it and its neighbours are drawn as; by edge (kEdges) and half.
/// beside: nullptr where nothing is drawn.
[[nodiscard]] TileSlide slide_of(int part, int level, const Fineness& tile,
                                 const std::array<const Fineness*, 8>& beside);

/// Position of a grid's vertex relative to the eye, metres, ECEF axes. parts: LodMethod::sliding_parts().
/// Vertices on an edge have the same bits from both sides.
[[nodiscard]] glm::vec3 slid_vertex(const Block& block, std::uint16_t vertex, const TileSlide& slide,
                                    int parts, const SplitPosition& eye);

}  // namespace eyepoint::terrain::tiles
