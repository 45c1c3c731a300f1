/// Errors of triangles that are asked for again and again while a mesh collapses.
#pragma once

#include <vector>

#include "tools/terrain/nest/triangle_key.hpp"

namespace eyepoint::tools {

/// The errors of triangles between vertices that do not move, by their three numbers. It forgets: a triangle
/// takes the place of another one that falls on the same place.
class TriangleErrors {
  public:
    TriangleErrors() : places_(std::size_t{1} << kTrianglePlaceBits) {}

    /// The triangle's error when that is known, or when it is known to be above `enough_m` a number above
    /// that; else what `measure(enough_m)` gives, which is such a number too.
    template <typename Measure>
    [[nodiscard]] float find(const std::array<std::uint16_t, 3>& triangle, float enough_m,
                             const Measure& measure) {
        const TriangleKey key = key_of(triangle);
        Place& place = places_[place_of(key)];
        const bool known = place.key == key;
        if (known && (place.is_whole || place.error_m > enough_m)) return place.error_m;
        place = {key, measure(enough_m), false};
        place.is_whole = place.error_m <= enough_m;
        return place.error_m;
    }

  private:
    struct Place {
        TriangleKey key = kNoTriangle;
        float error_m = 0.0F;
        bool is_whole = false;  ///< else the error is at least this
    };
    std::vector<Place> places_;
};

}  // namespace eyepoint::tools
