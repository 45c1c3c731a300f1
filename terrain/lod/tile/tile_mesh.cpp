#include "terrain/lod/tile/tile_mesh.hpp"

namespace eyepoint::terrain::tiles {

namespace {

struct Post {
    int row = 0;
    int column = 0;
};

class Maker {
  public:
    Maker(std::vector<std::uint16_t>& indices, const Division& division, int part, std::uint8_t stitched)
        : indices_(indices),
          cells_(division.cells),
          origin_{part / division.parts * division.cells, part % division.parts * division.cells},
          stitched_(stitched) {}

    void append(int level) {
        const int step = 1 << level;
        for (int row = step; row < cells_; row += 2 * step) {
            for (int column = step; column < cells_; column += 2 * step) append_fan({row, column}, step);
        }
    }

  private:
    /// Around a post, counter-clockwise from above, from the south-west.
    void append_fan(Post middle, int step) {
        constexpr std::array<Post, 8> kRound{
            {{-1, -1}, {-1, 0}, {-1, 1}, {0, 1}, {1, 1}, {1, 0}, {1, -1}, {0, -1}}};
        std::array<std::uint16_t, 8> rim{};
        std::size_t count = 0;
        for (const Post& way : kRound) {
            const Post post{middle.row + way.row * step, middle.column + way.column * step};
            const bool in_side = way.row == 0 || way.column == 0;
            if (!in_side || !stitched_at(post)) rim[count++] = index(post);
        }
        for (std::size_t i = 0; i < count; ++i)
            indices_.insert(indices_.end(), {index(middle), rim[i], rim[(i + 1) % count]});
    }

    [[nodiscard]] bool stitched_at(Post post) const {
        const auto has = [&](Edge edge, int along) {
            return (stitched_ >> (2 * static_cast<int>(edge) + (2 * along < cells_ ? 0 : 1)) & 1) != 0;
        };
        return (post.column == 0 && has(Edge::West, post.row)) ||
               (post.column == cells_ && has(Edge::East, post.row)) ||
               (post.row == 0 && has(Edge::South, post.column)) ||
               (post.row == cells_ && has(Edge::North, post.column));
    }

    [[nodiscard]] std::uint16_t index(Post post) const {
        return static_cast<std::uint16_t>((origin_.row + post.row) * kBlockPosts + origin_.column +
                                          post.column);
    }

    std::vector<std::uint16_t>& indices_;
    int cells_;
    Post origin_;
    std::uint8_t stitched_;
};

}  // namespace

TileMeshes::TileMeshes(const Division& division) : levels_(division.levels) {
    for (int part = 0; part < division.parts * division.parts; ++part) {
        for (int level = 0; level < division.levels; ++level) {
            for (int set = 0; set < kHalfEdgeSets; ++set) {
                const auto first = static_cast<std::uint32_t>(indices_.size());
                Maker{indices_, division, part, static_cast<std::uint8_t>(set)}.append(level);
                ranges_.push_back({first, static_cast<std::uint32_t>(indices_.size()) - first});
            }
        }
    }
}

}  // namespace eyepoint::terrain::tiles
