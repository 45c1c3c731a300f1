/// The kinds of output there are.
#pragma once

#include "ig/output/output.hpp"
#include "ig/output/picture_folder.hpp"
#include "ig/output/video_pipe.hpp"
#include "ig/window.hpp"

namespace eyepoint::ig {

/// Draws for the frame record alone.
class NoOutput final : public Output {
  public:
    tl::expected<void, std::string> show(const FrameBuffer&, const FrameMoment&) override { return {}; }
};

/// Numbered pictures in a folder: every frame, or the first frame of every period.
class PictureOutput final : public Output {
  public:
    /// every_s: 0 for every frame.
    PictureOutput(PictureFolder folder, double every_s) : folder_(std::move(folder)), every_s_(every_s) {}
    tl::expected<void, std::string> show(const FrameBuffer& frame, const FrameMoment& moment) override;

  private:
    PictureFolder folder_;
    double every_s_;
    double next_s_ = 0.0;
    Picture picture_;
};

/// A video file in which every frame is seen as long as it was on the screen: a late frame leaves the one
/// before it standing.
class VideoOutput final : public Output {
  public:
    explicit VideoOutput(VideoPipe pipe) : pipe_(std::move(pipe)) {}
    tl::expected<void, std::string> show(const FrameBuffer& frame, const FrameMoment& moment) override;
    tl::expected<void, std::string> finish() override { return pipe_.finish(); }

  private:
    VideoPipe pipe_;
    Picture picture_;
    std::optional<std::uint64_t> last_slot_;
};

/// The window; frames follow its size.
class WindowOutput final : public Output {
  public:
    /// The window is not owned and outlives the output.
    explicit WindowOutput(Window& window) : window_(window) {}
    tl::expected<void, std::string> show(const FrameBuffer& frame, const FrameMoment& moment) override;
    std::optional<PictureSize> wanted_size() const override { return window_.size(); }
    std::optional<Show> wanted_show() const override { return window_.wanted_show(); }
    bool hud_switched() const override { return window_.hud_switched(); }
    bool lost_picture() override { return window_.take_damage(); }
    bool keep_going() override;

  private:
    Window& window_;
};

}  // namespace eyepoint::ig
