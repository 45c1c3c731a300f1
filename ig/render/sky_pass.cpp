#include "ig/render/sky_pass.hpp"

#include "ig/render/program.hpp"

namespace eyepoint::ig {

tl::expected<SkyPass, std::string> SkyPass::create() {
    auto program = link_program({{"frame.glsl", "sky.vert.glsl"},
                                 {"frame.glsl", "chapman.glsl", "atmosphere.glsl", "sky.frag.glsl"},
                                 {}});
    if (!program) return tl::unexpected(program.error());
    return SkyPass{std::move(*program)};
}

void SkyPass::draw() const {
    glUseProgram(program_.name());
    glBindVertexArray(no_attributes_.name());
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GEQUAL);
    glDepthMask(GL_FALSE);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDepthMask(GL_TRUE);
}

}  // namespace eyepoint::ig
