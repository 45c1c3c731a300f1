#include "tools/bench/papers/larsen_christensen.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

#include <fmt/format.h>

#include "ig/lod_view.hpp"
#include "tools/bench/eyes.hpp"
#include "tools/bench/goals/drawing_goals.hpp"
#include "tools/bench/median.hpp"
#include "tools/bench/papers/built_field.hpp"
#include "tools/bench/papers/default_match.hpp"

namespace eyepoint::tools {

namespace {

constexpr double kTileTauPx = 1.0;
/// Eyes drawn: so far apart that ten seconds are flown, so near that none jumps over a morph.
constexpr std::size_t kFlownFrames = 300, kFramesAnEye = 8, kEyesAMeasure = 8;
constexpr TurnOptions kTurns{.turns = 4};

/// The field has 4097 posts a side down to this depth, half as many with each depth less.
constexpr int kFullDepth = 13, kFullPosts = 4097;

struct TimedLine {
    int posts = 0;                     ///< of the terrain, a side
    int tile = 0;                      ///< of a tile
    double with = 0.0, without = 0.0;  ///< frames a second
};
constexpr std::array<TimedLine, 6> kTable7{{{513, 17, 66.25, 67.07},
                                            {513, 33, 39.49, 38.17},
                                            {1025, 17, 28.31, 28.51},
                                            {1025, 33, 39.71, 38.12},
                                            {2049, 17, 8.65, 7.66},
                                            {2049, 33, 18.59, 18.05}}};

double cpu_ms(const TurnFrame& frame) { return frame.cpu_ms; }
double selection_ms(const TurnFrame& frame) { return frame.selection_ms; }
double triangles(const TurnFrame& frame) { return static_cast<double>(frame.triangles); }

double percent_more(double with, double without) { return 100.0 * (without / with - 1.0); }

std::string tile_line(int posts) { return fmt::format("tiles of {}", posts); }

/// The benchmark field at fewer posts, and what is flown over it.
class Cut {
  public:
    static tl::expected<Cut, std::string> make(const PaperSettings& settings, int posts);

    [[nodiscard]] tl::expected<PaperRow, std::string> measure(const TimedLine& line) const;

  private:
    Cut(BuiltField field, std::vector<ig::FlightEye> eyes)
        : field_(std::move(field)), eyes_(std::move(eyes)) {}
    [[nodiscard]] std::vector<terrain::LodView> views(std::size_t every) const;
    [[nodiscard]] tl::expected<FlightFigures, std::string> errors(const terrain::tiles::Options& tile) const;
    [[nodiscard]] tl::expected<ToleranceMatch, std::string> default_as_good_as(double p999_px) const;

