#include "ig/render/slot_table.hpp"

#include <algorithm>

namespace eyepoint::ig {

std::optional<SlotTable::Placement> SlotTable::place(terrain::TileId tile, std::uint64_t frame) {
    if (const auto found = slot_by_tile_.find(tile); found != slot_by_tile_.end()) {
        slots_[found->second].used_frame = frame;
        return Placement{found->second, false};
    }
    const auto age = [](const Slot& slot) { return slot.occupied ? slot.used_frame + 1 : 0; };
    const auto oldest = std::min_element(slots_.begin(), slots_.end(),
                                         [&](const Slot& a, const Slot& b) { return age(a) < age(b); });
    if (oldest->occupied && oldest->used_frame == frame) return std::nullopt;
    if (oldest->occupied) slot_by_tile_.erase(oldest->tile);
    *oldest = {tile, frame, true};
    const auto slot = static_cast<std::uint32_t>(oldest - slots_.begin());
    slot_by_tile_.emplace(tile, slot);
    return Placement{slot, true};
}

}  // namespace eyepoint::ig
