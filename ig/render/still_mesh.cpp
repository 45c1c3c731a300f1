#include "ig/render/still_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "terrain/lod/nested_motion.hpp"

namespace eyepoint::ig {

namespace {

using terrain::BlockVertex;
using terrain::kBlockVertices;

/// Signed normalised 10:10:10, as block.glsl reads it.
std::uint32_t packed_normal(const glm::vec3& normal) {
    const glm::vec3 scaled = glm::round(glm::normalize(normal) * 511.0F);
    const auto bits = [](float value) {
        return static_cast<std::uint32_t>(static_cast<int>(value)) & 0x3ffU;
    };
    return bits(scaled.x) | bits(scaled.y) << 10 | bits(scaled.z) << 20;
}

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
    return {place.high,
            place.low,
            packed_normal(drawn.normal),
            draw.node->block->vertices[vertex].surface,
            packed_place(drawn.place),
            terrain::NestedMesh::kStays << 16 | terrain::kNoVertex};
}

void fill(const GlBuffer& buffer, std::size_t bytes, const void* content) {
    glNamedBufferStorage(buffer.name(), static_cast<GLsizeiptr>(std::max<std::size_t>(bytes, 4)), content, 0);
}

/// Content of the mesh's buffers, gathered draw by draw.
class Gathering {
  public:
    Gathering(const DrawList& list, std::span<const std::uint16_t> grid_indices, const terrain::LodView& view,
              bool morph)
        : list_(list), grid_indices_(grid_indices), view_(view), motion_(terrain::motion_view(view, morph)) {}

    void add(const terrain::BlockDraw& draw, std::uint32_t slot) {
        const terrain::Block& block = *draw.node->block;
        const auto [known, fresh] = places_.try_emplace(slot, static_cast<std::uint32_t>(places_.size()));
        if (fresh) place(draw, slot);
        const std::uint32_t base = known->second * kBlockVertices;
        const std::span<const std::uint16_t> indices = grid_indices_.empty() ? block.indices : grid_indices_;
        std::vector<std::uint32_t>& own = by_features[list_.features_of(draw, slot)];
        for (const std::uint16_t index : indices.subspan(draw.indices.first, draw.indices.count)) {
            all.push_back(base + index);
            own.push_back(base + index);
        }
    }

    std::vector<BlockVertex> vertices;
    std::vector<DrawList::BlockRecord> records;
    std::vector<std::uint32_t> all;
    std::array<std::vector<std::uint32_t>, kFeatureSets> by_features;

  private:
    /// The block's vertices and its record, without parents.
    void place(const terrain::BlockDraw& draw, std::uint32_t slot) {
        const terrain::Block& block = *draw.node->block;
        const std::size_t base = vertices.size();
        vertices.resize(base + kBlockVertices);
        for (std::size_t i = 0; i < block.vertices.size(); ++i) {
            vertices[base + i] = grid_indices_.empty()
                                     ? stopped(draw, static_cast<std::uint16_t>(i), view_, motion_)
                                     : block.vertices[i];
        }
        records.push_back(list_.record(slot));
        records.back().tree = {DrawList::kNoSlot, 0U, 0U, 0U};
    }

    const DrawList& list_;
    std::span<const std::uint16_t> grid_indices_;
    const terrain::LodView& view_;
    terrain::MotionView motion_;
    std::unordered_map<std::uint32_t, std::uint32_t> places_;  ///< in this mesh, by slot of the list
};

}  // namespace

StillMesh::StillMesh(const terrain::Selection& selection, const DrawList& list,
                     std::span<const std::uint16_t> grid_indices, const terrain::LodView& view, bool morph)
    : vertex_words_(GLenum{GL_TEXTURE_BUFFER}),
      record_words_(GLenum{GL_TEXTURE_BUFFER}),
      features_(list.features()),
      images_(list.images().texture()) {
    Gathering content{list, grid_indices, view, morph};
    for (std::size_t i = 0; i < selection.draws.size(); ++i) content.add(selection.draws[i], list.slot(i));
    std::vector<std::uint32_t> indices = std::move(content.all);
    all_ = {0, indices.size()};
    for (std::size_t set = 0; set < kFeatureSets; ++set) {
        parts_[set] = {indices.size(), content.by_features[set].size()};
        indices.insert(indices.end(), content.by_features[set].begin(), content.by_features[set].end());
    }
    fill(vertices_, content.vertices.size() * sizeof(BlockVertex), content.vertices.data());
    fill(indices_, indices.size() * sizeof(std::uint32_t), indices.data());
    fill(records_, content.records.size() * sizeof(DrawList::BlockRecord), content.records.data());
    glTextureBuffer(vertex_words_.name(), GL_RG32UI, vertices_.name());
    glTextureBuffer(record_words_.name(), GL_RGBA32F, records_.name());
}

DrawnTerrain StillMesh::terrain() const {
    return {vertices_.name(), vertex_words_.name(), indices_.name(),
            records_.name(),  record_words_.name(), images_,
            features_};
}

void StillMesh::Part::draw() const {
    // NOLINTNEXTLINE(performance-no-int-to-ptr): OpenGL takes offsets into a buffer as pointers.
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(count), GL_UNSIGNED_INT,
                   reinterpret_cast<const void*>(first * sizeof(std::uint32_t)));
}

void StillMesh::draw_all() const { all_.draw(); }

void StillMesh::draw_features(std::size_t set) const { parts_[set].draw(); }

}  // namespace eyepoint::ig
