/// A trace file read back, as Perfetto's UI would read it.
#pragma once

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace eyepoint::testing {

struct TracedSpan {
    std::string name;
    std::int64_t begin_ns = 0;
    std::int64_t end_ns = 0;
    nlohmann::json numbers;

    [[nodiscard]] bool holds(const TracedSpan& other) const {
        return begin_ns <= other.begin_ns && other.end_ns <= end_ns;
    }
    [[nodiscard]] bool apart_from(const TracedSpan& other) const {
        return end_ns <= other.begin_ns || other.end_ns <= begin_ns;
    }
};

inline std::string text_of(const std::filesystem::path& file) {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// Spans by the name of their track, in the file's order. Throws nlohmann::json::exception for what is not
/// the format.
inline std::map<std::string, std::vector<TracedSpan>> tracks_of(const std::string& text) {
    const auto in_ns = [](const nlohmann::json& us) { return std::llround(us.get<double>() * 1e3); };
    std::map<int, std::string> names;
    std::map<std::string, std::vector<TracedSpan>> tracks;
    for (const nlohmann::json& event : nlohmann::json::parse(text)) {
        const int row = event.at("tid");
        if (event.at("name") == "thread_name") {
            names[row] = event.at("args").at("name");
            tracks[names[row]];
        }
        if (event.at("ph") != "X") continue;
        const std::int64_t begin_ns = in_ns(event.at("ts"));
        tracks[names.at(row)].push_back({event.at("name"), begin_ns, begin_ns + in_ns(event.at("dur")),
                                         event.value("args", nlohmann::json{})});
    }
    return tracks;
}

/// Whether of any two spans one holds the other or they are apart, and times rise: spans end in the file's
/// order.
inline bool nest_and_rise(const std::vector<TracedSpan>& spans) {
    for (std::size_t i = 0; i < spans.size(); ++i) {
        if (spans[i].end_ns < spans[i].begin_ns || spans[i].begin_ns < 0) return false;
        if (i > 0 && spans[i].end_ns < spans[i - 1].end_ns) return false;
        for (std::size_t j = 0; j < i; ++j)
            if (!spans[i].holds(spans[j]) && !spans[i].apart_from(spans[j])) return false;
    }
    return true;
}

inline std::vector<TracedSpan> named(const std::vector<TracedSpan>& spans, const std::string& name) {
    std::vector<TracedSpan> found;
    for (const TracedSpan& span : spans)
        if (span.name == name) found.push_back(span);
    return found;
}

/// How many spans of a name lie within another.
inline std::size_t count_within(const TracedSpan& outer, const std::vector<TracedSpan>& spans,
                                const std::string& name) {
    std::size_t count = 0;
    for (const TracedSpan& span : spans) count += span.name == name && outer.holds(span) ? 1 : 0;
    return count;
}

}  // namespace eyepoint::testing
