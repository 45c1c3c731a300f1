/// A picture at full size and at halved sizes, each an area average of the one above.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace eyepoint::tools {

/// Colour 0..255 and how much of it there is, 0..1.
struct Colour {
    std::array<float, 3> rgb{};
    float alpha = 0.0F;
};

/// Colours are averaged in proportion to alpha, so that what is masked out leaves no trace in coarser levels.
/// Thread use: const use is safe from any thread.
class ImagePyramid {
  public:
    /// rgba: rows from the top, columns * rows * 4 bytes. wraps: the right edge continues at the left.
    ImagePyramid(int columns, int rows, std::vector<std::uint8_t> rgba, bool wraps);

    [[nodiscard]] int levels() const { return static_cast<int>(levels_.size()); }
    /// Bilinear between the texels of a level; u and v are shares of width and height, 0..1 from the top
    /// left. Beyond the outer texels' centres their colour holds, or wraps in u.
    [[nodiscard]] Colour at(int level, double u, double v) const;

  private:
    struct Level {
        int columns = 0;
        int rows = 0;
        std::vector<std::uint8_t> rgba;
    };
    [[nodiscard]] static Level halved(const Level& above);

    std::vector<Level> levels_;
    bool wraps_;
};

}  // namespace eyepoint::tools
