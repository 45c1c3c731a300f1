/// The frame loop: one channel's life from the first deadline to the last.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

#include "config/settings.hpp"
#include "ig/control/frame_control.hpp"
#include "ig/eyepoint.hpp"
#include "ig/frame_buffer.hpp"
#include "ig/frame_clock.hpp"
#include "ig/frame_record.hpp"
#include "ig/heard_host.hpp"
#include "ig/hud/hud.hpp"
#include "ig/output/output.hpp"
#include "ig/pacing/pacer.hpp"
#include "ig/pacing/still_picture.hpp"
#include "ig/run_summary.hpp"
#include "ig/scene.hpp"
#include "ig/trace/frame_tracks.hpp"
#include "net/host_link.hpp"

namespace eyepoint::ig {

/// Draws frames until one of these: stop is asked for, `frames` are drawn, the host has been silent for
/// end_after_silence_s since its last valid packet, the window is closed, or an output fails.
///
/// Until the host has placed the vehicle nothing is drawn, shown, recorded or counted; only Start Of Frame is
/// sent. The first eye's terrain is then loaded whole before the first frame, so that no picture shows less
/// than there is; deadlines passed in that time are not missed ones. From then on every turn that the Pacer
/// calls due draws the newest eye, also when the host pauses; but with frame.draw "on_change" not what the
/// last frame already shows. Each eye is moved on to the time its frame is seen at: in fixed pacing one
/// period after its deadline (or a usual frame's time, where that is longer), else a usual frame's time from
/// now. Thread use: the thread of the GL context.
class FrameLoop {
  public:
    /// What the loop works with; nothing is owned, all outlive it.
    struct Parts {
        Scene& scene;
        net::HostLink& host;
        Output& output;
        FrameRecord* record = nullptr;  ///< may be null
        Hud* hud = nullptr;             ///< null: none, whatever settings and output say
        Clock& clock;
        const terrain::Geoid* geoid = nullptr;
        terrain::SurfaceHeight* surface = nullptr;
        std::optional<ControlTarget> control;  ///< none: the tolerance stands
        FrameTracks tracks;                    ///< by default nothing is traced
        std::function<bool()> stop_requested;
        std::function<void(std::string_view)> warn;
    };

    FrameLoop(const config::Settings& settings, Parts parts, FrameBuffer frame_buffer);

    /// On failure: one sentence; the summary holds what was drawn until then.
    [[nodiscard]] tl::expected<void, std::string> run();

    [[nodiscard]] const RunSummary& summary() const { return summary_; }
    /// From the first frame's deadline until now or the end, seconds; 0 before it.
    [[nodiscard]] double seconds() const;

  private:
    struct FrameStart;

    [[nodiscard]] bool ended();
    [[nodiscard]] FrameTick wait();
    [[nodiscard]] tl::expected<void, std::string> turn(const FrameTick& tick);
    [[nodiscard]] unsigned hear(const FrameTick& tick);
    [[nodiscard]] std::optional<TimedEye> eye_of(const FrameTick& tick) const;
    [[nodiscard]] bool hud_wanted() const;
    void draw_hud();
    void tell_hud(const FrameEntry& entry);
    [[nodiscard]] bool finish_picture(std::int64_t first_draw_ns) const;
    [[nodiscard]] tl::expected<void, std::string> show(const FrameMoment& moment);
    [[nodiscard]] bool host_silent();
    void answer_host();
    void notice_stop(std::int64_t now_ns);
    [[nodiscard]] bool waits_for_fresh_eye(std::int64_t now_ns) const;
    [[nodiscard]] tl::expected<void, std::string> follow_output_size();
    [[nodiscard]] std::int64_t seen_at_ns(const FrameTick& tick) const;
    [[nodiscard]] bool shown_already(const View& view);
    void begin_flight(const View& first);
    [[nodiscard]] tl::expected<void, std::string> fly(const TimedEye& eye, const FrameTick& tick,
                                                      const FrameStart& start);
    [[nodiscard]] tl::expected<FrameEntry, std::string> draw(const TimedEye& eye, const FrameStart& start);
    void control(FrameEntry& entry);
    [[nodiscard]] tl::expected<void, std::string> record(const FrameEntry& entry);

    config::Settings settings_;
    EyepointReading reading_;
    Parts parts_;
    FrameBuffer frame_buffer_;
    Pacer pacer_;
    HeardHost host_;
    RunSummary summary_;
    StillPicture still_picture_;
    bool hud_drawn_ = false;  ///< in the last frame
    std::optional<ToleranceController> controller_;
    std::optional<ControlLog> control_log_;
    std::uint32_t ticks_ = 0;
    std::int64_t begin_ns_ = 0;
    std::int64_t last_turn_ns_ = 0;
    std::int64_t fresh_until_ns_ = 0;  ///< after a stop: until then only a fresh eye is drawn
    std::uint64_t missed_ = 0;         ///< since the frame before
    double usual_frame_ns_ = 0.0;      ///< from its turn until it was shown, a running mean
    std::int64_t drawn_arrival_ns_ = 0;
    bool flying_ = false;
    std::optional<std::int64_t> first_deadline_ns_;
};

}  // namespace eyepoint::ig
