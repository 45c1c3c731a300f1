#include "terrain/lod/selective/block_selection.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace eyepoint::terrain::selective {

namespace {

constexpr std::size_t kMostIndices = std::size_t{3} * 2 * kBlockCells * kBlockCells;

std::uint16_t* put(std::uint16_t* at, const TreeTriangle& triangle) {
    return std::copy(triangle.vertices.begin(), triangle.vertices.end(), at);
}

}  // namespace

/// Dependency operation: active goes from false to true, and the parents are locked by one more.
void BlockSelection::depend(Rank rank) {
    active_[rank] = 1;
    for (const Rank parent : DependencyHierarchy::of_block().vertices()[rank].parents) {
        if (parent == kNoRank) continue;
        ++lock_[parent];
        if (active_[parent] == 0) depend(parent);
    }
}

/// Unlocking operation, the reverse. A parent that is not locked any more goes, too; should it fail the test
/// itself, it comes back when the traversal reaches it, for it is of a coarser level.
void BlockSelection::unlock(Rank rank) {
    active_[rank] = 0;
    for (const Rank parent : DependencyHierarchy::of_block().vertices()[rank].parents) {
        if (parent == kNoRank) continue;
        if (--lock_[parent] == 0) unlock(parent);
    }
}

/// When the traversal has passed a level, what is active there is final: a vertex changes only by its own
/// test or by a finer one's. So a triangle is drawn if its apex is active and the middle of its base, passed
/// before, is not; and no vertex is visited twice.
void BlockSelection::select(const TestedPosts& tested, std::vector<std::uint16_t>& indices) {
    const DependencyHierarchy& hierarchy = DependencyHierarchy::of_block();
    const HierarchyVertex* vertices = hierarchy.vertices().data();
    std::array<std::uint16_t, kMostIndices> drawn;
    std::uint16_t* end = drawn.data();
    std::array<std::uint32_t, kInside + 1> border{};
    float stands_for_m = std::numeric_limits<float>::max();
    for (std::size_t i = 0; i < kRanks; ++i) {
        const Rank rank = static_cast<Rank>(i);
        const bool fails = tested.passes_by[rank] < 0.0F;
        if (fails != active(rank) && lock_[rank] == 0) fails ? depend(rank) : unlock(rank);
        if (!active(rank)) {
            stands_for_m = std::min(stands_for_m, tested.stands_for_m[rank]);
            continue;
        }
        const HierarchyVertex& vertex = vertices[rank];
        border[vertex.edge] |= vertex.border_bit;
        for (const TreeTriangle* triangle = vertex.triangles.data();
             triangle != vertex.triangles.data() + vertex.triangle_count; ++triangle) {
            if (triangle->middle == kNoRank || !active(triangle->middle)) end = put(end, *triangle);
        }
    }
    if (!active(hierarchy.roots()[0].middle)) {
        for (const TreeTriangle& root : hierarchy.roots()) end = put(end, root);
    }
    indices.insert(indices.end(), drawn.data(), end);
    std::copy_n(border.begin(), border_.size(), border_.begin());
    stands_for_m_ = stands_for_m;
}

}  // namespace eyepoint::terrain::selective
