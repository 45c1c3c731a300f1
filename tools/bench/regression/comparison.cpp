#include "tools/bench/regression/comparison.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string_view>

#include <fmt/format.h>

#include "tools/bench/regression/flight_ratios.hpp"

namespace eyepoint::tools {

namespace {

struct Count {
    const char* key;
    const char* what;
    bool fewer_is_better;
};
constexpr std::array kCounts{
    Count{"triangles", "triangles", true},
    Count{"triangles_hidden", "triangles left out as hidden", false},
    Count{"draws", "draws", true},
    Count{"gl_calls", "GL calls", true},
    Count{"blocks_drawn", "blocks drawn", true},
    Count{"blocks_tested", "blocks tested", true},
    Count{"blocks_evaluated", "blocks evaluated", true},
    Count{"blocks_reused", "blocks reused", false},
    Count{"blocks_uploaded", "blocks uploaded", true},
    Count{"bytes_uploaded", "bytes uploaded", true},
    Count{"allocations", "heap allocations of the frame thread", true},
    Count{"new_state_pairs", "new programs and state pairs", true},
};

std::optional<std::string> difference(const FlightResult& before, const FlightResult& after) {
    const FlightIdentity &a = before.identity, &b = after.identity;
    const auto said = [](const char* what, const auto& one, const auto& other) {
        return fmt::format("the flights differ in {} ({} and {}); fly both the same way", what, one, other);
    };
    if (a.flight_hash != b.flight_hash) return said("the recording", a.flight, b.flight);
    if (a.terrain != b.terrain) return said("the terrain", a.terrain, b.terrain);
    if (a.size != b.size)
        return said("size", fmt::format("{}x{}", a.size.width_px, a.size.height_px),
                    fmt::format("{}x{}", b.size.width_px, b.size.height_px));
    if (a.rate_hz != b.rate_hz) return said("rate", a.rate_hz, b.rate_hz);
    if (a.vertical_fov_deg != b.vertical_fov_deg)
        return said("field of view", a.vertical_fov_deg, b.vertical_fov_deg);
    if (a.tau_px != b.tau_px) return said("tolerance", a.tau_px, b.tau_px);
    if (a.lod_method != b.lod_method) return said("LOD method", a.lod_method, b.lod_method);
    if (a.shading != b.shading) return said("shading", a.shading, b.shading);
    if (a.streaming != b.streaming) return said("waiting for loads", a.streaming, b.streaming);
    if (before.frames != after.frames) return said("number of frames", before.frames, after.frames);
    return std::nullopt;
}

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

ComparedLine compare_count(const Count& count, const std::vector<double>& before,
                           const std::vector<double>& after) {
    ComparedLine line{.kind = ComparedLine::Kind::Count,
                      .what = count.what,
                      .before = sum(before),
                      .after = sum(after),
                      .change = {},
                      .verdict = Verdict::Same,
                      .remark = {}};
    const auto first = std::mismatch(before.begin(), before.end(), after.begin());
    if (first.first == before.end()) return line;
    if (line.before == line.after) {
        line.verdict = Verdict::Different;
    } else {
        line.verdict = (line.after < line.before) == count.fewer_is_better ? Verdict::Better : Verdict::Worse;
    }
    std::size_t frames = 0;
    for (std::size_t i = 0; i < before.size(); ++i) frames += before[i] != after[i] ? 1 : 0;
    line.remark = fmt::format("in {} frames, first in frame {}: {:.0f}, then {:.0f}", frames,
                              first.first - before.begin() + 1, *first.first, *first.second);
    return line;
}

/// Drivers are partly in C++: their allocations count too.
void compare_counts(const FlightResult& before, const FlightResult& after, Comparison& comparison) {
    const bool same_gl = before.identity.gl == after.identity.gl;
    for (const Count& count : kCounts) {
        const auto *one = before.find(count.key), *other = after.find(count.key);
        if (one == nullptr || other == nullptr) continue;
        if (!same_gl && count.key == std::string_view("allocations")) {
            comparison.notes.emplace_back("allocations: not compared, as OpenGL differs");
        } else {
            comparison.lines.push_back(compare_count(count, *one, *other));
        }
    }
}

Verdict verdict(const Interval& change, double margin) {
    if (change.low > 1.0 + margin) return Verdict::Worse;
    if (change.high < 1.0 - margin) return Verdict::Better;
    return change.low >= 1.0 - margin && change.high <= 1.0 + margin ? Verdict::Same : Verdict::Unclear;
}

ComparedLine compare_ratio(ComparedLine::Kind kind, const FlightRatio& before, const FlightRatio& after,
                           double margin) {
    const double run = std::max(mean_run_length(before.series), mean_run_length(after.series));
    const Interval change = bootstrap(before.frames.size(), run, [&](FrameChoice choice) {
        return after.figure(choice) / before.figure(choice);
    });
    std::vector<std::uint32_t> all(before.frames.size());
    std::iota(all.begin(), all.end(), 0U);
    return {.kind = kind,
            .what = before.what,
            .before = before.figure(all),
            .after = after.figure(all),
            .change = change,
            .verdict = verdict(change, margin),
            .remark = {}};
}

void compare_all(ComparedLine::Kind kind, const std::vector<FlightRatio>& before,
                 const std::vector<FlightRatio>& after, double margin, Comparison& comparison) {
    for (const FlightRatio& one : before) {
        const auto other = std::ranges::find(after, one.key, &FlightRatio::key);
        if (other == after.end()) continue;
        if (one.frames != other->frames || one.frames.empty()) {
            comparison.notes.push_back(one.what + ": not compared, as it was taken of different frames");
            continue;
        }
        comparison.lines.push_back(compare_ratio(kind, one, *other, margin));
    }
}

void compare_pictures(const FlightResult& before, const FlightResult& after, Comparison& comparison) {
    if (before.picture_hashes.empty() || after.picture_hashes.empty()) {
        comparison.notes.emplace_back("pictures: not compared, as a result has no hashes");
        return;
    }
    if (before.identity.gl != after.identity.gl) {
        comparison.notes.push_back(fmt::format(
            "pictures: hashes not compared, as OpenGL differs ({}; {}); compare the pictures with --pictures",
            before.identity.gl.version, after.identity.gl.version));
        return;
    }
    std::size_t differing = 0, first = 0;
    for (std::size_t i = before.frames; i-- > 0;) {
        if (before.picture_hashes[i] == after.picture_hashes[i]) continue;
        ++differing;
        first = i + 1;
    }
    const auto frames = static_cast<double>(before.frames);
    comparison.lines.push_back(
        {.kind = ComparedLine::Kind::Picture,
         .what = "pictures, by hash",
         .before = frames,
         .after = frames,
         .change = {},
         .verdict = differing == 0 ? Verdict::Same : Verdict::Different,
         .remark = differing == 0 ? std::string{}
                                  : fmt::format("{} frames differ, first frame {}", differing, first)});
}

}  // namespace

bool Comparison::passes(bool exact) const {
    return std::ranges::none_of(lines, [&](const ComparedLine& line) {
        const bool count = line.kind == ComparedLine::Kind::Count;
        return line.verdict == Verdict::Worse || line.verdict == Verdict::Different ||
               (exact && count && line.verdict == Verdict::Better);
    });
}

tl::expected<Comparison, std::string> compare(const FlightResult& before, const FlightResult& after,
                                              const ComparisonOptions& options) {
    if (auto differs = difference(before, after)) return tl::unexpected(std::move(*differs));
    Comparison comparison;
    compare_counts(before, after, comparison);
    compare_pictures(before, after, comparison);
    compare_all(ComparedLine::Kind::Ratio, flight_ratios(before), flight_ratios(after), options.margin,
                comparison);
    if (before.identity.machine == after.identity.machine && before.identity.gl == after.identity.gl) {
        compare_all(ComparedLine::Kind::Time, flight_times(before), flight_times(after), options.margin,
                    comparison);
    } else {
        comparison.notes.emplace_back("times: not compared, as machine or OpenGL differ");
    }
    return comparison;
}

}  // namespace eyepoint::tools
