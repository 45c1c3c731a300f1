/// Which vertices of a block are in its mesh, and the triangles that they make. Source: Ueng & Chuang,
/// section 3.3.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "terrain/lod/selective/dependency_hierarchy.hpp"

namespace eyepoint::terrain::selective {

/// What the screen-error test says of a block's vertices at one eye, by rank (screen_error.hpp).
struct TestedPosts {
    std::array<float, kRanks> passes_by{};  ///< negative: the vertex fails, and must be in the mesh
    /// So far, metres, may the eye move before the vertex's error can be above tau + s.
    std::array<float, kRanks> stands_for_m{};
};

/// The border vertices in a block's mesh, by edge (kEdges): bit k for the k-th post from the edge's start
/// (south or west), 1..31. Both ends always are.
using BorderSelection = std::array<std::uint32_t, 4>;

class BlockSelection {
  public:
    /// Traverses the hierarchy bottom-up and selects anew; appends the mesh's triangles, three vertices each,
    /// as it goes. The result is the smallest selection that has all vertices that fail the test and, with
    /// each, its parents; it does not depend on the selection before.
    void select(const TestedPosts& tested, std::vector<std::uint16_t>& indices);

    [[nodiscard]] bool active(Rank rank) const { return active_[rank] != 0; }
    /// How many children are active; zero: not locked.
    [[nodiscard]] int lock(Rank rank) const { return lock_[rank]; }
    /// Of the last select(): the least that any vertex left out stands for, metres.
    [[nodiscard]] float stands_for_m() const { return stands_for_m_; }
    [[nodiscard]] const BorderSelection& border() const { return border_; }

  private:
    void depend(Rank rank);
    void unlock(Rank rank);

    std::array<std::uint8_t, kRanks> active_{};
    std::array<std::int8_t, kRanks> lock_{};
    BorderSelection border_{};
    float stands_for_m_ = 0.0F;
};

}  // namespace eyepoint::terrain::selective
