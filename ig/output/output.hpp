/// Where finished frames go.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <tl/expected.hpp>

#include "ig/frame_buffer.hpp"
#include "ig/picture.hpp"
#include "ig/shading.hpp"

namespace eyepoint::ig {

/// Which frame it is, and when.
struct FrameMoment {
    std::uint64_t frame = 0;  ///< drawn frames, counted from 1
    std::uint64_t slot = 0;   ///< of the frame clock
    double time_s = 0.0;      ///< the slot's deadline, since the first frame's
};

/// Takes each frame once it is whole. Thread use: the thread of the GL context.
class Output {
  public:
    virtual ~Output() = default;

    /// On failure the run ends: one sentence with what could not be written.
    [[nodiscard]] virtual tl::expected<void, std::string> show(const FrameBuffer& frame,
                                                               const FrameMoment& moment) = 0;
    /// Completes what was written. Without it, nothing that looks complete is left.
    [[nodiscard]] virtual tl::expected<void, std::string> finish() { return {}; }
    /// The size that frames are to have from now on, if the output has a say in it.
    [[nodiscard]] virtual std::optional<PictureSize> wanted_size() const { return std::nullopt; }
    /// What frames are to show from now on, if the output has a say in it.
    [[nodiscard]] virtual std::optional<Show> wanted_show() const { return std::nullopt; }
    /// True where the user has switched the HUD to the other of what the settings say.
    [[nodiscard]] virtual bool hud_switched() const { return false; }
    /// True where what was shown has been lost since the last call (a window uncovered) and wants a new
    /// frame.
    [[nodiscard]] virtual bool lost_picture() { return false; }
    /// Once a frame, also while there is nothing to show: false when the user asks for the end.
    [[nodiscard]] virtual bool keep_going() { return true; }
};

}  // namespace eyepoint::ig
