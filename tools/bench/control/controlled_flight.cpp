#include "tools/bench/control/controlled_flight.hpp"

#include <chrono>
#include <utility>

#include "ig/gpu_fence.hpp"
#include "ig/process_usage.hpp"
#include "terrain/database/database.hpp"

namespace eyepoint::tools {

namespace {

/// Drawn before the first frame that counts: first uses, the choice of shading.
constexpr int kWarmUpFrames = 3;

double monotonic_ms() {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

double now_ms(CostClock clock) { return clock == CostClock::Cpu ? ig::process_cpu_ms() : monotonic_ms(); }

ControlledFrame draw_frame(ig::Scene& scene, const ig::View& view, CostClock clock) {
    const double start_ms = now_ms(clock);
    const ig::FrameStatistics drawn = scene.draw(view);
    (void)ig::wait_for_gpu();
    return {.cost_ms = now_ms(clock) - start_ms,
            .tau_px = drawn.tau_px,
            .triangles = drawn.triangles,
            .bytes_uploaded = drawn.bytes_uploaded};
}

}  // namespace

tl::expected<ControlStage, std::string> ControlStage::create(const std::filesystem::path& terrain,
                                                             const ig::SceneOptions& options) {
    auto database = terrain::Database::open(terrain);
    if (!database) return tl::unexpected(database.error());
    auto context = ig::EglContext::create(false);
    if (!context) return tl::unexpected(context.error());
    auto scene = ig::Scene::create(std::make_shared<const terrain::Database>(*std::move(database)), options);
    if (!scene) return tl::unexpected(scene.error());
    return ControlStage{*std::move(context), *std::move(scene)};
}

ControlStage::ControlStage(ig::EglContext context, std::unique_ptr<ig::Scene> scene)
    : context_(std::move(context)), scene_(std::move(scene)) {}

tl::expected<void, std::string> ControlStage::fit(const ig::View& view) {
    const ig::PictureSize size{view.width_px, view.height_px};
    if (frame_buffer_ && frame_buffer_->size() == size) return {};
    auto frame_buffer = ig::FrameBuffer::create(size);
    if (!frame_buffer) return tl::unexpected(frame_buffer.error());
    frame_buffer_ = *std::move(frame_buffer);
    return {};
}

tl::expected<std::vector<ControlledFrame>, std::string> ControlStage::fly(std::span<const ig::FlightEye> eyes,
                                                                          const FlightSetting& setting) {
    std::optional<ig::ToleranceController> controller;
    if (setting.control) controller.emplace(*setting.control);
    double tau_px = controller ? controller->tau_px() : setting.tau_px;
    std::vector<ControlledFrame> frames;
    for (const ig::FlightEye& eye : eyes) {
        const ig::View& view = eye.eyepoint.view;
        if (auto fitted = fit(view); !fitted) return tl::unexpected(fitted.error());
        scene_->set_tau(tau_px);
        scene_->set_time(eye.time_s);
        scene_->load_all(view);
        frame_buffer_->bind();
        for (int i = 0; frames.empty() && i < kWarmUpFrames; ++i)
            (void)draw_frame(*scene_, view, setting.clock);
        ControlledFrame frame = draw_frame(*scene_, view, setting.clock);
        if (controller) {
            const ig::ControlDecision decision =
                controller->next({.tau_px = tau_px,
                                  .triangles = static_cast<double>(frame.triangles),
                                  .cost_ms = frame.cost_ms});
            frame.state = decision.state;
            frame.unreachable_share = decision.unreachable_share;
            tau_px = decision.tau_px;
        }
        frames.push_back(frame);
    }
    return frames;
}

}  // namespace eyepoint::tools
