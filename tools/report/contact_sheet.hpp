/// Many pictures of a run on one.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include <tl/expected.hpp>

#include "tools/report/pictures.hpp"

namespace eyepoint::tools {

/// Lays the pictures out in rows, left to right and top to bottom, with a gap between them.
[[nodiscard]] SmallPicture lay_out(std::span<const SmallPicture> pictures, int columns);

/// Writes the picture in the format of the file's extension, whole or not at all. On failure: one sentence.
[[nodiscard]] tl::expected<void, std::string> write_picture(const std::filesystem::path& file,
                                                            const SmallPicture& picture);

}  // namespace eyepoint::tools
