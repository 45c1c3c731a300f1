#include "tools/bench/regression/bench_result_columns.hpp"

#include <functional>
#include <limits>
#include <utility>

#include <fmt/format.h>

namespace eyepoint::tools {

namespace {

using Value = std::function<double(const BenchFrame&)>;

template <typename Number>
double number(Number value) {
    return static_cast<double>(value);
}

const std::vector<std::pair<const char*, Value>>& columns() {
    static const std::vector<std::pair<const char*, Value>> kColumns{
        {"frame", [](const auto& f) { return number(f.entry.frame); }},
        {"host_frame", [](const auto& f) { return number(f.entry.host_frame); }},
        {"time_s", [](const auto& f) { return f.entry.time_s; }},
        {"latitude_deg", [](const auto& f) { return f.entry.eye.latitude_deg; }},
        {"longitude_deg", [](const auto& f) { return f.entry.eye.longitude_deg; }},
        {"ellipsoidal_height_m", [](const auto& f) { return f.entry.eye.height.metres(); }},
        {"frame_ms", [](const auto& f) { return f.entry.frame_ms; }},
        {"cpu_ms", [](const auto& f) { return f.entry.cpu_ms; }},
        {"frame_thread_cpu_ms", [](const auto& f) { return f.entry.frame_thread_cpu_ms; }},
        {"selection_ms", [](const auto& f) { return f.entry.drawn.selection_cpu_ms; }},
        {"outside_gl_ms", [](const auto& f) { return f.outside_gl_ms; }},
        {"triangles", [](const auto& f) { return number(f.entry.drawn.triangles); }},
        {"triangles_hidden", [](const auto& f) { return number(f.entry.drawn.triangles_hidden); }},
        {"draws", [](const auto& f) { return number(f.entry.drawn.draws); }},
        {"gl_calls", [](const auto& f) { return number(f.gl_calls); }},
        {"blocks_drawn", [](const auto& f) { return number(f.entry.drawn.blocks_drawn); }},
        {"blocks_tested", [](const auto& f) { return number(f.entry.drawn.blocks_tested); }},
        {"blocks_reused", [](const auto& f) { return number(f.entry.drawn.blocks_reused); }},
        {"blocks_evaluated",
         [](const auto& f) { return number(f.entry.drawn.blocks_tested - f.entry.drawn.blocks_reused); }},
        {"blocks_uploaded", [](const auto& f) { return number(f.entry.drawn.blocks_uploaded); }},
        {"bytes_uploaded", [](const auto& f) { return number(f.entry.drawn.bytes_uploaded); }},
        {"loads_pending", [](const auto& f) { return number(f.entry.drawn.loads_pending); }},
        {"tau_px", [](const auto& f) { return f.entry.drawn.tau_px; }},
        {"allocations", [](const auto& f) { return number(f.allocations); }},
        {"new_state_pairs", [](const auto& f) { return number(f.new_state_pairs); }},
    };
    return kColumns;
}

const char* name_of(ig::Shading shading) { return shading == ig::Shading::Forward ? "forward" : "deferred"; }

void add_still(const BenchResult& bench, FlightResult& result) {
    constexpr double kAbsent = std::numeric_limits<double>::quiet_NaN();
    std::vector<double> still;
    bool any = false;
    for (const BenchFrame& frame : bench.frames) {
        any = any || frame.still_cpu_ms.has_value();
        still.push_back(frame.still_cpu_ms.value_or(kAbsent));
    }
    if (any) result.columns["still_cpu_ms"] = std::move(still);
}

}  // namespace

FlightResult flight_result(const BenchResult& bench, FlightIdentity identity) {
    FlightResult result;
    result.identity = std::move(identity);
    result.identity.gl = bench.gl;
    result.identity.terrain = bench.terrain_name;
    result.identity.shading = name_of(bench.shading);
    result.frames = bench.frames.size();
    for (const auto& [key, value] : columns()) {
        std::vector<double>& column = result.columns[key];
        for (const BenchFrame& frame : bench.frames) column.push_back(value(frame));
    }
    add_still(bench, result);
    result.figures = {{"readback_ms", bench.readback.read_ms},
                      {"copy_ms", bench.readback.copy_ms},
                      {"bare_resident_bytes", number(bench.bare_resident_bytes)},
                      {"peak_resident_bytes", number(bench.peak_resident_bytes)}};
    for (const BenchFrame& frame : bench.frames)
        if (frame.picture_hash) result.picture_hashes.push_back(fmt::format("{:016x}", *frame.picture_hash));
    return result;
}

}  // namespace eyepoint::tools
