#include "ig/frame_loop.hpp"

#include <utility>

#include "ig/gpu_fence.hpp"
#include "ig/process_usage.hpp"

namespace eyepoint::ig {

namespace {

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
      frame_clock_(parts_.clock, settings.frame.rate_hz),
      begin_ns_(parts_.clock.now_ns()) {}

tl::expected<void, std::string> FrameLoop::run() {
    while (!ended()) {
        const FrameTick tick = frame_clock_.wait();
        const FrameStart start{parts_.clock.now_ns(), process_cpu_ms(), thread_cpu_ms()};
        hear_host();
        answer_host();
        if (auto sized = follow_output_size(); !sized) return sized;
        const auto eyepoint = newest_eye();
        if (!eyepoint) continue;
        if (!flying_) {
            begin_flight(*eyepoint);
            continue;
        }
        if (auto flown = fly(*eyepoint, tick, start); !flown) return flown;
    }
    return parts_.output.finish();
}

bool FrameLoop::ended() {
    const std::uint64_t wanted = settings_.frame.frames;
    return parts_.stop_requested() || (wanted > 0 && summary_.frames() >= wanted) || host_silent() ||
           !parts_.output.keep_going();
}

bool FrameLoop::host_silent() {
    const double limit_s = settings_.host.end_after_silence_s;
    return limit_s > 0.0 && parts_.host.state() != nullptr &&
           seconds_between(last_heard_ns_, parts_.clock.now_ns()) > limit_s;
}

void FrameLoop::hear_host() {
    const net::PollResult heard = parts_.host.poll();
    const std::int64_t now_ns = parts_.clock.now_ns();
    if (heard.applied > 0) last_heard_ns_ = now_ns;
    const std::string newest = heard.details.empty() ? std::string{} : heard.details.back();
    if (const auto line = drop_log_.line(parts_.host.counters(), newest, now_ns)) parts_.warn(*line);
}

void FrameLoop::answer_host() {
    constexpr double kTicksPerSecond = 1e5;  // CIGI's timestamp counts 10 microseconds
    const net::HostState* state = parts_.host.state();
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

std::optional<Eyepoint> FrameLoop::newest_eye() const {
    const net::HostState* state = parts_.host.state();
    return state == nullptr ? std::nullopt : eyepoint_of(*state, reading_, frame_buffer_.size());
}

void FrameLoop::begin_flight(const Eyepoint& first) {
    frame_buffer_.bind();
    parts_.scene.load_all(first.view);
    parts_.scene.draw(first.view);
    (void)wait_for_gpu();
    frame_clock_.restart();
    flying_ = true;
}

tl::expected<void, std::string> FrameLoop::fly(const Eyepoint& eyepoint, const FrameTick& tick,
                                               const FrameStart& start) {
    if (!first_deadline_ns_) first_deadline_ns_ = tick.deadline_ns;
    auto entry = draw(eyepoint, start);
    if (!entry) return tl::unexpected(entry.error());
    entry->time_s = seconds_between(*first_deadline_ns_, tick.deadline_ns);
    entry->missed_deadlines = tick.missed;

    const std::int64_t whole_ns = parts_.clock.now_ns();
    if (auto shown = parts_.output.show(frame_buffer_, {entry->frame, tick.slot, entry->time_s}); !shown)
        return shown;
    entry->output_ms = ms_between(whole_ns, parts_.clock.now_ns());
    return record(*entry);
}

tl::expected<FrameEntry, std::string> FrameLoop::draw(const Eyepoint& eyepoint, const FrameStart& start) {
    const net::HostState& state = *parts_.host.state();
    FrameEntry entry;
    entry.frame = summary_.frames() + 1;
    entry.host_frame = state.host_frame;
    entry.sim_time_s = state.host_time_s;
    entry.eye = eyepoint.place;
    entry.new_packet =
        std::exchange(drawn_arrival_ns_, state.arrival.realtime_ns) != state.arrival.realtime_ns;

    if (const auto show = parts_.output.wanted_show()) parts_.scene.set_show(*show);
    frame_buffer_.bind();
    const std::int64_t draw_ns = parts_.clock.now_ns();
    entry.drawn = parts_.scene.draw(eyepoint.view);
    for (const std::string& fault : parts_.scene.take_faults())
        parts_.warn(fault + "; an ancestor is drawn there");
    if (!wait_for_gpu()) {
        return tl::unexpected(
            std::string("the graphics driver did not finish a frame within 10 seconds; restart, and "
                        "update the driver if it happens again"));
    }
    const std::int64_t whole_ns = parts_.clock.now_ns();
    entry.gpu_ms = ms_between(draw_ns, whole_ns) - entry.drawn.selection_cpu_ms;
    entry.arrival_to_complete_ms = ms_between(state.arrival.realtime_ns, parts_.clock.realtime_ns());
    entry.frame_ms = ms_between(start.now_ns, whole_ns);
    entry.cpu_ms = process_cpu_ms() - start.process_cpu_ms;
    entry.frame_thread_cpu_ms = thread_cpu_ms() - start.thread_cpu_ms;
    return entry;
}

tl::expected<void, std::string> FrameLoop::record(const FrameEntry& entry) {
    summary_.add(entry);
    if (parts_.record == nullptr) return {};
    return parts_.record->add(to_json_line(entry));
}

double FrameLoop::seconds() const {
    return first_deadline_ns_ ? seconds_between(*first_deadline_ns_, parts_.clock.now_ns()) : 0.0;
}

}  // namespace eyepoint::ig
