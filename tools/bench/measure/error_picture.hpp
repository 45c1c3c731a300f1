/// Post error as colour, as the eye sees it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/mat3x3.hpp>

#include "tools/bench/measure/post_error.hpp"

namespace eyepoint::tools {

/// The camera of a picture, as ig::View has it: columns of axes are right, up and backward.
struct PictureCamera {
    glm::dmat3 axes{1.0};
    double left = -1.0, right = 1.0, bottom = -1.0, top = 1.0;
    int width_px = 0, height_px = 0;
};

/// Rows from the top, RGB.
struct ErrorPicture {
    int width_px = 0, height_px = 0;
    std::vector<std::uint8_t> rgb;
};

/// Draws the full-resolution surface, every cell of posts two triangles with depth, coloured by the error of
/// a corner as a share of the tolerance: dark blue 0, through green at a half and yellow at 1, to red at 2
/// and above; magenta: a corner that nothing covers. Where there is no surface, grey. At the foot a bar from
/// 0 to 2 tolerances with a mark at each half.
[[nodiscard]] ErrorPicture paint_error(const MeasuredPosts& posts, const PostView& view,
                                       const PictureCamera& camera);

/// Colour of an error, `share` tolerances.
[[nodiscard]] std::array<std::uint8_t, 3> error_colour(double share);

}  // namespace eyepoint::tools
