/// Whether two flights' pictures look the same, where OpenGL differs and their bits therefore do.
#pragma once

#include <filesystem>
#include <string>

#include <tl/expected.hpp>

#include "tools/bench/regression/comparison.hpp"

namespace eyepoint::tools {

/// How far pictures of two implementations of OpenGL may be apart, in shares of full brightness. They
/// interpolate, filter textures and compute powers with different precision and break ties at triangle edges
/// their own ways; a shift by half a pixel or a wrong colour is told all the same.
struct PictureThreshold {
    float step = 4.5F / 255.0F;  ///< a pixel differs when a channel is further apart than this
    double share = 0.02;         ///< of the pixels may differ
    double mean = 1.5 / 255.0;   ///< mean difference over all channels
};

/// Compares the pictures (PNG) of the same names by OpenImageIO. On failure (a folder without pictures, a
/// picture that only one has or that cannot be read, sizes that differ): one sentence.
[[nodiscard]] tl::expected<ComparedLine, std::string> compare_picture_folders(
    const std::filesystem::path& before, const std::filesystem::path& after,
    const PictureThreshold& threshold = {});

}  // namespace eyepoint::tools
