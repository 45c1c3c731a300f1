#include "tools/bench/papers/ueng_chuang.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include <fmt/format.h>

#include "ig/lod_view.hpp"
#include "tools/bench/bench_run.hpp"
#include "tools/bench/goals/goal_bench.hpp"
#include "tools/bench/median.hpp"
#include "tools/bench/papers/built_field.hpp"
#include "tools/bench/papers/circular_flight.hpp"
#include "tools/bench/papers/default_match.hpp"

namespace eyepoint::tools {

namespace {

using terrain::selective::ErrorFormula;
using terrain::selective::Options;
using terrain::selective::ReuseTest;

constexpr double kFovDeg = 40.0;
/// Frames whose CPU is measured; frames between those whose mesh is compared with all posts.
constexpr std::size_t kDrawnFrames = 60, kErrorFrames = 60;
/// 200 m/s at 30 frames a second on a circle of a quarter of the field.
constexpr CircularFlight kFlight{.circle_frames = 5760, .frames = 600};

/// On the equator, where cells are as wide as high, on the lines of tiles of depth 14: 20 x 20 of them.
constexpr const char* kExtent = "8.7890625,0,9.0087890625,0.2197265625";
constexpr int kDepth = 14;

struct PaperLine {
    double tau_px = 0.0;
    std::optional<double> slack_px;                               ///< none: without a cache
    double triangles = 0.0, lod_ms = 0.0, frames_a_second = 0.0;  ///< table 1
    std::optional<double> selected, missed_percent;               ///< table 3, which is of a cache
};
constexpr std::array<PaperLine, 3> kUncached{{{0.5, {}, 49097, 34.8, 5.5, {}, {}},
                                              {1.0, {}, 25158, 23.7, 10.2, {}, {}},
                                              {2.0, {}, 11277, 13.3, 22.1, {}, {}}}};
constexpr std::array<PaperLine, 7> kCached{{{0.5, 0.05, 47487, 1.2, 6.9, 23731, 1.5},
                                            {0.5, 0.10, 45972, 0.7, 7.1, 22971, 3.4},
                                            {1.0, 0.05, 24595, 1.4, 13.7, 12239, 0.7},
                                            {1.0, 0.10, 24025, 0.8, 14.0, 11953, 1.7},
                                            {1.0, 0.20, 22950, 0.6, 14.9, 11414, 3.8},
                                            {2.0, 0.10, 11028, 0.9, 32.1, 5425, 0.6},
                                            {2.0, 0.20, 10770, 0.7, 32.4, 5295, 1.3}}};

/// One way of selecting, flown.
struct Flown {
    double triangles = 0.0, lod_ms = 0.0, frame_ms = 0.0;
    terrain::SelectionAudit audit;  ///< in sum
};

struct Way {
    std::string method = "selective";
    double tau_px = 1.0, slack_px = 0.0;
    ReuseTest reuse = ReuseTest::Off;
    [[nodiscard]] Options options() const { return {.error = ErrorFormula::Paper, .reuse = reuse}; }
};

class Layout {
  public:
    static tl::expected<Layout, std::string> make(const PaperSettings& settings);

    [[nodiscard]] tl::expected<Flown, std::string> fly(const Way& way) const;
    /// The default at the tolerance at which it errs as little as `selective` without a cache.
    [[nodiscard]] tl::expected<Way, std::string> default_as_good_as(double tau_px) const;

  private:
    Layout(BuiltField field, std::vector<ig::FlightEye> eyes)
        : field_(std::move(field)), eyes_(std::move(eyes)) {}
    [[nodiscard]] std::vector<terrain::LodView> views(const Way& way, std::size_t every) const {
        std::vector<terrain::LodView> result;
        for (std::size_t i = 0; i < eyes_.size(); i += every)
            result.push_back(ig::lod_view(eyes_[i].eyepoint.view, way.tau_px, way.slack_px));
        return result;
    }
    [[nodiscard]] tl::expected<double, std::string> frame_ms(const Way& way) const;

