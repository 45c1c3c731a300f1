#include "tools/bench/regression/flight_ratios.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace eyepoint::tools {

namespace {

std::vector<std::uint32_t> all_frames(std::size_t count) {
    std::vector<std::uint32_t> frames(count);
    std::iota(frames.begin(), frames.end(), 0U);
    return frames;
}

FlightRatio median_of(std::string key, std::string what, const std::vector<double>& values) {
    return {std::move(key), std::move(what), all_frames(values.size()), values,
            [values](FrameChoice choice) { return percentile_of(values, choice, 0.5); }};
}

FlightRatio tail_over_median(std::string key, std::string what, const std::vector<double>& values,
                             double share) {
    return {std::move(key), std::move(what), all_frames(values.size()), values,
            [values, share](FrameChoice choice) {
                return percentile_of(values, choice, share) / percentile_of(values, choice, 0.5);
            }};
}

FlightRatio price_of_lod(const std::vector<double>& cpu_ms, const std::vector<double>& still_ms) {
    std::vector<std::uint32_t> frames;
    std::vector<double> prices;
    for (std::size_t i = 0; i < still_ms.size(); ++i) {
        if (!(still_ms[i] > 0.0)) continue;
        frames.push_back(static_cast<std::uint32_t>(i));
        prices.push_back(cpu_ms[i] / still_ms[i]);
    }
    return {"price_of_lod", "frame CPU over that of a static mesh, median", std::move(frames), prices,
            [prices](FrameChoice choice) { return percentile_of(prices, choice, 0.5); }};
}

FlightRatio share_of(const std::vector<double>& part, const std::vector<double>& whole) {
    return {"selection_over_frame", "selection CPU over frame CPU", all_frames(part.size()), part,
            [part, whole](FrameChoice choice) {
                double parts = 0.0, wholes = 0.0;
                for (const std::uint32_t i : choice) {
                    parts += part[i];
                    wholes += whole[i];
                }
                return parts / wholes;
            }};
}

}  // namespace

Interval FlightRatio::interval() const { return bootstrap(frames.size(), mean_run_length(series), figure); }

double percentile_of(const std::vector<double>& values, FrameChoice choice, double share) {
    std::vector<double> chosen(choice.size());
    std::transform(choice.begin(), choice.end(), chosen.begin(), [&](std::uint32_t i) { return values[i]; });
    const auto count = static_cast<double>(chosen.size());
    const auto rank = static_cast<std::ptrdiff_t>(std::max(std::ceil(share * count), 1.0)) - 1;
    std::nth_element(chosen.begin(), chosen.begin() + rank, chosen.end());
    return chosen[static_cast<std::size_t>(rank)];
}

std::vector<FlightRatio> flight_ratios(const FlightResult& result) {
    std::vector<FlightRatio> ratios;
    const std::vector<double>* cpu_ms = result.find("cpu_ms");
    if (cpu_ms == nullptr) return ratios;
    if (const auto* still_ms = result.find("still_cpu_ms"))
        ratios.push_back(price_of_lod(*cpu_ms, *still_ms));
    ratios.push_back(tail_over_median("p99_over_median", "frame CPU, p99 over median", *cpu_ms, 0.99));
    ratios.push_back(tail_over_median("p999_over_median", "frame CPU, p99.9 over median", *cpu_ms, 0.999));
    if (const auto* selection_ms = result.find("selection_ms"))
        ratios.push_back(share_of(*selection_ms, *cpu_ms));
    return ratios;
}

std::vector<FlightRatio> flight_times(const FlightResult& result) {
    std::vector<FlightRatio> times;
    if (const auto* cpu_ms = result.find("cpu_ms"))
        times.push_back(median_of("cpu_ms", "frame CPU, ms, median", *cpu_ms));
    if (const auto* outside_ms = result.find("outside_gl_ms"))
        times.push_back(median_of("outside_gl_ms", "frame thread outside GL, ms, median", *outside_ms));
    return times;
}

}  // namespace eyepoint::tools
