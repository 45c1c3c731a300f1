#include "terrain/lod/tile/tile_slide.hpp"

#include <algorithm>

namespace eyepoint::terrain::tiles {

namespace {

glm::vec3 vector(const std::array<float, 3>& parts) { return {parts[0], parts[1], parts[2]}; }

/// The shader's computation, operation by operation. Places are (column, row) in the block's cells.
class Slider {
  public:
    Slider(const Block& block, const TileSlide& slide, int parts, const SplitPosition& eye)
        : block_(block),
          slide_(slide),
          cells_(kBlockCells / parts),
          origin_{slide.part % parts * cells_, slide.part / parts * cells_},
          eye_(eye) {}

    [[nodiscard]] glm::vec3 drawn(glm::ivec2 at) const {
        if (on_border(at)) return on_edge(at);
        const int step = 1 << slide_.level;
        const glm::ivec2 post = (at - origin_) / step;
        if (slide_.slid == 0 || ((post.x | post.y) & 1) == 0) return stored(at);
        const auto [a, b] = ends_of(post);
        return slid(stored(at), end(origin_ + a * step), end(origin_ + b * step), slide_.slid);
    }

  private:
    [[nodiscard]] glm::vec3 stored(glm::ivec2 at) const {
        const BlockVertex& vertex = block_.vertices[static_cast<std::size_t>(at.y * kBlockPosts + at.x)];
        return (vector(vertex.high) - vector(eye_.high)) + (vector(vertex.low) - vector(eye_.low));
    }
    [[nodiscard]] static glm::vec3 slid(const glm::vec3& from, const glm::vec3& a, const glm::vec3& b,
                                        int steps) {
        const float share = static_cast<float>(steps) * (1.0F / kSlideSteps);
        const glm::vec3 middle = 0.5F * (a + b);
        return (1.0F - share) * from + share * middle;
    }
    [[nodiscard]] bool on_border(glm::ivec2 at) const {
        const glm::ivec2 in = at - origin_;
        return in.x == 0 || in.x == cells_ || in.y == 0 || in.y == cells_;
    }
    [[nodiscard]] glm::vec3 end(glm::ivec2 at) const { return on_border(at) ? on_edge(at) : stored(at); }

    /// Corners stand: along an edge they are no odd post of any level.
    [[nodiscard]] glm::vec3 on_edge(glm::ivec2 at) const {
        const glm::ivec2 in = at - origin_;
        const bool upright = in.x == 0 || in.x == cells_;
        const int along = upright ? in.y : in.x;
        const int edge = upright ? (in.x == 0 ? 0 : 1) : (in.y == 0 ? 2 : 3);
        const int half = 2 * edge + (2 * along < cells_ ? 0 : 1);
        const int steps = slide_.border[static_cast<std::size_t>(half)];
        const int step = 1 << (slide_.level + (slide_.stitched >> half & 1));
        if (steps == 0 || (along / step & 1) == 0) return stored(at);
        const glm::ivec2 way = upright ? glm::ivec2{0, step} : glm::ivec2{step, 0};
        return slid(stored(at), stored(at - way), stored(at + way), steps);
    }

    const Block& block_;
    const TileSlide& slide_;
    int cells_;
    glm::ivec2 origin_;
    const SplitPosition& eye_;
};

/// In steps of the slide, from the coarsest.
int fineness(const Fineness& tile) { return tile.resolution * kSlideSteps - tile.slid; }

}  // namespace

std::pair<glm::ivec2, glm::ivec2> ends_of(glm::ivec2 post) {
    const glm::ivec2 odd = post & 1;
    const glm::ivec2 cell = post >> 1;
    const bool falling = odd.x + odd.y == 2 && ((cell.x + cell.y) & 1) != 0;
    const glm::ivec2 way{odd.x, falling ? -odd.y : odd.y};
    return {post - way, post + way};
}

Fineness border(const Fineness& tile, const Fineness& beside) {
    const int resolution = std::min(tile.resolution, beside.resolution);
    return {resolution, resolution * kSlideSteps - std::min(fineness(tile), fineness(beside))};
}

TileSlide slide_of(int part, int level, const Fineness& tile, const std::array<const Fineness*, 8>& beside) {
    TileSlide slide;
    slide.part = static_cast<std::uint8_t>(part);
    slide.level = static_cast<std::uint8_t>(level);
    slide.slid = static_cast<std::uint8_t>(tile.slid);
    for (std::size_t half = 0; half < beside.size(); ++half) {
        const Fineness edge = beside[half] != nullptr ? border(tile, *beside[half]) : tile;
        slide.border[half] = static_cast<std::uint8_t>(edge.slid);
        if (edge.resolution < tile.resolution) slide.stitched |= static_cast<std::uint8_t>(1U << half);
    }
    return slide;
}

glm::vec3 slid_vertex(const Block& block, std::uint16_t vertex, const TileSlide& slide, int parts,
                      const SplitPosition& eye) {
    return Slider{block, slide, parts, eye}.drawn({vertex % kBlockPosts, vertex / kBlockPosts});
}

}  // namespace eyepoint::terrain::tiles
