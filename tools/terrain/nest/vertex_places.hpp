/// Where the vertices of a tile are while its mesh is made coarser: inner ones at one place, those on edges
/// at others from some levels on.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tools/terrain/nest/collapse.hpp"
#include "tools/terrain/nest/sampled_surface.hpp"

namespace eyepoint::tools {

/// A corner with its exact place, as MeshVertex has it.
struct Placed {
    std::int64_t x = 0;
    std::int64_t y = 0;
    Corner corner;
};

using PlacedTriangle = std::array<const Placed*, 3>;

[[nodiscard]] bool same_place(const Placed& a, const Placed& b);
/// Exact.
[[nodiscard]] bool counterclockwise(const PlacedTriangle& corners);
/// Two corners are one place.
[[nodiscard]] bool is_empty(const PlacedTriangle& corners);

/// Vertices by their number in the request, which is read when this is made.
class VertexPlaces {
  public:
    using Vertex = std::uint16_t;
    /// From a level on a vertex of an edge is somewhere else.
    struct Later {
        int level = 0;
        Placed place;
    };

    VertexPlaces(const CollapseRequest& request, const SampledSurface& surface);

    /// Where it is before it goes anywhere.
    [[nodiscard]] const Placed& own(Vertex v) const { return own_[v]; }
    [[nodiscard]] const Placed& at_level(Vertex v, int level) const;
    /// By level; empty for an inner vertex.
    [[nodiscard]] const std::vector<Later>& later(Vertex v) const { return later_[v]; }
    /// Of the tile.
    [[nodiscard]] bool is_corner(Vertex v) const { return is_corner_[v] != 0; }
    /// The next level at which a corner of a triangle goes somewhere else; kNoLevel for none.
    static constexpr int kNoLevel = 1 << 30;
    [[nodiscard]] int next_level(const std::array<Vertex, 3>& triangle, int level) const;

  private:
    std::vector<Placed> own_;
    std::vector<std::vector<Later>> later_;
    std::vector<char> is_corner_;
};

}  // namespace eyepoint::tools
