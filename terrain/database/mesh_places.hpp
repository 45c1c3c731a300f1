/// Where the vertices of a nested mesh lie in their tile, and which are near a place: what the mesh codec's
/// predictions stand on. Whole numbers only, so that a writer and a reader agree on every machine.
/// Thread use: pure functions and values, from any thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "terrain/database/database.hpp"

namespace eyepoint::terrain {

/// Of a tile's mesh: as many as it has posts.
inline constexpr std::size_t kMaxVertices = std::size_t{kBlockPosts} * kBlockPosts;
/// Distance of the tile's own posts, in kPlaceUnits.
inline constexpr std::int32_t kPostUnits = kPlaceUnits / kBlockCells;

/// In kPlaceUnits from the tile's south-west corner, 0..kPlaceUnits.
struct Place {
    std::int32_t x = 0;
    std::int32_t y = 0;
};

[[nodiscard]] constexpr Place place_of_post(int post) {
    return {post % kBlockPosts * kPostUnits, post / kBlockPosts * kPostUnits};
}

[[nodiscard]] constexpr Place place_of(const NestedMesh::FinePost& post) {
    return {static_cast<std::int32_t>(post.x), static_cast<std::int32_t>(post.y)};
}

/// Places of all vertices, in their order.
[[nodiscard]] std::vector<Place> vertex_places(const NestedMesh& mesh);

/// Sides of the tile that a place is on: bit 0 west, 1 east, 2 south, 3 north.
[[nodiscard]] constexpr std::uint8_t sides_of(Place place) {
    constexpr std::int32_t kFar = kPlaceUnits;
    return static_cast<std::uint8_t>((place.x == 0 ? 1 : 0) | (place.x == kFar ? 2 : 0) |
                                     (place.y == 0 ? 4 : 0) | (place.y == kFar ? 8 : 0));
}

/// Places by square cells.
class PlaceIndex {
  public:
    /// Cells a side: a power of two, at most kBlockCells. The tile's far sides lie in cells of their own.
    explicit PlaceIndex(std::span<const Place> places, int cells = kBlockCells);

    /// Calls visit(index of a place) for all places, nearest cell first (equal distances: southern, then
    /// western cell first), in a cell in their order, until it returns false.
    template <typename Visit>
    void visit_from(Place centre, Visit visit) const {
        const int column = centre.x / cell_units_, row = centre.y / cell_units_;
        for (const CellOffset offset : cells_by_distance()) {
            const int x = column + offset.x, y = row + offset.y;
            if (x < 0 || x > cells_ || y < 0 || y > cells_) continue;
            const auto cell = static_cast<std::size_t>(y * kBlockPosts + x);
            for (std::size_t at = first_[cell]; at < first_[cell + 1]; ++at) {
                if (!visit(std::size_t{order_[at]})) return;
            }
        }
    }

  private:
    struct CellOffset {
        std::int8_t x = 0;
        std::int8_t y = 0;
    };
    static std::span<const CellOffset> cells_by_distance();
    [[nodiscard]] std::size_t cell_of(Place place) const;

    int cells_ = kBlockCells;
    std::int32_t cell_units_ = kPostUnits;
    std::array<std::uint16_t, kBlockPosts * kBlockPosts + 1> first_{};  ///< of a cell, in order_
    std::vector<std::uint16_t> order_;
};

}  // namespace eyepoint::terrain
