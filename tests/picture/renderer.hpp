/// The product's own way from a host's words to a picture, for one test.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "ig/egl_context.hpp"
#include "ig/frame_buffer.hpp"
#include "ig/scene.hpp"
#include "terrain/database/database.hpp"
#include "tests/picture/reference_camera.hpp"

namespace eyepoint::testing {

/// What stays where no terrain is drawn in sentinel mode: a colour that terrain never has.
[[nodiscard]] bool is_sentinel(const ig::Picture& picture, int x, int y);

/// A picture and, from its depth buffer, the distance along the view axis at every pixel's centre, metres;
/// 0 where nothing is drawn. Rows from the top.
struct DrawnPicture {
    ig::Picture picture;
    std::vector<double> distance_m;
    ig::FrameStatistics statistics;

    [[nodiscard]] double distance_at(int x, int y) const {
        return distance_m[static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.size.width_px) +
                          static_cast<std::size_t>(x)];
    }
};

/// The view that the product makes of a pose told by a host, in ellipsoidal heights.
[[nodiscard]] ig::View view_of(const CameraPose& pose);

/// A context, a frame buffer and a scene over one database. Throws std::runtime_error with the sentence.
class Renderer {
  public:
    Renderer(std::shared_ptr<const terrain::Database> database, ig::PictureSize size,
             const ig::SceneOptions& options);

    /// Everything that the view asks for is loaded first.
    [[nodiscard]] DrawnPicture draw_complete(const CameraPose& pose);
    [[nodiscard]] ig::Picture draw_complete(const ig::View& view);
    /// Draws with what has been loaded by now.
    ig::FrameStatistics draw_now(const ig::View& view, ig::Picture& picture);
    [[nodiscard]] DrawnPicture draw_distances(const ig::View& view);

    /// What draw_floor leaves, of the view that was drawn last.
    [[nodiscard]] DrawnPicture draw_floor(const ig::View& view);
    /// What draw_still leaves of the view that was drawn last.
    [[nodiscard]] DrawnPicture draw_still(const ig::View& view);
    /// What `draw` makes of the last picture, whose frame buffer is bound for it.
    [[nodiscard]] ig::Picture draw_over(const std::function<void()>& draw);
    [[nodiscard]] ig::Shading shading() const { return scene_->shading(); }

    [[nodiscard]] const ig::GlIdentity& gl() const { return context_.identity(); }

  private:
    ig::EglContext context_;
    ig::FrameBuffer frame_buffer_;
    std::unique_ptr<ig::Scene> scene_;
};

/// Throws std::runtime_error.
void write_png(const ig::Picture& picture, const std::string& file);

/// For looking at what a test draws: NAME.png in the folder that EYEPOINT_LOOK names, where it is set.
void keep_for_looking(const ig::Picture& picture, const std::string& name);

}  // namespace eyepoint::testing
