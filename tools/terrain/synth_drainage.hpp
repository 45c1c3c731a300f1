/// Landscape evolution on a grid: uplift against rivers, which is what makes valleys join, ridges branch and
/// slopes lead down to the sea.
///
/// Rivers cut by the stream power law, dh/dt = U - K A^0.5 |grad h|, A being the drained area; solved
/// implicitly from the sea upstream (J. Braun & S. Willett, "A very efficient O(n), implicit and parallel
/// method to solve the stream power equation", Geomorphology 180, 2013). Pits are drained over their lowest
/// rim by a priority flood (R. Barnes, C. Lehman & D. Mulla, Computers & Geosciences 62, 2014). Slopes
/// steeper than rock stands slide.
#pragma once

#include <cstdint>
#include <vector>

#include "tools/terrain/synth_grid.hpp"

namespace eyepoint::tools {

/// Where water goes.
struct Drainage {
    std::vector<std::uint32_t> receiver;  ///< the post each drains to; itself at base level
    std::vector<std::uint32_t> order;     ///< every post, receivers before those that drain to them
    std::vector<double> area_m2;          ///< drained through the post, its own cell included
};

/// is_base marks the posts where water leaves (the sea); the grid's border is base too. Water goes to the
/// steepest of eight neighbours, the steepness of each disturbed by chance, from the seed: else valleys would
/// show the grid.
[[nodiscard]] Drainage route_water(const HeightGrid& grid, const std::vector<std::uint8_t>& is_base,
                                   std::uint64_t seed);

struct ErosionRates {
    double step_years = 0.0;
    double erodibility_per_year = 0.0;                    ///< K, for areas in square metres
    const std::vector<double>* steepest_slope = nullptr;  ///< rise over run
    const std::vector<double>* uplift_m_per_year = nullptr;
    const std::vector<double>* erodibility_factor = nullptr;
};

/// One time step. Base posts keep their heights.
[[nodiscard]] HeightGrid erode(const HeightGrid& grid, const std::vector<std::uint8_t>& is_base,
                               const ErosionRates& rates, std::uint64_t seed);

}  // namespace eyepoint::tools
