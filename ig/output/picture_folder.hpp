/// Numbered PNG pictures in a folder.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include <tl/expected.hpp>

#include "ig/picture.hpp"

namespace eyepoint::ig {

/// A folder that takes pictures; each is written beside its place and renamed when whole. Thread use: one
/// thread.
class PictureFolder {
  public:
    /// Makes the folder if it is not there, and tries to write into it. On failure: one sentence with the
    /// remedy.
    [[nodiscard]] static tl::expected<PictureFolder, std::string> open(const std::filesystem::path& folder);

    /// Writes frame-NUMBER.png, six digits or more, RGB. A picture of that number is replaced.
    [[nodiscard]] tl::expected<void, std::string> write(const Picture& picture, std::uint64_t number) const;

  private:
    explicit PictureFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}
    std::filesystem::path folder_;
};

/// Writes a PNG file (RGB, 8 bits), replacing a file of that name when the new one is whole. On failure: one
/// sentence, and nothing is left of the attempt.
[[nodiscard]] tl::expected<void, std::string> write_png(const Picture& picture,
                                                        const std::filesystem::path& file);

}  // namespace eyepoint::ig
