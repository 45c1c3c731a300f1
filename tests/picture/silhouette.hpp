/// Where straight edges run in a picture, to a fraction of a pixel.
#pragma once

#include <functional>
#include <optional>

#include <glm/vec2.hpp>

namespace eyepoint::testing {

/// Whether the feature covers a pixel's centre.
using Coverage = std::function<bool(int x, int y)>;

/// A straight line in the picture: x = at_zero + slope * y where it is steep, else y = at_zero + slope * x.
struct ImageLine {
    bool steep = true;
    double at_zero = 0.0;
    double slope = 0.0;

    [[nodiscard]] double at(double along) const { return at_zero + slope * along; }
};

/// Pixels on either side of an expected edge in which the drawn one is looked for, and the fewest rows that
/// make a line.
inline constexpr int kEdgeSearchPx = 8;
inline constexpr int kLeastEdgeRows = 40;

/// The drawn edge along an expected segment of a feature's outline: in every row (or column, whichever
/// crosses the edge) between a tenth and three quarters of the way, the one place near the expected one where
/// coverage begins, known to half a pixel; then the least-squares line through them all. `inside`: a place
/// within the feature. Nothing when fewer than kLeastEdgeRows rows, or nine in ten, show just one such place.
[[nodiscard]] std::optional<ImageLine> fit_edge(const Coverage& covers, const glm::dvec2& from,
                                                const glm::dvec2& to, const glm::dvec2& inside);

/// Where two lines cross; nothing for parallel ones.
[[nodiscard]] std::optional<glm::dvec2> crossing(const ImageLine& a, const ImageLine& b);

}  // namespace eyepoint::testing