    BuiltField field_;
    std::vector<ig::FlightEye> eyes_;
};

/// The depth at which the benchmark field has so many posts.
int depth_of(int posts) {
    int depth = kFullDepth;
    for (int full = kFullPosts; full > posts; full = (full + 1) / 2) --depth;
    return depth;
}

tl::expected<Cut, std::string> Cut::make(const PaperSettings& settings, int posts) {
    auto field =
        BuiltField::build(settings, {"--dem", (settings.benchmark / "rainier-refined-4097.tif").string(),
                                     "--max-depth", fmt::format("{}", depth_of(posts))});
    if (!field) return tl::unexpected(field.error());
    auto eyes = read_eyes({.file = settings.benchmark / "cruise.csv", .size = kGoalPicture});
    if (!eyes) return tl::unexpected(eyes.error());
    eyes->resize(std::min(eyes->size(), kFlownFrames));
    return Cut{std::move(*field), every_nth(*eyes, kFramesAnEye)};
}

std::vector<terrain::LodView> Cut::views(std::size_t every) const {
    std::vector<terrain::LodView> result;
    for (const ig::FlightEye& eye : every_nth(eyes_, every))
        result.push_back(ig::lod_view(eye.eyepoint.view, kTileTauPx, 0.0));
    return result;
}

tl::expected<FlightFigures, std::string> Cut::errors(const terrain::tiles::Options& tile) const {
    auto flight = LodFlight::create(field_.database(), {.lod_method = "tile", .tile = tile});
    if (!flight) return tl::unexpected(flight.error());
    FullSurface surface(field_.database());
    const auto frames = measure_flight(**flight, surface, views(1), {.every = kEyesAMeasure, .pops = false});
    if (!frames) return tl::unexpected(frames.error());
    return summarise(*frames);
}

tl::expected<ToleranceMatch, std::string> Cut::default_as_good_as(double p999_px) const {
    FullSurface surface(field_.database());
    return match_default(field_.database(), surface, views(kEyesAMeasure), p999_px);
}

tl::expected<PaperRow, std::string> Cut::measure(const TimedLine& line) const {
    ig::SceneOptions without = goal_scene("tile", kTileTauPx);
    without.tile.posts = line.tile;
    without.morph = false;
    ig::SceneOptions with = without;
    with.morph = true;
    const auto figures = errors(with.tile);
    if (!figures) return tl::unexpected(figures.error());
    const double p999_px = figures->posts.error.percentile(0.999);
    const auto match = default_as_good_as(p999_px);
    if (!match) return tl::unexpected(match.error());
    const std::array scenes{without, with, goal_scene("nested", match->tau_px)};
    const auto frames = draw_by_turns(field_.database(), scenes, eyes_, kGoalPicture, kTurns);
    if (!frames) return tl::unexpected(frames.error());
    const auto a_second = [](const std::vector<TurnFrame>& drawn) {
        return 1000.0 / median_of(drawn, cpu_ms);
    };
    return PaperRow{fmt::format("{}, {}", line.posts, line.tile),
                    {{"frames a second, morph", a_second((*frames)[1]), line.with},
                     {"no morph", a_second((*frames)[0]), line.without},
                     {"morph adds, % of a frame", 100.0 * (frame_ratio({(*frames)[0], (*frames)[1]}) - 1.0),
                      percent_more(line.with, line.without)},
                     {"triangles, morph", median_of((*frames)[1], triangles), {}},
                     {"no morph", median_of((*frames)[0], triangles), {}},
                     {"selection, ms", median_of((*frames)[1], selection_ms), {}},
                     {"post error p99.9, px", p999_px, {}},
                     {"max, px", figures->posts.error.maximum(), {}},
                     {"cracks", static_cast<double>(figures->faults.cracks), {}},
                     {"nested: triangles", median_of((*frames)[2], triangles), {}},
                     {"nested: frames a second", a_second((*frames)[2]), {}},
                     {"nested: selection, ms", median_of((*frames)[2], selection_ms), {}}},
                    static_cast<double>(line.posts),
                    tile_line(line.tile)};
}

PaperTable empty_table() {
    return {"Larsen & Christensen, table 7",
            fmt::format(
                "Method `tile` at tau {} px. Terrain: one field (Mt Rainier, 92 km a side) at three "
                "resolutions, so that, as the paper's, the small one is rough and the large one smooth. The "
                "first 10 s of `cruise`, every {}th frame, {} x {} pixels, 40 degrees; drawn by turns in one "
                "process, software GL. Frames a second: of one core, by the process CPU of the median frame. "
                "The paper's machine: Pentium III 800 MHz, GeForce 3.",
                kTileTauPx, kFramesAnEye, kGoalPicture.width_px, kGoalPicture.height_px),
            "terrain, tile",
            {},
            {}};
}

}  // namespace

tl::expected<PaperTable, std::string> larsen_christensen_table_7(const PaperSettings& settings) {
    PaperTable table = empty_table();
    if (settings.benchmark.empty()) {
        table.notes = {"Not run: the benchmark field was not given (EYEPOINT_REAL_DATA, --benchmark)."};
        return table;
    }
    std::optional<Cut> cut;
    int posts = 0;
    for (const TimedLine& line : kTable7) {
        if (line.posts != posts) {
            auto made = Cut::make(settings, line.posts);
            if (!made) return tl::unexpected(made.error());
            cut = std::move(*made);
            posts = line.posts;
        }
        auto row = cut->measure(line);
        if (!row) return tl::unexpected(row.error());
        table.rows.push_back(std::move(*row));
    }
    table.plots = {{"What morph adds, % of a frame",
                    "posts a side of the terrain",
                    {"morph adds, % of a frame"},
                    {tile_line(17), tile_line(33)}}};
    table.notes = {
        "Morph adds: the median of the frames' ratios. The paper's are its frame rates' "
        "([tile](../methods/tile.md)).",
        "Nested: at the greatest tolerance at which it errs no more than `tile` with morph, at the 99.9th "
        "percentile."};
    return table;
}

}  // namespace eyepoint::tools
