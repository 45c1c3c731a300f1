/// Eyes that go everywhere a method may fail: close to the ground inside blocks' boxes, straight down,
/// turning fast, over a line or a pole and back.
#pragma once

#include <cstddef>
#include <random>
#include <vector>

#include "terrain/lod/lod_method.hpp"
#include "tests/support/analytic_terrain.hpp"

namespace eyepoint::testing {

/// Around the middle of a terrain's detail; the same for a seed. Legs of kLegViews views, each of one kind:
/// low, down, turning, jumping.
class RandomWalk {
  public:
    static constexpr int kLegViews = 6;
    RandomWalk(const AnalyticTerrain& terrain, std::uint64_t seed) : terrain_(terrain), random_(seed) {}

    [[nodiscard]] terrain::LodView next(double tau_px, double slack_px);
    [[nodiscard]] std::vector<terrain::LodView> views(std::size_t count, double tau_px, double slack_px);

  private:
    [[nodiscard]] double unit() { return std::uniform_real_distribution<double>(0.0, 1.0)(random_); }
    void begin_leg();

    AnalyticTerrain terrain_;
    std::mt19937_64 random_;
    int views_ = 0;
    double east_deg_ = 0.0, north_deg_ = 0.0;            ///< of the middle, on the ground
    double east_step_deg_ = 0.0, north_step_deg_ = 0.0;  ///< a view
    double above_m_ = 0.0;                               ///< ground
    double course_rad_ = 0.0, course_step_rad_ = 0.0;
    double down_rad_ = 0.0, roll_rad_ = 0.0;
};

}  // namespace eyepoint::testing
