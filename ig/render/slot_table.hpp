/// Which tile has which of a fixed number of places on the graphics card; the longest unused is given away
/// first.
#pragma once

#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "terrain/tiling/tile_id.hpp"

namespace eyepoint::ig {

class SlotTable {
  public:
    struct Placement {
        std::uint32_t slot = 0;
        bool fresh = false;  ///< newly given to this tile: its content is to be uploaded
    };

    explicit SlotTable(std::uint32_t slots) : slots_(slots) {}

    /// The tile's slot. A slot given out in this frame keeps its tile for the whole frame; none when all
    /// slots have been given out in this frame.
    [[nodiscard]] std::optional<Placement> place(terrain::TileId tile, std::uint64_t frame);

    [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(slots_.size()); }
    /// Adds free slots behind the present ones.
    void grow_to(std::uint32_t slots) { slots_.resize(slots); }

  private:
    struct Slot {
        terrain::TileId tile;
        std::uint64_t used_frame = 0;
        bool occupied = false;
    };
    std::vector<Slot> slots_;
    std::unordered_map<terrain::TileId, std::uint32_t, terrain::TileHash> slot_by_tile_;
};

}  // namespace eyepoint::ig
