/// A finished picture in memory.
#pragma once

#include <cstdint>
#include <vector>

namespace eyepoint::ig {

struct PictureSize {
    int width_px = 0;
    int height_px = 0;
    auto operator<=>(const PictureSize&) const = default;
};

/// Rows from the top, pixels from the left, four bytes each: red, green, blue (sRGB) and one that means
/// nothing.
struct Picture {
    static constexpr int kBytesPerPixel = 4;
    PictureSize size;
    std::vector<std::uint8_t> rgba;

    [[nodiscard]] static std::size_t bytes(PictureSize size) {
        return static_cast<std::size_t>(size.width_px) * static_cast<std::size_t>(size.height_px) *
               kBytesPerPixel;
    }
};

}  // namespace eyepoint::ig
