#include "ig/pacing/still_picture.hpp"

namespace eyepoint::ig {

bool StillPicture::holds(const View& view, const std::optional<Show>& show) const {
    return settled_ && view_ == view && show_ == show;
}

void StillPicture::drawn(const View& view, const std::optional<Show>& show,
                         const FrameStatistics& statistics) {
    settled_ = view_.has_value() && statistics.loads_pending == 0 && statistics.blocks_uploaded == 0 &&
               statistics.tau_px == tau_px_;
    view_ = view;
    show_ = show;
    tau_px_ = statistics.tau_px;
}

}  // namespace eyepoint::ig