    BuiltField field_;
    std::vector<ig::FlightEye> eyes_;
};

tl::expected<Layout, std::string> Layout::make(const PaperSettings& settings) {
    auto field = BuiltField::build(settings, {"--dem", (settings.benchmark / "rainier-641.tif").string(),
                                              "--extent", kExtent, "--max-depth", fmt::format("{}", kDepth)});
    if (!field) return tl::unexpected(field.error());
    auto eyes = eyes_of(kFlight, field->database(), kGoalPicture, kFovDeg);
    if (!eyes) return tl::unexpected(eyes.error());
    return Layout{std::move(*field), std::move(*eyes)};
}

tl::expected<double, std::string> Layout::frame_ms(const Way& way) const {
    BenchOptions drawing;
    drawing.terrain = field_.folder();
    drawing.size = kGoalPicture;
    drawing.scene.lod_method = way.method;
    drawing.scene.selective = way.options();
    drawing.scene.tau_px = way.tau_px;
    drawing.scene.slack = way.slack_px / way.tau_px;
    drawing.scene.shading = ig::Shading::Deferred;
    const auto drawn = run_bench(drawing, {eyes_.begin(), eyes_.begin() + kDrawnFrames});
    if (!drawn) return tl::unexpected(drawn.error());
    return median_of(drawn->frames, [](const BenchFrame& frame) { return frame.entry.cpu_ms; });
}

tl::expected<Flown, std::string> Layout::fly(const Way& way) const {
    auto flight =
        LodFlight::create(field_.database(), {.lod_method = way.method, .selective = way.options()});
    if (!flight) return tl::unexpected(flight.error());
    FullSurface surface(field_.database());
    const auto frames =
        measure_flight(**flight, surface, views(way, 1), {.posts = false, .pops = false, .faults = false});
    if (!frames) return tl::unexpected(frames.error());
    const auto drawn_ms = frame_ms(way);
    if (!drawn_ms) return tl::unexpected(drawn_ms.error());
    const FlightFigures figures = summarise(*frames);
    return Flown{figures.triangles_mean, figures.selection_us_mean / 1000.0, *drawn_ms, figures.audit};
}

tl::expected<Way, std::string> Layout::default_as_good_as(double tau_px) const {
    const Way uncached{.tau_px = tau_px};
    const auto match =
        match_default(field_.database(), {.lod_method = uncached.method, .selective = uncached.options()},
                      views(uncached, kErrorFrames));
    if (!match) return tl::unexpected(match.error());
    return Way{.method = "nested", .tau_px = match->tau_px};
}

double more_percent(double now, double before) { return 100.0 * (now / before - 1.0); }
double less_percent(double now, double before) { return 100.0 * (1.0 - now / before); }
double per_frame(std::uint64_t sum) { return static_cast<double>(sum) / static_cast<double>(kFlight.frames); }

/// paper: the line that this one is to be compared with. without: its line without a cache.
PaperRow row_of(const std::string& name, const Flown& flown, const Flown& uncached, const PaperLine& without,
                const std::optional<PaperLine>& paper) {
    const auto of = [&](auto PaperLine::*figure) {
        return paper ? std::optional<double>{(*paper).*figure} : std::nullopt;
    };
    const auto against = [&](double PaperLine::*figure, const auto& compare) {
        const bool cached = paper && paper->slack_px;
        return cached ? std::optional{compare((*paper).*figure, without.*figure)} : std::nullopt;
    };
    const bool selective = flown.audit.selected > 0;
    const auto counted = [&](double figure) { return selective ? std::optional{figure} : std::nullopt; };
    const double selected = static_cast<double>(flown.audit.selected);
    return {name,
            {{"triangles", flown.triangles, of(&PaperLine::triangles)},
             {"against uncached, %", more_percent(flown.triangles, uncached.triangles),
              against(&PaperLine::triangles, more_percent)},
             {"LOD, ms", flown.lod_ms, of(&PaperLine::lod_ms)},
             {"LOD time saved, %", less_percent(flown.lod_ms, uncached.lod_ms),
              against(&PaperLine::lod_ms, less_percent)},
             {"frames a second", 1000.0 / flown.frame_ms, of(&PaperLine::frames_a_second)},
             {"more than uncached, %", more_percent(uncached.frame_ms, flown.frame_ms),
              against(&PaperLine::frames_a_second, more_percent)},
             {"vertices selected", counted(per_frame(flown.audit.selected)), of(&PaperLine::selected)},
             {"missed, %", counted(100.0 * static_cast<double>(flown.audit.missed) / selected),
              of(&PaperLine::missed_percent)},
             {"beyond tau + s, a frame", counted(per_frame(flown.audit.too_far)), {}},
             {"worst vertex, px", counted(flown.audit.worst_px), {}}}};
}

PaperTable empty_table() {
    return {
        "Ueng & Chuang, tables 1 to 3",
        fmt::format(
            "Method `selective` with the paper's screen error, in its layout: 20 x 20 blocks of 33 x 33 "
            "posts (Mt Rainier, mirrored, 38 m between posts, on the equator). {} frames of a circle at 200 "
            "m/s, 1,000 m above its highest ground, 800 x 800 pixels, 40 degrees; LOD: selection, by "
            "the thread's clock, mean. Frames a second: of one core, by the process CPU of the median of {} "
            "frames drawn in software GL. The paper's machine: Pentium III 660 MHz, GeForce 256.",
            kFlight.frames, kDrawnFrames),
        "tau, px",
        {},
        {}};
}

std::string line_of(double tau_px, const char* way) { return fmt::format("tau {}, {}", tau_px, way); }

std::vector<PaperPlot> plots_of_tolerance(double tau_px) {
    const std::vector<std::string> lines{line_of(tau_px, "uncached"), line_of(tau_px, "four corners"),
                                         line_of(tau_px, "sound"), line_of(tau_px, "nested")};
    return {{fmt::format("Triangles, tau {} px", tau_px), "s, px", {"triangles"}, lines},
            {fmt::format("LOD, ms, tau {} px", tau_px), "s, px", {"LOD, ms"}, lines, true}};
}

/// The rows of one tolerance.
tl::expected<std::vector<PaperRow>, std::string> rows_of(const Layout& layout, const PaperLine& without) {
    const double tau_px = without.tau_px;
    const auto uncached = layout.fly({.tau_px = tau_px});
    if (!uncached) return tl::unexpected(uncached.error());
    std::vector<PaperRow> rows{
        row_of(fmt::format("{}, uncached", tau_px), *uncached, *uncached, without, without)};
    rows.back().line = line_of(tau_px, "uncached");
    for (const PaperLine& line : kCached) {
        if (line.tau_px != tau_px) continue;
        for (const bool sound : {false, true}) {
            const auto flown = layout.fly({.tau_px = tau_px,
                                           .slack_px = line.slack_px.value(),
                                           .reuse = sound ? ReuseTest::Sound : ReuseTest::FourCorner});
            if (!flown) return tl::unexpected(flown.error());
            rows.push_back(row_of(
                fmt::format("{}, s {}, {}", tau_px, line.slack_px.value(), sound ? "sound" : "four corners"),
                *flown, *uncached, without, sound ? std::nullopt : std::optional{line}));
            rows.back().x = line.slack_px.value();
            rows.back().line = line_of(tau_px, sound ? "sound" : "four corners");
        }
    }
    const auto as_good = layout.default_as_good_as(tau_px);
    if (!as_good) return tl::unexpected(as_good.error());
    const auto nested = layout.fly(*as_good);
    if (!nested) return tl::unexpected(nested.error());
    rows.push_back(
        row_of(fmt::format("nested (tau {:.2f})", as_good->tau_px), *nested, *uncached, without, {}));
    rows.back().line = line_of(tau_px, "nested");
    return rows;
}

}  // namespace

tl::expected<PaperTable, std::string> ueng_chuang_tables_1_to_3(const PaperSettings& settings) {
    PaperTable table = empty_table();
    if (settings.benchmark.empty()) {
        table.notes = {"Not run: the benchmark field was not given (EYEPOINT_REAL_DATA, --benchmark)."};
        return table;
    }
    const auto layout = Layout::make(settings);
    if (!layout) return tl::unexpected(layout.error());
    for (const PaperLine& without : kUncached) {
        auto rows = rows_of(*layout, without);
        if (!rows) return tl::unexpected(rows.error());
        std::ranges::move(*rows, std::back_inserter(table.rows));
        std::ranges::move(plots_of_tolerance(without.tau_px), std::back_inserter(table.plots));
    }
    table.notes = {
        "Missed: vertices that the screen error asks for and that are not selected, of all selected; beyond: "
        "of them, "
        "above tau + s ([selective](../methods/selective.md)).",
        "Nested: at the greatest tolerance at which 99.9% of the posts err no more than with `selective` "
        "uncached."};
    return table;
}

}  // namespace eyepoint::tools
