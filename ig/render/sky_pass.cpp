#include "ig/render/sky_pass.hpp"

#include <array>
#include <string_view>

#include "ig/render/program.hpp"

namespace eyepoint::ig {

tl::expected<SkyPass, std::string> SkyPass::create() {
    constexpr std::array<std::string_view, 2> kVertex{"frame.glsl", "sky.vert.glsl"};
    constexpr std::array<std::string_view, 3> kFragment{"frame.glsl", "atmosphere.glsl", "sky.frag.glsl"};
    auto program = link_program(kVertex, kFragment);
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
