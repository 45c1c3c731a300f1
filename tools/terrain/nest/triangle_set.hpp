/// Triangles of which something has been found true that stays true.
#pragma once

#include <vector>

#include "tools/terrain/nest/triangle_key.hpp"

namespace eyepoint::tools {

/// It forgets: a triangle takes the place of another one that falls on the same place.
class TriangleSet {
  public:
    [[nodiscard]] bool has(const std::array<std::uint16_t, 3>& triangle) const {
        return places_[place_of(key_of(triangle))] == key_of(triangle);
    }
    void add(const std::array<std::uint16_t, 3>& triangle) {
        places_[place_of(key_of(triangle))] = key_of(triangle);
    }

  private:
    std::vector<TriangleKey> places_ =
        std::vector<TriangleKey>(std::size_t{1} << kTrianglePlaceBits, kNoTriangle);
};

}  // namespace eyepoint::tools
