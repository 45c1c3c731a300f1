#include "ig/output/outputs.hpp"

namespace eyepoint::ig {

tl::expected<void, std::string> PictureOutput::show(const FrameBuffer& frame, const FrameMoment& moment) {
    if (moment.time_s < next_s_) return {};
    while (every_s_ > 0.0 && next_s_ <= moment.time_s) next_s_ += every_s_;
    frame.read(picture_);
    return folder_.write(picture_, moment.frame);
}

tl::expected<void, std::string> VideoOutput::show(const FrameBuffer& frame, const FrameMoment& moment) {
    // Frames that are not paced by the grid may share a slot; a video has one picture in each.
    if (last_slot_ == moment.slot) return {};
    last_slot_ = moment.slot;
    frame.read(picture_);
    return pipe_.write(picture_, moment.slot);
}

tl::expected<void, std::string> WindowOutput::show(const FrameBuffer& frame, const FrameMoment&) {
    frame.blit_to_window(window_.size());
    window_.swap();
    return {};
}

bool WindowOutput::keep_going() {
    window_.handle_events();
    return !window_.close_requested();
}

}  // namespace eyepoint::ig
