/// A small repeating noise picture that breaks up the ground's plain colours.
#pragma once

#include "ig/render/gl_objects.hpp"

namespace eyepoint::ig {

/// 256 x 256 texels, repeating without a seam, with smaller copies; red: broad patches, green: fine grain;
/// both with mean 0.5. The same bits on every machine.
[[nodiscard]] GlTexture make_noise_texture();

}  // namespace eyepoint::ig
