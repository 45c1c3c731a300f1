#include "terrain/lod/terrain_horizon.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace eyepoint::terrain {

namespace {

/// No picture is made that reaches farther to a side: tan 65 degrees.
constexpr double kWidestU = 2.1;
/// No picture is made of a view with a corner less far forward, as a share of its distance.
constexpr double kLeastForward = 0.2;
/// Of a column: rounding of where a line ends in it.
constexpr float kRounding = 1e-3F;

/// Directions of the view volume's corners, in order around it, unit length.
std::array<glm::dvec3, 4> corner_rays(const std::array<glm::dvec3, 4>& sides) {
    const auto& [left, right, bottom, top] = sides;
    std::array<glm::dvec3, 4> rays{glm::cross(left, bottom), glm::cross(bottom, right),
                                   glm::cross(right, top), glm::cross(top, left)};
    const glm::dvec3 inward = left + right + bottom + top;
    for (glm::dvec3& ray : rays) ray = glm::normalize(glm::dot(ray, inward) < 0.0 ? -ray : ray);
    return rays;
}

/// std::floor is a call on processors that need not have the instruction.
int floored(float value) {
    const int whole = static_cast<int>(value);
    return whole - (static_cast<float>(whole) > value ? 1 : 0);
}

}  // namespace

std::optional<UprightView> upright_view(const LodView& view) {
    UprightView upright;
    upright.eye = view.eye;
    upright.radius_m = glm::length(view.eye);
    const glm::dvec3 up = view.eye / upright.radius_m;
    const auto rays = corner_rays(view.sides);
    const glm::dvec3 middle = rays[0] + rays[1] + rays[2] + rays[3];
    const glm::dvec3 level = middle - up * glm::dot(middle, up);
    if (!(glm::length(level) > kLeastForward)) return std::nullopt;
    const glm::dvec3 forward = glm::normalize(level);
    upright.axes = {glm::cross(forward, up), forward, up};
    double least_u = std::numeric_limits<double>::max(), greatest_u = std::numeric_limits<double>::lowest();
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const glm::dvec3 ray = glm::transpose(upright.axes) * rays[i];
        if (ray.y < kLeastForward) return std::nullopt;
        upright.corners[i] = {ray.x / ray.y, ray.z / ray.y};
        least_u = std::min(least_u, upright.corners[i].x);
        greatest_u = std::max(greatest_u, upright.corners[i].x);
    }
    if (std::max(-least_u, greatest_u) > kWidestU) return std::nullopt;
    upright.least_u = static_cast<float>(least_u);
    upright.greatest_u = static_cast<float>(greatest_u);
    return upright;
}

/// The part of a column that a line has crossed so far.
struct TerrainHorizon::Carry {
    int column = -1;  ///< crossed from its left border on; -1: none
    float v = 0.0F;
    float ahead_m = 0.0F;
};

void TerrainHorizon::reset(const UprightView& view, float margin) {
    least_u_ = view.least_u;
    columns_per_u_ = static_cast<float>(kColumns) / (view.greatest_u - view.least_u);
    margin_ = margin;
    ahead_m_.fill(-1.0F);
    v_.fill(std::numeric_limits<float>::max());
    // The lowest of the view's outline in every column.
    for (std::size_t i = 0; i < view.corners.size(); ++i) {
        glm::dvec2 from = view.corners[i], to = view.corners[(i + 1) % view.corners.size()];
        if (from.x > to.x) std::swap(from, to);
        const auto first =
            std::clamp(static_cast<int>(column_at(static_cast<float>(from.x))) - 1, 0, kColumns - 1);
        const auto last =
            std::clamp(static_cast<int>(column_at(static_cast<float>(to.x))) + 1, 0, kColumns - 1);
        const auto v_at = [&](int border) {
            const double u = double{least_u_} + border / double{columns_per_u_};
            const double share = (u - from.x) / std::max(to.x - from.x, 1e-12);
            return static_cast<float>(from.y + (to.y - from.y) * std::clamp(share, 0.0, 1.0));
        };
        for (int column = first; column <= last; ++column) {
            float& v = v_[static_cast<std::size_t>(column)];
            v = std::min({v, v_at(column), v_at(column + 1)});
        }
    }
}

