#include "tools/bench/measure/error_picture.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace eyepoint::tools {

namespace {

using Colour = std::array<std::uint8_t, 3>;
constexpr Colour kUncovered{255, 0, 255}, kNothing{90, 90, 90}, kMark{255, 255, 255};

/// A post on the picture.
struct Spot {
    double x = 0.0, y = 0.0;  ///< pixels from the left and the top
    double nearness = 0.0;    ///< one over the distance along the view axis; 0: behind the eye
};

class Canvas {
  public:
    Canvas(const PostView& view, const PictureCamera& camera) : view_(view), camera_(camera) {
        picture_.width_px = camera.width_px;
        picture_.height_px = camera.height_px;
        const std::size_t pixels =
            static_cast<std::size_t>(camera.width_px) * static_cast<std::size_t>(camera.height_px);
        nearest_.assign(pixels, 0.0F);
        for (std::size_t i = 0; i < pixels; ++i)
            picture_.rgb.insert(picture_.rgb.end(), kNothing.begin(), kNothing.end());
    }

    void add(const MeasuredTile& tile) {
        const PostTile& posts = *tile.tile;
        const glm::dvec3 eye = posts.in_frame(glm::dvec3{0.0}, view_.lod.eye);
        const glm::dmat3 to_camera = glm::transpose(camera_.axes) * posts.axes;
        std::array<Spot, PostTile::kSide * PostTile::kSide> spots;
        for (std::size_t i = 0; i < spots.size(); ++i) {
            const PostTile::Place& place = posts.posts[i];
            spots[i] = project(to_camera * (glm::dvec3{place.x, place.y, place.z} - eye));
        }
        for (std::size_t row = 0; row + 1 < PostTile::kSide; ++row) {
            for (std::size_t column = 0; column + 1 < PostTile::kSide; ++column) {
                const std::size_t sw = row * PostTile::kSide + column, nw = sw + PostTile::kSide;
                if (std::isnan(tile.px_per_m[sw])) continue;
                const Colour colour = colour_of(tile, sw);
                fill({spots[sw], spots[sw + 1], spots[nw + 1]}, colour);
                fill({spots[sw], spots[nw + 1], spots[nw]}, colour);
            }
        }
    }

    [[nodiscard]] ErrorPicture take() {
        legend();
        return std::move(picture_);
    }

  private:
    [[nodiscard]] Spot project(const glm::dvec3& at) const {
        if (at.z > -view_.lod.near_m) return {};
        const double nearness = -1.0 / at.z;
        return {(at.x * nearness - camera_.left) / (camera_.right - camera_.left) * camera_.width_px,
                (camera_.top - at.y * nearness) / (camera_.top - camera_.bottom) * camera_.height_px,
                nearness};
    }

    [[nodiscard]] Colour colour_of(const MeasuredTile& tile, std::size_t post) const {
        if (std::isnan(tile.above_m[post])) return kUncovered;
        return error_colour(std::abs(tile.above_m[post]) * tile.px_per_m[post] / view_.lod.tau_px);
    }

    /// A pixel belongs to a triangle that its middle is in; a triangle smaller than a pixel marks the one it
    /// starts in.
    void fill(const std::array<Spot, 3>& corner, const Colour& colour) {
        const auto& [a, b, c] = corner;
        if (a.nearness <= 0.0 || b.nearness <= 0.0 || c.nearness <= 0.0) return;
        put(static_cast<int>(std::floor(a.x)), static_cast<int>(std::floor(a.y)), a.nearness, colour);
        const auto clip = [](double value, int most) {
            return static_cast<int>(std::clamp(value, 0.0, most * 1.0));
        };
        const int left = clip(std::ceil(std::min({a.x, b.x, c.x}) - 0.5), camera_.width_px),
                  right = clip(std::floor(std::max({a.x, b.x, c.x}) - 0.5) + 1.0, camera_.width_px),
                  top = clip(std::ceil(std::min({a.y, b.y, c.y}) - 0.5), camera_.height_px),
                  bottom = clip(std::floor(std::max({a.y, b.y, c.y}) - 0.5) + 1.0, camera_.height_px);
        const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        if (area == 0.0) return;
        for (int y = top; y < bottom; ++y) {
            for (int x = left; x < right; ++x) {
                const double px = x + 0.5 - a.x, py = y + 0.5 - a.y;
                const double to_b = (px * (c.y - a.y) - py * (c.x - a.x)) / area,
                             to_c = ((b.x - a.x) * py - (b.y - a.y) * px) / area;
                if (to_b < 0.0 || to_c < 0.0 || to_b + to_c > 1.0) continue;
                put(x, y, a.nearness + to_b * (b.nearness - a.nearness) + to_c * (c.nearness - a.nearness),
                    colour);
            }
        }
    }

    void put(int x, int y, double nearness, const Colour& colour) {
        if (x < 0 || y < 0 || x >= camera_.width_px || y >= camera_.height_px) return;
        const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(camera_.width_px) +
                           static_cast<std::size_t>(x);
        if (nearness <= nearest_[pixel]) return;
        nearest_[pixel] = static_cast<float>(nearness);
        std::copy(colour.begin(), colour.end(),
                  picture_.rgb.begin() + static_cast<std::ptrdiff_t>(pixel * 3));
    }

    void legend() {
        constexpr int kHeightPx = 12;
        constexpr double kShares = 2.0, kInFrontOfAll = 1e30;
        for (int x = 0; x < camera_.width_px; ++x) {
            const double share = kShares * x / camera_.width_px;
            const bool mark = std::fmod(share, 0.5) < kShares / camera_.width_px;
            for (int y = 0; y < kHeightPx; ++y)
                put(x, camera_.height_px - 1 - y, kInFrontOfAll, mark ? kMark : error_colour(share));
        }
    }

    const PostView& view_;
    const PictureCamera& camera_;
    ErrorPicture picture_;
    std::vector<float> nearest_;
};

}  // namespace

std::array<std::uint8_t, 3> error_colour(double share) {
    constexpr std::array<std::array<double, 4>, 4> kStops{{{0.0, 20.0, 30.0, 90.0},
                                                           {0.5, 40.0, 160.0, 90.0},
                                                           {1.0, 250.0, 220.0, 40.0},
                                                           {2.0, 220.0, 20.0, 20.0}}};
    const double at = std::clamp(share, 0.0, kStops.back()[0]);
    std::size_t stop = 1;
    while (stop + 1 < kStops.size() && at > kStops[stop][0]) ++stop;
    const auto &low = kStops[stop - 1], &high = kStops[stop];
    const double part = (at - low[0]) / (high[0] - low[0]);
    Colour colour{};
    for (std::size_t i = 0; i < colour.size(); ++i)
        colour[i] = static_cast<std::uint8_t>(std::lround(low[i + 1] + part * (high[i + 1] - low[i + 1])));
    return colour;
}

ErrorPicture paint_error(const MeasuredPosts& posts, const PostView& view, const PictureCamera& camera) {
    Canvas canvas(view, camera);
    for (const MeasuredTile& tile : posts.tiles) canvas.add(tile);
    return canvas.take();
}

}  // namespace eyepoint::tools
