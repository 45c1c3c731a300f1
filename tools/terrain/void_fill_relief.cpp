#include "tools/terrain/void_fill_relief.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>

namespace eyepoint::tools {

namespace {

std::uint64_t mixed(std::uint64_t bits) {
    bits = (bits ^ (bits >> 31)) * 0x7fb5d329728ea185ULL;
    bits = (bits ^ (bits >> 27)) * 0x81dadef4bc2dd44dULL;
    return bits ^ (bits >> 33);
}

/// Slope contribution of the lattice corner at whole coordinates, seen from an offset of (dx, dy).
double corner(std::int64_t x, std::int64_t y, int octave, double dx, double dy) {
    const std::uint64_t bits =
        mixed(static_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15ULL ^
              mixed(static_cast<std::uint64_t>(y) + static_cast<std::uint64_t>(octave) * 977));
    const double angle = static_cast<double>(bits >> 11) * 0x1p-53 * 2.0 * std::numbers::pi;
    return std::cos(angle) * dx + std::sin(angle) * dy;
}

/// Gradient noise, about -0.7..0.7, with Perlin's quintic fade.
double gradient_noise(double x, double y, int octave) {
    const double whole_x = std::floor(x);
    const double whole_y = std::floor(y);
    const double dx = x - whole_x;
    const double dy = y - whole_y;
    const auto column = static_cast<std::int64_t>(whole_x);
    const auto row = static_cast<std::int64_t>(whole_y);
    const auto fade = [](double t) { return t * t * t * (t * (t * 6.0 - 15.0) + 10.0); };
    const double south =
        std::lerp(corner(column, row, octave, dx, dy), corner(column + 1, row, octave, dx - 1, dy), fade(dx));
    const double north = std::lerp(corner(column, row + 1, octave, dx, dy - 1),
                                   corner(column + 1, row + 1, octave, dx - 1, dy - 1), fade(dx));
    return std::lerp(south, north, fade(dy));
}

}  // namespace

float ridged_relief(double column, double row) {
    constexpr int kOctaves = 5;
    constexpr double kLongestPosts = 64.0;
    constexpr double kHurst = 0.9;
    // Measured once over 256 x 256 posts: makes the second difference over 2 posts 1 in the root mean square.
    constexpr double kScale = 24.3;
    double relief = 0.0;
    double wavelength = kLongestPosts;
    double amplitude = 1.0;
    for (int octave = 0; octave < kOctaves; ++octave) {
        // Each octave's lattice is turned another way, or rows and columns would show.
        const double turn = 0.4 + 0.65 * octave;
        const double x = (column * std::cos(turn) - row * std::sin(turn)) / wavelength;
        const double y = (column * std::sin(turn) + row * std::cos(turn)) / wavelength;
        const double noise = gradient_noise(x, y, octave);
        // A rounded crest instead of |noise| keeps ridges from becoming knives at post spacing.
        relief += amplitude * (0.35 - std::sqrt(noise * noise + 0.003));
        wavelength *= 0.5;
        amplitude *= std::pow(0.5, kHurst);
    }
    return static_cast<float>(relief * kScale);
}

}  // namespace eyepoint::tools
