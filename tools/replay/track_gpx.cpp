// GPX 1.0 and 1.1 (topografix.com): track points with a time and an elevation, all tracks and segments in
// their order.
#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "tools/replay/track.hpp"

namespace eyepoint::tools {
namespace {

template <typename T>
std::optional<T> number(std::string_view text) {
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return !text.empty() && error == std::errc() && end == text.data() + text.size() ? std::optional(value)
                                                                                     : std::nullopt;
}

// "Z", "+02:00" or "-05:30" as seconds east of UTC; a time without a zone is UTC, as GPX says.
std::optional<int> zone_of(std::string_view text) {
    if (text.empty() || text == "Z") return 0;
    if (text.size() != 6 || text[3] != ':' || (text[0] != '+' && text[0] != '-')) return std::nullopt;
    const auto hours = number<int>(text.substr(1, 2)), minutes = number<int>(text.substr(4, 2));
    if (!hours || !minutes) return std::nullopt;
    return (text[0] == '-' ? -1 : 1) * (*hours * 3600 + *minutes * 60);
}

// ISO 8601, "2019-08-25T08:02:11.25Z", as seconds since 1970 UTC.
std::optional<double> utc_of(std::string_view text) {
    if (text.size() < 19 || text[4] != '-' || text[7] != '-' || text[10] != 'T' || text[13] != ':' ||
        text[16] != ':') {
        return std::nullopt;
    }
    const std::size_t zone_at = std::min(text.find_first_of("Z+-", 19), text.size());
    const auto year = number<int>(text.substr(0, 4));
    const auto month = number<unsigned>(text.substr(5, 2)), day = number<unsigned>(text.substr(8, 2));
    const auto hours = number<int>(text.substr(11, 2)), minutes = number<int>(text.substr(14, 2));
    const auto seconds = number<double>(text.substr(17, zone_at - 17));
    const auto zone = zone_of(text.substr(zone_at));
    if (!year || !month || !day || !hours || !minutes || !seconds || !zone) return std::nullopt;
    const auto date = std::chrono::year(*year) / std::chrono::month(*month) / std::chrono::day(*day);
    if (!date.ok()) return std::nullopt;
    const auto days = std::chrono::sys_days(date).time_since_epoch().count();
    return static_cast<double>(days) * 86400.0 + *hours * 3600 + *minutes * 60 + *seconds - *zone;
}

std::optional<TrackFix> fix_of(const pugi::xml_node& point) {
    const auto time = utc_of(point.child_value("time"));
    const auto latitude = number<double>(point.attribute("lat").value());
    const auto longitude = number<double>(point.attribute("lon").value());
    const auto elevation = number<double>(point.child_value("ele"));
    if (!time || !latitude || !longitude || !elevation) return std::nullopt;
    return TrackFix{*time, *latitude, *longitude, *elevation, std::nullopt};
}

}  // namespace

tl::expected<Track, std::string> parse_gpx(std::string_view text) {
    pugi::xml_document document;
    const auto result =
        document.load_buffer(text.data(), text.size(), pugi::parse_default | pugi::parse_trim_pcdata);
    if (!result) {
        return tl::unexpected(
            fmt::format("not well-formed XML: {} at byte {}", result.description(), result.offset));
    }
    Track track;
    track.altitude_source = "ele";
    for (const pugi::xml_node& trk : document.child("gpx").children("trk")) {
        for (const pugi::xml_node& segment : trk.children("trkseg")) {
            for (const pugi::xml_node& point : segment.children("trkpt")) {
                const auto fix = fix_of(point);
                if (fix) track.fixes.push_back(*fix);
                track.skipped += fix ? 0 : 1;
            }
        }
    }
    if (!track.fixes.empty()) {
        track.start_utc_s = static_cast<std::int64_t>(std::floor(track.fixes.front().time_s));
        for (TrackFix& fix : track.fixes) fix.time_s -= static_cast<double>(*track.start_utc_s);
    }
    return tidy(std::move(track));
}

}  // namespace eyepoint::tools
