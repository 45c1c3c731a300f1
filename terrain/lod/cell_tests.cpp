#include "terrain/lod/cell_tests.hpp"

#include <bit>
#include <cstddef>
#include <cstring>

// One function for each kind of processor, chosen when the program is loaded. Not under AddressSanitizer,
// which is not set up by then.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define EYEPOINT_EACH_PROCESSOR __attribute__((target_clones("avx2", "default")))
#else
#define EYEPOINT_EACH_PROCESSOR
#endif

namespace eyepoint::terrain {

namespace {

constexpr std::size_t kCellCount = CellBoxes::kCells;
using CellFlags = std::array<std::uint8_t, kCellCount>;  // 0 or 1

/// A product brings the low bits of eight bytes, one after the other, into its top byte.
[[gnu::always_inline]] inline CellSet set_of(const CellFlags& flags) {
    static_assert(std::endian::native == std::endian::little);
    CellSet result = 0;
    for (std::size_t i = 0; i < kCellCount; i += 8) {
        std::uint64_t eight = 0;
        std::memcpy(&eight, &flags[i], sizeof eight);
        result |= (eight * 0x0102040810204080) >> 56 << i;
    }
    return result;
}

/// Square of how far a point is before `low` or beyond `high`, weighted; 0 between them.
[[gnu::always_inline]] inline float near_square(std::uint8_t low, std::uint8_t high, float at, float weight) {
    const float below = static_cast<float>(low) - at, above = at - static_cast<float>(high);
    const float beyond = below > above ? below : above;
    const float off = beyond > 0.0F ? beyond : 0.0F;
    return weight * off * off;
}

/// Square of how far it is from the farther of the two, weighted.
[[gnu::always_inline]] inline float far_square(std::uint8_t low, std::uint8_t high, float at, float weight) {
    const float to_low = at - static_cast<float>(low), to_high = static_cast<float>(high) - at;
    const float off = to_low > to_high ? to_low : to_high;
    return weight * off * off;
}

}  // namespace

EYEPOINT_EACH_PROCESSOR
CellSet cells_beyond(const CellBoxes::Level& boxes, const StepPoint& point, float least_square_m2) {
    const auto [x, y, z] = point.at;
    const auto [by_x, by_y, by_z] = point.square_metres;
    CellFlags flags;
    for (std::size_t i = 0; i < kCellCount; ++i) {
        const float square_m2 = near_square(boxes.low[0][i], boxes.high[0][i], x, by_x) +
                                near_square(boxes.low[1][i], boxes.high[1][i], y, by_y) +
                                near_square(boxes.low[2][i], boxes.high[2][i], z, by_z);
        flags[i] = static_cast<std::uint8_t>(square_m2 >= least_square_m2 ? 1 : 0);
    }
    return set_of(flags);
}

EYEPOINT_EACH_PROCESSOR
CellSet cells_within(const CellBoxes::Level& boxes, const StepPoint& point, float most_square_m2) {
    const auto [x, y, z] = point.at;
    const auto [by_x, by_y, by_z] = point.square_metres;
    CellFlags flags;
    for (std::size_t i = 0; i < kCellCount; ++i) {
        const float square_m2 = far_square(boxes.low[0][i], boxes.high[0][i], x, by_x) +
                                far_square(boxes.low[1][i], boxes.high[1][i], y, by_y) +
                                far_square(boxes.low[2][i], boxes.high[2][i], z, by_z);
        flags[i] = static_cast<std::uint8_t>(square_m2 <= most_square_m2 ? 1 : 0);
    }
    return set_of(flags);
}

EYEPOINT_EACH_PROCESSOR
CellSet cells_below(const CellBoxes::Level& boxes, const StepPlane& plane, float least_m) {
    const auto [by_x, by_y, by_z] = plane.slope_m;
    const std::uint8_t* const x = (by_x > 0.0F ? boxes.high : boxes.low)[0].data();
    const std::uint8_t* const y = (by_y > 0.0F ? boxes.high : boxes.low)[1].data();
    const std::uint8_t* const z = (by_z > 0.0F ? boxes.high : boxes.low)[2].data();
    const float first_m = plane.first_m;
    CellFlags flags;
    for (std::size_t i = 0; i < kCellCount; ++i) {
        const float highest_m = first_m + by_x * static_cast<float>(x[i]) + by_y * static_cast<float>(y[i]) +
                                by_z * static_cast<float>(z[i]);
        flags[i] = static_cast<std::uint8_t>(highest_m < least_m ? 1 : 0);
    }
    return set_of(flags);
}

}  // namespace eyepoint::terrain
