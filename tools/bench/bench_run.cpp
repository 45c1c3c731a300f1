#include "tools/bench/bench_run.hpp"

#include <chrono>
#include <functional>
#include <memory>

#include <fmt/format.h>

#include "ig/distribution.hpp"
#include "ig/egl_context.hpp"
#include "ig/frame_buffer.hpp"
#include "ig/gpu_fence.hpp"
#include "ig/output/picture_folder.hpp"
#include "ig/process_usage.hpp"
#include "terrain/database/database.hpp"

namespace eyepoint::tools {

namespace {

double monotonic_ms() {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

struct Outputs {
    std::optional<ig::PictureFolder> pictures;
    std::optional<ig::FrameRecord> record;
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
    return outputs;
}

ig::FrameEntry draw_frame(ig::Scene& scene, const ig::FlightEye& eye, std::uint64_t number) {
    ig::FrameEntry entry;
    entry.frame = number;
    entry.host_frame = eye.host_frame;
    entry.time_s = eye.time_s;
    entry.eye = eye.eyepoint.place;
    const double cpu_ms = ig::process_cpu_ms(), thread_ms = ig::thread_cpu_ms(), wall_ms = monotonic_ms();
    entry.drawn = scene.draw(eye.eyepoint.view);
    (void)ig::wait_for_gpu();
    entry.frame_ms = monotonic_ms() - wall_ms;
    entry.cpu_ms = ig::process_cpu_ms() - cpu_ms;
    entry.frame_thread_cpu_ms = ig::thread_cpu_ms() - thread_ms;
    return entry;
}

tl::expected<void, std::string> put_out(Outputs& outputs, const BenchOptions& options,
                                        const ig::FrameBuffer& frame_buffer, const ig::FrameEntry& entry) {
    if (outputs.record) {
        if (auto added = outputs.record->add(ig::to_json_line(entry)); !added) return added;
    }
    if (outputs.pictures && (entry.frame - 1) % options.picture_every == 0) {
        ig::Picture picture;
        frame_buffer.read(picture);
        return outputs.pictures->write(picture, entry.frame);
    }
    return {};
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
    auto scene = ig::Scene::create(shared, options.scene);
    if (!scene) return tl::unexpected(scene.error());

    BenchResult result{context->identity().renderer, context->identity().version, {}, 0.0, 0};
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
    for (const ig::FlightEye& eye : eyes) {
        if (options.complete) (*scene)->load_all(eye.eyepoint.view);
        frame_buffer->bind();
        result.frames.push_back(draw_frame(**scene, eye, result.frames.size() + 1));
        result.wall_s += result.frames.back().frame_ms * 1e-3;
        if (auto put = put_out(*outputs, options, *frame_buffer, result.frames.back()); !put) {
            return tl::unexpected(put.error());
        }
    }
    result.peak_resident_bytes = ig::peak_resident_bytes();
    return result;
}

std::string describe(const BenchResult& result) {
    const auto row = [&](const char* name, const std::function<double(const ig::FrameEntry&)>& value) {
        ig::Distribution distribution;
        double sum = 0.0;
        for (const ig::FrameEntry& frame : result.frames) {
            distribution.add(value(frame));
            sum += value(frame);
        }
        return fmt::format("{:<26}{:>12.3f}{:>12.3f}{:>12.3f}{:>12.3f}{:>12.3f}\n", name,
                           sum / static_cast<double>(result.frames.size()), distribution.percentile(0.5),
                           distribution.percentile(0.95), distribution.percentile(0.99),
                           distribution.maximum());
    };
    double cpu_ms = 0.0, selection_ms = 0.0;
    for (const ig::FrameEntry& frame : result.frames) {
        cpu_ms += frame.cpu_ms;
        selection_ms += frame.drawn.selection_cpu_ms;
    }
    std::string text = fmt::format("OpenGL: {} ({})\n", result.gl_renderer, result.gl_version);
    text += fmt::format(
        "{} frames in {:.1f} s of drawing: {:.1f} frames a second; peak memory {:.0f} MiB\n\n",
        result.frames.size(), result.wall_s, static_cast<double>(result.frames.size()) / result.wall_s,
        static_cast<double>(result.peak_resident_bytes) / 1048576.0);
    text += fmt::format("{:<26}{:>12}{:>12}{:>12}{:>12}{:>12}\n", "a frame", "mean", "median", "p95", "p99",
                        "max");
    text += row("frame, wall ms", [](const auto& frame) { return frame.frame_ms; });
    text += row("frame, process CPU ms", [](const auto& frame) { return frame.cpu_ms; });
    text += row("LOD selection, CPU ms", [](const auto& frame) { return frame.drawn.selection_cpu_ms; });
    text += row("triangles", [](const auto& frame) { return static_cast<double>(frame.drawn.triangles); });
    text += row("draws", [](const auto& frame) { return static_cast<double>(frame.drawn.draws); });
    text += row("blocks tested",
                [](const auto& frame) { return static_cast<double>(frame.drawn.blocks_tested); });
    text += row("uploaded KiB",
                [](const auto& frame) { return static_cast<double>(frame.drawn.bytes_uploaded) / 1024.0; });
    text +=
        fmt::format("\nLOD selection takes {:.2f}% of the frames' CPU time\n", 100.0 * selection_ms / cpu_ms);
    return text;
}

}  // namespace eyepoint::tools
