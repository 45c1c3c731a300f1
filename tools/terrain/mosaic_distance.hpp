/// How far posts are from an edge, and the weights with which a finer source fades into a coarser one there.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace eyepoint::tools {

/// Euclidean distance, in posts, of every post to the nearest one whose site is not 0; huge where there is
/// none. Felzenszwalb and Huttenlocher, Distance Transforms of Sampled Functions, Theory of Computing 8
/// (2012): exact, linear.
[[nodiscard]] std::vector<float> distance_to_sites(std::span<const std::uint8_t> sites, int columns,
                                                   int rows);

/// Weight of a source at its posts: 0 on the outermost covered posts, rising as a smoothstep to 1 `margin`
/// posts inside. Kept in 1/65535.
class EdgeWeights {
  public:
    /// Weight 1 everywhere.
    EdgeWeights() = default;
    /// covered(column, row) is asked for posts up to margin + 1 outside the grid too, so that an edge beyond
    /// which another source continues is none.
    EdgeWeights(int columns, int rows, int margin, const std::function<bool(int, int)>& covered);

    [[nodiscard]] float at(std::size_t post) const {
        return weights_.empty() ? 1.0F : static_cast<float>(weights_[post]) * (1.0F / 65535.0F);
    }
    [[nodiscard]] bool is_one() const { return weights_.empty(); }

  private:
    std::vector<std::uint16_t> weights_;
};

}  // namespace eyepoint::tools
