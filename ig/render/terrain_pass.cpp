#include "ig/render/terrain_pass.hpp"

#include <cmath>
#include <cstddef>

#include "ig/render/noise_texture.hpp"
#include "ig/render/program.hpp"

namespace eyepoint::ig {

namespace {

constexpr std::uint32_t kFirstSlots = 1024;
constexpr std::uint32_t kImageLayers = 512;
/// The noise repeats every side of a tile of this depth (0.18 degrees, about 20 km), the same over the whole
/// Earth.
constexpr int kNoiseDepth = 10;
constexpr double kMetresPerDegree = 111320.0;

double fraction(double value) { return value - std::floor(value); }

const terrain::TileNode* nearest_with_image(const terrain::TileNode& node) {
    const terrain::TileNode* candidate = &node;
    while (candidate != nullptr && !(candidate->block && candidate->block->image))
        candidate = candidate->parent;
    return candidate;
}

}  // namespace

tl::expected<TerrainPass, std::string> TerrainPass::create(std::span<const std::uint16_t> indices) {
    std::vector<Variant> variants;
    for (std::size_t features = 0; features < kVariants; ++features) {
        ProgramSource source{{"frame.glsl", "terrain.vert.glsl"},
                             {"frame.glsl", "chapman.glsl", "atmosphere.glsl", "terrain.frag.glsl"},
                             {}};
        if ((features & kWater) != 0) source.defines.emplace_back("WATER");
        if ((features & kImage) != 0) source.defines.emplace_back("IMAGES");
        auto program = link_program(source);
        if (!program) return tl::unexpected(program.error());
        variants.push_back({std::move(*program), {}, {}, {}});
    }
    return TerrainPass{std::move(variants), indices};
}

TerrainPass::TerrainPass(std::vector<Variant> variants, std::span<const std::uint16_t> indices)
    : variants_(std::move(variants)),
      noise_(make_noise_texture()),
      blocks_(kFirstSlots),
      images_(kImageLayers) {
    glNamedBufferStorage(indices_.name(), static_cast<GLsizeiptr>(indices.size_bytes()), indices.data(), 0);
    glVertexArrayElementBuffer(layout_.name(), indices_.name());
    const auto attribute = [this](GLuint location, std::size_t offset) {
        glEnableVertexArrayAttrib(layout_.name(), location);
        glVertexArrayAttribBinding(layout_.name(), location, 0);
        return static_cast<GLuint>(offset);
    };
    using Vertex = terrain::BlockVertex;
    glVertexArrayAttribFormat(layout_.name(), 0, 3, GL_FLOAT, GL_FALSE, attribute(0, offsetof(Vertex, high)));
    glVertexArrayAttribFormat(layout_.name(), 1, 3, GL_FLOAT, GL_FALSE, attribute(1, offsetof(Vertex, low)));
    glVertexArrayAttribFormat(layout_.name(), 2, 4, GL_INT_2_10_10_10_REV, GL_TRUE,
                              attribute(2, offsetof(Vertex, normal)));
    glVertexArrayAttribIFormat(layout_.name(), 3, 1, GL_UNSIGNED_INT,
                               attribute(3, offsetof(Vertex, surface)));
}

TerrainPass::BlockRecord TerrainPass::describe(const terrain::TileNode& node, std::uint64_t frame) {
    BlockRecord record{{-1.0F, 1.0F, 0.0F, 0.0F}, {1.0F, 0.0F, 0.0F, 0.0F}};
    const auto depth = static_cast<int>(node.tile.depth);
    const double noise_scale = std::ldexp(1.0, kNoiseDepth - depth);
    record.noise = glm::vec4{glm::dvec4{noise_scale, fraction(node.tile.x * noise_scale),
                                        fraction(node.tile.y * noise_scale), 0.0}};
    if (const terrain::TileNode* pictured = nearest_with_image(node)) {
        const auto layer = images_.layer_of(*pictured->block->image, frame);
        const double scale = std::ldexp(1.0, static_cast<int>(pictured->tile.depth) - depth);
        const double texel_m =
            terrain::tile_side_deg(pictured->tile.depth) / terrain::kImageTexels * kMetresPerDegree;
        if (layer)
            record.image =
                glm::vec4{glm::dvec4{static_cast<double>(*layer), scale, fraction(node.tile.x * scale),
                                     fraction(node.tile.y * scale)}};
        record.noise.w = static_cast<float>(texel_m);
    }
    return record;
}

void TerrainPass::upload(const terrain::Selection& selection, std::uint64_t frame) {
    for (Variant& variant : variants_) {
        variant.counts.clear();
        variant.offsets.clear();
        variant.base_vertices.clear();
    }
    for (const terrain::BlockDraw& draw : selection.draws) {
        const terrain::Block& block = *draw.node->block;
        const std::uint32_t slot = blocks_.slot_of(block, frame);
        records_.resize(blocks_.slots());
        records_[slot] = describe(*draw.node, frame);
        Variant& variant =
            variants_[(block.has_water ? kWater : 0) + (records_[slot].image.x >= 0.0F ? kImage : 0)];
        variant.counts.push_back(static_cast<GLsizei>(draw.indices.count));
        // NOLINTNEXTLINE(performance-no-int-to-ptr): OpenGL takes offsets into a buffer as pointers.
        variant.offsets.push_back(reinterpret_cast<const void*>(draw.indices.first * sizeof(std::uint16_t)));
        variant.base_vertices.push_back(static_cast<GLint>(slot * terrain::kBlockVertices));
    }
    glNamedBufferData(record_buffer_.name(), static_cast<GLsizeiptr>(records_.size() * sizeof(BlockRecord)),
                      records_.data(), GL_STREAM_DRAW);
}

void TerrainPass::bind() const {
    glBindVertexArray(layout_.name());
    glVertexArrayVertexBuffer(layout_.name(), 0, blocks_.vertex_buffer(), 0, sizeof(terrain::BlockVertex));
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, record_buffer_.name());
    glBindTextureUnit(0, images_.texture());
    glBindTextureUnit(1, noise_.name());
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glEnable(GL_CULL_FACE);
}

