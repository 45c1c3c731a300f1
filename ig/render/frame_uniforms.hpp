/// What the shaders of all passes read about a frame (ig/render/shaders/frame.glsl).
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "ig/render/gl_objects.hpp"
#include "ig/scene.hpp"
#include "ig/view.hpp"

namespace eyepoint::ig {

/// Layout std140 of the block Frame.
struct FrameUniforms {
    glm::mat4 clip_from_relative{1.0F};
    glm::vec4 eye_high{0.0F};
    glm::vec4 eye_low{0.0F};
    glm::vec4 eye_up{0.0F};
    glm::vec4 sun_direction{0.0F};
    glm::vec4 sunlight{0.0F};
    glm::vec4 skylight{0.0F};
    glm::vec4 air_at_eye{0.0F};
    glm::vec4 ray_corner{0.0F};
    glm::vec4 ray_right{0.0F};
    glm::vec4 ray_up{0.0F};
    glm::vec4 motion{0.0F};
};

/// From positions relative to the eye, in ECEF axes, to clip space: reverse Z (1 at near_m, 0 at infinity),
/// off-axis volumes as in CIGI's View Definition.
[[nodiscard]] glm::dmat4 clip_from_relative(const View& view);

[[nodiscard]] FrameUniforms frame_uniforms(const View& view, const SceneOptions& options);

}  // namespace eyepoint::ig
