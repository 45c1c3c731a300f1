/// A view as it looks at one tile: what block and vertex selection share.
#pragma once

#include <algorithm>
#include <array>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "terrain/lod/hyperblock/hyper_tree.hpp"
#include "terrain/lod/lod_method.hpp"
#include "terrain/lod/tile_cut.hpp"

namespace eyepoint::terrain::hyperblock {

/// Of a view, in floats.
struct ScreenScale {
    explicit ScreenScale(const LodView& view)
        : m_per_shape_m(static_cast<float>(view.kappa_px / view.tau_px)),
          m_per_arc_m(static_cast<float>(view.kappa_px / kHorizonPx)),
          near_m(static_cast<float>(view.near_m)) {
        for (std::size_t i = 0; i < sides.size(); ++i) sides[i] = glm::vec3{view.sides[i]};
    }
    /// So far away an error is at the tolerance, metres (Figure 11).
    template <typename Error>
    [[nodiscard]] float reach_m(const Error& of) const {
        return std::max(of.error_m * m_per_shape_m, of.arc_m * m_per_arc_m);
    }

    float m_per_shape_m;
    float m_per_arc_m;  ///< the arc of the Earth is held to kHorizonPx
    float near_m;
    std::array<glm::vec3, 4> sides{};
};

struct EyeInTile {
    glm::vec3 eye_m{0.0F};  ///< from the tile's origin
    float box_m = 0.0F;     ///< least distance of anything in the tile, near_m at least

    [[nodiscard]] float distance_m(const Sphere& sphere) const {
        return std::max(glm::distance(sphere.centre_m, eye_m) - sphere.radius_m, box_m);
    }
    /// Bounding-sphere culling (4.3, Figure 10): how a sphere lies to the view's four sides.
    enum class Lies : std::uint8_t { Outside, Across, Inside };
    [[nodiscard]] Lies lies(const Sphere& sphere, const ScreenScale& scale) const {
        const glm::vec3 to_centre = sphere.centre_m - eye_m;
        Lies lies = Lies::Inside;
        for (const glm::vec3& side : scale.sides) {
            const float beyond_m = glm::dot(side, to_centre);
            if (beyond_m < -sphere.radius_m) return Lies::Outside;
            if (beyond_m < sphere.radius_m) lies = Lies::Across;
        }
        return lies;
    }
};
[[nodiscard]] inline EyeInTile eye_in_tile(const LodView& view, const Ecef& origin, double box_m) {
    return {glm::vec3{view.eye - origin}, static_cast<float>(std::max(box_m, view.near_m))};
}

}  // namespace eyepoint::terrain::hyperblock
