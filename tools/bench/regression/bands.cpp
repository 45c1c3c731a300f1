#include "tools/bench/regression/bands.hpp"

#include <algorithm>
#include <fstream>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "tools/bench/regression/flight_ratios.hpp"

namespace eyepoint::tools {

namespace {

ComparedLine judged(const FlightRatio& ratio, const Band& band) {
    const Interval interval = ratio.interval();
    return {.kind = ComparedLine::Kind::Band,
            .what = ratio.what,
            .before = band.at_most,
            .after = interval.value,
            .change = {},
            .verdict = interval.value <= band.at_most ? Verdict::Same : Verdict::Worse,
            .remark = fmt::format("95% interval {:.4g} to {:.4g}; at most {:.4g}: {}", interval.low,
                                  interval.high, band.at_most, band.reason)};
}

ComparedLine missing(const Band& band) {
    return {.kind = ComparedLine::Kind::Band,
            .what = band.key,
            .before = band.at_most,
            .after = std::numeric_limits<double>::quiet_NaN(),
            .change = {},
            .verdict = Verdict::Worse,
            .remark = "the run does not have this ratio"};
}

}  // namespace

tl::expected<std::vector<Band>, std::string> read_bands(const std::filesystem::path& file) {
    std::ifstream stream(file);
    if (!stream) return tl::unexpected(file.string() + ": cannot be read; is the file there?");
    try {
        const auto json = nlohmann::json::parse(stream);
        std::vector<Band> bands;
        for (const auto& [key, band] : json.items())
            bands.push_back({key, band.at("at_most").get<double>(), band.at("reason").get<std::string>()});
        return bands;
    } catch (const nlohmann::json::exception& fault) {
        return tl::unexpected(
            fmt::format("{}: no bands ({}); a band is \"KEY\": {{\"at_most\": 1.2, \"reason\": "
                        "\"...\"}}",
                        file.string(), fault.what()));
    }
}

std::vector<ComparedLine> judge(const FlightResult& result, const std::vector<Band>& bands) {
    const std::vector<FlightRatio> ratios = flight_ratios(result);
    std::vector<ComparedLine> lines;
    for (const Band& band : bands) {
        const auto ratio = std::ranges::find(ratios, band.key, &FlightRatio::key);
        lines.push_back(ratio == ratios.end() ? missing(band) : judged(*ratio, band));
    }
    return lines;
}

}  // namespace eyepoint::tools
