/// Cracks in a sentinel picture: pixels with no terrain where the terrain must be.
///
/// The drawn terrain is a height field over the Earth: every ray from the Earth's centre meets it once (but
/// for slopes within 0.2 degrees of vertical, as heights stand on the ellipsoid and not on a sphere), and it
/// closes around the Earth. Take a vertical plane through the eye, which is above the ground: if a ray in it
/// hits terrain at P, every lower ray of the same azimuth passes below P or meets terrain before, so it hits
/// terrain too. Nothing overhangs. So along an azimuth there is terrain up to the skyline and none above it,
/// and three statements hold for a picture without cracks, each checked at every pixel:
///   1. A ray that hits an ellipsoid below all terrain hits terrain: a pixel there is never sentinel.
///   2. Going up from a sentinel pixel, along the picture's own direction of up at that place, no solid
///      terrain follows. Solid is a pixel all whose eight neighbours are terrain: a sentinel pixel's upward
///      line is sky, so terrain on all sides of it would need a gap between peaks less than two pixels wide.
///      A step of kUpwardStepsPx is enough, as a hole of any size has an upper end.
///   3. Sentinel pixels that touch one another lead to the picture's border: the sky is never an island.
/// Not found: a slit open to the sky that runs straight up the picture, above the horizon of the lowest
/// ground; it looks like a gap between two peaks.
#pragma once

#include <string>
#include <vector>

#include "ig/picture.hpp"
#include "ig/view.hpp"

namespace eyepoint::testing {

inline constexpr int kUpwardStepsPx = 4;

struct CrackReport {
    int terrain_pixels = 0;
    int below_horizon = 0;  ///< sentinel pixels that break statement 1
    int under_terrain = 0;  ///< statement 2
    int islands = 0;        ///< statement 3
    int first_x = -1, first_y = -1;

    [[nodiscard]] int total() const { return below_horizon + under_terrain + islands; }
};

/// lowest_height_m: ellipsoidal height that no terrain is below.
[[nodiscard]] CrackReport find_cracks(const ig::Picture& picture, const ig::View& view,
                                      double lowest_height_m);

/// A hole punched for proving that it is found.
void punch(ig::Picture& picture, int x, int y, int width, int height);

}  // namespace eyepoint::testing
