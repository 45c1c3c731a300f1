/// What a moving tolerance leaves of the LOD cache.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include <tl/expected.hpp>

#include "ig/recorded_flight.hpp"
#include "tools/bench/control/controlled_flight.hpp"

namespace eyepoint::tools {

/// The share of choices of blocks in view that an earlier frame's stood for, when every eye is selected for
/// once with its frame's tau; everything loaded, nothing drawn. `slack`: share of tau. As many frames as
/// eyes. On failure: one sentence.
[[nodiscard]] tl::expected<double, std::string> reuse_share(const std::filesystem::path& terrain,
                                                            const std::string& lod_method, double slack,
                                                            std::span<const ig::FlightEye> eyes,
                                                            std::span<const ControlledFrame> frames);

}  // namespace eyepoint::tools
