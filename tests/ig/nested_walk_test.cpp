/// The walk of nested.glsl against terrain::drawn_vertex: run with `ctest -L picture`.
#include <array>
#include <bit>
#include <cstring>
#include <memory>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <epoxy/gl.h>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include "ig/egl_context.hpp"
#include "ig/eyepoint.hpp"
#include "ig/frame_buffer.hpp"
#include "ig/lod_view.hpp"
#include "ig/render/draw_list.hpp"
#include "ig/render/frame_uniforms.hpp"
#include "ig/render/program.hpp"
#include "terrain/lod/nested_motion.hpp"
#include "terrain/pager/pager.hpp"
#include "tests/support/analytic_terrain.hpp"
#include "tests/terrain/lod/pattern_planet.hpp"

namespace eyepoint::ig {
namespace {

constexpr PictureSize kSize{640, 480};

/// The terrain's vertex shader, linked to hand out positions in place of drawing.
GlProgram walking_program() {
    std::string text = "#version 450 core\n#define NESTED\n";
    for (const char* file : {"frame.glsl", "block.glsl", "nested.glsl", "terrain.vert.glsl"})
        text += shader_text(file);
    const char* source = text.c_str();
    const GlShader shader{GLenum{GL_VERTEX_SHADER}};
    glShaderSource(shader.name(), 1, &source, nullptr);
    glCompileShader(shader.name());
    GlProgram program;
    glAttachShader(program.name(), shader.name());
    const char* caught = "relative";
    glTransformFeedbackVaryings(program.name(), 1, &caught, GL_INTERLEAVED_ATTRIBS);
    glLinkProgram(program.name());
    GLint linked = GL_FALSE;
    glGetProgramiv(program.name(), GL_LINK_STATUS, &linked);
    EXPECT_EQ(linked, GL_TRUE);
    return program;
}

using Point = std::array<float, 3>;

class Walker {
  public:
    Walker() : program_(walking_program()) {
        using Vertex = terrain::BlockVertex;
        for (GLuint location = 0; location < 3; ++location) {
            glEnableVertexArrayAttrib(layout_.name(), location);
            glVertexArrayAttribBinding(layout_.name(), location, 0);
        }
        glVertexArrayAttribFormat(layout_.name(), 0, 3, GL_FLOAT, GL_FALSE, offsetof(Vertex, high));
        glVertexArrayAttribFormat(layout_.name(), 1, 3, GL_FLOAT, GL_FALSE, offsetof(Vertex, low));
        glVertexArrayAttribIFormat(layout_.name(), 2, 2, GL_UNSIGNED_INT, offsetof(Vertex, place));
        glNamedBufferStorage(caught_.name(), terrain::kBlockVertices * sizeof(Point), nullptr, 0);
    }

    void begin(const DrawList& list, const FrameUniforms& uniforms) {
        glNamedBufferData(uniforms_.name(), sizeof(uniforms), &uniforms, GL_STREAM_DRAW);
        glBindBufferBase(GL_UNIFORM_BUFFER, 0, uniforms_.name());
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, list.record_buffer());
        glBindTextureUnit(2, list.block_store().vertex_words());
        glBindVertexArray(layout_.name());
        glVertexArrayVertexBuffer(layout_.name(), 0, list.block_store().vertex_buffer(), 0,
                                  sizeof(terrain::BlockVertex));
        glUseProgram(program_.name());
    }

    /// Where the shader draws so many vertices from a place in the vertex buffer on.
    [[nodiscard]] std::vector<Point> positions(GLint first, std::size_t count) const {
        glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, caught_.name());
        glEnable(GL_RASTERIZER_DISCARD);
        glBeginTransformFeedback(GL_POINTS);
        glDrawArrays(GL_POINTS, first, static_cast<GLsizei>(count));
        glEndTransformFeedback();
        glDisable(GL_RASTERIZER_DISCARD);
        std::vector<Point> points(count);
        glGetNamedBufferSubData(caught_.name(), 0, static_cast<GLsizeiptr>(count * sizeof(Point)),
                                points.data());
        return points;
    }

  private:
    GlProgram program_;
    GlVertexArray layout_;
    GlBuffer uniforms_;
    GlBuffer caught_;
};

struct Tally {
    std::size_t vertices = 0;
    std::size_t moved = 0;      ///< drawn elsewhere than they are
    std::size_t differing = 0;  ///< in any bit
    std::size_t with_floors = 0;
    double largest_relative = 0.0;

