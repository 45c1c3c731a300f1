/// The head-up display: how the run fares, drawn over the picture.
#pragma once

#include <memory>
#include <string>

#include <tl/expected.hpp>

#include "ig/hud/hud_lines.hpp"
#include "ig/picture.hpp"

struct ImGuiContext;

namespace eyepoint::ig {

/// Pixels from the upper left corner.
struct PictureRectangle {
    int left_px = 0, top_px = 0, width_px = 0, height_px = 0;
};

/// A box in the picture's upper left corner with graphs of the last HudHistory::kFrames frames and
/// hud_lines(). Drawn by Dear ImGui, with a context of its own that takes no input and no files. Needs the
/// OpenGL context that it was made in to be current, at its end too. Thread use: the context's thread.
class Hud {
  public:
    /// Letters get larger in whole steps, one for every 720 rows of the picture that it is made for;
    /// everything that drawing needs is made here. On failure (no libGL): one sentence with the remedy.
    [[nodiscard]] static tl::expected<Hud, std::string> create(PictureSize size);

    /// Once a frame, also where it is not drawn: the frame that is now whole.
    void take(const HudReading& reading);

    /// Draws what was taken last into the bound framebuffer, whose viewport is over all of it. Leaves the
    /// OpenGL state as it was.
    void draw(PictureSize size) const;

    /// All that draw() changes of a picture that is large enough.
    [[nodiscard]] PictureRectangle rectangle() const;

  private:
    struct Release {
        void operator()(ImGuiContext* context) const;
    };
    explicit Hud(int scale);
    void draw_graphs() const;
    void draw_lines() const;

    int scale_;
    std::unique_ptr<ImGuiContext, Release> context_;
    HudHistory history_;
    HudReading reading_;
};

}  // namespace eyepoint::ig
