#include "tools/terrain/synth_noise.hpp"

#include <algorithm>
#include <cmath>

namespace eyepoint::tools {

namespace {

/// Octaves are not whole multiples of each other, so that lattices do not line up.
constexpr double kLacunarity = 2.03;

/// The slope of one of twelve gradients, towards the middles of a cube's edges, along an offset.
double slope(std::uint64_t bits, double x, double y, double z) {
    const double u = (bits & 8U) != 0 ? y : x;
    const double v = (bits & 12U) == 0 ? y : ((bits & 13U) == 12 ? x : z);
    return ((bits & 1U) != 0 ? -u : u) + ((bits & 2U) != 0 ? -v : v);
}

double fade(double t) { return t * t * t * (t * (t * 6.0 - 15.0) + 10.0); }
double mix(double a, double b, double t) { return a + t * (b - a); }

}  // namespace

std::uint64_t lattice_hash(std::int64_t x, std::int64_t y, std::int64_t z, std::uint64_t seed) {
    std::uint64_t bits = seed + static_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15ULL +
                         static_cast<std::uint64_t>(y) * 0xc2b2ae3d27d4eb4fULL +
                         static_cast<std::uint64_t>(z) * 0x165667b19e3779f9ULL;
    bits = (bits ^ (bits >> 31)) * 0xd6e8feb86659fd93ULL;
    return bits ^ (bits >> 32);
}

double gradient_noise(const glm::dvec3& place, std::uint64_t seed) {
    const double fx = std::floor(place.x), fy = std::floor(place.y), fz = std::floor(place.z);
    const auto ix = static_cast<std::int64_t>(fx), iy = static_cast<std::int64_t>(fy),
               iz = static_cast<std::int64_t>(fz);
    const double x = place.x - fx, y = place.y - fy, z = place.z - fz;
    const double u = fade(x), v = fade(y), w = fade(z);
    const auto corner = [&](int i, int j, int k) {
        return slope(lattice_hash(ix + i, iy + j, iz + k, seed), x - i, y - j, z - k);
    };
    const double low =
        mix(mix(corner(0, 0, 0), corner(1, 0, 0), u), mix(corner(0, 1, 0), corner(1, 1, 0), u), v);
    const double high =
        mix(mix(corner(0, 0, 1), corner(1, 0, 1), u), mix(corner(0, 1, 1), corner(1, 1, 1), u), v);
    return mix(low, high, w);
}

double fractal_noise(glm::dvec3 place, std::uint64_t seed, int octaves, double persistence) {
    double sum = 0.0, amplitude = 1.0, total = 0.0;
    for (int octave = 0; octave < octaves; ++octave) {
        sum += amplitude * gradient_noise(place, seed + static_cast<std::uint64_t>(octave));
        total += amplitude;
        amplitude *= persistence;
        place *= kLacunarity;
    }
    return sum / total;
}

double ridged_noise(glm::dvec3 place, std::uint64_t seed, int octaves, double persistence) {
    double sum = 0.0, amplitude = 1.0, total = 0.0, weight = 1.0;
    for (int octave = 0; octave < octaves; ++octave) {
        const double fold = 1.0 - std::abs(gradient_noise(place, seed + static_cast<std::uint64_t>(octave)));
        const double ridge = fold * fold * weight;
        sum += amplitude * ridge;
        total += amplitude;
        weight = std::clamp(ridge * 1.6, 0.0, 1.0);
        amplitude *= persistence;
        place *= kLacunarity;
    }
    return sum / total;
}

double smooth_step(double low, double high, double value) {
    const double t = std::clamp((value - low) / (high - low), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

}  // namespace eyepoint::tools
