/// The surface below a tile, and how far flat triangles are from it.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "terrain/geodesy/position.hpp"
#include "terrain/tiling/tile_id.hpp"
#include "tools/terrain/nest/height_samples.hpp"

namespace eyepoint::tools {

/// A corner: place in units of samples from the south-west, and position.
struct Corner {
    double x = 0.0;
    double y = 0.0;
    std::array<float, 3> position_m{};
};

/// Distances between samples and triangles. Where the Earth is all but flat (tiles of kFlatDepth and deeper)
/// along the tile's middle vertical, between points of equal latitude and longitude; else in space between
/// those.
class SampledSurface {
  public:
    static constexpr std::uint32_t kFlatDepth = 7;

    SampledSurface(terrain::TileId tile, const HeightSamples& samples);

    [[nodiscard]] int side() const { return side_; }
    /// Position of a post, in the frame the distances are taken in (only [0] counts where the Earth is flat).
    [[nodiscard]] std::array<float, 3> position_m(double latitude_deg, double longitude_deg,
                                                  double height_m) const;

    /// Distance between two corners, metres; in tiles of kFlatDepth and deeper not less, and a little more.
    [[nodiscard]] float side_m(const Corner& a, const Corner& b) const;

    /// Greatest distance of the samples in a counterclockwise triangle from it, metres; a number above
    /// `enough_m` when it is more than that, as soon as that is known. Samples outside the grid are left out.
    [[nodiscard]] float error_m(const Corner& a, const Corner& b, const Corner& c, float enough_m) const;

    /// Not less than error_m() of any triangle whose corners are on the way from the three of `from`, which
    /// are counterclockwise, to those of `to`, or anywhere between such corners: infinite if there are lone
    /// samples. Distances from the plane of `from`, of what slides and of all samples in the box around,
    /// added up: mostly that is little enough, and cheaper than the errors of the triangles on the way.
    [[nodiscard]] float sweep_bound_m(const std::array<Corner, 3>& from,
                                      const std::array<Corner, 3>& to) const;

  private:
    template <std::size_t kParts>
    [[nodiscard]] float greatest(const Corner& a, const Corner& b, const Corner& c, float enough_m) const;
    template <std::size_t kParts>
    [[nodiscard]] float sweep_bound(const std::array<Corner, 3>& from, const std::array<Corner, 3>& to) const;

    [[nodiscard]] std::vector<std::size_t> keep_lone(terrain::TileId tile, const HeightSamples& samples);
    [[nodiscard]] float lone_error_m(const std::array<const Corner*, 3>& corners, double area) const;

    int side_;
    bool flat_;
    std::array<float, 2> spacing_m_{};  ///< between samples, eastward and northward, where the Earth is flat
    terrain::Ecef origin_;
    terrain::Ecef up_;
    std::array<std::vector<float>, 3> positions_m_;
    std::vector<float> between_m_;
    bool all_are_samples_;  ///< between_m_ is 0
    /// Lone samples, by the row below them: those of row r from lone_rows_[r] to lone_rows_[r + 1].
    struct Lone {
        double x, y;
        std::array<float, 3> position_m;
    };
    std::vector<Lone> lone_;
    std::vector<std::size_t> lone_rows_;
};

}  // namespace eyepoint::tools
