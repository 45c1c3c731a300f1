/// The surface below a tile as a square grid of samples.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace eyepoint::tools {

/// A post between the samples of a grid: place in units of its samples from the south-west.
struct LoneSample {
    double x = 0.0;
    double y = 0.0;
    float height_m = 0.0F;
};

/// Heights at samples a side: rows from south, samples from west. A tile without children has its posts;
/// others their children's samples, thinned to every second one beyond kMostSamples a side.
struct HeightSamples {
    static constexpr int kMostSamples = 513;
    int side = 0;
    std::vector<float> heights_m;
    /// How far full-resolution posts that are no samples may lie from the grid of samples around, metres.
    std::vector<float> between_m;
    /// Posts off the grid that lie farther from it than that: spikes, cliffs.
    std::vector<LoneSample> lone;

    [[nodiscard]] std::size_t at(int row, int column) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(side) +
               static_cast<std::size_t>(column);
    }
    /// Joins four children's samples (south-west, south-east, north-west, north-east), of any sides.
    /// most_between_m: what left out samples may lie from the grid without being kept as lone ones.
    [[nodiscard]] static HeightSamples join(const std::array<HeightSamples, 4>& children,
                                            float most_between_m);
};

}  // namespace eyepoint::tools
