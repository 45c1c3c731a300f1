#include "tools/bench/papers/he_wang_liu.hpp"

#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>

#include <fmt/format.h>

#include "ig/lod_view.hpp"
#include "tools/bench/eyes.hpp"
#include "tools/bench/goals/scratch_folder.hpp"
#include "tools/bench/goals/streamed_flight.hpp"
#include "tools/bench/measure/node_bytes.hpp"
#include "tools/bench/median.hpp"
#include "tools/bench/papers/default_match.hpp"
#include "tools/bench/papers/straight_flight.hpp"
#include "tools/process/child_process.hpp"
#include "tools/report/page.hpp"

namespace eyepoint::tools {

namespace {

constexpr ig::PictureSize kSize{1024, 768};
constexpr double kFovDeg = 40.0, kRateHz = 30.0;
constexpr double kLeastBudgetTauPx = 0.1;  ///< so small that the budget decides
constexpr int kCacheMib = 64;
constexpr double kMib = 1048576.0;

/// The paper's, with blocks of 32.
struct PaperLine {
    std::uint32_t faces = 0;
    double frames_a_second = 0.0;
};
constexpr std::array<PaperLine, 3> kPaper{{{5000, 145.0}, {10000, 115.0}, {20000, 65.0}}};
constexpr double kPaperNodeBytes = 56.0;  ///< its struct, with pointers of 64 bits

tl::expected<void, std::string> run_program(std::vector<std::string> arguments) {
    constexpr std::chrono::minutes kPatience{60};
    const std::string name = arguments.front();
    auto child = ChildProcess::start(std::move(arguments));
    if (!child) return tl::unexpected(child.error());
    const Ending ending = child->wait(kPatience);
    if (ending.exit_code == 0) return {};
    return tl::unexpected(name + " failed: " + ending.standard_error);
}

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }
double mean(const std::vector<double>& values) { return sum(values) / static_cast<double>(values.size()); }

/// What is flown: by what method, in how many triangles or to what tolerance.
struct Method {
    std::string name;
    double tau_px = kLeastBudgetTauPx;
    std::uint32_t budget = 0;
};

class Experiment {
  public:
    static tl::expected<Experiment, std::string> prepare(const PaperSettings& settings);

    /// Draws the flight, blocks arriving as they are read.
    [[nodiscard]] tl::expected<FlightResult, std::string> draw(const Method& method) const;
    /// The triangles, and the 99.9th percentile of the post error, with everything loaded.
    [[nodiscard]] tl::expected<FlightFigures, std::string> measure(const Method& method);
    /// The default, at the tolerance that gives the same percentile.
    [[nodiscard]] tl::expected<ToleranceMatch, std::string> default_as_good_as(double p999_px);

  private:
    Experiment(PaperSettings settings, ScratchFolder scratch,
               std::shared_ptr<const terrain::Database> database)
        : settings_(std::move(settings)),
          scratch_(std::move(scratch)),
          database_(database),
          surface_(std::make_unique<FullSurface>(std::move(database))) {}

    [[nodiscard]] std::filesystem::path flight() const { return scratch_.path() / "flight.pcap"; }
    [[nodiscard]] std::vector<terrain::LodView> views(double tau_px, std::size_t every) const;

