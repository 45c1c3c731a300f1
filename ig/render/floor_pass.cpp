#include "ig/render/floor_pass.hpp"

#include "ig/render/program.hpp"

namespace eyepoint::ig {

tl::expected<FloorPass, std::string> FloorPass::create() {
    std::vector<GlProgram> programs;
    for (std::size_t set = 0; set < kFeatureSets; ++set) {
        auto program =
            link_program({{"frame.glsl", "floor.vert.glsl"}, ground_files(), feature_defines(set)});
        if (!program) return tl::unexpected(program.error());
        programs.push_back(std::move(*program));
    }
    return FloorPass{std::move(programs)};
}

void FloorPass::draw(const DrawList& list, GLuint noise) const {
    glBindVertexArray(no_attributes_.name());
    glBindTextureUnit(0, list.images().texture());
    glBindTextureUnit(1, noise);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);  // the triangle is infinitely far: in front of it is what was drawn
    glDepthMask(GL_FALSE);
    glUseProgram(programs_[list.features()].name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDepthMask(GL_TRUE);
}

}  // namespace eyepoint::ig
