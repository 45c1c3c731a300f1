#include "tools/bench/measure/flight_measure.hpp"

#include <algorithm>

#include "tools/bench/median.hpp"

namespace eyepoint::tools {

namespace {

std::uint32_t blocks_in(const terrain::Selection& selection) {
    std::uint32_t blocks = 0;
    const terrain::TileNode* last = nullptr;
    for (const terrain::BlockDraw& draw : selection.draws) {
        if (draw.node != last) ++blocks;
        last = draw.node;
    }
    return blocks;
}

class Lap {
  public:
    Lap(LodFlight& flight, FullSurface& surface, std::span<const terrain::LodView> views,
        const MeasureOptions& options)
        : flight_(flight), surface_(surface), views_(views), options_(options) {}

    tl::expected<FrameMeasure, std::string> fly(std::size_t frame, const SeePosts& see) {
        const terrain::Selection& selection = flight_.select(views_[frame]);
        FrameMeasure result;
        result.frame = frame;
        result.triangles = selection.triangles;
        result.triangles_hidden = selection.triangles_hidden;
        result.draws = static_cast<std::uint32_t>(selection.draws.size());
        result.blocks_drawn = blocks_in(selection);
        result.blocks_tested = selection.blocks_tested;
        result.blocks_reused = selection.blocks_reused;
        result.blocks_chosen = selection.blocks_chosen;
        result.work = flight_.work();
        const bool measured = frame % options_.every == 0;
        const bool before_measured =
            options_.pops && (frame + 1) % options_.every == 0 && frame + 1 < views_.size();
        if (!measured && !before_measured) return result;

        const DrawnMesh mesh = drawn_mesh(selection, flight_.method(), views_[frame], options_.morph);
        result.measured = measured;
        if (const auto* selective = dynamic_cast<const terrain::SelectiveLod*>(&flight_.method()))
            result.audit = selective->audit(views_[frame]);
        result.empty_triangles = mesh.empty_triangles;
        if (measured && options_.faults) result.faults = find_mesh_faults(mesh);
        if (!options_.posts) return result;
        const PostView view{views_[frame], options_.far_m};
        auto posts = measure_posts(surface_, mesh, view);
        if (!posts) return tl::unexpected(posts.error());
        if (measured) result.posts = post_figures(*posts);
        if (measured && before_ && before_frame_ + 1 == frame) result.pops = pops(*before_, *posts);
        if (measured && see) {
            if (auto seen = see(frame, view, *posts); !seen) return tl::unexpected(seen.error());
        }
        before_ = std::move(*posts);
        before_frame_ = frame;
        return result;
    }

  private:
    LodFlight& flight_;
    FullSurface& surface_;
    std::span<const terrain::LodView> views_;
    const MeasureOptions& options_;
    std::optional<MeasuredPosts> before_;
    std::size_t before_frame_ = 0;
};

}  // namespace

tl::expected<std::vector<FrameMeasure>, std::string> measure_flight(LodFlight& flight, FullSurface& surface,
                                                                    std::span<const terrain::LodView> views,
                                                                    const MeasureOptions& options,
                                                                    const SeePosts& see) {
    for (const terrain::LodView& view : views) (void)flight.settle(view);
    if (!views.empty()) (void)flight.settle(views.front());
    flight.forget_uploads();
    Lap lap(flight, surface, views, options);
    std::vector<FrameMeasure> frames;
    frames.reserve(views.size());
    for (std::size_t frame = 0; frame < views.size(); ++frame) {
        auto measured = lap.fly(frame, see);
        if (!measured) return tl::unexpected(measured.error());
        frames.push_back(std::move(*measured));
    }
    return frames;
}

FlightFigures summarise(std::span<const FrameMeasure> frames) {
    FlightFigures sum;
    sum.frames = frames.size();
    if (frames.empty()) return sum;
    std::vector<double> triangles, selection_us, block_ns;
    double reused = 0.0, in_view = 0.0, selection_ns = 0.0;
    for (const FrameMeasure& frame : frames) {
        triangles.push_back(static_cast<double>(frame.triangles));
        selection_us.push_back(frame.work.cpu_ns * 1e-3);
        selection_ns += frame.work.cpu_ns;
        if (frame.blocks_tested > 0) block_ns.push_back(frame.work.cpu_ns / frame.blocks_tested);
        sum.triangles_mean += static_cast<double>(frame.triangles);
        sum.triangles_max = std::max(sum.triangles_max, frame.triangles);
        sum.draws_mean += frame.draws;
        sum.blocks_drawn_mean += frame.blocks_drawn;
        sum.hidden_mean += static_cast<double>(frame.triangles_hidden);
        sum.tested_mean += frame.blocks_tested;
        reused += frame.blocks_reused;
        in_view += frame.blocks_reused + frame.blocks_chosen;
        if (&frame != &frames.front()) {
            sum.allocations += frame.work.allocations;
            sum.frames_allocating += frame.work.allocations > 0 ? 1 : 0;
        }
        sum.uploaded_kib_mean += static_cast<double>(frame.work.uploaded_bytes) / 1024.0;
        sum.frames_wishing += frame.work.blocks_wished > 0 ? 1 : 0;
        if (!frame.measured) continue;
        ++sum.measured_frames;
        sum.empty_mean += static_cast<double>(frame.empty_triangles);
        sum.posts.merge(frame.posts);
        sum.worst_frame_p999_px = std::max(sum.worst_frame_p999_px, frame.posts.error.percentile(0.999));
        sum.pops.merge(frame.pops);
        sum.faults.edges += frame.faults.edges;
        sum.faults.borders += frame.faults.borders;
        sum.faults.cracks += frame.faults.cracks;
        sum.faults.overlaps += frame.faults.overlaps;
        sum.audit.merge(frame.audit);
    }
    const auto count = static_cast<double>(frames.size());
    sum.reused_share = in_view > 0.0 ? reused / in_view : 0.0;
    sum.ns_per_block = sum.tested_mean > 0.0 ? selection_ns / sum.tested_mean : 0.0;
    for (double* mean : {&sum.triangles_mean, &sum.draws_mean, &sum.blocks_drawn_mean, &sum.hidden_mean,
                         &sum.tested_mean, &sum.uploaded_kib_mean})
        *mean /= count;
    if (sum.measured_frames > 0) sum.empty_mean /= static_cast<double>(sum.measured_frames);
    sum.selection_us_mean = selection_ns * 1e-3 / count;
    sum.triangles_median = median(std::move(triangles));
    sum.median_ns_per_block = median(std::move(block_ns));
    sum.selection_us_median = median(std::move(selection_us));
    return sum;
}

}  // namespace eyepoint::tools
