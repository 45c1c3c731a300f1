/// A track log: where a vehicle was, and when.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

#include "net/host_state.hpp"

namespace eyepoint::tools {

struct TrackFix {
    double time_s = 0.0;  ///< since Track::start_utc_s, or since the log's own zero where that is absent
    double latitude_deg = 0.0;   ///< WGS84, -90..90
    double longitude_deg = 0.0;  ///< -180..180
    double altitude_m = 0.0;     ///< above the datum of the log, whatever that is
    std::optional<net::AttitudeDeg> attitude;
};

struct Track {
    std::vector<TrackFix> fixes;              ///< at least two, times strictly increasing
    std::optional<std::int64_t> start_utc_s;  ///< seconds since 1970 of time_s = 0, where the log has a date
    std::uint64_t skipped =
        0;  ///< fixes not used: no time, position or altitude, out of range, or not later than before
    std::string
        altitude_source;  ///< for the report: "GNSS altitude", "pressure altitude", "ele", "altitude_m"
};

/// Which of an IGC log's two altitudes is taken. Automatic: GNSS where the log has any that is not zero.
enum class IgcAltitude : std::uint8_t { Automatic, Gnss, Pressure };

/// The formats, each from a file's whole text. On failure: one clause, without the file's name.
[[nodiscard]] tl::expected<Track, std::string> parse_igc(std::string_view text, IgcAltitude altitude);
[[nodiscard]] tl::expected<Track, std::string> parse_gpx(std::string_view text);
/// Comma-separated, with a header line that names the columns in any order: time_s, latitude_deg,
/// longitude_deg, altitude_m, and all or none of yaw_deg, pitch_deg, roll_deg. Other columns are passed over.
[[nodiscard]] tl::expected<Track, std::string> parse_csv(std::string_view text);

/// Reads .igc, .gpx or .csv, by the name's end (in any case). On failure: one sentence that names the file.
[[nodiscard]] tl::expected<Track, std::string> read_track(const std::filesystem::path& file,
                                                          IgcAltitude altitude);

/// Keeps the fixes whose numbers are in range and whose time is later than that of the fix kept before;
/// counts the rest in `skipped`. A date before 1970 or after 2096 is forgotten. Refuses when fewer than two
/// fixes are left.
[[nodiscard]] tl::expected<Track, std::string> tidy(Track track);

}  // namespace eyepoint::tools
