/// The triangles of a mesh while its vertices go, one into another.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tools/terrain/nest/collapse.hpp"

namespace eyepoint::tools {

/// Vertices and triangles by their numbers in the mesh it is made from.
class CollapsingMesh {
  public:
    using Vertex = std::uint16_t;
    using Triangle = std::array<Vertex, 3>;

    explicit CollapsingMesh(const TriangleMesh& mesh);

    [[nodiscard]] std::size_t vertices() const { return around_.size(); }
    [[nodiscard]] std::size_t vertices_left() const;
    [[nodiscard]] const Triangle& triangle(std::uint32_t t) const { return triangles_[t]; }
    /// Triangles that have a vertex.
    [[nodiscard]] const std::vector<std::uint32_t>& around(Vertex v) const { return around_[v]; }
    /// Its neighbours.
    [[nodiscard]] std::vector<Vertex> ring(Vertex v) const;
    /// Of two neighbours: 1 where they are on the mesh's border.
    [[nodiscard]] std::ptrdiff_t shared_triangles(Vertex a, Vertex b) const;

    [[nodiscard]] bool gone(Vertex v) const;
    [[nodiscard]] std::uint8_t gone_level(Vertex v) const { return result_.gone_level[v]; }
    [[nodiscard]] Vertex target(Vertex v) const { return result_.target[v]; }

    /// A vertex goes into a neighbour; the triangles of both are gone, its others the neighbour's.
    void collapse(Vertex v, Vertex target, int level);
    /// What went to a vertex that went at the same level goes to where that went.
    void follow_targets();

    /// Remembers the mesh as it is.
    void remember();
    /// Triangles that had a vertex then, and what they were.
    [[nodiscard]] std::span<const std::uint32_t> around_before(Vertex v) const;
    [[nodiscard]] const Triangle& triangle_before(std::uint32_t t) const { return before_[t]; }

    /// What has become of it; nothing may be asked after that.
    [[nodiscard]] CollapseResult take();

  private:
    std::vector<Triangle> triangles_;
    std::vector<bool> dead_;
    std::vector<std::vector<std::uint32_t>> around_;
    std::vector<Triangle> before_;  ///< triangles_ as remembered; and around_, in one row
    std::vector<std::uint32_t> around_before_;
    std::vector<std::size_t> first_before_;
    CollapseResult result_;
};

[[nodiscard]] inline bool has(const CollapsingMesh::Triangle& triangle, CollapsingMesh::Vertex v) {
    return triangle[0] == v || triangle[1] == v || triangle[2] == v;
}

}  // namespace eyepoint::tools
