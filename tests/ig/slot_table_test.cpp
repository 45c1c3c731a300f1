#include "ig/render/slot_table.hpp"

#include <gtest/gtest.h>

namespace eyepoint::ig {
namespace {

terrain::TileId tile(std::uint32_t x) { return {10, x, 0}; }

TEST(SlotTable, ATileKeepsItsSlotAndIsFreshOnce) {
    SlotTable table(4);
    const auto first = table.place(tile(1), 1).value();
    const auto again = table.place(tile(1), 2).value();
    EXPECT_TRUE(first.fresh);
    EXPECT_FALSE(again.fresh);
    EXPECT_EQ(first.slot, again.slot);
}

TEST(SlotTable, TheLongestUnusedTileGivesWay) {
    SlotTable table(2);
    const auto old_slot = table.place(tile(1), 1)->slot;
    (void)table.place(tile(2), 2);
    EXPECT_EQ(table.place(tile(3), 3)->slot, old_slot);
    EXPECT_TRUE(table.place(tile(1), 4)->fresh);
}

TEST(SlotTable, ASlotOfThisFrameIsNotGivenAway) {
    SlotTable table(1);
    (void)table.place(tile(1), 7);
    EXPECT_FALSE(table.place(tile(2), 7));
    table.grow_to(2);
    EXPECT_EQ(table.place(tile(2), 7)->slot, 1U);
    EXPECT_FALSE(table.place(tile(1), 7)->fresh);
}

}  // namespace
}  // namespace eyepoint::ig
