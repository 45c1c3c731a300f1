#include "tests/picture/cracks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <GeographicLib/Constants.hpp>
#include <glm/geometric.hpp>

#include "tests/picture/renderer.hpp"

namespace eyepoint::testing {

namespace {

/// One byte a pixel, with what a pixel outside of the picture counts as.
class Mask {
  public:
    Mask(int width, int height, std::uint8_t outside)
        : width_(width),
          height_(height),
          outside_(outside),
          bytes_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}

    [[nodiscard]] std::uint8_t at(int x, int y) const {
        return x < 0 || y < 0 || x >= width_ || y >= height_ ? outside_ : bytes_[index(x, y)];
    }
    void set(int x, int y, std::uint8_t value) { bytes_[index(x, y)] = value; }
    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }

  private:
    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
    }
    int width_, height_;
    std::uint8_t outside_;
    std::vector<std::uint8_t> bytes_;
};

/// Rays of a view's pixels in its own axes (right, up, backward), and what is asked of them.
class PixelRays {
  public:
    PixelRays(const ig::View& view, double lowest_height_m) : view_(view) {
        using GeographicLib::Constants;
        const double a = Constants::WGS84_a() + lowest_height_m;
        const double b = Constants::WGS84_a() * (1.0 - Constants::WGS84_f()) + lowest_height_m;
        scale_ = {1.0 / a, 1.0 / a, 1.0 / b};
        eye_ = view.eye_ecef * scale_;
        up_ = glm::transpose(view.axes) * glm::normalize(view.eye_ecef);
    }

    [[nodiscard]] bool hits_lowest(int x, int y) const {
        const glm::dvec3 ray = (view_.axes * direction(x, y)) * scale_;
        const double inward = -glm::dot(ray, eye_);
        return inward > 0.0 && inward * inward > glm::dot(ray, ray) * (glm::dot(eye_, eye_) - 1.0);
    }

    /// Unit step in the picture (x right, y down) that raises the ray in its vertical plane.
    [[nodiscard]] glm::dvec2 upward(int x, int y) const {
        const glm::dvec3 ray = direction(x, y);
        return glm::normalize(glm::dvec2{up_.x + ray.x * up_.z, -(up_.y + ray.y * up_.z)});
    }

  private:
    [[nodiscard]] glm::dvec3 direction(int x, int y) const {
        return {view_.left + (view_.right - view_.left) * (x + 0.5) / view_.width_px,
                view_.top - (view_.top - view_.bottom) * (y + 0.5) / view_.height_px, -1.0};
    }
    const ig::View& view_;
    glm::dvec3 scale_, eye_, up_;
};

Mask terrain_of(const ig::Picture& picture) {
    Mask terrain(picture.size.width_px, picture.size.height_px, 0);
    for (int y = 0; y < terrain.height(); ++y)
        for (int x = 0; x < terrain.width(); ++x) terrain.set(x, y, is_sentinel(picture, x, y) ? 0 : 1);
    return terrain;
}

bool is_solid(const Mask& terrain, int x, int y) {
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
            if (terrain.at(x + dx, y + dy) == 0) return false;
    return true;
}

bool solid_follows(const Mask& terrain, int x, int y, const glm::dvec2& upward) {
    for (int step = 1; step <= kUpwardStepsPx; ++step) {
        const auto to_x = static_cast<int>(std::lround(x + step * upward.x));
        const auto to_y = static_cast<int>(std::lround(y + step * upward.y));
        if (terrain.at(to_x, to_y) != 0 && is_solid(terrain, to_x, to_y)) return true;
    }
    return false;
}

/// Sentinel pixels that no path of sentinel pixels, diagonal steps included, joins to the border.
std::vector<glm::ivec2> find_islands(const Mask& terrain) {
    Mask reached(terrain.width(), terrain.height(), 1);
    std::vector<glm::ivec2> open;
    const auto reach = [&](int x, int y) {
        if (reached.at(x, y) != 0 || terrain.at(x, y) != 0) return;
        reached.set(x, y, 1);
        open.push_back({x, y});
    };
    for (int x = 0; x < terrain.width(); ++x)
        for (const int y : {0, terrain.height() - 1}) reach(x, y);
    for (int y = 0; y < terrain.height(); ++y)
        for (const int x : {0, terrain.width() - 1}) reach(x, y);
    while (!open.empty()) {
        const glm::ivec2 at = open.back();
        open.pop_back();
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx) reach(at.x + dx, at.y + dy);
    }
    std::vector<glm::ivec2> islands;
    for (int y = 0; y < terrain.height(); ++y)
        for (int x = 0; x < terrain.width(); ++x)
            if (terrain.at(x, y) == 0 && reached.at(x, y) == 0) islands.push_back({x, y});
    return islands;
}

}  // namespace

CrackReport find_cracks(const ig::Picture& picture, const ig::View& view, double lowest_height_m) {
    const Mask terrain = terrain_of(picture);
    const PixelRays rays(view, lowest_height_m);
    CrackReport report;
    const auto found = [&report](int& count, int x, int y) {
        if (report.total() == 0) report.first_x = x, report.first_y = y;
        ++count;
    };
    for (int y = 0; y < terrain.height(); ++y) {
        for (int x = 0; x < terrain.width(); ++x) {
            if (terrain.at(x, y) != 0) {
                ++report.terrain_pixels;
            } else if (rays.hits_lowest(x, y)) {
                found(report.below_horizon, x, y);
            } else if (solid_follows(terrain, x, y, rays.upward(x, y))) {
                found(report.under_terrain, x, y);
            }
        }
    }
    for (const glm::ivec2& island : find_islands(terrain)) found(report.islands, island.x, island.y);
    return report;
}

void punch(ig::Picture& picture, int x, int y, int width, int height) {
    for (int row = y; row < y + height; ++row) {
        for (int column = x; column < x + width; ++column) {
            std::uint8_t* pixel =
                picture.rgba.data() + static_cast<std::ptrdiff_t>(row * picture.size.width_px + column) *
                                          ig::Picture::kBytesPerPixel;
            pixel[0] = 255, pixel[1] = 0, pixel[2] = 255;
        }
    }
}

}  // namespace eyepoint::testing
