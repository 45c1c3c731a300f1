/// What is looked at in the selections of every method.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "terrain/lod/lod_method.hpp"
#include "tests/terrain/lod/drawn_mesh.hpp"

namespace eyepoint::testing {

/// Fails unless there is a mesh, without cracks and overlaps, with so many triangles folded over or upright.
void expect_whole(const MeshFaults& faults, const std::string& where, std::size_t folded = 0);

/// Of the draws of a method that has a list for each block.
[[nodiscard]] std::vector<std::vector<std::uint16_t>> index_lists(const terrain::Selection& selection);
[[nodiscard]] std::vector<std::uint64_t> versions(const terrain::Selection& selection);

/// The lists of blocks in selections one after another.
class ListHistory {
  public:
    /// Fails where a block has another list than when it was drawn last, and the same version.
    void add(const terrain::Selection& selection);

    /// Lists that were sent, and lists that were there already.
    [[nodiscard]] std::size_t changed() const { return changed_; }
    [[nodiscard]] std::size_t kept() const { return kept_; }

  private:
    std::unordered_map<terrain::TileId, terrain::BlockMesh, terrain::TileHash> last_;
    std::size_t changed_ = 0, kept_ = 0;
};

}  // namespace eyepoint::testing
