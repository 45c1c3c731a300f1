#include "tests/picture/silhouette.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace eyepoint::testing {

namespace {

constexpr double kFromShare = 0.1, kToShare = 0.75;

/// The place, between two pixel centres, where coverage begins along a row (steep) or column towards the
/// inside; nothing where it does so not once.
std::optional<double> change_near(const Coverage& covers, bool steep, bool inside_after, int row,
                                  double expected) {
    const int first = static_cast<int>(std::floor(expected)) - kEdgeSearchPx;
    const auto covered = [&](int across) { return steep ? covers(across, row) : covers(row, across); };
    std::optional<double> change;
    for (int across = first; across < first + 2 * kEdgeSearchPx; ++across) {
        if (covered(across) == inside_after || covered(across + 1) != inside_after) continue;
        if (change) return std::nullopt;
        change = across + 1.0;
    }
    return change;
}

ImageLine least_squares(bool steep, const std::vector<glm::dvec2>& points) {
    glm::dvec2 mean{0.0};
    for (const glm::dvec2& point : points) mean += point / static_cast<double>(points.size());
    double along2 = 0.0, product = 0.0;
    for (const glm::dvec2& point : points) {
        along2 += (point.x - mean.x) * (point.x - mean.x);
        product += (point.x - mean.x) * (point.y - mean.y);
    }
    const double slope = product / along2;
    return {steep, mean.y - slope * mean.x, slope};
}

}  // namespace

std::optional<ImageLine> fit_edge(const Coverage& covers, const glm::dvec2& from, const glm::dvec2& to,
                                  const glm::dvec2& inside) {
    const bool steep = std::abs(to.y - from.y) >= std::abs(to.x - from.x);
    const glm::dvec2 start = from + kFromShare * (to - from), end = from + kToShare * (to - from);
    const double along_start = steep ? start.y : start.x, along_end = steep ? end.y : end.x;
    const double across_start = steep ? start.x : start.y, across_end = steep ? end.x : end.y;
    const double slope = (across_end - across_start) / (along_end - along_start);
    const bool inside_after = steep ? inside.x > across_start + slope * (inside.y - along_start)
                                    : inside.y > across_start + slope * (inside.x - along_start);
    const int first = static_cast<int>(std::ceil(std::min(along_start, along_end)));
    const int last = static_cast<int>(std::floor(std::max(along_start, along_end)));
    std::vector<glm::dvec2> changes;  // x: along, y: across
    for (int row = first; row < last; ++row) {
        const double along = row + 0.5;
        const auto change =
            change_near(covers, steep, inside_after, row, across_start + slope * (along - along_start));
        if (change) changes.push_back({along, *change});
    }
    if (static_cast<int>(changes.size()) < std::max(kLeastEdgeRows, (last - first) * 9 / 10))
        return std::nullopt;
    return least_squares(steep, changes);
}

std::optional<glm::dvec2> crossing(const ImageLine& a, const ImageLine& b) {
    // Each line as p x + q y = r.
    const auto coefficients = [](const ImageLine& line) {
        return line.steep ? glm::dvec2{1.0, -line.slope} : glm::dvec2{-line.slope, 1.0};
    };
    const glm::dvec2 p = coefficients(a), q = coefficients(b);
    const double determinant = p.x * q.y - p.y * q.x;
    if (std::abs(determinant) < 1e-9) return std::nullopt;
    return glm::dvec2{(a.at_zero * q.y - p.y * b.at_zero) / determinant,
                      (p.x * b.at_zero - a.at_zero * q.x) / determinant};
}

}  // namespace eyepoint::testing
