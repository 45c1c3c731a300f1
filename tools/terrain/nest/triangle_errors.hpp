/// Errors of triangles that are asked for again and again while a mesh collapses.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace eyepoint::tools {

/// The errors of triangles between vertices that do not move, by their three numbers. It forgets: a triangle
/// takes the place of another one that falls on the same place.
class TriangleErrors {
  public:
    TriangleErrors() : places_(std::size_t{1} << kBits) {}

    /// The triangle's error when that is known, or when it is known to be above `enough_m` a number above
    /// that; else what `measure(enough_m)` gives, which is such a number too.
    template <typename Measure>
    [[nodiscard]] float find(const std::array<std::uint16_t, 3>& triangle, float enough_m,
                             const Measure& measure) {
        const std::uint64_t key =
            triangle[0] | std::uint64_t{triangle[1]} << 16U | std::uint64_t{triangle[2]} << 32U;
        Place& place = places_[(key * kSpread) >> (64U - kBits)];
        const bool known = place.key == key;
        if (known && (place.is_whole || place.error_m > enough_m)) return place.error_m;
        place = {key, measure(enough_m), false};
        place.is_whole = place.error_m <= enough_m;
        return place.error_m;
    }

  private:
    static constexpr unsigned kBits = 12;
    static constexpr std::uint64_t kSpread = 0x9e3779b97f4a7c15U;  // 2^64 over the golden ratio
    static constexpr std::uint64_t kNoKey = ~std::uint64_t{0};
    struct Place {
        std::uint64_t key = kNoKey;
        float error_m = 0.0F;
        bool is_whole = false;  ///< else the error is at least this
    };
    std::vector<Place> places_;
};

}  // namespace eyepoint::tools
