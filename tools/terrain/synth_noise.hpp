/// Gradient noise in space: a function of place alone, so a planet made of it has no seam and no pole.
/// After K. Perlin, "Improving Noise" (2002), with gradients hashed from the lattice point and the seed.
/// Thread use: pure functions, from any thread; the same bits for the same arguments.
#pragma once

#include <cstdint>

#include <glm/vec3.hpp>

namespace eyepoint::tools {

/// Evenly scattered bits for a lattice point.
[[nodiscard]] std::uint64_t lattice_hash(std::int64_t x, std::int64_t y, std::int64_t z, std::uint64_t seed);

/// Smooth, about -1..1, mean 0, features about one unit across.
[[nodiscard]] double gradient_noise(const glm::dvec3& place, std::uint64_t seed);

/// A sum of octaves, each half as wide; persistence is each octave's amplitude against the one before.
/// Divided by the sum of amplitudes: about -1..1.
[[nodiscard]] double fractal_noise(glm::dvec3 place, std::uint64_t seed, int octaves, double persistence);

/// Ridges, 0..1: each octave is folded at zero and weighted by the one before, so valleys stay smooth and
/// crests are rough (F. K. Musgrave's ridged multifractal, "Texturing and Modeling", chapter 16).
[[nodiscard]] double ridged_noise(glm::dvec3 place, std::uint64_t seed, int octaves, double persistence);

/// 0 below low, 1 above high, smooth between.
[[nodiscard]] double smooth_step(double low, double high, double value);

}  // namespace eyepoint::tools
