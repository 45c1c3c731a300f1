#include "tests/terrain/lod/selection_checks.hpp"

#include <gtest/gtest.h>

namespace eyepoint::testing {

using terrain::BlockDraw;
using terrain::Selection;

void expect_whole(const MeshFaults& faults, const std::string& where, std::size_t folded) {
    EXPECT_GT(faults.edges, 0U) << where;
    EXPECT_EQ(faults.cracks, 0U) << where;
    EXPECT_EQ(faults.overlaps, 0U) << where;
    EXPECT_EQ(faults.unequal_bits, 0U) << where;
    EXPECT_EQ(faults.folded, folded) << where;
}

std::vector<std::vector<std::uint16_t>> index_lists(const Selection& selection) {
    std::vector<std::vector<std::uint16_t>> lists;
    for (const BlockDraw& draw : selection.draws) lists.push_back(draw.mesh->indices);
    return lists;
}

std::vector<std::uint64_t> versions(const Selection& selection) {
    std::vector<std::uint64_t> versions;
    for (const BlockDraw& draw : selection.draws) versions.push_back(draw.mesh->version);
    return versions;
}

void ListHistory::add(const Selection& selection) {
    for (const BlockDraw& draw : selection.draws) {
        terrain::BlockMesh& last = last_[draw.node->tile];
        if (last.version == draw.mesh->version) {
            EXPECT_EQ(last.indices, draw.mesh->indices);
            ++kept_;
        } else {
            ++changed_;
        }
        last = *draw.mesh;
    }
}

}  // namespace eyepoint::testing
