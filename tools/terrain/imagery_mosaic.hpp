/// Several pictures as the colour of the whole Earth.
#pragma once

#include <vector>

#include "tools/terrain/gdal_imagery.hpp"
#include "tools/terrain/imagery_pyramid.hpp"
#include "tools/terrain/surface_source.hpp"

namespace eyepoint::tools {

/// Where no picture reaches: the colour of bare, dry ground from far above.
inline constexpr std::array<std::uint8_t, 3> kUnseenGround{104, 101, 84};

/// Pictures of like spacing (within a factor of 1.5) form a class; finer classes lie over coarser ones and
/// fade into them over 5% of a picture's shorter side within the edge of the class, and wherever alpha says.
/// Texels coarser than a picture's pixels are area averages. Thread use: const use is safe from any thread.
class ImageMosaic final : public ImagerySource {
  public:
    explicit ImageMosaic(std::vector<ColourGrid> grids, std::uint32_t max_depth = terrain::kMaxDepth);

    /// Whether a picture inside the tile has pixels finer than a texel of the parent's picture by more
    /// than 1.3.
    [[nodiscard]] bool has_detail(terrain::TileId tile) const override;
    void sample(const Lattice& lattice, std::span<std::uint8_t> out) const override;

    /// Finest first, without pixels.
    [[nodiscard]] const std::vector<FileFacts>& facts() const { return facts_; }
    [[nodiscard]] bool is_global() const;

  private:
    struct Picture {
        GridMapping mapping;
        int columns = 0;
        int rows = 0;
        double spacing_deg = 0.0;
        terrain::GeographicExtent bounds;
        bool goes_round = false;
        ImagePyramid pyramid;
    };
    static void fade_edges(std::vector<ColourGrid*>& of_class);

    std::uint32_t max_depth_;
    std::vector<Picture> pictures_;  ///< finest first
    std::vector<FileFacts> facts_;
};

}  // namespace eyepoint::tools
