#include "ig/render/still_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "terrain/lod/nested_motion.hpp"
#include "terrain/lod/tile/tile_slide.hpp"

namespace eyepoint::ig {

namespace {

using terrain::BlockVertex;
using terrain::kBlockVertices;

std::uint32_t packed_place(const glm::vec2& place) {
    const auto units = [](float value) {
        return static_cast<std::uint32_t>(std::clamp(value, 0.0F, 1.99F) * terrain::kVertexPlaceUnits);
    };
    return units(place.x) | units(place.y) << 16;
}

/// A vertex of a nested mesh where the view has it, never to move again.
BlockVertex stopped(const terrain::BlockDraw& draw, std::uint16_t vertex, const terrain::LodView& view,
                    const terrain::MotionView& motion) {
    const terrain::DrawnVertex drawn = terrain::drawn_vertex(*draw.node, vertex, draw.floors, motion);
    const terrain::SplitPosition place = terrain::split(view.eye + glm::dvec3{drawn.from_eye});
    return {place.high, place.low, packed_place(drawn.place), draw.node->block->vertices[vertex].rest};
}

void fill(const GlBuffer& buffer, std::size_t bytes, const void* content) {
    glNamedBufferStorage(buffer.name(), static_cast<GLsizeiptr>(std::max<std::size_t>(bytes, 4)), content, 0);
}

/// The same of a tile's that slides.
BlockVertex stopped(const terrain::BlockDraw& draw, std::uint16_t vertex, int parts,
                    const terrain::LodView& view) {
    const terrain::Block& block = *draw.node->block;
    const glm::vec3 from_eye =
        terrain::tiles::slid_vertex(block, vertex, draw.slide, parts, terrain::split(view.eye));
    const terrain::SplitPosition place = terrain::split(view.eye + glm::dvec3{from_eye});
    return {place.high, place.low, block.vertices[vertex].place, block.vertices[vertex].rest};
}

/// Content of the mesh's buffers, gathered draw by draw.
class Gathering {
  public:
    Gathering(const DrawList& list, const terrain::LodMethod& method, const terrain::LodView& view,
              bool morph)
        : vertices(std::size_t{list.block_store().slots()} * kBlockVertices),
          list_(list),
          method_(method),
          view_(view),
          motion_(terrain::motion_view(view, morph)) {}

    void add(const terrain::BlockDraw& draw, std::uint32_t slot) {
        const auto [known, fresh] = blocks_.try_emplace(slot);
        if (fresh) {
            known->second.first = slot * kBlockVertices;
            known->second.place.fill(kUnused);
        }
        std::vector<std::uint32_t>& own = by_features[list_.features_of(draw, slot)];
        for (const std::uint16_t index : terrain::indices_of(draw, method_.indices())) {
            all.push_back(vertex(draw, index, known->second));
            own.push_back(all.back());
        }
    }

    std::vector<BlockVertex> vertices;
    std::vector<std::uint32_t> all;
    std::array<std::vector<std::uint32_t>, kFeatureSets> by_features;

  private:
    /// A block's vertices stand in the order of their first use, as in any mesh made for drawing: drivers
    /// keep the last ones.
    struct Placed {
        std::uint32_t first = 0;
        std::uint16_t used = 0;
        std::array<std::uint16_t, kBlockVertices> place;
    };
    static constexpr std::uint16_t kUnused = 0xffff;

    std::uint32_t vertex(const terrain::BlockDraw& draw, std::uint16_t index, Placed& block) {
        std::uint16_t& place = block.place[index];
        if (place == kUnused) {
            place = block.used++;
            vertices[block.first + place] = stood(draw, index);
        }
        return block.first + place;
    }

    [[nodiscard]] BlockVertex stood(const terrain::BlockDraw& draw, std::uint16_t index) const {
        if (method_.mesh_kind() == terrain::MeshKind::Nested) return stopped(draw, index, view_, motion_);
        const int parts = method_.sliding_parts();
        return parts > 0 ? stopped(draw, index, parts, view_) : draw.node->block->vertices[index];
    }

    const DrawList& list_;
    const terrain::LodMethod& method_;
    const terrain::LodView& view_;
    terrain::MotionView motion_;
    std::unordered_map<std::uint32_t, Placed> blocks_;  ///< by slot of the list
};

}  // namespace

StillMesh::StillMesh(const terrain::Selection& selection, const DrawList& list,
                     const terrain::LodMethod& method, const terrain::LodView& view, bool morph)
    : painted_{.records = list.record_buffer(),
               .record_words = list.record_words(),
               .relief = list.block_store().relief(),
               .images = list.images().texture(),
               .features = list.features()} {
    Gathering content{list, method, view, morph};
    for (std::size_t i = 0; i < selection.draws.size(); ++i) content.add(selection.draws[i], list.slot(i));
    std::vector<std::uint32_t> indices = std::move(content.all);
    all_ = {0, indices.size()};
    for (std::size_t set = 0; set < kFeatureSets; ++set) {
        parts_[set] = {indices.size(), content.by_features[set].size()};
        indices.insert(indices.end(), content.by_features[set].begin(), content.by_features[set].end());
    }
    fill(vertices_, content.vertices.size() * sizeof(BlockVertex), content.vertices.data());
    fill(indices_, indices.size() * sizeof(std::uint32_t), indices.data());
}

DrawnTerrain StillMesh::terrain() const {
    DrawnTerrain terrain = painted_;
    terrain.vertices = vertices_.name();
    terrain.indices = indices_.name();
    return terrain;
}

void StillMesh::Part::draw() const {
    // NOLINTNEXTLINE(performance-no-int-to-ptr): OpenGL takes offsets into a buffer as pointers.
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(count), GL_UNSIGNED_INT,
                   reinterpret_cast<const void*>(first * sizeof(std::uint32_t)));
}

void StillMesh::draw_all() const { all_.draw(); }

void StillMesh::draw_features(std::size_t set) const { parts_[set].draw(); }

}  // namespace eyepoint::ig
