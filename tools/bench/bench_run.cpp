#include "tools/bench/bench_run.hpp"

#include <chrono>
#include <functional>
#include <memory>

#include <fmt/format.h>
#include <xxhash.h>

#include "ig/distribution.hpp"
#include "ig/egl_context.hpp"
#include "ig/frame_buffer.hpp"
#include "ig/gpu_fence.hpp"
#include "ig/output/picture_folder.hpp"
#include "ig/process_usage.hpp"
#include "terrain/database/database.hpp"
#include "tools/bench/regression/gl_census.hpp"

namespace eyepoint::tools {

namespace {

double monotonic_ms() {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

struct Outputs {
    ig::Picture picture;  ///< reused
    std::optional<ig::PictureFolder> pictures;
    std::optional<ig::FrameRecord> record;
    std::unique_ptr<ig::Trace> trace;
    ig::FrameTracks tracks;
};

tl::expected<Outputs, std::string> open_outputs(const BenchOptions& options) {
    Outputs outputs;
    if (options.pictures) {
        auto folder = ig::PictureFolder::open(*options.pictures);
        if (!folder) return tl::unexpected(folder.error());
        outputs.pictures = std::move(*folder);
    }
    if (options.record) {
        auto record = ig::FrameRecord::create(*options.record);
        if (!record) return tl::unexpected(record.error());
        outputs.record = std::move(*record);
    }
    if (options.trace) {
        auto trace = ig::Trace::create(*options.trace);
        if (!trace) return tl::unexpected(trace.error());
        outputs.trace = std::move(*trace);
        outputs.tracks = ig::make_frame_tracks(*outputs.trace, options.scene.loader_threads);
    }
    return outputs;
}

/// Draws frames and looks at each from all sides.
class FrameBench {
  public:
    FrameBench(const BenchOptions& options, const ig::FrameTracks& tracks, ig::Scene& scene,
               const ig::FrameBuffer& frame_buffer)
        : options_(options), tracks_(tracks), scene_(scene), frame_buffer_(frame_buffer) {}

    [[nodiscard]] BenchFrame draw(const ig::FlightEye& eye, std::uint64_t number) {
        BenchFrame frame;
        ig::FrameEntry& entry = frame.entry;
        entry.frame = number;
        entry.host_frame = eye.host_frame;
        entry.time_s = eye.time_s;
        entry.eye = eye.eyepoint.place;
        frame_buffer_.bind();
        draw_timed(eye.eyepoint.view, frame);
        if (options_.still_every > 0 && (number - 1) % options_.still_every == 0)
            frame.still_cpu_ms = still_cpu_ms(eye.eyepoint.view);
        return frame;
    }

  private:
    void draw_timed(const ig::View& view, BenchFrame& frame) {
        ig::FrameEntry& entry = frame.entry;
        const std::uint64_t allocations = options_.allocations != nullptr ? options_.allocations() : 0;
        const GlCensus::Count before = census_.count();
        const double cpu_ms = ig::process_cpu_ms(), thread_ms = ig::thread_cpu_ms(), wall_ms = monotonic_ms();
        entry.drawn = scene_.draw(view);
        const double asked_ms = monotonic_ms();
        const GlCensus::Count after = census_.count();
        finish_picture(entry.drawn.first_draw_ns);
        entry.frame_ms = monotonic_ms() - wall_ms;
        entry.cpu_ms = ig::process_cpu_ms() - cpu_ms;
        entry.frame_thread_cpu_ms = ig::thread_cpu_ms() - thread_ms;
        frame.allocations = options_.allocations != nullptr ? options_.allocations() - allocations : 0;
        frame.outside_gl_ms = asked_ms - wall_ms - (after.in_gl_ms - before.in_gl_ms);
        frame.gl_calls = after.calls - before.calls;
        frame.new_state_pairs = after.programs + after.state_pairs - before.programs - before.state_pairs;
    }

    void finish_picture(std::int64_t first_draw_ns) const {
        const ig::Span span(tracks_.frame, "wait for the GPU");
        (void)ig::wait_for_gpu();
        if (tracks_.gpu.on()) tracks_.gpu.add({"picture", first_draw_ns, ig::steady_now_ns(), {}});
    }

    /// The frame that draw() left, as a static mesh: once to have it on the card, then timed.
    [[nodiscard]] double still_cpu_ms(const ig::View& view) {
        scene_.keep_still(view);
        frame_buffer_.bind();
        scene_.draw_still(view);
        (void)ig::wait_for_gpu();
        const double cpu_ms = ig::process_cpu_ms();
        scene_.draw_still(view);
        (void)ig::wait_for_gpu();
        return ig::process_cpu_ms() - cpu_ms;
    }

    const BenchOptions& options_;
    const ig::FrameTracks& tracks_;
    ig::Scene& scene_;
    const ig::FrameBuffer& frame_buffer_;
    GlCensus census_;
};

std::uint64_t hash_of(ig::Picture& picture) {
    for (std::size_t i = 3; i < picture.rgba.size(); i += ig::Picture::kBytesPerPixel) picture.rgba[i] = 255;
    return XXH3_64bits(picture.rgba.data(), picture.rgba.size());
}

tl::expected<void, std::string> put_out(Outputs& outputs, const BenchOptions& options,
                                        const ig::FrameBuffer& frame_buffer, BenchFrame& frame) {
    if (outputs.record) {
        const ig::Span span(outputs.tracks.frame, "record");
        if (auto added = outputs.record->add(ig::to_json_line(frame.entry)); !added) return added;
    }
    const bool kept = outputs.pictures && (frame.entry.frame - 1) % options.picture_every == 0;
    if (!kept && !options.hash_pictures) return {};
    const ig::Span span(outputs.tracks.frame, "output");
    frame_buffer.read(outputs.picture);
    if (options.hash_pictures) frame.picture_hash = hash_of(outputs.picture);
    if (kept) return outputs.pictures->write(outputs.picture, frame.entry.frame);
    return {};
}

void load_all(ig::Scene& scene, const ig::FlightEye& eye, const ig::FrameTracks& tracks) {
    const ig::Span span(tracks.frame, "loading all, not timed");
    scene.load_all(eye.eyepoint.view);
}

tl::expected<std::unique_ptr<ig::Scene>, std::string> make_scene(
    const BenchOptions& options, const ig::FrameTracks& tracks,
    std::shared_ptr<const terrain::Database> database) {
    ig::SceneOptions scene = options.scene;
    scene.tracks = tracks;
    if (options.method) return ig::Scene::create(std::move(database), scene, options.method());
    return ig::Scene::create(std::move(database), scene);
}

}  // namespace

tl::expected<BenchResult, std::string> run_bench(const BenchOptions& options,
                                                 const std::vector<ig::FlightEye>& eyes) {
    auto outputs = open_outputs(options);
    if (!outputs) return tl::unexpected(outputs.error());
    auto database = terrain::Database::open(options.terrain);
    if (!database) return tl::unexpected(database.error());
    auto shared = std::make_shared<const terrain::Database>(std::move(*database));
    auto context = ig::EglContext::create(false);
    if (!context) return tl::unexpected(context.error());
    auto frame_buffer = ig::FrameBuffer::create(options.size);
    if (!frame_buffer) return tl::unexpected(frame_buffer.error());
    const std::uint64_t bare_bytes = ig::resident_bytes();
    auto scene = make_scene(options, outputs->tracks, shared);
    if (!scene) return tl::unexpected(scene.error());

    if (outputs->record) {
        const ig::RecordHeader header{"bench", context->identity(),     options.size,
                                      0.0,     shared->manifest().name, options.scene.lod_method};
        if (auto added = outputs->record->add(ig::to_json_line(header)); !added)
            return tl::unexpected(added.error());
    }
    frame_buffer->bind();
    (*scene)->load_all(eyes.front().eyepoint.view);
    (*scene)->warm_up(eyes.front().eyepoint.view);
    (void)ig::wait_for_gpu();
    BenchResult result{context->identity(), {}, shared->manifest().name, {}, 0.0, bare_bytes, 0, {}};
    result.frames.reserve(eyes.size());
    FrameBench bench{options, outputs->tracks, **scene, *frame_buffer};
    for (const ig::FlightEye& eye : eyes) {
        const ig::Span span(outputs->tracks.frame, "frame", {"frame", result.frames.size() + 1});
        (*scene)->set_time(eye.time_s);
        if (options.complete) load_all(**scene, eye, outputs->tracks);
        result.frames.push_back(bench.draw(eye, result.frames.size() + 1));
        result.wall_s += result.frames.back().entry.frame_ms * 1e-3;
        if (auto put = put_out(*outputs, options, *frame_buffer, result.frames.back()); !put) {
            return tl::unexpected(put.error());
        }
    }
    if (outputs->trace) {
        if (auto finished = outputs->trace->finish(); !finished) return tl::unexpected(finished.error());
    }
    result.shading = (*scene)->shading();
    result.peak_resident_bytes = ig::peak_resident_bytes();
    result.readback = time_readback(*frame_buffer);
    return result;
}

std::string describe(const BenchResult& result) {
    const auto row = [&](const char* name, const std::function<double(const BenchFrame&)>& value) {
        ig::Distribution distribution;
        double sum = 0.0;
        for (const BenchFrame& frame : result.frames) {
            distribution.add(value(frame));
            sum += value(frame);
        }
        return fmt::format("{:<26}{:>12.3f}{:>12.3f}{:>12.3f}{:>12.3f}{:>12.3f}\n", name,
                           sum / static_cast<double>(result.frames.size()), distribution.percentile(0.5),
                           distribution.percentile(0.95), distribution.percentile(0.99),
                           distribution.maximum());
    };
    double cpu_ms = 0.0, selection_ms = 0.0;
    for (const BenchFrame& frame : result.frames) {
        cpu_ms += frame.entry.cpu_ms;
        selection_ms += frame.entry.drawn.selection_cpu_ms;
    }
    std::string text = fmt::format("OpenGL: {} ({})\n", result.gl.renderer, result.gl.version);
    text += fmt::format(
        "{} frames in {:.1f} s of drawing: {:.1f} frames a second; peak memory {:.0f} MiB\n\n",
        result.frames.size(), result.wall_s, static_cast<double>(result.frames.size()) / result.wall_s,
        static_cast<double>(result.peak_resident_bytes) / 1048576.0);
    text += fmt::format("{:<26}{:>12}{:>12}{:>12}{:>12}{:>12}\n", "a frame", "mean", "median", "p95", "p99",
                        "max");
    text += row("frame, wall ms", [](const auto& frame) { return frame.entry.frame_ms; });
    text += row("frame, process CPU ms", [](const auto& frame) { return frame.entry.cpu_ms; });
    text +=
        row("LOD selection, CPU ms", [](const auto& frame) { return frame.entry.drawn.selection_cpu_ms; });
    text += row("frame thread outside GL, ms", [](const auto& frame) { return frame.outside_gl_ms; });
    text += row("allocations", [](const auto& frame) { return static_cast<double>(frame.allocations); });
    text +=
        row("triangles", [](const auto& frame) { return static_cast<double>(frame.entry.drawn.triangles); });
    text += row("draws", [](const auto& frame) { return static_cast<double>(frame.entry.drawn.draws); });
    text += row("blocks tested",
                [](const auto& frame) { return static_cast<double>(frame.entry.drawn.blocks_tested); });
    text += row("uploaded KiB", [](const auto& frame) {
        return static_cast<double>(frame.entry.drawn.bytes_uploaded) / 1024.0;
    });
    text += fmt::format("\nreading a frame back takes {:.3f} ms, copying as many bytes {:.3f} ms\n",
                        result.readback.read_ms, result.readback.copy_ms);
    text +=
        fmt::format("LOD selection takes {:.2f}% of the frames' CPU time\n", 100.0 * selection_ms / cpu_ms);
    return text;
}

}  // namespace eyepoint::tools
