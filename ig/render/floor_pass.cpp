#include "ig/render/floor_pass.hpp"

#include "ig/render/program.hpp"

namespace eyepoint::ig {

tl::expected<FloorPass, std::string> FloorPass::create(bool nested) {
    std::vector<GlProgram> programs;
    for (std::size_t set = 0; set < kFeatureSets; ++set) {
        auto program =
            link_program({{"frame.glsl", "floor.vert.glsl"}, ground_files(), shading_defines(set, nested)});
        if (!program) return tl::unexpected(program.error());
        programs.push_back(std::move(*program));
    }
    return FloorPass{std::move(programs)};
}

void FloorPass::draw(const DrawnTerrain& terrain, std::uint32_t slot, GLuint noise) const {
    glBindVertexArray(no_attributes_.name());
    terrain.bind_painted(noise);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);  // the triangle is infinitely far: in front of it is what was drawn
    glDepthMask(GL_FALSE);
    glUseProgram(programs_[terrain.features].name());
    glUniform1i(0, static_cast<GLint>(slot));
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDepthMask(GL_TRUE);
}

}  // namespace eyepoint::ig
