#include "tools/replay/track.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <iterator>

#include <fmt/format.h>

namespace eyepoint::tools {
namespace {

bool usable(const TrackFix& fix) {
    const bool finite = std::isfinite(fix.time_s) && std::isfinite(fix.altitude_m);
    // Comparisons are false for NaN.
    const bool on_earth = std::abs(fix.latitude_deg) <= 90.0 && std::abs(fix.longitude_deg) <= 180.0;
    constexpr double kLowestM = -1000.0, kHighestM = 1.0e6;
    const bool in_reach = fix.altitude_m >= kLowestM && fix.altitude_m <= kHighestM;
    const bool attitude_finite =
        !fix.attitude || (std::isfinite(fix.attitude->yaw_deg) && std::abs(fix.attitude->pitch_deg) <= 90.0 &&
                          std::isfinite(fix.attitude->roll_deg));
    return finite && on_earth && in_reach && attitude_finite;
}

}  // namespace

tl::expected<Track, std::string> tidy(Track track) {
    std::vector<TrackFix> kept;
    kept.reserve(track.fixes.size());
    for (const TrackFix& fix : track.fixes) {
        if (usable(fix) && (kept.empty() || fix.time_s > kept.back().time_s)) kept.push_back(fix);
    }
    track.skipped += track.fixes.size() - kept.size();
    track.fixes = std::move(kept);
    // What does not fit a packet's 32-bit time is no date of a flight.
    constexpr std::int64_t kLatestUtc_s = 4'000'000'000;
    if (track.start_utc_s && (*track.start_utc_s < 0 || *track.start_utc_s > kLatestUtc_s))
        track.start_utc_s.reset();
    if (track.fixes.size() >= 2) return track;
    return tl::unexpected(fmt::format("it has {} usable fixes ({} skipped), at least two are needed",
                                      track.fixes.size(), track.skipped));
}

tl::expected<Track, std::string> read_track(const std::filesystem::path& file, IgcAltitude altitude) {
    std::ifstream stream(file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    if (!stream.is_open() || stream.bad())
        return tl::unexpected(fmt::format("cannot read {}", file.string()));
    std::string ending = file.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return std::tolower(c); });
    const auto parse = [&]() -> tl::expected<Track, std::string> {
        if (ending == ".igc") return parse_igc(text, altitude);
        if (ending == ".gpx") return parse_gpx(text);
        if (ending == ".csv") return parse_csv(text);
        return tl::unexpected(std::string("its name has to end in .igc, .gpx or .csv"));
    };
    return parse().map_error(
        [&](const std::string& cause) { return fmt::format("{}: {}", file.string(), cause); });
}

}  // namespace eyepoint::tools
