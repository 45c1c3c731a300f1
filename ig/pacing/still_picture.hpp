/// Whether the next frame would show what the last one shows.
#pragma once

#include <optional>

#include "ig/frame_statistics.hpp"
#include "ig/shading.hpp"
#include "ig/view.hpp"

namespace eyepoint::ig {

/// Everything that a picture is made from, as of the last frame: the view (with its size), what is shown, and
/// whether terrain was still coming or the tolerance moving. A plain value.
class StillPicture {
  public:
    /// False before the first frame.
    [[nodiscard]] bool holds(const View& view, const std::optional<Show>& show) const;
    void drawn(const View& view, const std::optional<Show>& show, const FrameStatistics& statistics);

  private:
    std::optional<View> view_;
    std::optional<Show> show_;
    double tau_px_ = 0.0;
    bool settled_ = false;
};

}  // namespace eyepoint::ig
