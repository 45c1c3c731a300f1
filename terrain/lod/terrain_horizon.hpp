/// What near terrain hides of far terrain: the highest line that drawn terrain reaches in every column of an
/// upright picture, near to far.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include <glm/mat3x3.hpp>

#include "terrain/lod/lod_method.hpp"

namespace eyepoint::terrain {

/// An upright picture of a view: u = right / forward, v = up / forward, whatever the view's pitch and roll;
/// up points away from the Earth's centre, so that a column u is a half plane through the eye and the Earth's
/// centre, and terrain is a height above every one of a column's places.
struct UprightView {
    Ecef eye{0.0};
    glm::dmat3 axes{1.0};   ///< columns: right, forward, up
    double radius_m = 0.0;  ///< distance of the eye from the Earth's centre
    float least_u = 0.0F;   ///< of what the view sees
    float greatest_u = 0.0F;
    std::array<glm::dvec2, 4> corners{};  ///< of what the view sees: (u, v), in order around it
};
/// Nothing where there is no such picture: the view looks, somewhere in it, more than about 75 degrees up or
/// down, or is wider than 130 degrees.
[[nodiscard]] std::optional<UprightView> upright_view(const LodView& view);

/// A point in an upright picture. `ahead_m` orders points of one column: the tangent, times the eye's
/// distance from the Earth's centre, of the angle there between the eye and the point, over the same for u =
/// 0.
struct UprightPoint {
    float u = 0.0F;
    float v = 0.0F;
    float ahead_m = 0.0F;
};

/// Premises, the caller's: the terrain is one closed surface, the eye is above it, and the near plane cuts
/// nothing of it off. Then a point of the surface hides everything that is farther ahead in its column and
/// below it: the line of sight to it passes beneath that point, inside the Earth, so it has gone through the
/// surface before. The order of calls does not matter to this, since a column remembers how far ahead what it
/// shows is; near to far hides most. Thread use: one thread.
class TerrainHorizon {
  public:
    static constexpr int kColumns = 512;  ///< across the view

    /// Empties the horizon: it hides what is below the view.
    /// margin: how much lower, in v, a thing must be to count as hidden.
    void reset(const UprightView& view, float margin);

    enum class Sight : unsigned char { Visible, Hidden, Outside };
    /// Of anything between least_u and greatest_u, not above v, not nearer than ahead_m. Hidden: no point of
    /// it can be seen over the horizon; Outside: nor without the terrain, because it is below or beside the
    /// view.
    [[nodiscard]] Sight sight(float least_u, float greatest_u, float v, float ahead_m) const;

    /// A line that is on or below the surface, straight in space between the points; those without a place in
    /// the picture (not ahead of the eye) have ahead_m <= 0 and break it. Raises the columns that it crosses
    /// wholly, each to the line's lowest point in it.
    void raise(std::span<const UprightPoint> line);

  private:
    struct Carry;
    void raise_segment(const UprightPoint& from, const UprightPoint& to, Carry& carry);
    void raise_columns(int first, int last, float v, float rise, float ahead_m);
    [[nodiscard]] float column_at(float u) const { return (u - least_u_) * columns_per_u_; }

    std::array<float, kColumns> v_{};        ///< everything farther ahead and below is hidden
    std::array<float, kColumns> ahead_m_{};  ///< how far ahead that begins; negative: the view's lower border
    float least_u_ = 0.0F;
    float columns_per_u_ = 1.0F;
    float margin_ = 0.0F;
};

}  // namespace eyepoint::terrain
