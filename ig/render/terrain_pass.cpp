#include "ig/render/terrain_pass.hpp"

#include <array>
#include <cmath>
#include <cstddef>

#include <glm/vec4.hpp>

#include "ig/render/noise_texture.hpp"
#include "ig/render/program.hpp"

namespace eyepoint::ig {

namespace {

using Files = std::vector<std::string_view>;

constexpr glm::vec4 kPaper{0.93F, 0.93F, 0.90F, 0.35F};
constexpr glm::vec4 kInk{0.10F, 0.16F, 0.30F, 0.0F};

/// Tiles a side of a block, as a #define; there are no others (terrain/lod/tile/tile_mesh.hpp).
std::string_view tile_parts(int parts) {
    return parts == 1 ? "TILE_PARTS 1" : parts == 2 ? "TILE_PARTS 2" : "TILE_PARTS 4";
}

ProgramSource source(bool nested, int sliding_parts, Files fragment_files, Files defines) {
    Files vertex{"frame.glsl", "block.glsl"};
    if (nested) {
        vertex.emplace_back("nested.glsl");
        defines.emplace_back("NESTED");
    }
    if (sliding_parts > 0) {
        vertex.emplace_back("tile_slide.glsl");
        defines.emplace_back(tile_parts(sliding_parts));
    }
    vertex.emplace_back("terrain.vert.glsl");
    return {std::move(vertex), std::move(fragment_files), std::move(defines)};
}

/// Brightness 0..1; the hue turns once over 0..1.
glm::vec4 painted(double hue, double brightness) {
    const auto channel = [&](double shift) {
        const double turn = hue + shift - std::floor(hue + shift);
        return static_cast<float>(brightness *
                                  (0.30 + 0.70 * std::clamp(std::abs(turn * 6.0 - 3.0) - 1.0, 0.0, 1.0)));
    };
    return {channel(0.0), channel(2.0 / 3.0), channel(1.0 / 3.0), 0.6F};
}

/// Levels next to each other are told apart: eight hues, two levels from red to red being eight apart.
glm::vec4 colour_of(const terrain::BlockDraw& draw) {
    constexpr double kHues = 8.0;
    const double depth = draw.node->tile.depth;
    return painted(draw.level * 3.0 / kHues, 0.55 + 0.15 * std::fmod(depth, 4.0));
}

}  // namespace

tl::expected<TerrainPass::Programs, std::string> TerrainPass::link(bool nested, const Motion& motion) {
    const auto source_of = [&](Files fragment_files, Files defines) {
        return source(motion.nested, motion.sliding_parts, std::move(fragment_files), std::move(defines));
    };
    Programs programs;
    for (std::size_t set = 0; set < kFeatureSets; ++set) {
        auto program = link_program(source_of(ground_files(), shading_defines(set, nested)));
        if (!program) return tl::unexpected(program.error());
        programs.shaded.push_back(std::move(*program));
    }
    const std::array<ProgramSource, 3> others{
        source_of({"surface.glsl", "surface.frag.glsl"}, {}), source_of({"depth.frag.glsl"}, {}),
        source_of({"frame.glsl", "relief.glsl", "shown.frag.glsl"}, shading_defines(0, nested))};
    for (const ProgramSource& other : others) {
        auto program = link_program(other);
        if (!program) return tl::unexpected(program.error());
        programs.others.push_back(std::move(*program));
    }
    return programs;
}

tl::expected<TerrainPass, std::string> TerrainPass::create(const terrain::LodMethod& method) {
    const bool nested = method.mesh_kind() == terrain::MeshKind::Nested;
    auto programs = link(nested, {.nested = nested});
    if (!programs) return tl::unexpected(programs.error());
    std::optional<Programs> sliding;
    if (method.sliding_parts() > 0) {
        auto linked = link(nested, {.sliding_parts = method.sliding_parts()});
        if (!linked) return tl::unexpected(linked.error());
        sliding = std::move(*linked);
    }
    return TerrainPass{std::move(*programs), std::move(sliding), method};
}

TerrainPass::TerrainPass(Programs programs, std::optional<Programs> sliding, const terrain::LodMethod& method)
    : programs_(std::move(programs)),
      sliding_(std::move(sliding)),
      nested_(method.mesh_kind() == terrain::MeshKind::Nested),
      noise_(make_noise_texture()),
      list_(nested_, method.sliding_parts(), !method.indices().empty()) {
    const std::span<const std::uint16_t> indices = method.indices();
    if (!indices.empty()) {
        shared_indices_.emplace();
        glNamedBufferStorage(shared_indices_->name(), static_cast<GLsizeiptr>(indices.size_bytes()),
                             indices.data(), 0);
    }
    describe_vertices();
}

void TerrainPass::describe_vertices() const {
    using Vertex = terrain::BlockVertex;
    for (GLuint location = 0; location < 3; ++location) {
        glEnableVertexArrayAttrib(layout_.name(), location);
        glVertexArrayAttribBinding(layout_.name(), location, 0);
    }
    glVertexArrayAttribFormat(layout_.name(), 0, 3, GL_FLOAT, GL_FALSE, offsetof(Vertex, high));
    glVertexArrayAttribFormat(layout_.name(), 1, 3, GL_FLOAT, GL_FALSE, offsetof(Vertex, low));
    static_assert(offsetof(Vertex, rest) == offsetof(Vertex, place) + 4);
    glVertexArrayAttribIFormat(layout_.name(), 2, 2, GL_UNSIGNED_INT, offsetof(Vertex, place));
}

FrameStatistics TerrainPass::update(const terrain::Selection& selection, std::uint64_t frame) {
    const std::uint64_t blocks_before = list_.uploaded_blocks(), bytes_before = list_.uploaded_bytes();
    list_.update(selection, frame);
    FrameStatistics statistics;
    statistics.triangles = selection.triangles;
    statistics.triangles_hidden = selection.triangles_hidden;
    statistics.draws = static_cast<std::uint32_t>(selection.draws.size());
    statistics.blocks_drawn = list_.blocks();
    statistics.blocks_tested = selection.blocks_tested;
    statistics.blocks_reused = selection.blocks_reused;
    statistics.blocks_uploaded = static_cast<std::uint32_t>(list_.uploaded_blocks() - blocks_before);
    statistics.bytes_uploaded = list_.uploaded_bytes() - bytes_before;
    return statistics;
}

DrawnTerrain TerrainPass::terrain() const {
    const BlockStore& blocks = list_.block_store();
    const GLuint indices = shared_indices_ ? shared_indices_->name() : blocks.index_buffer();
    return {blocks.vertex_buffer(),   blocks.vertex_words(), indices,
            list_.record_buffer(),    list_.record_words(),  blocks.relief(),
            list_.images().texture(), list_.slide_buffer(),  list_.features()};
}

void TerrainPass::begin(const DrawnTerrain& terrain) const {
    glBindVertexArray(layout_.name());
    glVertexArrayVertexBuffer(layout_.name(), 0, terrain.vertices, 0, sizeof(terrain::BlockVertex));
    glVertexArrayElementBuffer(layout_.name(), terrain.indices);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, terrain.records);
    if (sliding_) glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, terrain.slides);
    terrain.bind_painted(noise_.name());
    glBindTextureUnit(kVertexUnit, terrain.vertex_words);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glEnable(GL_CULL_FACE);
}

