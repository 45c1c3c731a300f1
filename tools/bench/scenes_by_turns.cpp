#include "tools/bench/scenes_by_turns.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

#include "ig/egl_context.hpp"
#include "ig/frame_buffer.hpp"
#include "ig/gpu_fence.hpp"
#include "ig/process_usage.hpp"
#include "terrain/database/database.hpp"

namespace eyepoint::tools {

namespace {

constexpr double kNotYet = std::numeric_limits<double>::infinity();

template <typename Draw>
double cpu_ms_of(const Draw& draw) {
    const double start_ms = ig::process_cpu_ms();
    draw();
    (void)ig::wait_for_gpu();
    return ig::process_cpu_ms() - start_ms;
}

std::uint64_t pixels_that_differ(const ig::Picture& a, const ig::Picture& b) {
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < a.rgba.size(); i += ig::Picture::kBytesPerPixel)
        count += std::memcmp(&a.rgba[i], &b.rgba[i], ig::Picture::kBytesPerPixel) != 0 ? 1 : 0;
    return count;
}

/// The scenes, at one eye after the other.
class Turns {
  public:
    Turns(std::vector<std::unique_ptr<ig::Scene>> scenes, ig::FrameBuffer frame_buffer, TurnOptions options)
        : scenes_(std::move(scenes)), frame_buffer_(std::move(frame_buffer)), options_(options) {}

    void warm_up(const ig::View& view) {
        for (const auto& scene : scenes_) {
            frame_buffer_.bind();
            scene->load_all(view);
            scene->warm_up(view);
            (void)ig::wait_for_gpu();
        }
    }

    /// By scene.
    [[nodiscard]] std::vector<TurnFrame> draw(const ig::FlightEye& eye) {
        const ig::View& view = eye.eyepoint.view;
        for (const auto& scene : scenes_) scene->set_time(eye.time_s);
        std::vector<TurnFrame> frames(scenes_.size());
        for (std::size_t i = 0; i < scenes_.size(); ++i) frames[i] = prepare(i, view);
        for (std::size_t turn = 0; turn < options_.turns; ++turn) {
            for (std::size_t place = 0; place < scenes_.size(); ++place) {
                const std::size_t i = (place + turn) % scenes_.size();
                draw_timed(i, view, frames[i]);
            }
        }
        return frames;
    }

  private:
    void draw_timed(std::size_t i, const ig::View& view, TurnFrame& frame) {
        frame_buffer_.bind();
        double selection_ms = 0.0;
        const double cpu_ms = cpu_ms_of([&] { selection_ms = scenes_[i]->draw(view).selection_cpu_ms; });
        frame.cpu_ms = std::min(frame.cpu_ms, cpu_ms);
        frame.selection_ms = std::min(frame.selection_ms, selection_ms);
        if (i == 0 && options_.floor) {
            const double floor_ms = cpu_ms_of([&] { scenes_[i]->draw_floor(view); });
            frame.floor_cpu_ms = std::min(frame.floor_cpu_ms.value_or(floor_ms), floor_ms);
        }
    }

    /// Loads, uploads, and draws once; counts and picture are of this.
    TurnFrame prepare(std::size_t i, const ig::View& view) {
        scenes_[i]->load_all(view);
        frame_buffer_.bind();
        const ig::FrameStatistics drawn = scenes_[i]->draw(view);
        TurnFrame frame{.cpu_ms = kNotYet,
                        .selection_ms = kNotYet,
                        .triangles = drawn.triangles,
                        .triangles_hidden = drawn.triangles_hidden};
        if (options_.pictures) {
            frame_buffer_.read(i == 0 ? first_picture_ : picture_);
            if (i > 0) frame.pixels_changed = pixels_that_differ(first_picture_, picture_);
        }
        if (i == 0 && options_.floor) scenes_[i]->draw_floor(view);
        (void)ig::wait_for_gpu();
        return frame;
    }

    std::vector<std::unique_ptr<ig::Scene>> scenes_;
    ig::FrameBuffer frame_buffer_;
    TurnOptions options_;
    ig::Picture first_picture_, picture_;
};

}  // namespace

tl::expected<std::vector<std::vector<TurnFrame>>, std::string> draw_by_turns(
    const std::shared_ptr<const terrain::Database>& database, std::span<const ig::SceneOptions> scenes,
    std::span<const ig::FlightEye> eyes, ig::PictureSize size, const TurnOptions& options) {
    auto context = ig::EglContext::create(false);
    if (!context) return tl::unexpected(context.error());
    auto frame_buffer = ig::FrameBuffer::create(size);
    if (!frame_buffer) return tl::unexpected(frame_buffer.error());
    std::vector<std::unique_ptr<ig::Scene>> made;
    for (const ig::SceneOptions& scene : scenes) {
        auto one = ig::Scene::create(database, scene);
        if (!one) return tl::unexpected(one.error());
        made.push_back(*std::move(one));
    }
    std::vector<std::vector<TurnFrame>> frames(scenes.size());
    Turns turns(std::move(made), *std::move(frame_buffer), options);
    if (!eyes.empty()) turns.warm_up(eyes.front().eyepoint.view);
    for (const ig::FlightEye& eye : eyes) {
        const std::vector<TurnFrame> drawn = turns.draw(eye);
        for (std::size_t i = 0; i < drawn.size(); ++i) frames[i].push_back(drawn[i]);
    }
    return frames;
}

}  // namespace eyepoint::tools
