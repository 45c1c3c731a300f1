/// Floors of edges while blocks are missing: what meets a block that is drawn coarser than the view asks for.
#pragma once

#include <cstdint>
#include <span>

#include "terrain/lod/lod_method.hpp"

namespace eyepoint::terrain {

/// A starved block is drawn at its first level though a finer one is asked for: its edges lack vertices that
/// its neighbours have. Gives it and, across its edges, the drawn blocks beside it that level as a floor; and
/// where a neighbour is so coarse that half its edge reaches beyond the starved block, whatever else meets
/// that half. Ends of a half need nothing: the vertices there are corners of a tile on the finer side, and
/// stay in it. `starved`: numbers of draws. Marks the drawn nodes with the frame's number.
void spread_floors(std::span<BlockDraw> draws, std::span<const std::uint32_t> starved, TileTree& tree,
                   std::uint64_t frame);

}  // namespace eyepoint::terrain
