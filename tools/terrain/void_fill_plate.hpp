/// A thin plate stretched over the missing posts of a grid.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace eyepoint::tools {

/// Least-squares problem of a thin plate under tension: the sum of squared second differences (xx, xy, yy),
/// and of first differences times the tension, over all terms that hold an unknown post; minimised by
/// conjugate gradients. Minimum curvature: Briggs, Machine Contouring Using Minimum Curvature, Geophysics 39
/// (1974).
class ThinPlate {
  public:
    static constexpr int kKnown = -1;
    static constexpr int kAbsent = -2;  ///< no post there, or one that may not be used

    /// One post of the problem: kAbsent, kKnown with its value, or the number of an unknown.
    struct Post {
        int unknown = kAbsent;
        float value = 0.0F;
    };

    explicit ThinPlate(std::size_t unknowns) : unknowns_(unknowns) {}

    /// Adds a difference of up to four posts, unless one is absent or none is unknown.
    void add(std::span<const Post> posts, std::span<const float> factors);

    /// Values of the unknowns, starting from the given ones.
    [[nodiscard]] std::vector<double> solve(std::vector<double> start) const;

  private:
    struct Term {
        std::array<std::int32_t, 4> unknown{kKnown, kKnown, kKnown, kKnown};
        std::array<float, 4> factor{};
        float known = 0.0F;
    };
    [[nodiscard]] std::vector<double> differences(std::span<const double> values, bool with_known) const;
    [[nodiscard]] std::vector<double> gathered(std::span<const double> residuals) const;

    std::size_t unknowns_;
    std::vector<Term> terms_;
};

}  // namespace eyepoint::tools
