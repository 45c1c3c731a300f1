#include <algorithm>
#include <array>
#include <charconv>

#include <fmt/format.h>

#include "tools/replay/track.hpp"

namespace eyepoint::tools {
namespace {

constexpr std::array<std::string_view, 7> kColumns{"time_s",  "latitude_deg", "longitude_deg", "altitude_m",
                                                   "yaw_deg", "pitch_deg",    "roll_deg"};
constexpr std::size_t kNeeded = 4;

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kBlank = " \t\r";
    const std::size_t first = text.find_first_not_of(kBlank);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

std::vector<std::string_view> fields_of(std::string_view line) {
    std::vector<std::string_view> fields;
    while (true) {
        const std::size_t comma = line.find(',');
        fields.push_back(trimmed(line.substr(0, comma)));
        if (comma == std::string_view::npos) return fields;
        line.remove_prefix(comma + 1);
    }
}

// For each of kColumns its place in a line.
using Places = std::array<std::optional<std::size_t>, kColumns.size()>;

tl::expected<Places, std::string> places_of(std::string_view header) {
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
    if (header.starts_with(kByteOrderMark)) header.remove_prefix(kByteOrderMark.size());
    const auto names = fields_of(header);
    Places places;
    for (std::size_t column = 0; column < kColumns.size(); ++column) {
        const auto found = std::find(names.begin(), names.end(), kColumns[column]);
        if (found != names.end()) places[column] = static_cast<std::size_t>(found - names.begin());
        if (found == names.end() && column < kNeeded) {
            return tl::unexpected(
                fmt::format("its first line has no column '{}', expected a header with time_s, "
                            "latitude_deg, longitude_deg, altitude_m",
                            kColumns[column]));
        }
    }
    const bool some = places[4] || places[5] || places[6], all = places[4] && places[5] && places[6];
    if (some && !all) {
        return tl::unexpected(
            std::string("it has some of yaw_deg, pitch_deg, roll_deg, expected all three or none"));
    }
    return places;
}

std::optional<TrackFix> fix_of(std::string_view line, const Places& places) {
    const auto fields = fields_of(line);
    std::array<double, kColumns.size()> values{};
    for (std::size_t column = 0; column < kColumns.size(); ++column) {
        if (!places[column]) continue;
        if (*places[column] >= fields.size()) return std::nullopt;
        const std::string_view field = fields[*places[column]];
        const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), values[column]);
        if (error != std::errc() || end != field.data() + field.size()) return std::nullopt;
    }
    TrackFix fix{values[0], values[1], values[2], values[3], std::nullopt};
    if (places[4]) fix.attitude = net::AttitudeDeg{values[4], values[5], values[6]};
    return fix;
}

}  // namespace

tl::expected<Track, std::string> parse_csv(std::string_view text) {
    const std::string_view header = text.substr(0, text.find('\n'));
    const auto places = places_of(header);
    if (!places) return tl::unexpected(places.error());
    text.remove_prefix(std::min(text.size(), header.size() + 1));
    Track track;
    track.altitude_source = "altitude_m";
    while (!text.empty()) {
        const std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(text.size(), line.size() + 1));
        if (trimmed(line).empty()) continue;
        const auto fix = fix_of(line, *places);
        if (fix) track.fixes.push_back(*fix);
        track.skipped += fix ? 0 : 1;
    }
    return tidy(std::move(track));
}

}  // namespace eyepoint::tools
