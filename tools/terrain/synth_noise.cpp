#include "tools/terrain/synth_noise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace eyepoint::tools {

namespace {

/// Octaves are not whole multiples of each other, so that lattices do not line up.
constexpr double kLacunarity = 2.03;

using Gradient = std::array<double, 3>;

/// One of twelve, towards the middles of a cube's edges, by four bits: a coordinate's sign by the first bit,
/// another one's by the second.
constexpr Gradient gradient_of(std::size_t bits) {
    const std::size_t first = (bits & 8U) != 0 ? 1 : 0;
    const std::size_t second = (bits & 12U) == 0 ? 1 : (bits & 13U) == 12 ? 0 : 2;
    Gradient gradient{};
    gradient[first] = (bits & 1U) != 0 ? -1.0 : 1.0;
    gradient[second] = (bits & 2U) != 0 ? -1.0 : 1.0;
    return gradient;
}

constexpr std::array<Gradient, 16> kGradients = [] {
    std::array<Gradient, 16> gradients{};
    for (std::size_t bits = 0; bits < gradients.size(); ++bits) gradients[bits] = gradient_of(bits);
    return gradients;
}();

/// The slope of the gradient that the bits say, along an offset: a look-up, for which of them it is cannot be
/// foreseen, and so no branch can.
double slope(std::uint64_t bits, double x, double y, double z) {
    const Gradient& gradient = kGradients[bits & 15U];
    return gradient[0] * x + gradient[1] * y + gradient[2] * z;
}

constexpr std::uint64_t kAcross = 0x9e3779b97f4a7c15U, kUp = 0xc2b2ae3d27d4eb4fU,
                        kAbove = 0x165667b19e3779f9U;

std::uint64_t scattered(std::uint64_t bits) {
    bits = (bits ^ (bits >> 31)) * 0xd6e8feb86659fd93U;
    return bits ^ (bits >> 32);
}

double fade(double t) { return t * t * t * (t * (t * 6.0 - 15.0) + 10.0); }
double mix(double a, double b, double t) { return a + t * (b - a); }

}  // namespace

std::uint64_t lattice_hash(std::int64_t x, std::int64_t y, std::int64_t z, std::uint64_t seed) {
    return scattered(seed + static_cast<std::uint64_t>(x) * kAcross + static_cast<std::uint64_t>(y) * kUp +
                     static_cast<std::uint64_t>(z) * kAbove);
}

double gradient_noise(const glm::dvec3& place, std::uint64_t seed) {
    const double fx = std::floor(place.x), fy = std::floor(place.y), fz = std::floor(place.z);
    const auto bits_of = [](double whole) {
        return static_cast<std::uint64_t>(static_cast<std::int64_t>(whole));
    };
    const std::uint64_t bits = seed + bits_of(fx) * kAcross + bits_of(fy) * kUp + bits_of(fz) * kAbove;
    const double x = place.x - fx, y = place.y - fy, z = place.z - fz;
    const double u = fade(x), v = fade(y), w = fade(z);
    const auto corner = [&](unsigned i, unsigned j, unsigned k) {
        return slope(scattered(bits + i * kAcross + j * kUp + k * kAbove), x - i, y - j, z - k);
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
