/// A length in 16 bits that is never too small.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

namespace eyepoint::terrain::bintree {

/// 0, or 1/128 m to 16,000 km in steps of a 2048th: 5 bits of a float's exponent and 11 of its fraction.
/// Grows with the length, so that what is nested stays so.
class LengthBound {
  public:
    constexpr LengthBound() = default;
    /// The least that is not below a length of at least 0, metres.
    [[nodiscard]] static constexpr LengthBound of(float length_m) {
        LengthBound bound;
        if (length_m <= 0.0F) return bound;
        const std::uint32_t steps_up = std::bit_cast<std::uint32_t>(std::max(length_m, kLeastM)) - kLeastBits;
        constexpr std::uint32_t kStep = 1U << kBitsLeftOut;
        bound.code_ = static_cast<std::uint16_t>((steps_up + kStep - 1) / kStep + 1);
        return bound;
    }
    [[nodiscard]] constexpr float metres() const {
        if (code_ == 0) return 0.0F;
        return std::bit_cast<float>(((std::uint32_t{code_} - 1U) << kBitsLeftOut) + kLeastBits);
    }

  private:
    static constexpr float kLeastM = 1.0F / 128.0F;
    static constexpr std::uint32_t kLeastBits = std::bit_cast<std::uint32_t>(kLeastM);
    static constexpr int kBitsLeftOut = 12;

    std::uint16_t code_ = 0;
};

}  // namespace eyepoint::terrain::bintree