    PaperSettings settings_;
    ScratchFolder scratch_;
    std::shared_ptr<const terrain::Database> database_;
    std::unique_ptr<FullSurface> surface_;
    std::vector<ig::FlightEye> eyes_;
};

tl::expected<Experiment, std::string> Experiment::prepare(const PaperSettings& settings) {
    auto scratch = ScratchFolder::create();
    if (!scratch) return tl::unexpected(scratch.error());
    auto database = terrain::Database::open(settings.synth_field);
    if (!database) return tl::unexpected(database.error());
    Experiment made(settings, std::move(*scratch),
                    std::make_shared<const terrain::Database>(std::move(*database)));
    const auto track = track_of({.seconds = settings.seconds}, made.database_);
    if (!track) return tl::unexpected(track.error());
    const auto log = made.scratch_.path() / "track.csv";
    if (auto written = write_whole(log, *track); !written) return tl::unexpected(written.error());
    const auto converted =
        run_program({(settings.programs / "eyepoint-replay").string(), "convert", log.string(), "-o",
                     made.flight().string(), "--rate", fmt::format("{}", kRateHz)});
    if (!converted) return tl::unexpected(converted.error());
    auto eyes = read_eyes({.file = made.flight(),
                           .size = kSize,
                           .vertical_fov_deg = kFovDeg,
                           .rate_hz = kRateHz,
                           .ellipsoid = true});
    if (!eyes) return tl::unexpected(eyes.error());
    made.eyes_ = std::move(*eyes);
    return made;
}

tl::expected<FlightResult, std::string> Experiment::draw(const Method& method) const {
    return draw_streamed({.programs = settings_.programs,
                          .flight = flight(),
                          .terrain = settings_.synth_field,
                          .size = kSize,
                          .vertical_fov_deg = kFovDeg,
                          .rate_hz = kRateHz,
                          .lod_method = method.name,
                          .tau_px = method.tau_px,
                          .triangle_budget = method.budget,
                          .block_cache_mib = kCacheMib});
}

std::vector<terrain::LodView> Experiment::views(double tau_px, std::size_t every) const {
    std::vector<terrain::LodView> result;
    for (std::size_t i = 0; i < eyes_.size(); i += every)
        result.push_back(ig::lod_view(eyes_[i].eyepoint.view, tau_px, 0.0));
    return result;
}

tl::expected<FlightFigures, std::string> Experiment::measure(const Method& method) {
    auto flight = LodFlight::create(database_, {.lod_method = method.name, .triangle_budget = method.budget});
    if (!flight) return tl::unexpected(flight.error());
    const auto frames = measure_flight(**flight, *surface_, views(method.tau_px, 1),
                                       {.every = settings_.every, .pops = false});
    if (!frames) return tl::unexpected(frames.error());
    return summarise(*frames);
}

tl::expected<ToleranceMatch, std::string> Experiment::default_as_good_as(double p999_px) {
    return match_default(database_, *surface_, views(1.0, settings_.every), p999_px);
}

double bytes_a_drawn_node(const FlightResult& drawn, double block_bytes) {
    return bytes_a_node(sum(*drawn.find("blocks_drawn")), sum(*drawn.find("triangles")), block_bytes);
}

/// By processor time, of all threads: wall time is the machine's other work, too.
double frames_a_second(const FlightResult& drawn) { return 1000.0 / median(*drawn.find("cpu_ms")); }

tl::expected<PaperRow, std::string> row_of(Experiment& experiment, const PaperLine& line) {
    const Method bintree{"bintree", kLeastBudgetTauPx, line.faces};
    const auto drawn = experiment.draw(bintree);
    if (!drawn) return tl::unexpected(drawn.error());
    const auto measured = experiment.measure(bintree);
    if (!measured) return tl::unexpected(measured.error());
    const double p999_px = measured->posts.error.percentile(0.999);
    const auto match = experiment.default_as_good_as(p999_px);
    if (!match) return tl::unexpected(match.error());
    const auto nested = experiment.draw({"nested", match->tau_px, 0});
    if (!nested) return tl::unexpected(nested.error());
    const double peak_mib = drawn->figures.at("peak_resident_bytes") / kMib;
    return PaperRow{fmt::format("{}", line.faces),
                    {{"frames a second", frames_a_second(*drawn), line.frames_a_second},
                     {"triangles", mean(*drawn->find("triangles")), {}},
                     {"selection, ms", mean(*drawn->find("selection_ms")), {}},
                     {"frames short of a block", static_cast<double>(frames_lacking_blocks(*drawn)), {}},
                     {"peak memory, MiB", peak_mib, {}},
                     {"above bare GL, MiB", mib_above_bare(*drawn), {}},
                     {"bytes a node", bytes_a_drawn_node(*drawn, kNodeSetsBytes), kPaperNodeBytes},
                     {"with errors", bytes_a_drawn_node(*drawn, kNodeSetsBytes + kNodeErrorsBytes), {}},
                     {"post error p99.9, px", p999_px, {}},
                     {"cracks", static_cast<double>(measured->faults.cracks), {}},
                     {"nested: post error p99.9, px", match->figures.posts.error.percentile(0.999), {}},
                     {"nested: triangles", match->figures.triangles_mean, {}},
                     {"nested: frames a second", frames_a_second(*nested), {}}},
                    static_cast<double>(line.faces),
                    "bintree"};
}

std::string setting_of(const PaperSettings& settings, const terrain::Manifest& field) {
    const double posts_a_degree = terrain::kBlockCells / terrain::tile_side_deg(field.max_depth);
    const auto posts = [&](double side_deg) { return std::lround(side_deg * posts_a_degree) + 1; };
    const terrain::GeographicExtent& detail = field.detail_extent;
    return fmt::format(
        "Method `bintree`. Terrain: {} x {} posts of {}, in blocks of 33 x 33 (the paper: 16385 x 16385). "
        "{:.0f} s straight north at 200 m/s, 30 frames a second of flight, about 1,000 m above ground, pitch "
        "-10 degrees, {} x {} pixels, {:.0f} degrees; drawn one after the other in software GL, blocks "
        "arriving as they are read, {} MiB of blocks kept. Frames a second: of one core, by the process CPU "
        "of "
        "the median frame. The paper's machine: Pentium 4, GeForce MX 400, 256 MB.",
        posts(detail.east_deg - detail.west_deg), posts(detail.north_deg - detail.south_deg), field.name,
        settings.seconds, kSize.width_px, kSize.height_px, kFovDeg, kCacheMib);
}

}  // namespace

tl::expected<PaperTable, std::string> he_wang_liu_table_1(const PaperSettings& settings) {
    const auto database = terrain::Database::open(settings.synth_field);
    if (!database) return tl::unexpected(database.error());
    auto experiment = Experiment::prepare(settings);
    if (!experiment) return tl::unexpected(experiment.error());
    PaperTable table{"He, Wang & Liu, table 1", setting_of(settings, database->manifest()), "faces", {}, {}};
    for (const PaperLine& line : kPaper) {
        auto row = row_of(*experiment, line);
        if (!row) return tl::unexpected(row.error());
        table.rows.push_back(std::move(*row));
    }
    table.plots = {{"Frames a second", "faces", {"frames a second", "nested: frames a second"}, {"bintree"}}};
    table.notes = {
        "Bytes a node: the bits of its block's two sets, split and wanted; with errors: and what its block "
        "knows of its posts, drawn or not ([bintree](../methods/bintree.md#measured)).",
        "Nested: at the greatest tolerance, 100 pixels at most, at which it errs no more than `bintree`.",
        "Not measured: the paper's blocks of 64 and 128 (140 to 145, 110 to 111, 60 to 63 frames a second); "
        "our databases have blocks of 32 cells."};
    return table;
}

}  // namespace eyepoint::tools
