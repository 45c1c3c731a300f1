/// What the mountain region is given before rivers shape it: its coast, its main valley, its rock and how
/// fast it rises. All functions of metres east and north of the region's centre. Thread use: const use is
/// safe from any thread.
#pragma once

#include <cstdint>

#include <glm/vec2.hpp>

namespace eyepoint::tools {

/// A place as the main valley sees it.
struct ValleyPlace {
    double along_m = 0.0;   ///< up the valley, 0 under the sample flight
    double across_m = 0.0;  ///< from its middle line
};

class RegionSetting {
  public:
    explicit RegionSetting(std::uint64_t seed) : seed_(seed) {}

    /// Metres from the ancient coast, land positive.
    [[nodiscard]] double inland_m(glm::dvec2 at) const;
    [[nodiscard]] double uplift_m_per_year(glm::dvec2 at) const;
    /// Factor on how fast rivers cut: rock differs in bands.
    [[nodiscard]] double erodibility_factor(glm::dvec2 at) const;
    /// Rise over run at which rock slides.
    [[nodiscard]] double steepest_slope(glm::dvec2 at) const;

    [[nodiscard]] ValleyPlace in_valley(glm::dvec2 at) const;
    /// Half the width of the main valley's floor; 0 beyond the valley's ends.
    [[nodiscard]] double floor_half_width_m(double along_m) const;
    /// Height of the floor, of the lake's surface where the lake is.
    [[nodiscard]] double floor_msl_m(double along_m) const;
    /// How much of a lake is in the main valley here: 0..1.
    [[nodiscard]] double lake_share(double along_m) const;

    /// About -1..1, features width_m across; another salt, another noise.
    [[nodiscard]] double noise(glm::dvec2 at, double width_m, std::uint64_t salt, int octaves) const;

  private:
    std::uint64_t seed_;
};

}  // namespace eyepoint::tools
