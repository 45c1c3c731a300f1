/// Gullies and ribs down a slope: stripes that run with the fall of the ground, each row of them branching
/// from the one twice as wide. A sum of windowed waves at scattered points (sparse convolution: A. Lagae, S.
/// Lefebvre, G. Drettakis & P. Dutre, "Procedural noise using sparse Gabor convolution", SIGGRAPH 2009).
/// Thread use: pure function, from any thread; the same bits for the same arguments.
#pragma once

#include <cstdint>

#include <glm/vec2.hpp>

namespace eyepoint::tools {

/// Metres to add to the ground at a place, metres east and north, where it rises by slope (rise over run).
/// Nothing on flat ground. longest_m: width of the broadest gullies. Continuous where slope is.
[[nodiscard]] double gullies_m(glm::dvec2 at_m, glm::dvec2 slope, double longest_m, std::uint64_t seed);

}  // namespace eyepoint::tools
