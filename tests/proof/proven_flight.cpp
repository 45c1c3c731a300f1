#include "tests/proof/proven_flight.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "ig/lod_view.hpp"

namespace eyepoint::testing {

namespace {

template <typename T>
T value_or_throw(tl::expected<T, std::string> made) {
    if (!made) throw std::runtime_error(made.error());
    return std::move(*made);
}

/// Vertices are floats from the eye and levels are compared in float (terrain::kLevelMargin).
constexpr double kRounding = 1e-3;

bool on_tile_edge(int row, int column) {
    constexpr int kLast = tools::PostTile::kSide - 1;
    return row == 0 || column == 0 || row == kLast || column == kLast;
}

/// Counts the posts beyond the tolerance.
///
/// Where a tile ends at coarser data, its posts on that edge are interpolated so that both sides are one
/// line, and stored as heights are: in whole steps. The drawn edge is the exact line, so such a post may be
/// off by half a step that no finer mesh could take away.
class Tally {
  public:
    Tally(Findings& findings, double height_step_m) : findings_(findings), step_m_(height_step_m) {}

    void add(std::size_t frame, const terrain::LodView& view, const tools::MeasuredTile& tile) {
        const double tolerance_px = (view.tau_px + view.slack_px) * (1.0 + kRounding);
        for (int row = 0; row < tools::PostTile::kSide; ++row) {
            for (int column = 0; column < tools::PostTile::kSide; ++column) {
                const auto post = static_cast<std::size_t>(row * tools::PostTile::kSide + column);
                const double error_px = std::abs(tile.above_m[post]) * tile.px_per_m[post];
                if (std::isnan(error_px) || error_px <= tolerance_px) continue;
                const double quantum_px =
                    on_tile_edge(row, column) ? 0.5 * step_m_ * tile.px_per_m[post] : 0.0;
                if (error_px <= tolerance_px + quantum_px) {
                    ++findings_.rounded_over;
                    continue;
                }
                ++findings_.beyond;
                const double allowed_px = view.tau_px + view.slack_px;
                if (findings_.worst.allowed_px > 0.0 &&
                    error_px / allowed_px <= findings_.worst.error_px / findings_.worst.allowed_px)
                    continue;
                findings_.worst = {frame,
                                   tile.tile->tile,
                                   row,
                                   column,
                                   error_px,
                                   allowed_px,
                                   tile.above_m[post],
                                   tile.folded[post]};
            }
        }
    }

  private:
    Findings& findings_;
    double step_m_;
};

std::string describe(const terrain::TileId& tile, int row, int column) {
    return fmt::format("tile {}/{}/{}, row {}, column {}", tile.depth, tile.x, tile.y, row, column);
}

std::string describe(const Violation& worst) {
    return fmt::format("frame {}, {}: {:.3f} px of {:.3f}, {:.2f} m above the post{}", worst.frame,
                       describe(worst.tile, worst.row, worst.column), worst.error_px, worst.allowed_px,
                       worst.above_m, worst.folded ? ", under a fold" : "");
}

std::string describe_hole(const tools::PostFigures& posts) {
    return posts.hole ? "one is " + describe(posts.hole->tile, posts.hole->row, posts.hole->column) : "";
}

}  // namespace

bool every_frame() { return std::getenv("EYEPOINT_EVERY_FRAME") != nullptr; }

std::size_t one_in(std::size_t frames) { return every_frame() ? 1 : frames; }

std::vector<terrain::LodView> views_of(std::span<const ig::FlightEye> eyes, const Tolerance& tolerance) {
    std::vector<terrain::LodView> views;
    for (const ig::FlightEye& eye : eyes) {
        views.push_back(
            ig::lod_view(eye.eyepoint.view, tolerance.tau_px, tolerance.slack_share * tolerance.tau_px));
    }
    return views;
}

ProvenFlight::ProvenFlight(std::shared_ptr<const terrain::Database> database,
                           const tools::FlightOptions& options)
    : database_(std::move(database)),
      flight_(value_or_throw(tools::LodFlight::create(database_, options))),
      surface_(database_) {}

Findings ProvenFlight::fly(std::span<const terrain::LodView> views, const tools::MeasureOptions& options) {
    Findings findings;
    Tally tally(findings, database_->manifest().height_step_m);
    const auto see = [&](std::size_t frame, const tools::PostView& view,
                         const tools::MeasuredPosts& posts) -> tl::expected<void, std::string> {
        for (const tools::MeasuredTile& tile : posts.tiles) tally.add(frame, view.lod, tile);
        return {};
    };
    findings.figures =
        tools::summarise(value_or_throw(tools::measure_flight(*flight_, surface_, views, options, see)));
    return findings;
}

void expect_whole(const Findings& findings, const std::string& name) {
    const tools::FlightFigures& figures = findings.figures;
    const tools::PostFigures& posts = figures.posts;
    fmt::print(
        "{}: {} of {} frames, {:.0f} triangles; {} edges, {} cracks, {} overlaps; {} posts, max {:.3f} px, "
        "p99.9 {:.3f} px, beyond {} (half a step {}), uncovered {}, overlapped {}, under a fold {}; pops {} "
        "max {:.3f} px; reused {:.1f}%\n",
        name, figures.measured_frames, figures.frames, figures.triangles_mean, figures.faults.edges,
        figures.faults.cracks, figures.faults.overlaps, posts.error.count(), posts.error.maximum(),
        posts.error.percentile(0.999), findings.beyond, findings.rounded_over, posts.uncovered,
        posts.overlapped, posts.folded, figures.pops.count(), figures.pops.maximum(),
        100.0 * figures.reused_share);
    if (findings.beyond > 0) fmt::print("worst: {}\n", describe(findings.worst));
    EXPECT_GT(figures.faults.edges, 0U) << name;
    EXPECT_GT(posts.error.count(), 0U) << name;
    EXPECT_EQ(figures.faults.cracks, 0U) << name;
    EXPECT_EQ(posts.uncovered, 0U) << name << ": " << describe_hole(posts);
}

void expect_sound(const Findings& findings, const std::string& name) {
    expect_whole(findings, name);
    EXPECT_EQ(findings.beyond, 0U) << name << ": " << describe(findings.worst);
}

std::size_t expect_whole_while_loading(const std::shared_ptr<const terrain::Database>& database,
                                       std::span<const terrain::LodView> views, std::size_t blocks_a_frame,
                                       std::size_t every, const std::string& lod_method) {
    auto method = terrain::make_lod_method(lod_method);
    auto pager = value_or_throw(
        terrain::Pager::create(database, {.mesh = method->mesh_kind(), .cache_bytes = 8ULL << 30}));
    tools::FullSurface surface(database);
    std::size_t loading = 0;
    for (std::size_t frame = 0; frame < views.size(); ++frame) {
        const terrain::LodView& view = views[frame];
        const terrain::Selection& selection = method->select(view, pager->tree(), frame + 1);
        loading += selection.wishes.empty() ? 0 : 1;
        const tools::DrawnMesh mesh = tools::drawn_mesh(selection, *method, view);
        EXPECT_EQ(tools::find_mesh_faults(mesh).cracks, 0U) << "frame " << frame;
        if (frame % every == 0) {
            const tools::PostFigures posts =
                tools::post_figures(value_or_throw(tools::measure_posts(surface, mesh, {view})));
            EXPECT_EQ(posts.uncovered, 0U) << "frame " << frame << ": " << describe_hole(posts);
        }
        pager->request(selection.wishes);
        (void)pager->wait_for_loads();
        (void)pager->publish(blocks_a_frame, frame + 1);
    }
    return loading;
}

}  // namespace eyepoint::testing
