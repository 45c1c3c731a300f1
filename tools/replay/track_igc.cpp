// IGC flight logs: B records (fixes), H DTE (date), I (extensions of the B record), by the FAI's technical
// specification for IGC-approved flight recorders, appendix A.
#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>

#include "tools/replay/track.hpp"

namespace eyepoint::tools {
namespace {

constexpr std::size_t kBRecordLength = 35;
constexpr int kSecondsPerDay = 86400;

std::optional<int> number(std::string_view text) {
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return !text.empty() && error == std::errc() && end == text.data() + text.size() ? std::optional(value)
                                                                                     : std::nullopt;
}

// Extra digits of the minutes that the I record announces as LAD or LOD: columns counted from 0.
struct Extension {
    std::size_t first = 0;
    std::size_t length = 0;
};
struct Extensions {
    Extension latitude, longitude;
};

// "I023636LAD3737LOD": a count, then first and last column (counted from 1) and a three-letter code each.
Extensions extensions_of(std::string_view record) {
    Extensions found;
    for (std::size_t at = 3; at + 7 <= record.size(); at += 7) {
        const auto first = number(record.substr(at, 2)), last = number(record.substr(at + 2, 2));
        if (!first || !last || *first < 1 || *last < *first) continue;
        const Extension extension{static_cast<std::size_t>(*first - 1),
                                  static_cast<std::size_t>(*last - *first + 1)};
        if (record.substr(at + 4, 3) == "LAD") found.latitude = extension;
        if (record.substr(at + 4, 3) == "LOD") found.longitude = extension;
    }
    return found;
}

// Thousandths of a minute and the extra digits behind them, as minutes.
std::optional<double> minutes(std::string_view record, std::size_t at, Extension extension) {
    const auto thousandths = number(record.substr(at, 5));
    if (!thousandths) return std::nullopt;
    double value = *thousandths / 1000.0;
    if (extension.length == 0 || extension.first + extension.length > record.size()) return value;
    const std::string_view digits = record.substr(extension.first, extension.length);
    double place = 1.0e-4;
    for (const char digit : digits) {
        if (digit < '0' || digit > '9') return value;
        value += (digit - '0') * place;
        place /= 10.0;
    }
    return value;
}

struct Fix {
    TrackFix fix;
    int pressure_altitude_m = 0;
    int gnss_altitude_m = 0;
};

// B HHMMSS DDMMmmmN DDDMMmmmE A PPPPP GGGGG, without the spaces.
std::optional<Fix> parse_fix(std::string_view record, const Extensions& extensions) {
    if (record.size() < kBRecordLength) return std::nullopt;
    const auto hours = number(record.substr(1, 2)), minute = number(record.substr(3, 2)),
               seconds = number(record.substr(5, 2));
    const auto latitude = number(record.substr(7, 2)), longitude = number(record.substr(15, 3));
    const auto latitude_minutes = minutes(record, 9, extensions.latitude);
    const auto longitude_minutes = minutes(record, 18, extensions.longitude);
    const auto pressure = number(record.substr(25, 5)), gnss = number(record.substr(30, 5));
    const bool whole = hours && minute && seconds && latitude && longitude && latitude_minutes &&
                       longitude_minutes && pressure && gnss;
    if (!whole) return std::nullopt;
    const double north = record[14] == 'S' ? -1.0 : 1.0, east = record[23] == 'W' ? -1.0 : 1.0;
    Fix fix;
    fix.fix.time_s = *hours * 3600 + *minute * 60 + *seconds;
    fix.fix.latitude_deg = north * (*latitude + *latitude_minutes / 60.0);
    fix.fix.longitude_deg = east * (*longitude + *longitude_minutes / 60.0);
    fix.pressure_altitude_m = *pressure;
    fix.gnss_altitude_m = *gnss;
    return fix;
}

// "HFDTE250819", "HFDTEDATE:250819,01", "HFDTEDATE: 250819": day, month, year of this century.
std::optional<std::int64_t> midnight_of(std::string_view record) {
    const std::size_t first = record.find_first_of("0123456789");
    if (first == std::string_view::npos || first + 6 > record.size()) return std::nullopt;
    const auto day = number(record.substr(first, 2)), month = number(record.substr(first + 2, 2)),
               year = number(record.substr(first + 4, 2));
    if (!day || !month || !year) return std::nullopt;
    const auto date = std::chrono::year(2000 + *year) / std::chrono::month(static_cast<unsigned>(*month)) /
                      std::chrono::day(static_cast<unsigned>(*day));
    if (!date.ok()) return std::nullopt;
    return std::int64_t{std::chrono::sys_days(date).time_since_epoch().count()} * kSecondsPerDay;
}

// The clock of a B record begins again at midnight: a step back of more than half a day is the next day.
void unroll_midnights(std::vector<Fix>& fixes) {
    double days_s = 0.0;
    for (std::size_t i = 1; i < fixes.size(); ++i) {
        double& time_s = fixes[i].fix.time_s;
        time_s += days_s;
        if (time_s >= fixes[i - 1].fix.time_s - kSecondsPerDay / 2.0) continue;
        days_s += kSecondsPerDay;
        time_s += kSecondsPerDay;
    }
}

}  // namespace

tl::expected<Track, std::string> parse_igc(std::string_view text, IgcAltitude altitude) {
    Track track;
    Extensions extensions;
    std::vector<Fix> fixes;
    while (!text.empty()) {
        std::string_view record = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(text.size(), record.size() + 1));
        if (record.ends_with('\r')) record.remove_suffix(1);
        if (record.starts_with('I')) extensions = extensions_of(record);
        if (record.size() > 5 && record[0] == 'H' && record.substr(2, 3) == "DTE" && !track.start_utc_s) {
            track.start_utc_s = midnight_of(record);
        }
        if (!record.starts_with('B')) continue;
        const auto fix = parse_fix(record, extensions);
        if (fix) fixes.push_back(*fix);
        track.skipped += fix ? 0 : 1;
    }
    unroll_midnights(fixes);
    const bool gnss =
        altitude == IgcAltitude::Gnss ||
        (altitude == IgcAltitude::Automatic &&
         std::any_of(fixes.begin(), fixes.end(), [](const Fix& fix) { return fix.gnss_altitude_m != 0; }));
    track.altitude_source = gnss ? "GNSS altitude" : "pressure altitude";
    for (Fix& fix : fixes) {
        fix.fix.altitude_m = gnss ? fix.gnss_altitude_m : fix.pressure_altitude_m;
        // A recorder without a three-dimensional fix writes 0; beside real altitudes that is a hole, not a
        // place.
        const bool hole = gnss && fix.gnss_altitude_m == 0 && fix.pressure_altitude_m > 100;
        if (!hole) track.fixes.push_back(fix.fix);
        track.skipped += hole ? 1 : 0;
    }
    return tidy(std::move(track));
}

}  // namespace eyepoint::tools
