/// The sky wherever no terrain was drawn.
#pragma once

#include <memory>
#include <string>

#include <tl/expected.hpp>

#include "ig/render/gl_objects.hpp"

namespace eyepoint::ig {

class SkyPass {
  public:
    [[nodiscard]] static tl::expected<SkyPass, std::string> create();
    /// Needs the frame's uniforms bound. Draws at infinite distance, behind what is there; leaves depth as it
    /// is.
    void draw() const;

  private:
    explicit SkyPass(GlProgram program) : program_(std::move(program)) {}
    GlProgram program_;
    GlVertexArray no_attributes_;
};

}  // namespace eyepoint::ig
