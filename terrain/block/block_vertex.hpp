/// Makes the vertices of a tile: of its own posts, and of posts of deeper tiles between them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

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
/// post or a fine one. So has a normal from every tile of one depth. Keeps a reference to the data.
class VertexMaker {
  public:
    explicit VertexMaker(const BlockData& data);

    /// Of an own post, 0..32 each.
    [[nodiscard]] BlockVertex at_post(int row, int column) const;
    /// The surface's slope is interpolated between the own posts around it, water is the nearest one's. Quick
    /// when called in the order of NestedMesh::fine_posts.
    [[nodiscard]] BlockVertex at_fine_post(const NestedMesh::FinePost& post);

  private:
    [[nodiscard]] glm::dvec2 slope(int row, int column) const;
    [[nodiscard]] double undulation_m(double north, double east) const;

    const BlockData& data_;
    double per_north_m_ = 0.0;                       ///< 1 / distance of the posts on both sides
    std::array<double, kBlockPosts> per_east_m_{};   ///< of a row
    std::array<Parallel, kBlockPosts> parallels_{};  ///< of the rows
    std::array<Meridian, kBlockPosts> meridians_{};  ///< of the columns
    std::uint32_t fine_y_ = 0;                       ///< whose parallel fine_parallel_ is
    Parallel fine_parallel_;
    std::vector<double> rotation_ = std::vector<double>(9);  ///< scratch of GeographicLib's
};

}  // namespace eyepoint::terrain
