#include "tools/bench/measure_report.hpp"

#include <fmt/format.h>

namespace eyepoint::tools {

namespace {

std::string posts_table(const FlightFigures& figures) {
    const PostFigures& posts = figures.posts;
    std::string text;
    text +=
        fmt::format("posts in view               {}, uncovered {}, overlapped {}, under a fold {}\n",
                    posts.error.count() + posts.uncovered, posts.uncovered, posts.overlapped, posts.folded);
    text += fmt::format(
        "post error, px              max {:.3f}  p99.9 {:.3f} (worst frame {:.3f})  rms {:.3f}\n",
        posts.error.maximum(), posts.error.percentile(0.999), figures.worst_frame_p999_px, posts.error.rms());
    const WorstPost& worst = posts.worst;
    text += fmt::format("  worst                     tile {}/{}-{}, row {}, column {}: {:+.2f} m{}\n",
                        worst.tile.depth, worst.tile.x, worst.tile.y, worst.row, worst.column, worst.above_m,
                        worst.folded
                            ? fmt::format(", under a fold; max off folds {:.3f} px", posts.most_off_folds_px)
                            : std::string{});
    if (posts.hole) {
        text += fmt::format("  a hole                    tile {}/{}-{}, row {}, column {}\n",
                            posts.hole->tile.depth, posts.hole->tile.x, posts.hole->tile.y, posts.hole->row,
                            posts.hole->column);
    }
    text += fmt::format("pops, px                    max {:.3f}  p99.9 {:.3f}  ({} posts)\n",
                        figures.pops.maximum(), figures.pops.percentile(0.999), figures.pops.count());
    text += fmt::format("edges                       {}, borders {}, cracks {}, overlaps {}\n",
                        figures.faults.edges, figures.faults.borders, figures.faults.cracks,
                        figures.faults.overlaps);
    return text;
}

std::string audit_table(const FlightFigures& figures) {
    const terrain::SelectionAudit& audit = figures.audit;
    const auto frames = static_cast<double>(figures.measured_frames);
    return fmt::format(
        "vertices selected           mean {:.0f}; missed {:.1f} ({:.2f}%), above tau + slack {:.1f}, worst "
        "{:.3f} px\n"
        "  triangles in dikes        mean {:.0f}\n",
        static_cast<double>(audit.selected) / frames, static_cast<double>(audit.missed) / frames,
        100.0 * static_cast<double>(audit.missed) / static_cast<double>(audit.selected),
        static_cast<double>(audit.too_far) / frames, audit.worst_px,
        static_cast<double>(audit.dike_triangles) / frames);
}

nlohmann::json to_json(const terrain::SelectionAudit& audit) {
    return {{"selected", audit.selected},
            {"missed", audit.missed},
            {"above_tau_and_slack", audit.too_far},
            {"worst_px", audit.worst_px},
            {"dike_triangles", audit.dike_triangles}};
}

nlohmann::json to_json(const PixelDistribution& pixels) {
    return {{"count", pixels.count()},
            {"max_px", pixels.maximum()},
            {"p999_px", pixels.percentile(0.999)},
            {"rms_px", pixels.rms()}};
}

nlohmann::json to_json(const PostFigures& posts) {
    return {{"error", to_json(posts.error)},
            {"uncovered", posts.uncovered},
            {"overlapped", posts.overlapped},
            {"folded", posts.folded},
            {"max_off_folds_px", posts.most_off_folds_px},
            {"worst",
             {{"depth", posts.worst.tile.depth},
              {"x", posts.worst.tile.x},
              {"y", posts.worst.tile.y},
              {"row", posts.worst.row},
              {"column", posts.worst.column},
              {"above_m", posts.worst.above_m},
              {"under_fold", posts.worst.folded}}}};
}

nlohmann::json to_json(const MeshFaults& faults) {
    return {{"edges", faults.edges},
            {"borders", faults.borders},
            {"cracks", faults.cracks},
            {"overlaps", faults.overlaps}};
}

}  // namespace

std::string describe(const FlightFigures& figures) {
    std::string text = fmt::format("{} frames, {} measured\n", figures.frames, figures.measured_frames);
    text += fmt::format("triangles                   mean {:.0f}  median {:.0f}  max {}\n",
                        figures.triangles_mean, figures.triangles_median, figures.triangles_max);
    text += fmt::format("  of them slid shut         {:.0f}; left out as hidden {:.0f}\n", figures.empty_mean,
                        figures.hidden_mean);
    text += fmt::format("draws                       {:.0f} of {:.0f} blocks\n", figures.draws_mean,
                        figures.blocks_drawn_mean);
    text += fmt::format("blocks tested               {:.0f}, reused {:.2f}%\n", figures.tested_mean,
                        100.0 * figures.reused_share);
    text += fmt::format(
        "selection, CPU us           mean {:.1f}  median {:.1f}  (median {:.1f} ns a block tested)\n",
        figures.selection_us_mean, figures.selection_us_median, figures.median_ns_per_block);
    text += fmt::format("heap allocations            {} in {} frames after the first\n", figures.allocations,
                        figures.frames_allocating);
    text += fmt::format("uploads, KiB a frame        {:.1f}; frames with something not loaded {}\n",
                        figures.uploaded_kib_mean, figures.frames_wishing);
    if (figures.audit.selected > 0) text += audit_table(figures);
    return text + posts_table(figures);
}

nlohmann::json to_json(const FlightFigures& figures) {
    return {{"frames", figures.frames},
            {"measured_frames", figures.measured_frames},
            {"triangles_mean", figures.triangles_mean},
            {"triangles_median", figures.triangles_median},
            {"triangles_max", figures.triangles_max},
            {"triangles_empty_mean", figures.empty_mean},
            {"triangles_hidden_mean", figures.hidden_mean},
            {"draws_mean", figures.draws_mean},
            {"blocks_drawn_mean", figures.blocks_drawn_mean},
            {"blocks_tested_mean", figures.tested_mean},
            {"blocks_reused_share", figures.reused_share},
            {"selection_cpu_us_mean", figures.selection_us_mean},
            {"selection_cpu_us_median", figures.selection_us_median},
            {"selection_cpu_ns_per_block", figures.ns_per_block},
            {"heap_allocations", figures.allocations},
            {"frames_allocating", figures.frames_allocating},
            {"uploaded_kib_mean", figures.uploaded_kib_mean},
            {"frames_wishing", figures.frames_wishing},
            {"posts", to_json(figures.posts)},
            {"worst_frame_p999_px", figures.worst_frame_p999_px},
            {"pops", to_json(figures.pops)},
            {"mesh", to_json(figures.faults)},
            {"audit", to_json(figures.audit)}};
}

nlohmann::json to_json(const FrameMeasure& frame) {
    nlohmann::json json{{"frame", frame.frame},
                        {"triangles", frame.triangles},
                        {"triangles_hidden", frame.triangles_hidden},
                        {"draws", frame.draws},
                        {"blocks_tested", frame.blocks_tested},
                        {"blocks_reused", frame.blocks_reused},
                        {"blocks_chosen", frame.blocks_chosen},
                        {"selection_cpu_us", frame.work.cpu_ns * 1e-3},
                        {"heap_allocations", frame.work.allocations},
                        {"uploaded_bytes", frame.work.uploaded_bytes}};
    if (!frame.measured) return json;
    json["triangles_empty"] = frame.empty_triangles;
    json["posts"] = to_json(frame.posts);
    json["pops"] = to_json(frame.pops);
    json["mesh"] = to_json(frame.faults);
    return json;
}

}  // namespace eyepoint::tools
