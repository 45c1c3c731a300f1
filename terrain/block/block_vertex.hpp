/// Makes the vertices of a tile: of its own posts, and of posts of deeper tiles between them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "terrain/block/block.hpp"
#include "terrain/database/database.hpp"

namespace eyepoint::terrain {

/// What all places of one latitude share, from GeographicLib: the ellipsoid's distances from the axis and
/// from the plane of the equator, and the direction of the vertical.
struct Parallel {
    double from_axis_m = 0.0;
    double from_equator_m = 0.0;
    double sine = 0.0;
    double cosine = 1.0;
};
/// What all places of one longitude share.
struct Meridian {
    double sine = 0.0;
    double cosine = 1.0;
};

/// Every attribute of a vertex but its motion. A position is a function of latitude, longitude and height
/// alone, in one order of operations: a place has the same bits from every tile, whether it is the tile's own
/// post or a fine one. Keeps a reference to the data.
class VertexMaker {
  public:
    explicit VertexMaker(const BlockData& data);

    /// Of an own post, 0..32 each.
    [[nodiscard]] BlockVertex at_post(int row, int column) const;
    /// Quick when called in the order of NestedMesh::fine_posts.
    [[nodiscard]] BlockVertex at_fine_post(const NestedMesh::FinePost& post);

  private:
    [[nodiscard]] double undulation_m(double north, double east) const;

    const BlockData& data_;
    std::array<Parallel, kBlockPosts> parallels_{};  ///< of the rows
    std::array<Meridian, kBlockPosts> meridians_{};  ///< of the columns
    std::uint32_t fine_y_ = 0;                       ///< whose parallel fine_parallel_ is
    Parallel fine_parallel_;
    std::vector<double> rotation_ = std::vector<double>(9);  ///< scratch of GeographicLib's
};

}  // namespace eyepoint::terrain
