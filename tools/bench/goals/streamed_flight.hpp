/// A flight drawn by a process of its own, blocks arriving as they are read, so that its peak memory is its
/// own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include <tl/expected.hpp>

#include "ig/picture.hpp"
#include "tools/bench/regression/flight_result.hpp"

namespace eyepoint::tools {

struct StreamedFlight {
    std::filesystem::path programs;  ///< folder of Eyepoint's programs
    std::filesystem::path flight;    ///< recorded flight, altitudes above the ellipsoid, or planar path
    std::filesystem::path terrain;
    ig::PictureSize size;
    double vertical_fov_deg = 40.0;
    double rate_hz = 30.0;  ///< frames a second of a recorded flight
    std::string lod_method;
    double tau_px = 1.0;
    std::uint32_t triangle_budget = 0;  ///< bintree alone; 0: none
    std::uint64_t block_cache_mib = 64;
};

/// By `eyepoint-bench flight`: frame after frame without a pause, the first view loaded whole. On failure:
/// one sentence.
[[nodiscard]] tl::expected<FlightResult, std::string> draw_streamed(const StreamedFlight& flight);

/// Frames that were drawn without a block that they asked for.
[[nodiscard]] std::size_t frames_lacking_blocks(const FlightResult& drawn);
/// Peak of resident memory above what the process has with an OpenGL context and a picture alone.
[[nodiscard]] double mib_above_bare(const FlightResult& drawn);

}  // namespace eyepoint::tools
