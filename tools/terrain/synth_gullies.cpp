#include "tools/terrain/synth_gullies.hpp"

#include <cmath>

#include <glm/geometric.hpp>

#include "tools/terrain/synth_noise.hpp"

namespace eyepoint::tools {

namespace {

constexpr int kOctaves = 3;
/// Height of a rib above its gullies, against their width, on the steepest ground.
constexpr double kHeightPerWidth = 0.10;
/// Points lie on a scattered lattice of cells so many stripes wide.
constexpr double kStripesPerCell = 1.3;

double share(std::uint64_t bits) {
    return static_cast<double>(bits & 0xffffffU) / static_cast<double>(1U << 24);
}

struct Wave {
    double value = 0.0;          ///< -1..1
    glm::dvec2 slope{0.0, 0.0};  ///< of the value, per metre
};

/// Like a cosine of an angle in turns and its slope, from two cubics: cosines would take most of the time.
struct Swing {
    double value, slope_per_turn;
};
Swing swing(double turns) {
    const double part = turns - std::floor(turns + 0.5);
    const double u = 2.0 * std::abs(part);
    return {1.0 - 2.0 * u * u * (3.0 - 2.0 * u), std::copysign(24.0 * u * (1.0 - u), -part)};
}

/// Stripes width_m apart whose crests run at right angles to across, a unit vector.
Wave stripes(glm::dvec2 at_m, glm::dvec2 across, double width_m, std::uint64_t seed) {
    const glm::dvec2 at = at_m / (kStripesPerCell * width_m);
    const double column = std::floor(at.x), row = std::floor(at.y);
    double sum = 0.0, fall = 0.0, total = 0.0;
    for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) {
            const std::uint64_t bits = lattice_hash(static_cast<std::int64_t>(column) + i,
                                                    static_cast<std::int64_t>(row) + j, 0, seed);
            const glm::dvec2 away{at.x - column - i - 0.2 - 0.6 * share(bits),
                                  at.y - row - j - 0.2 - 0.6 * share(bits >> 24)};
            const double inside = 1.0 - glm::dot(away, away) / 1.44;
            if (inside <= 0.0) continue;
            const double weight = inside * inside * inside;
            const Swing here = swing(kStripesPerCell * glm::dot(away, across));
            sum += weight * here.value;
            fall += weight * here.slope_per_turn;
            total += weight;
        }
    }
    if (total <= 0.0) return {};
    return {sum / total, across * (fall / total / width_m)};
}

}  // namespace

double gullies_m(glm::dvec2 at_m, glm::dvec2 slope, double longest_m, std::uint64_t seed) {
    const double steepness = smooth_step(0.12, 0.75, glm::length(slope));
    if (steepness <= 0.0) return 0.0;
    double result_m = 0.0, width_m = longest_m;
    for (int octave = 0; octave < kOctaves; ++octave) {
        const glm::dvec2 down = glm::normalize(slope);
        const Wave wave =
            stripes(at_m, {-down.y, down.x}, width_m, seed + static_cast<std::uint64_t>(octave));
        const double height_m = 0.5 * kHeightPerWidth * width_m * steepness;
        result_m += height_m * wave.value;
        slope += height_m * wave.slope;
        width_m *= 0.5;
    }
    return result_m;
}

}  // namespace eyepoint::tools
