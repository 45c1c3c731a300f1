/// The terrain's shader once at every pixel, without terrain: what shading alone costs.
#pragma once

#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "ig/render/draw_list.hpp"
#include "ig/render/gl_objects.hpp"

namespace eyepoint::ig {

class FloorPass {
  public:
    [[nodiscard]] static tl::expected<FloorPass, std::string> create();

    /// Shades every pixel whose depth says that something was drawn there, with the features that the list's
    /// blocks need. Needs the frame's uniforms bound; leaves depth as it is.
    void draw(const DrawList& list, GLuint noise) const;

  private:
    explicit FloorPass(std::vector<GlProgram> programs) : programs_(std::move(programs)) {}

    std::vector<GlProgram> programs_;  ///< by set of features
    GlVertexArray no_attributes_;
};

}  // namespace eyepoint::ig
