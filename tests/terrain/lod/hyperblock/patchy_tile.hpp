/// A tile that is rough in places and flat in others, with its hyper-blocks.
#pragma once

#include <memory>
#include <optional>
#include <random>

#include "terrain/lod/hyperblock/hyper_tree.hpp"

namespace eyepoint::testing {

inline constexpr terrain::TileId kPatchyTile{12, 4283, 3072};
inline constexpr float kPatchyUnseenM = 3.0F;

/// Bumps of up to 900 m around a few posts on a plain.
[[nodiscard]] inline std::shared_ptr<const terrain::Block> patchy_block(unsigned seed) {
    terrain::BlockData data;
    data.tile = kPatchyTile;
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> height_m(0.0F, 900.0F), place(0.0F, 34.0F), radius(1.0F, 9.0F);
    for (int patch = static_cast<int>(random() % 6); patch > 0; --patch) {
        const float row = place(random), column = place(random), reach = radius(random);
        for (int post = 0; post < static_cast<int>(data.heights_m.size()); ++post) {
            const float dr = static_cast<float>(post / terrain::kApronPosts) - row,
                        dc = static_cast<float>(post % terrain::kApronPosts) - column;
            if (dr * dr + dc * dc < reach * reach)
                data.heights_m[static_cast<std::size_t>(post)] = height_m(random);
        }
    }
    return terrain::unfold(data, std::nullopt);
}

struct PatchyTile {
    explicit PatchyTile(unsigned seed, int hyper_level, float tolerance_m = 100.0F)
        : block(patchy_block(seed)),
          posts(terrain::selective::block_posts(*block, kPatchyUnseenM)),
          points(terrain::hyperblock::point_set(posts, kPatchyUnseenM, {tolerance_m, 1e9F})),
          tree(terrain::hyperblock::make_hyper_tree(*block, posts, kPatchyUnseenM, points, hyper_level)) {}

    std::shared_ptr<const terrain::Block> block;
    terrain::selective::BlockPosts posts;
    terrain::hyperblock::PointSet points;
    terrain::hyperblock::HyperTree tree;
};

}  // namespace eyepoint::testing