void TerrainPass::warm_up(const terrain::Selection& selection, std::uint64_t frame) {
    upload(selection, frame);
    bind();
    for (const Variant& variant : variants_) {
        glUseProgram(variant.program.name());
        glDrawElements(GL_TRIANGLES, 3, GL_UNSIGNED_SHORT, nullptr);
    }
    glDisable(GL_CULL_FACE);
}

FrameStatistics TerrainPass::draw(const terrain::Selection& selection, std::uint64_t frame) {
    const std::uint64_t blocks_before = blocks_.uploads(), images_before = images_.uploads();
    upload(selection, frame);
    bind();
    FrameStatistics statistics;
    for (const Variant& variant : variants_) {
        if (variant.counts.empty()) continue;
        glUseProgram(variant.program.name());
        glMultiDrawElementsBaseVertex(GL_TRIANGLES, variant.counts.data(), GL_UNSIGNED_SHORT,
                                      variant.offsets.data(), static_cast<GLsizei>(variant.counts.size()),
                                      variant.base_vertices.data());
        statistics.draws += static_cast<std::uint32_t>(variant.counts.size());
    }
    glDisable(GL_CULL_FACE);
    statistics.triangles = selection.triangles;
    statistics.blocks_drawn = static_cast<std::uint32_t>(selection.draws.size());
    statistics.blocks_tested = selection.blocks_tested;
    statistics.blocks_uploaded = static_cast<std::uint32_t>(blocks_.uploads() - blocks_before);
    constexpr std::uint64_t kImageBytes = std::uint64_t{terrain::kImageTexels} * terrain::kImageTexels * 4;
    statistics.bytes_uploaded = statistics.blocks_uploaded * BlockStore::kBytesPerBlock +
                                (images_.uploads() - images_before) * kImageBytes;
    return statistics;
}

}  // namespace eyepoint::ig
