/// A run's numbered pictures, chosen and made small.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <tl/expected.hpp>

namespace eyepoint::tools {

/// An 8-bit sRGB picture, row 0 at the top.
struct SmallPicture {
    std::string name;  ///< of its file, without folder and extension
    int width_px = 0;
    int height_px = 0;
    std::vector<std::uint8_t> rgb{};
};

/// The folder's pictures (.png, .jpg, .jpeg), by name, thinned to at most `count` spread evenly from the
/// first to the last. On failure (no such folder, no picture in it): one sentence.
[[nodiscard]] tl::expected<std::vector<std::filesystem::path>, std::string> choose_pictures(
    const std::filesystem::path& folder, std::size_t count);

/// Reads a picture and resizes it to the width, its shape kept. On failure: one sentence.
[[nodiscard]] tl::expected<SmallPicture, std::string> read_small(const std::filesystem::path& file,
                                                                 int width_px);

/// JPEG, quality 1..100. On failure: one sentence.
[[nodiscard]] tl::expected<std::string, std::string> jpeg(const SmallPicture& picture, int quality);

}  // namespace eyepoint::tools
