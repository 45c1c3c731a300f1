/// Several elevation grids as one surface of the whole Earth.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "terrain/geodesy/geoid.hpp"
#include "tools/terrain/mosaic_layer.hpp"
#include "tools/terrain/sea_mask.hpp"
#include "tools/terrain/surface_source.hpp"

namespace eyepoint::tools {

/// Tiles that hold nothing but sea are made down to this depth: posts 1.2 km apart follow the Earth's curve
/// to 3 cm.
inline constexpr std::uint32_t kDeepestSeaTile = 9;

struct MosaicOptions {
    SeaRule sea = SeaRule::Auto;
    std::uint32_t max_depth = terrain::kMaxDepth;
};

/// What became of one joined grid.
struct LayerFacts {
    std::vector<FileFacts> files;
    double spacing_deg = 0.0;
    terrain::GeographicExtent bounds;
    std::uint64_t voids_filled = 0;
    std::uint64_t voids_outside = 0;  ///< void in the file, shown from coarser data
    std::uint64_t sea_posts = 0;
    int margin_posts = 0;              ///< over which it fades into what is coarser; 0 where it has no edge
    bool filled_over_coarser = false;  ///< voids follow the shape of a coarser source
};

/// The Earth's surface from joined grids. Grids of like spacing (within a factor of 1.5) form a class; finer
/// classes lie over coarser ones and fade into them over a margin inside the edge of the class; within a
/// class the first in order lies over the next and fades into it where both are. Below all lies the sea, MSL
/// 0. The margin is 5% of the shorter side of the layer's smallest file, at most 20 posts of the next coarser
/// class, at least 4 posts. Thread use: const use is safe from any thread.
class Mosaic final : public ElevationSource {
  public:
    /// Grids hold MSL heights with voids, already joined (join_neighbours). The geoid must outlive the
    /// mosaic. progress is told the layers done and to do.
    Mosaic(std::vector<HeightGrid> grids, const terrain::Geoid& geoid, const MosaicOptions& options,
           const std::function<void(std::size_t done, std::size_t total)>& progress = {});

    [[nodiscard]] bool has_detail(terrain::TileId tile) const override;
    void sample(const Lattice& lattice, std::span<SurfaceSample> out) const override;

    /// MSL heights and water, before the geoid is added.
    struct MslSample {
        float msl_height_m = 0.0F;
        bool water = true;
    };
    [[nodiscard]] std::vector<MslSample> sample_msl(std::span<const LatLon> places) const;

    /// In drawing order, finest class first.
    [[nodiscard]] const std::vector<LayerFacts>& facts() const { return facts_; }
    /// Whether some layer covers the whole Earth.
    [[nodiscard]] bool is_global() const;

  private:
    using Class = std::vector<MosaicLayer>;
    [[nodiscard]] LayerFacts add_layer(Class& of_class, HeightGrid grid, SeaRule rule);
    void fade_edges(std::size_t class_index);
    [[nodiscard]] int margin_posts(const MosaicLayer& layer, std::size_t class_index) const;

    const terrain::Geoid* geoid_;
    std::uint32_t max_depth_;
    std::vector<Class> classes_;  ///< coarsest first
    std::vector<LayerFacts> facts_;
};

}  // namespace eyepoint::tools
