#include "ig/render/resolve_pass.hpp"

#include "ig/render/program.hpp"

namespace eyepoint::ig {

tl::expected<ResolvePass, std::string> ResolvePass::create(bool nested) {
    std::vector<GlProgram> programs;
    for (std::size_t set = 0; set < kFeatureSets; ++set) {
        auto program = link_program({{"frame.glsl", "sky.vert.glsl"},
                                     {"frame.glsl", "tile.glsl", "relief.glsl", "chapman.glsl",
                                      "atmosphere.glsl", "ground.glsl", "surface.glsl", "resolve.frag.glsl"},
                                     shading_defines(set, nested)});
        if (!program) return tl::unexpected(program.error());
        programs.push_back(std::move(*program));
    }
    return ResolvePass{std::move(programs)};
}

void ResolvePass::begin(const SurfaceBuffer& surface, const DrawnTerrain& terrain, GLuint noise) const {
    glBindVertexArray(no_attributes_.name());
    terrain.bind_painted(noise);
    glBindTextureUnit(kSurfaceUnit, surface.texture());
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);  // the triangle is infinitely far: in front of it is what was drawn
    glDepthMask(GL_FALSE);
}

void ResolvePass::cover(std::size_t features) const {
    glUseProgram(programs_[features].name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

void ResolvePass::draw(const SurfaceBuffer& surface, const DrawnTerrain& terrain, GLuint noise) const {
    begin(surface, terrain, noise);
    cover(terrain.features);
    glDepthMask(GL_TRUE);
}

void ResolvePass::warm_up(const SurfaceBuffer& surface, const DrawnTerrain& terrain, GLuint noise) const {
    begin(surface, terrain, noise);
    for (std::size_t set = 0; set < kFeatureSets; ++set) cover(set);
    glDepthMask(GL_TRUE);
}

}  // namespace eyepoint::ig
