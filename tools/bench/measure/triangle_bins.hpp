/// Which drawn triangles may lie over which tile of posts.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tools/bench/measure/drawn_mesh.hpp"
#include "tools/bench/measure/full_surface.hpp"

namespace eyepoint::tools {

/// By the triangles' extents in latitude and longitude, a little enlarged: straight edges in space are not
/// quite straight there.
class TriangleBins {
  public:
    /// After surface.look(), which returned so many tiles.
    TriangleBins(const FullSurface& surface, const DrawnMesh& mesh, std::size_t tiles);

    /// Numbers of triangles, for the tile of that number in what look() returned.
    [[nodiscard]] std::span<const std::uint32_t> over(std::size_t tile) const {
        return std::span{triangles_}.subspan(first_[tile], first_[tile + 1] - first_[tile]);
    }

  private:
    std::vector<std::uint32_t> triangles_;
    std::vector<std::size_t> first_;
};

}  // namespace eyepoint::tools
