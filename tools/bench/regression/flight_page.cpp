#include "tools/bench/regression/flight_page.hpp"

#include <limits>

#include <fmt/format.h>

#include "tools/bench/regression/flight_ratios.hpp"
#include "tools/report/page.hpp"

namespace eyepoint::tools {

namespace {

RecordHeader header_of(const FlightIdentity& identity) {
    return {{"gl_renderer", identity.gl.renderer},
            {"gl_version", identity.gl.version},
            {"version", identity.program},
            {"Machine", identity.machine},
            {"Flight", identity.flight},
            {"terrain", identity.terrain},
            {"lod_method", identity.lod_method},
            {"Shading", identity.shading},
            {"width_px", std::to_string(identity.size.width_px)},
            {"height_px", std::to_string(identity.size.height_px)},
            {"rate_hz", fmt::format("{}", identity.rate_hz)},
            {"Loads", identity.streaming ? "not waited for" : "waited for before each frame"}};
}

/// Frame CPU over that of the static mesh, where there was one.
void add_price(FrameColumns& record) {
    const auto *cpu_ms = record.find("cpu_ms"), *still_ms = record.find("still_cpu_ms");
    if (cpu_ms == nullptr || still_ms == nullptr) return;
    std::vector<double> price;
    for (std::size_t i = 0; i < record.frames; ++i) price.push_back((*cpu_ms)[i] / (*still_ms)[i]);
    record.columns["price_of_lod"] = std::move(price);
}

}  // namespace

tl::expected<std::string, std::string> flight_page(const FlightResult& result) {
    FrameColumns record{.header = header_of(result.identity),
                        .frames = result.frames,
                        .columns = result.columns,
                        .cut_off = false};
    add_price(record);
    RecordHeader figures;
    for (const FlightRatio& ratio : flight_ratios(result)) {
        const Interval interval = ratio.interval();
        figures.emplace_back(ratio.what, fmt::format("{:.3g} (95%: {:.3g} to {:.3g})", interval.value,
                                                     interval.low, interval.high));
    }
    return report_page(result.identity.flight + " over " + result.identity.terrain, record, {}, figures);
}

}  // namespace eyepoint::tools
