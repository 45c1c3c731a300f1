/// One tile's block from its parent's block and the source.
///
/// Heights are one function of place: a coarse post is a fine post. So the even posts of a child, which are
/// posts of its parent, are the parent's; odd posts are sampled, but on an edge with no tile of the same
/// depth beyond it they are the midpoint of their two neighbours on the edge, which is where the coarser
/// side's surface lies. All posts at a pole have one height, and the antimeridian is sampled at 180 W from
/// both sides.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include <tl/expected.hpp>

#include "terrain/database/database.hpp"
#include "terrain/geodesy/geoid.hpp"
#include "tools/terrain/compile_plan.hpp"
#include "tools/terrain/surface_source.hpp"

namespace eyepoint::tools {

/// A block while it is made: heights in whole quanta (terrain/database/interpolate.hpp), laid out as
/// BlockData's.
struct QuantisedBlock {
    terrain::TileId tile;
    std::array<std::int32_t, terrain::kApronPosts * terrain::kApronPosts> heights{};
    std::array<std::uint8_t, terrain::kBlockPosts * terrain::kBlockPosts> water{};

    [[nodiscard]] std::int32_t& height(int row, int column) {
        return heights[static_cast<std::size_t>((row + 1) * terrain::kApronPosts + column + 1)];
    }
    [[nodiscard]] std::int32_t height(int row, int column) const {
        return heights[static_cast<std::size_t>((row + 1) * terrain::kApronPosts + column + 1)];
    }
};

class BlockMaker {
  public:
    /// The plan and the source are kept by reference.
    BlockMaker(const TilePlan& plan, const ElevationSource& source, double height_step_m)
        : plan_(plan), source_(source), height_step_m_(height_step_m) {}

    /// parent is null for a root tile. On failure (a height that is no number): one sentence.
    [[nodiscard]] tl::expected<QuantisedBlock, std::string> make(terrain::TileId tile,
                                                                 const QuantisedBlock* parent) const;

    /// The block as it is stored.
    [[nodiscard]] terrain::BlockData finish(const QuantisedBlock& block, const terrain::Geoid& geoid) const;

  private:
    [[nodiscard]] tl::expected<QuantisedBlock, std::string> sample(terrain::TileId tile) const;
    void sample_column(QuantisedBlock& block, int column, double longitude_deg) const;
    void level_pole(QuantisedBlock& block, int row, double latitude_deg) const;
    void match_coarser_edges(QuantisedBlock& block) const;

    const TilePlan& plan_;
    const ElevationSource& source_;
    double height_step_m_;
};

}  // namespace eyepoint::tools
