#include "tools/bench/goals/streamed_flight.hpp"

#include <algorithm>
#include <chrono>
#include <vector>

#include <fmt/format.h>

#include "tools/bench/goals/scratch_folder.hpp"
#include "tools/process/child_process.hpp"

namespace eyepoint::tools {

tl::expected<FlightResult, std::string> draw_streamed(const StreamedFlight& flight) {
    constexpr std::chrono::minutes kPatience{60};
    const auto scratch = ScratchFolder::create();
    if (!scratch) return tl::unexpected(scratch.error());
    const auto result = scratch->path() / "result.json";
    auto child = ChildProcess::start({(flight.programs / "eyepoint-bench").string(),
                                      "flight",
                                      flight.flight.string(),
                                      "--terrain",
                                      flight.terrain.string(),
                                      "--lod",
                                      flight.lod_method,
                                      "--tau",
                                      fmt::format("{}", flight.tau_px),
                                      "--triangles",
                                      fmt::format("{}", flight.triangle_budget),
                                      "--size",
                                      fmt::format("{}x{}", flight.size.width_px, flight.size.height_px),
                                      "--fov",
                                      fmt::format("{}", flight.vertical_fov_deg),
                                      "--rate",
                                      fmt::format("{}", flight.rate_hz),
                                      "--cache-mib",
                                      fmt::format("{}", flight.block_cache_mib),
                                      "--ellipsoid",
                                      "--streaming",
                                      "--still-every",
                                      "0",
                                      "--json",
                                      result.string()});
    if (!child) return tl::unexpected(child.error());
    const Ending ending = child->wait(kPatience);
    if (ending.exit_code != 0)
        return tl::unexpected("eyepoint-bench flight failed: " + ending.standard_error);
    return read_flight_result(result);
}

std::size_t frames_lacking_blocks(const FlightResult& drawn) {
    return static_cast<std::size_t>(
        std::ranges::count_if(*drawn.find("loads_pending"), [](double loads) { return loads > 0.0; }));
}

double mib_above_bare(const FlightResult& drawn) {
    constexpr double kMib = 1048576.0;
    return (drawn.figures.at("peak_resident_bytes") - drawn.figures.at("bare_resident_bytes")) / kMib;
}

}  // namespace eyepoint::tools