void TerrainPass::warm_up(bool surface) const {
    begin(terrain());
    const auto once = [](const GlProgram& program) {
        glUseProgram(program.name());
        glDrawElements(GL_TRIANGLES, 3, GL_UNSIGNED_SHORT, nullptr);
    };
    for (const Programs* programs : {&programs_, sliding_ ? &*sliding_ : nullptr}) {
        if (programs == nullptr) continue;
        if (surface) {
            once(programs->others[kSurface]);
        } else {
            for (const GlProgram& program : programs->shaded) once(program);
        }
    }
    glDisable(GL_CULL_FACE);
}

void TerrainPass::draw() const {
    begin(terrain());
    draw_shaded(programs_, list_.others());
    if (sliding_) draw_shaded(*sliding_, list_.sliding());
    glDisable(GL_CULL_FACE);
}

void TerrainPass::draw_shaded(const Programs& programs, const SortedCommands& commands) {
    for (std::size_t set = 0; set < kFeatureSets; ++set) {
        if (commands.by_features[set].empty()) continue;
        glUseProgram(programs.shaded[set].name());
        commands.by_features[set].draw();
    }
}

void TerrainPass::draw_each(Other program) const {
    glUseProgram(programs_.others[program].name());
    list_.others().all.draw();
    if (!sliding_ || list_.sliding().all.empty()) return;
    glUseProgram(sliding_->others[program].name());
    list_.sliding().all.draw();
}

void TerrainPass::draw_surface() const {
    begin(terrain());
    draw_each(kSurface);
    glDisable(GL_CULL_FACE);
}

bool TerrainPass::prepare_still() {
    if (!nested_ || motionless_) return true;
    auto programs = link(true, {});
    if (programs) motionless_ = std::move(*programs);
    return motionless_.has_value();
}

void TerrainPass::draw(const StillMesh& mesh) const {
    begin(mesh.terrain());
    for (std::size_t set = 0; set < kFeatureSets; ++set) {
        if (!mesh.has_features(set)) continue;
        glUseProgram(still_programs().shaded[set].name());
        mesh.draw_features(set);
    }
    glDisable(GL_CULL_FACE);
}

void TerrainPass::draw_surface(const StillMesh& mesh) const {
    begin(mesh.terrain());
    glUseProgram(still_programs().others[kSurface].name());
    mesh.draw_all();
    glDisable(GL_CULL_FACE);
}

void TerrainPass::draw_depth() const {
    begin(terrain());
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    draw_each(kDepth);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDisable(GL_CULL_FACE);
}

void TerrainPass::draw_wireframe() const {
    begin(terrain());
    glUseProgram(moving_programs().others[kShown].name());
    glUniform4fv(0, 1, &kPaper.x);
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(-1.0F, -4.0F);  // reverse Z: away from the eye
    list_.all().draw();
    glDisable(GL_POLYGON_OFFSET_FILL);
    glUniform4fv(0, 1, &kInk.x);
    glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    list_.all().draw();
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    glDisable(GL_CULL_FACE);
}

void TerrainPass::draw_levels(const terrain::Selection& selection) const {
    begin(terrain());
    glUseProgram(moving_programs().others[kShown].name());
    const DrawCommands& all = list_.all();
    for (std::size_t i = 0; i < selection.draws.size(); ++i) {
        const glm::vec4 paint = colour_of(selection.draws[i]);
        glUniform4fv(0, 1, &paint.x);
        glDrawElementsBaseVertex(GL_TRIANGLES, all.counts[i], GL_UNSIGNED_SHORT, all.offsets[i],
                                 all.base_vertices[i]);
    }
    glDisable(GL_CULL_FACE);
}

}  // namespace eyepoint::ig
