/// Turns a track log into a recorded flight.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include <tl/expected.hpp>

#include "tools/replay/track.hpp"
#include "tools/replay/track_flight.hpp"

namespace eyepoint::tools {

struct ConvertRequest {
    std::filesystem::path track;
    std::filesystem::path output;
    IgcAltitude altitude = IgcAltitude::Automatic;
    FlightSampling sampling{};
    std::uint16_t port = 5560;  ///< destination port of the packets written
};

struct ConvertReport {
    std::size_t fixes = 0;
    std::uint64_t skipped = 0;
    std::size_t packets = 0;
    double seconds = 0.0;
    std::string altitude_source;
};

/// Writes FGNetFDM version 24. Capture times are those of the track, or count from 1970 where it has no date.
/// On failure: one sentence.
[[nodiscard]] tl::expected<ConvertReport, std::string> convert(const ConvertRequest& request);

}  // namespace eyepoint::tools
