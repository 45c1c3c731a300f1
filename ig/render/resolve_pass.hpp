/// Shading after raster: the terrain's shader once a pixel.
#pragma once

#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "ig/render/drawn_terrain.hpp"
#include "ig/render/gl_objects.hpp"
#include "ig/render/surface_buffer.hpp"

namespace eyepoint::ig {

class ResolvePass {
  public:
    /// nested: of blocks of nested meshes.
    [[nodiscard]] static tl::expected<ResolvePass, std::string> create(bool nested);

    /// Shades every pixel whose depth says that something was drawn there, from the surface. Needs the
    /// frame's uniforms bound; leaves depth as it is.
    void draw(const SurfaceBuffer& surface, const DrawnTerrain& terrain, GLuint noise) const;
    /// The same with every program, so that no later frame pays for a first use.
    void warm_up(const SurfaceBuffer& surface, const DrawnTerrain& terrain, GLuint noise) const;

  private:
    explicit ResolvePass(std::vector<GlProgram> programs) : programs_(std::move(programs)) {}
    void begin(const SurfaceBuffer& surface, const DrawnTerrain& terrain, GLuint noise) const;
    void cover(std::size_t features) const;

    std::vector<GlProgram> programs_;  ///< by set of features
    GlVertexArray no_attributes_;
};

}  // namespace eyepoint::ig
