/// The flights and terrain databases of the picture tests.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "ig/recorded_flight.hpp"
#include "terrain/database/database.hpp"

namespace eyepoint::testing {

/// tools/flights/goms-c172-60s-30hz.pcap.
[[nodiscard]] std::filesystem::path sample_flight();

/// A database folder, opened. Throws std::runtime_error with the sentence.
[[nodiscard]] std::shared_ptr<const terrain::Database> open_database(const std::filesystem::path& folder);

/// The synthetic planet over which the sample flight is flown, made by the CTest fixture synth_terrain.
[[nodiscard]] std::shared_ptr<const terrain::Database> open_synthetic_terrain();

/// EYEPOINT_REAL_DATA, where set.
[[nodiscard]] std::optional<std::filesystem::path> real_data();

/// Every eye of a recorded flight, one a packet: flown in virtual time at the recording's own packet rate.
/// Throws std::runtime_error.
[[nodiscard]] std::vector<ig::FlightEye> eyes_of(const std::filesystem::path& flight, ig::PictureSize size,
                                                 double rate_hz);

}  // namespace eyepoint::testing
