#include "tools/bench/regression/flight_result.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace eyepoint::tools {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kVersion = 1;
constexpr const char* kFormatKey = "eyepoint_flight_result";

/// Tenths of a microsecond: the clocks know no better.
double rounded_time(double value_ms) { return std::round(value_ms * 1e4) * 1e-4; }

Json json_of(const FlightIdentity& identity) {
    return {{"program", identity.program},
            {"machine", identity.machine},
            {"gl_renderer", identity.gl.renderer},
            {"gl_version", identity.gl.version},
            {"flight", identity.flight},
            {"flight_hash", identity.flight_hash},
            {"terrain", identity.terrain},
            {"width_px", identity.size.width_px},
            {"height_px", identity.size.height_px},
            {"rate_hz", identity.rate_hz},
            {"vertical_fov_deg", identity.vertical_fov_deg},
            {"tau_px", identity.tau_px},
            {"lod_method", identity.lod_method},
            {"shading", identity.shading},
            {"streaming", identity.streaming}};
}

FlightIdentity identity_of(const Json& json) {
    return {json.at("program").get<std::string>(),
            json.at("machine").get<std::string>(),
            {json.at("gl_renderer").get<std::string>(), json.at("gl_version").get<std::string>()},
            json.at("flight").get<std::string>(),
            json.at("flight_hash").get<std::string>(),
            json.at("terrain").get<std::string>(),
            {json.at("width_px").get<int>(), json.at("height_px").get<int>()},
            json.at("rate_hz").get<double>(),
            json.at("vertical_fov_deg").get<double>(),
            json.at("tau_px").get<double>(),
            json.at("lod_method").get<std::string>(),
            json.at("shading").get<std::string>(),
            json.at("streaming").get<bool>()};
}

Json json_of(const std::string& key, const std::vector<double>& column) {
    Json json = Json::array();
    for (const double value : column) {
        if (!std::isfinite(value)) {
            json.push_back(nullptr);
        } else if (value == std::floor(value) && std::abs(value) < 9e15) {
            json.push_back(static_cast<std::int64_t>(value));
        } else {
            json.push_back(is_timing(key) ? rounded_time(value) : value);
        }
    }
    return json;
}

std::vector<double> column_of(const Json& json) {
    std::vector<double> column;
    for (const Json& value : json)
        column.push_back(value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>());
    return column;
}

FlightResult result_of(const Json& json) {
    FlightResult result;
    result.identity = identity_of(json.at("run"));
    result.frames = json.at("frames").get<std::size_t>();
    for (const auto& [key, column] : json.at("columns").items()) result.columns[key] = column_of(column);
    result.picture_hashes = json.at("picture_hashes").get<std::vector<std::string>>();
    result.figures = json.at("figures").get<std::map<std::string, double>>();
    return result;
}

bool whole(const FlightResult& result) {
    const bool hashes = result.picture_hashes.empty() || result.picture_hashes.size() == result.frames;
    return hashes && result.frames > 0 && std::ranges::all_of(result.columns, [&](const auto& column) {
               return column.second.size() == result.frames;
           });
}

}  // namespace

const std::vector<double>* FlightResult::find(const std::string& key) const {
    const auto found = columns.find(key);
    return found == columns.end() ? nullptr : &found->second;
}

bool is_timing(const std::string& key) { return std::string_view(key).ends_with("_ms"); }

FlightResult counts_of(FlightResult result) {
    std::erase_if(result.columns, [](const auto& column) { return is_timing(column.first); });
    result.figures.clear();
    result.picture_hashes.clear();
    result.identity.machine.clear();
    return result;
}

std::string to_json_text(const FlightResult& result) {
    std::string text = fmt::format(
        "{{\n\"{}\": {},\n\"run\": {},\n\"frames\": {},\n\"figures\": {},\n\"columns\": {{", kFormatKey,
        kVersion, json_of(result.identity).dump(1), result.frames, Json(result.figures).dump());
    const char* before = "\n";
    for (const auto& [key, column] : result.columns)
        text += fmt::format("{}{}: {}", std::exchange(before, ",\n"), Json(key).dump(),
                            json_of(key, column).dump());
    return text + fmt::format("\n}},\n\"picture_hashes\": {}\n}}\n", Json(result.picture_hashes).dump());
}

tl::expected<FlightResult, std::string> parse_flight_result(const std::string& text) {
    const Json json = Json::parse(text, nullptr, false);
    const auto format = json.is_object() ? json.find(kFormatKey) : json.end();
    if (!json.is_object() || format == json.end())
        return tl::unexpected(std::string("no flight result; make one with eyepoint-bench flight --json"));
    if (*format != kVersion)
        return tl::unexpected(
            fmt::format("a flight result of version {}, and this program reads version {}; "
                        "fly it again with this program",
                        format->dump(), kVersion));
    try {
        FlightResult result = result_of(json);
        if (whole(result)) return result;
    } catch (const Json::exception& fault) {
        return tl::unexpected(fmt::format("a flight result with a fault ({}); fly it again", fault.what()));
    }
    return tl::unexpected(std::string("a flight result whose columns differ in length; fly it again"));
}

tl::expected<FlightResult, std::string> read_flight_result(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    if (!stream) return tl::unexpected(file.string() + ": cannot be read; is the file there?");
    return parse_flight_result(text).map_error(
        [&](const std::string& sentence) { return file.string() + " is " + sentence; });
}

}  // namespace eyepoint::tools