    void add(const Point& shader, const terrain::DrawnVertex& expected, const terrain::BlockVertex& vertex,
             const terrain::SplitPosition& eye) {
        ++vertices;
        bool still = true, same = true;
        double distance = 0.0, error = 0.0;
        for (int axis = 0; axis < 3; ++axis) {
            const auto at = static_cast<std::size_t>(axis);
            const float unmoved = (vertex.high[at] - eye.high[at]) + (vertex.low[at] - eye.low[at]);
            still = still && unmoved == expected.from_eye[axis];
            same = same && shader[at] == expected.from_eye[axis];
            distance = std::max(distance, std::abs(static_cast<double>(expected.from_eye[axis])));
            error = std::max(error, std::abs(static_cast<double>(shader[at]) - expected.from_eye[axis]));
        }
        moved += still ? 0 : 1;
        differing += same ? 0 : 1;
        largest_relative = std::max(largest_relative, error / distance);
    }
};

class NestedWalkGl : public ::testing::TestWithParam<bool> {
  protected:
    NestedWalkGl()
        : context_(EglContext::create(false).value()),
          frame_buffer_(FrameBuffer::create(kSize).value()),
          database_(testing::make_pattern_database({}, scratch_.path() / "db")),
          pager_(
              terrain::Pager::create(database_, {.threads = 1, .mesh = terrain::MeshKind::Nested}).value()),
          method_(terrain::make_lod_method("nested")) {
        options_.morph = GetParam();
        frame_buffer_.bind();  // nothing is drawn without one
    }

    [[nodiscard]] const terrain::Selection& select(const View& view) {
        const auto& selection = method_->select(
            lod_view(view, options_.tau_px, options_.slack * options_.tau_px), pager_->tree(), ++frame_);
        pager_->request(selection.wishes);
        return selection;
    }

    void compare(const terrain::Selection& selection, const View& view) {
        list_->update(selection, frame_);
        walker_->begin(*list_, frame_uniforms(view, options_));
        const auto motion = terrain::motion_view(
            lod_view(view, options_.tau_px, options_.slack * options_.tau_px), options_.morph);
        std::set<const terrain::TileNode*> seen;
        for (std::size_t i = 0; i < selection.draws.size(); ++i) {
            const terrain::BlockDraw& draw = selection.draws[i];
            if (!seen.insert(draw.node).second) continue;
            const auto& vertices = draw.node->block->vertices;
            const auto points = walker_->positions(list_->all().base_vertices[i], vertices.size());
            for (std::size_t v = 0; v < vertices.size(); ++v) {
                tally_.add(
                    points[v],
                    terrain::drawn_vertex(*draw.node, static_cast<std::uint16_t>(v), draw.floors, motion),
                    vertices[v], motion.eye);
            }
            tally_.with_floors += draw.floors != terrain::EdgeFloors{} ? 1 : 0;
        }
    }

    testing::ScratchFolder scratch_;
    EglContext context_;
    FrameBuffer frame_buffer_;
    std::shared_ptr<const terrain::Database> database_;
    std::unique_ptr<terrain::Pager> pager_;
    std::unique_ptr<terrain::LodMethod> method_;
    SceneOptions options_;
    std::optional<DrawList> list_{std::in_place, true, 0, false};
    std::optional<Walker> walker_{std::in_place};
    std::uint64_t frame_ = 0;
    Tally tally_;
};

/// Level views to the north from a row of places and heights.
View view_from(int n) {
    std::mt19937 random(static_cast<unsigned>(n));
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const double latitude_deg = 140.0 * unit(random) - 70.0, longitude_deg = 360.0 * unit(random) - 180.0;
    const double height_m = 1000.0 * std::pow(1000.0, unit(random));
    return neutral_view({latitude_deg, longitude_deg, terrain::EllipsoidalHeight{height_m}}, {}, kSize);
}

/// Blocks arrive a few at a time, so that some frames have edges that wait for what is beyond them (floors).
TEST_P(NestedWalkGl, PutsEveryVertexWhereTheProcessorPutsIt) {
    for (int n = 0; n < 6; ++n) {
        const View view = view_from(n);
        while (true) {
            compare(select(view), view);
            if (!pager_->wait_for_loads()) break;
            (void)pager_->publish(9, frame_);
        }
    }
    EXPECT_GT(tally_.moved, tally_.vertices / 20) << "of " << tally_.vertices;
    EXPECT_GT(tally_.with_floors, 10U);
    EXPECT_EQ(tally_.differing, 0U) << "of " << tally_.vertices << ", the worst by "
                                    << tally_.largest_relative << " of its distance";
}

INSTANTIATE_TEST_SUITE_P(Morph, NestedWalkGl, ::testing::Bool(),
                         [](const auto& instance) { return instance.param ? "Slides" : "Jumps"; });

}  // namespace
}  // namespace eyepoint::ig
