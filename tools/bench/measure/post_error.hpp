/// Post error: how far the drawn mesh is from every full-resolution post in view, in metres and in pixels.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "tools/bench/measure/drawn_mesh.hpp"
#include "tools/bench/measure/full_surface.hpp"
#include "tools/bench/measure/pixel_distribution.hpp"

namespace eyepoint::tools {

/// One tile's posts in one frame, index row * PostTile::kSide + column.
struct MeasuredTile {
    std::shared_ptr<const PostTile> tile;
    /// Height of the drawn mesh above the post along the post's vertical, metres; the greatest in size where
    /// several triangles cover it. NaN where none does.
    std::vector<float> above_m;
    /// Pixels that a metre of vertical distance is at the post: kappa * h / D^2, h being the horizontal part
    /// of the distance D from the eye. NaN for a post that is not in view or not counted in this tile.
    std::vector<float> px_per_m;
    /// Triangles that cover the post, seen from above, less those seen from below; 1 where the mesh is whole.
    std::vector<std::int8_t> layers;
    /// A triangle that covers the post is seen from below.
    std::vector<bool> folded;
};

/// The posts in view of one frame, tile by tile.
struct MeasuredPosts {
    std::vector<MeasuredTile> tiles;
};

/// The post with the greatest error.
struct WorstPost {
    terrain::TileId tile;
    int row = 0, column = 0;
    float error_px = -1.0F;  ///< less than 0: there is none
    float above_m = 0.0F;
    bool folded = false;
};

struct PostFigures {
    WorstPost worst;
    PixelDistribution error;         ///< |above| in pixels of all posts in view that are covered
    double most_off_folds_px = 0.0;  ///< the greatest of posts that are under no fold
    std::uint64_t uncovered = 0;     ///< posts in view over which nothing is drawn: holes
    std::optional<WorstPost> hole;   ///< one of them; without an error
    std::uint64_t overlapped = 0;    ///< covered by more than one layer
    std::uint64_t folded = 0;        ///< under a triangle that is seen from below
    void merge(const PostFigures& other);
};

/// Finds, for every post of every tile in view, the drawn triangles that its vertical meets. Exact as to
/// which triangle that is (a post on an edge or a corner is in one); heights to the rounding of the vertices
/// (floats from the eye). On failure (unreadable tile): one sentence.
[[nodiscard]] tl::expected<MeasuredPosts, std::string> measure_posts(FullSurface& surface,
                                                                     const DrawnMesh& mesh,
                                                                     const PostView& view);

[[nodiscard]] PostFigures post_figures(const MeasuredPosts& posts);

/// The jump of the drawn height of every post in view in both frames, in pixels of the second.
[[nodiscard]] PixelDistribution pops(const MeasuredPosts& before, const MeasuredPosts& after);

}  // namespace eyepoint::tools