TerrainHorizon::Sight TerrainHorizon::sight(float least_u, float greatest_u, float v, float ahead_m) const {
    const float left = column_at(least_u) - kRounding, right = column_at(greatest_u) + kRounding;
    if (right < 0.0F || left >= static_cast<float>(kColumns)) return Sight::Outside;
    const int first = left > 0.0F ? static_cast<int>(left) : 0;
    const int last = right < static_cast<float>(kColumns) ? static_cast<int>(right) : kColumns - 1;
    const float least_v = v + margin_;
    float nearest_m = -1.0F;
    for (auto column = static_cast<std::size_t>(first); column <= static_cast<std::size_t>(last); ++column) {
        if (!(least_v < v_[column]) || ahead_m < ahead_m_[column]) return Sight::Visible;
        nearest_m = std::max(nearest_m, ahead_m_[column]);
    }
    return nearest_m < 0.0F ? Sight::Outside : Sight::Hidden;
}

void TerrainHorizon::raise(std::span<const UprightPoint> line) {
    if (line.size() < 2) return;
    const bool rightward = line.back().u > line.front().u;
    Carry carry;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const auto& from = rightward ? line[i] : line[line.size() - 1 - i];
        const auto& to = rightward ? line[i + 1] : line[line.size() - 2 - i];
        raise_segment(from, to, carry);
    }
}

void TerrainHorizon::raise_segment(const UprightPoint& from, const UprightPoint& to, Carry& carry) {
    const float begin = column_at(from.u), end = column_at(to.u);
    if (!(from.ahead_m > 0.0F && to.ahead_m > 0.0F && end > begin) || end <= 0.0F ||
        begin >= static_cast<float>(kColumns)) {
        carry.column = -1;
        return;
    }
    const float rise = (to.v - from.v) / (end - begin), ahead_m = std::max(from.ahead_m, to.ahead_m);
    const auto v_at = [&](float at) { return from.v + (at - begin) * rise; };
    const int first_border = -floored(-begin), last_border = floored(end);
    if (last_border < first_border) {  // inside one column
        if (carry.column != last_border) return;
        carry.v = std::min(carry.v, to.v);
        carry.ahead_m = std::max(carry.ahead_m, ahead_m);
        return;
    }
    const float v = v_at(static_cast<float>(first_border));
    if (carry.column >= 0 && carry.column < first_border && carry.column < kColumns)
        raise_columns(carry.column, carry.column + 1, std::min({carry.v, from.v, v}), 0.0F,
                      std::max(carry.ahead_m, ahead_m));
    const int first = std::max(first_border, 0), last = std::min(last_border, kColumns);
    raise_columns(first, last, v + std::min(rise, 0.0F) + rise * static_cast<float>(first - first_border),
                  rise, ahead_m);
    carry = {last_border, std::min(v_at(static_cast<float>(last_border)), to.v), ahead_m};
}

/// Columns first to last - 1 to v, v + rise, ...; in a plain loop over arrays, of which the compiler makes
/// vectors.
void TerrainHorizon::raise_columns(int first, int last, float v, float rise, float ahead_m) {
    float* const column_v = v_.data() + first;
    float* const column_ahead_m = ahead_m_.data() + first;
    for (int i = 0; i < last - first; ++i) {
        const float new_v = v + rise * static_cast<float>(i);
        const float old_v = column_v[i], old_ahead_m = column_ahead_m[i];
        column_v[i] = new_v > old_v ? new_v : old_v;
        column_ahead_m[i] = new_v > old_v ? ahead_m : old_ahead_m;
    }
}

}  // namespace eyepoint::terrain
