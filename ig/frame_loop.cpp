#include "ig/frame_loop.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "ig/gpu_fence.hpp"
#include "ig/process_usage.hpp"
#include "net/nanoseconds.hpp"

namespace eyepoint::ig {

namespace {

/// Between two turns: longer than a slow frame takes.
constexpr double kStoppedS = 1.0, kStoppedPeriods = 2.5;
/// How old an eye may be, and how long it is waited for, after a stop.
constexpr std::int64_t kFreshNs = 100'000'000;

double ms_between(std::int64_t from_ns, std::int64_t to_ns) {
    return static_cast<double>(to_ns - from_ns) * 1e-6;
}

double seconds_between(std::int64_t from_ns, std::int64_t to_ns) {
    return static_cast<double>(to_ns - from_ns) * 1e-9;
}

}  // namespace

/// What is read when a frame begins.
struct FrameLoop::FrameStart {
    std::int64_t now_ns = 0;
    double process_cpu_ms = 0.0;
    double thread_cpu_ms = 0.0;
};

FrameLoop::FrameLoop(const config::Settings& settings, Parts parts, FrameBuffer frame_buffer)
    : settings_(settings),
      reading_{settings.view, settings.host.altitude_datum, parts.geoid, parts.surface},
      parts_(std::move(parts)),
      frame_buffer_(std::move(frame_buffer)),
      pacer_(settings.frame.pacing, settings.frame.rate_hz, parts_.clock,
             [&clock = parts_.clock, &host = parts_.host](std::int64_t until_ns) {
                 const std::int64_t left_ns = std::max<std::int64_t>(until_ns - clock.now_ns(), 0);
                 return host.wait_for_datagram(std::chrono::nanoseconds(left_ns));
             }),
      host_(settings, parts_.host, parts_.clock, parts_.warn),
      begin_ns_(parts_.clock.now_ns()),
      last_turn_ns_(begin_ns_) {
    if (!parts_.control) return;
    controller_.emplace(*parts_.control);
    control_log_.emplace(*parts_.control);
    parts_.scene.set_tau(controller_->tau_px());
}

tl::expected<void, std::string> FrameLoop::run() {
    while (!ended()) {
        if (auto turned = turn(wait()); !turned) return turned;
    }
    return parts_.output.finish();
}

FrameTick FrameLoop::wait() {
    const Span span(parts_.tracks.frame, "wait for the turn");
    return pacer_.wait();
}

/// One turn of the pacer: a frame, where one is due and there is something to draw.
tl::expected<void, std::string> FrameLoop::turn(const FrameTick& tick) {
    Span span(parts_.tracks.frame, "turn without a frame");
    const FrameStart start{parts_.clock.now_ns(), process_cpu_ms(), thread_cpu_ms()};
    const unsigned applied = hear(tick);
    notice_stop(start.now_ns);
    if (tick.on_grid) answer_host();
    if (auto sized = follow_output_size(); !sized) return sized;
    if (!pacer_.due(applied) || waits_for_fresh_eye(start.now_ns)) return {};
    const auto eye = eye_of(tick);
    if (!eye) return {};
    if (!flying_) {
        begin_flight(eye->eyepoint.view);
        return {};
    }
    if (shown_already(eye->eyepoint.view)) return {};
    span.call("frame", {"frame", summary_.frames() + 1});
    if (auto flown = fly(*eye, tick, start); !flown) return flown;
    pacer_.drew();
    return {};
}

unsigned FrameLoop::hear(const FrameTick& tick) {
    const Span span(parts_.tracks.frame, "host");
    const unsigned applied = host_.hear();
    missed_ += tick.missed;
    if (settings_.frame.pacing == config::Pacing::Host && applied > 1) missed_ += applied - 1;
    return applied;
}

std::optional<TimedEye> FrameLoop::eye_of(const FrameTick& tick) const {
    const Span span(parts_.tracks.frame, "motion");
    return host_.eye_at(seen_at_ns(tick), reading_, frame_buffer_.size());
}

bool FrameLoop::ended() {
    const std::uint64_t wanted = settings_.frame.frames;
    return parts_.stop_requested() || (wanted > 0 && summary_.frames() >= wanted) || host_silent() ||
           !parts_.output.keep_going();
}

/// What came while this process was held up, by the first view's loading or a stop, is heard first.
bool FrameLoop::host_silent() {
    const double limit_s = settings_.host.end_after_silence_s;
    if (limit_s <= 0.0 || host_.silent_s() <= limit_s) return false;
    (void)host_.hear();
    return host_.silent_s() > limit_s;
}

void FrameLoop::notice_stop(std::int64_t now_ns) {
    const double stopped_s = seconds_between(std::exchange(last_turn_ns_, now_ns), now_ns);
    if (!flying_ || stopped_s < std::max(kStoppedS, kStoppedPeriods / settings_.frame.rate_hz)) return;
    fresh_until_ns_ = now_ns + kFreshNs;
    parts_.warn(fmt::format(
        "no frame could begin for {:.1f} s (was the process stopped?); frames go on with the newest eye",
        stopped_s));
}

/// The socket's buffer keeps the oldest packets of a stop, not the newest.
bool FrameLoop::waits_for_fresh_eye(std::int64_t now_ns) const {
    return now_ns < fresh_until_ns_ && now_ns - host_.arrival_ns() > kFreshNs;
}

void FrameLoop::answer_host() {
    constexpr double kTicksPerSecond = 1e5;  // CIGI's timestamp counts 10 microseconds
    const net::HostState* state = host_.state();
    net::IgStatus status;
    status.ig_frame = ++ticks_;
    status.mode = state == nullptr ? net::IgMode::Standby : state->commanded_mode;
    status.database = state == nullptr ? std::int8_t{0} : state->requested_database;
    const double since_begin_s = seconds_between(begin_ns_, parts_.clock.now_ns());
    status.timestamp_10us =
        static_cast<std::uint32_t>(static_cast<std::uint64_t>(since_begin_s * kTicksPerSecond));
    // A host that has gone away does not end the run; it is missed by end_after_silence_s.
    (void)parts_.host.answer(status);
}

tl::expected<void, std::string> FrameLoop::follow_output_size() {
    const auto wanted = parts_.output.wanted_size();
    if (!wanted || *wanted == frame_buffer_.size()) return {};
    auto resized = FrameBuffer::create(*wanted);
    if (!resized) return tl::unexpected(resized.error());
    frame_buffer_ = *std::move(resized);
    return {};
}

std::int64_t FrameLoop::seen_at_ns(const FrameTick& tick) const {
    if (settings_.frame.pacing != config::Pacing::Fixed)
        return parts_.clock.now_ns() + std::llround(usual_frame_ns_);
    return tick.deadline_ns +
           std::llround(std::max(net::kNanosecondsPerSecond / settings_.frame.rate_hz, usual_frame_ns_));
}

bool FrameLoop::shown_already(const View& view) {
    const bool lost = parts_.output.lost_picture();
    return settings_.frame.draw == config::DrawWhen::OnChange && !lost && hud_drawn_ == hud_wanted() &&
           still_picture_.holds(view, parts_.output.wanted_show());
}

void FrameLoop::begin_flight(const View& first) {
    frame_buffer_.bind();
    parts_.scene.load_all(first);
    parts_.scene.draw(first);
    (void)wait_for_gpu();
    pacer_.restart();
    last_turn_ns_ = parts_.clock.now_ns();
    missed_ = 0;
    flying_ = true;
}

tl::expected<void, std::string> FrameLoop::fly(const TimedEye& eye, const FrameTick& tick,
                                               const FrameStart& start) {
    constexpr double kShare = 1.0 / 8.0;  // of the newest frame in the usual one
    constexpr double kMostNs = 1e6;       // so that a stop within a frame does not pass for usual
    if (!first_deadline_ns_) first_deadline_ns_ = tick.deadline_ns;
    parts_.scene.set_time(seconds_between(*first_deadline_ns_, tick.deadline_ns));
    auto entry = draw(eye, start);
    if (!entry) return tl::unexpected(entry.error());
    entry->time_s = seconds_between(*first_deadline_ns_, tick.deadline_ns);
    entry->missed_deadlines = std::exchange(missed_, 0);

    const std::int64_t whole_ns = parts_.clock.now_ns();
    if (auto shown = show({entry->frame, tick.slot, entry->time_s}); !shown) return shown;
    const std::int64_t shown_ns = parts_.clock.now_ns();
    entry->output_ms = ms_between(whole_ns, shown_ns);
    const double more_ns = static_cast<double>(shown_ns - start.now_ns) - usual_frame_ns_;
    usual_frame_ns_ += std::min(more_ns * kShare, kMostNs);
    control(*entry);
    tell_hud(*entry);
    return record(*entry);
}

/// Judges a whole frame and sets the tolerance of the next.
void FrameLoop::control(FrameEntry& entry) {
    if (!controller_) return;
    const ControlDecision decision = controller_->next(cost_of(entry));
    entry.control = name(decision.state);
    entry.unreachable_share = decision.unreachable_share;
    parts_.scene.set_tau(decision.tau_px);
    if (const auto line = control_log_->line(decision, parts_.clock.now_ns())) parts_.warn(*line);
}

tl::expected<FrameEntry, std::string> FrameLoop::draw(const TimedEye& eye, const FrameStart& start) {
    const net::HostState& state = *host_.state();
    FrameEntry entry;
    entry.frame = summary_.frames() + 1;
    entry.host_frame = state.host_frame;
    entry.sim_time_s = state.host_time_s;
    entry.eye = eye.eyepoint.place;
    entry.extrapolated_ms = eye.extrapolated_s * 1e3;
    entry.new_packet = std::exchange(drawn_arrival_ns_, eye.arrival_ns) != eye.arrival_ns;

    const auto show = parts_.output.wanted_show();
    if (show) parts_.scene.set_show(*show);
    frame_buffer_.bind();
    const std::int64_t draw_ns = parts_.clock.now_ns();
    entry.drawn = parts_.scene.draw(eye.eyepoint.view);
    draw_hud();
    still_picture_.drawn(eye.eyepoint.view, show, entry.drawn);
    for (const std::string& fault : parts_.scene.take_faults())
        parts_.warn(fault + "; an ancestor is drawn there");
    if (!finish_picture(entry.drawn.first_draw_ns)) {
        return tl::unexpected(
            std::string("the graphics driver did not finish a frame within 10 seconds; restart, and "
                        "update the driver if it happens again"));
    }
    const std::int64_t whole_ns = parts_.clock.now_ns();
    entry.gpu_ms = ms_between(draw_ns, whole_ns) - entry.drawn.selection_cpu_ms;
    entry.arrival_to_complete_ms = ms_between(eye.arrival_ns, whole_ns);
    entry.frame_ms = ms_between(start.now_ns, whole_ns);
    entry.cpu_ms = process_cpu_ms() - start.process_cpu_ms;
    entry.frame_thread_cpu_ms = thread_cpu_ms() - start.thread_cpu_ms;
    return entry;
}

bool FrameLoop::hud_wanted() const {
    return parts_.hud != nullptr &&
           (settings_.render.hud == config::Switch::On) != parts_.output.hud_switched();
}

void FrameLoop::draw_hud() {
    hud_drawn_ = hud_wanted();
    if (!hud_drawn_) return;
    const Span span(parts_.tracks.frame, "HUD");
    frame_buffer_.bind();
    parts_.hud->draw(frame_buffer_.size());
}

/// What the next frame's HUD shows.
void FrameLoop::tell_hud(const FrameEntry& entry) {
    if (parts_.hud == nullptr) return;
    parts_.hud->take({entry, settings_.frame.pacing, settings_.frame.rate_hz, host_.silent_s(),
                      hud_wanted() ? resident_bytes() : 0});
}

/// False where the graphics driver hangs.
bool FrameLoop::finish_picture(std::int64_t first_draw_ns) const {
    const Span span(parts_.tracks.frame, "wait for the GPU");
    const bool whole = wait_for_gpu();
    if (parts_.tracks.gpu.on()) parts_.tracks.gpu.add({"picture", first_draw_ns, steady_now_ns(), {}});
    return whole;
}

tl::expected<void, std::string> FrameLoop::show(const FrameMoment& moment) {
    const Span span(parts_.tracks.frame, "output");
    return parts_.output.show(frame_buffer_, moment);
}

tl::expected<void, std::string> FrameLoop::record(const FrameEntry& entry) {
    const Span span(parts_.tracks.frame, "record");
    summary_.add(entry);
    if (parts_.record == nullptr) return {};
    return parts_.record->add(to_json_line(entry));
}

double FrameLoop::seconds() const {
    return first_deadline_ns_ ? seconds_between(*first_deadline_ns_, parts_.clock.now_ns()) : 0.0;
}

}  // namespace eyepoint::ig
