#include "tools/bench/measure/drawn_mesh.hpp"

#include <algorithm>
#include <array>
#include <span>

#include "terrain/lod/nested_motion.hpp"
#include "terrain/lod/planet_horizon.hpp"
#include "terrain/lod/tile/tile_slide.hpp"

namespace eyepoint::tools {

namespace {

using terrain::BlockDraw;
using terrain::BlockVertex;
using terrain::MeshKind;

glm::vec3 vector(const std::array<float, 3>& parts) { return {parts[0], parts[1], parts[2]}; }

/// As ig/render/shaders/terrain.vert.glsl has it.
glm::vec3 from_eye(const BlockVertex& vertex, const terrain::SplitPosition& eye) {
    return (vector(vertex.high) - vector(eye.high)) + (vector(vertex.low) - vector(eye.low));
}

HalfTurns on_earth(terrain::TileId tile, const glm::dvec2& in_tile) {
    const double side = 1.0 / static_cast<double>(std::uint64_t{1} << tile.depth);
    return (glm::dvec2{tile.x, tile.y} + in_tile) * side;
}

class Builder {
  public:
    Builder(const terrain::LodMethod& method, const terrain::LodView& view, bool morph)
        : kind_(method.mesh_kind()),
          sliding_parts_(method.sliding_parts()),
          of_method_(method.indices()),
          eye_(terrain::split(view.eye)) {
        if (kind_ == MeshKind::Nested) motion_ = terrain::motion_view(view, morph);
        mesh_.eye = view.eye;
        mesh_.sides = view.sides;
        number_.fill(kNone);
    }

    void add(const BlockDraw& draw) {
        const std::size_t first = mesh_.triangles.size();
        const auto indices = terrain::indices_of(draw, of_method_);
        for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
            const MeshTriangle triangle{
                {vertex(draw, indices[i]), vertex(draw, indices[i + 1]), vertex(draw, indices[i + 2])}};
            if (is_empty(mesh_, triangle)) ++mesh_.empty_triangles;
            mesh_.triangles.push_back(triangle);
        }
        for (const std::uint16_t index : indices) number_[index] = kNone;
        mesh_.parts.push_back({draw.node->tile, first, mesh_.triangles.size()});
    }

    [[nodiscard]] DrawnMesh take() { return std::move(mesh_); }

  private:
    static constexpr std::uint32_t kNone = 0xffffffff;

    std::uint32_t vertex(const BlockDraw& draw, std::uint16_t index) {
        if (number_[index] == kNone) {
            number_[index] = static_cast<std::uint32_t>(mesh_.vertices.size());
            mesh_.vertices.push_back(kind_ == MeshKind::Grid ? grid_vertex(draw, index)
                                                             : nested_vertex(draw, index));
        }
        return number_[index];
    }

    [[nodiscard]] MeshVertex grid_vertex(const BlockDraw& draw, std::uint16_t index) const {
        constexpr int kLast = terrain::kBlockCells,
                      kUnitsAPost = terrain::kVertexPlaceUnits / terrain::kBlockCells;
        const int column = index % terrain::kBlockPosts, row = index / terrain::kBlockPosts;
        const glm::dvec2 in_tile = glm::dvec2{column, row} / static_cast<double>(kLast);
        const unsigned edges = (column == 0 ? 1U : 0U) | (column == kLast ? 2U : 0U) | (row == 0 ? 4U : 0U) |
                               (row == kLast ? 8U : 0U);
        const terrain::Block& block = *draw.node->block;
        const glm::vec3 at = sliding_parts_ > 0
                                 ? terrain::tiles::slid_vertex(block, index, draw.slide, sliding_parts_, eye_)
                                 : from_eye(block.vertices[index], eye_);
        return {at, on_earth(draw.node->tile, in_tile), glm::u16vec2{column * kUnitsAPost, row * kUnitsAPost},
                static_cast<std::uint8_t>(edges)};
    }

    [[nodiscard]] MeshVertex nested_vertex(const BlockDraw& draw, std::uint16_t index) const {
        const terrain::DrawnVertex drawn = terrain::drawn_vertex(*draw.node, index, draw.floors, motion_);
        const BlockVertex& own = draw.node->block->vertices[index];
        return {drawn.from_eye, on_earth(draw.node->tile, drawn.place),
                glm::u16vec2{own.place & 0xffffU, own.place >> 16}, own.sides()};
    }

    MeshKind kind_;
    int sliding_parts_;  ///< LodMethod's
    std::span<const std::uint16_t> of_method_;
    terrain::SplitPosition eye_;
    terrain::MotionView motion_;
    DrawnMesh mesh_;
    std::array<std::uint32_t, 1U << 16> number_{};
};

}  // namespace

bool is_empty(const DrawnMesh& mesh, const MeshTriangle& triangle) {
    const glm::vec3& a = mesh.vertices[triangle.vertices[0]].from_eye;
    const glm::vec3& b = mesh.vertices[triangle.vertices[1]].from_eye;
    const glm::vec3& c = mesh.vertices[triangle.vertices[2]].from_eye;
    return same_bits(a, b) || same_bits(b, c) || same_bits(c, a);
}

DrawnMesh drawn_mesh(const terrain::Selection& selection, const terrain::LodMethod& method,
                     const terrain::LodView& view, bool morph) {
    Builder builder(method, view, morph);
    double lowest_m = 0.0;
    for (const BlockDraw& draw : selection.draws) {
        builder.add(draw);
        lowest_m = std::min(lowest_m, double{draw.node->info.height_min_m});
    }
    DrawnMesh mesh = builder.take();
    mesh.lowest_height_m = lowest_m - terrain::mesh_below_surface_m(view, lowest_m);
    return mesh;
}

}  // namespace eyepoint::tools
