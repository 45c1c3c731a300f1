/// One grid of the mosaic, ready to be sampled.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tools/terrain/mosaic_distance.hpp"
#include "tools/terrain/mosaic_grid.hpp"

namespace eyepoint::tools {

/// What a layer says of one place.
struct LayerSample {
    float msl_height_m = 0.0F;
    float own_weight = 0.0F;    ///< falls to 0 at the edge of this layer
    float class_weight = 0.0F;  ///< falls to 0 at the edge of all layers of like spacing
    bool water = false;
    bool covered = false;
};

/// A joined grid, its voids filled, its sea marked. Between posts heights follow Steffen's cubic, first along
/// rows, then across them: exact at posts, smooth, and never above or below the posts on either side (M.
/// Steffen, A simple method for monotonic interpolation in one dimension, Astronomy and Astrophysics 239,
/// 1990). Thread use: const use is safe from any thread.
class MosaicLayer {
  public:
    /// water: 1 for posts of sea, whose heights must be 0.
    MosaicLayer(HeightGrid grid, std::vector<std::uint8_t> water);

    /// Sets the weights at the layer's edge; before, they are 1.
    void set_edges(EdgeWeights own, EdgeWeights of_class);

    [[nodiscard]] const HeightGrid& grid() const { return grid_; }
    [[nodiscard]] const terrain::GeographicExtent& bounds() const { return bounds_; }
    /// Whether it fades out anywhere.
    [[nodiscard]] bool has_edge() const { return !of_class_.is_one(); }
    /// Whether a whole post position holds a height; columns wrap and rows fold over the poles on a global
    /// grid.
    [[nodiscard]] bool covers(int column, int row) const;
    /// Whether a place lies on the layer, voids apart.
    [[nodiscard]] bool covers(LatLon place) const;
    void sample(std::span<const LatLon> places, std::span<LayerSample> out) const;

    enum class Content : std::uint8_t { None, Water, Land };
    /// The most that any covered post in or next to the extent is; may err towards more.
    [[nodiscard]] Content content(const terrain::GeographicExtent& extent) const;

  private:
    [[nodiscard]] std::ptrdiff_t post(int column, int row) const;  ///< -1 where there is none
    [[nodiscard]] float height(int column, int row) const;
    [[nodiscard]] LayerSample sample(GridPosition position) const;
    [[nodiscard]] float interpolated(int column, int row, double dx, double dy) const;
    [[nodiscard]] float along_row(int column, int row, double dx) const;
    [[nodiscard]] GridPosition onto_posts(GridPosition position) const;
    void summarise();

    HeightGrid grid_;
    std::vector<std::uint8_t> water_;
    EdgeWeights own_;
    EdgeWeights of_class_;
    terrain::GeographicExtent bounds_;
    int around_ = 0;      ///< columns of a full turn, 0 when the grid does not go round
    bool folds_ = false;  ///< the grid goes round and reaches the poles
    int north_fold_ = 0;  ///< row r beyond the first is row north_fold - r on the other side of the pole
    int south_fold_ = 0;
    std::vector<Content> blocks_;  ///< content of each kBlock x kBlock posts
    int block_columns_ = 0;
};

}  // namespace eyepoint::tools
