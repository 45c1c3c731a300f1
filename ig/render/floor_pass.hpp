/// The terrain's shader once at every pixel, without terrain: what shading alone costs.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "ig/render/drawn_terrain.hpp"
#include "ig/render/gl_objects.hpp"

namespace eyepoint::ig {

class FloorPass {
  public:
    /// nested: shades as blocks of nested meshes are.
    [[nodiscard]] static tl::expected<FloorPass, std::string> create(bool nested);

    /// Shades every pixel whose depth says that something was drawn there, with the features that any block
    /// needs, as ground of the block in a slot. Needs the frame's uniforms bound; leaves depth as it is.
    void draw(const DrawnTerrain& terrain, std::uint32_t slot, GLuint noise) const;

  private:
    explicit FloorPass(std::vector<GlProgram> programs) : programs_(std::move(programs)) {}

    std::vector<GlProgram> programs_;  ///< by set of features
    GlVertexArray no_attributes_;
};

}  // namespace eyepoint::ig
