#include "terrain/pager/pager.hpp"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>
#include <mutex>
#include <set>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "terrain/database/shard.hpp"
#include "terrain/geodesy/earth.hpp"
#include "terrain/lod/tile/tile_lod.hpp"
#include "tests/support/analytic_terrain.hpp"
#include "tests/terrain/lod/drawn_mesh.hpp"

namespace eyepoint::terrain {
namespace {

using testing::AnalyticTerrain;
using testing::ScratchFolder;

constexpr std::uint64_t kPlenty = 1ULL << 30;
/// More frames than a block is kept after its last use whatever the budget.
constexpr std::uint64_t kLongAfter = 1000;

/// A planet of three depths, four around the Alps, read by every test.
class PagerTest : public ::testing::Test {
  protected:
    static void SetUpTestSuite() {
        scratch_ = std::make_unique<ScratchFolder>();
        database_ = testing::make_database({.detail_depth = 4, .planet_depth = 2}, scratch_->path() / "db");
    }
    static void TearDownTestSuite() {
        database_.reset();
        scratch_.reset();
    }

    static std::unique_ptr<Pager> open(const PagerOptions& options) {
        return std::move(Pager::create(database_, options).value());
    }
    /// A database that a test may damage.
    static std::filesystem::path copy_to(const ScratchFolder& scratch) {
        std::filesystem::copy(database_->folder(), scratch.path() / "db",
                              std::filesystem::copy_options::recursive);
        return scratch.path() / "db";
    }

    static inline std::unique_ptr<ScratchFolder> scratch_;
    static inline std::shared_ptr<const Database> database_;
};

/// Changes one byte in the middle of a tile's block.
void damage(const std::filesystem::path& database, TileId tile) {
    const auto path = database / shard_path(shard_root(tile));
    std::fstream file{path, std::ios::binary | std::ios::in | std::ios::out};
    std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>{file}, {}};
    const auto header = std::span{bytes}.first(kShardHeaderBytes);
    const std::size_t tiles = decode_shard_header(shard_root(tile), header).value();
    const auto index = std::span{bytes}.first(kShardHeaderBytes + tiles * kShardEntryBytes);
    const auto entries = decode_shard_index(shard_root(tile), index, bytes.size()).value();
    const auto entry = std::find_if(entries.begin(), entries.end(),
                                    [&](const ShardEntry& candidate) { return candidate.tile == tile; });
    ASSERT_NE(entry, entries.end());
    const std::uint64_t at = entry->block.offset + entry->block.size / 2;
    file.clear();
    file.seekp(static_cast<std::streamoff>(at));
    file.put(static_cast<char>(bytes[at] ^ 0xff));
}

/// Wishes for the eight tiles of depth 1, the wish for tile i with priority priorities[i].
std::vector<BlockRequest> wishes_below_roots(TileTree& tree, const std::array<double, 8>& priorities) {
    std::vector<BlockRequest> wishes;
    for (TileNode& root : tree.roots()) {
        for (TileNode& child : tree.children(root)) wishes.push_back({&child, priorities[wishes.size()]});
    }
    return wishes;
}
constexpr std::array<double, 8> kMixedPriorities{3.0, 7.0, 1.0, 5.0, 8.0, 2.0, 6.0, 4.0};

void load(Pager& pager, std::span<const BlockRequest> wishes, std::uint64_t frame) {
    pager.request(wishes);
    pager.wait_for_loads();
    pager.publish(wishes.size(), frame);
}

/// Every loaded tile with its vertices' bytes, depth first.
void append_content(const TileNode& node, std::vector<std::pair<TileId, std::string>>& content) {
    if (node.block) {
        const auto& vertices = node.block->vertices;
        content.emplace_back(node.tile, std::string{reinterpret_cast<const char*>(vertices.data()),
                                                    vertices.size() * sizeof(BlockVertex)});
    }
    if (!node.children) return;
    for (const TileNode& child : *node.children) append_content(child, content);
}

std::vector<std::pair<TileId, std::string>> content_of(Pager& pager) {
    std::vector<std::pair<TileId, std::string>> content;
    for (const TileNode& root : pager.tree().roots()) append_content(root, content);
    return content;
}

/// Loads the four children of both roots, then of every south-west child, down to a depth.
void load_down_to(Pager& pager, std::uint32_t depth) {
    std::vector<TileNode*> parents;
    for (TileNode& root : pager.tree().roots()) parents.push_back(&root);
    for (std::uint32_t at = 1; at <= depth; ++at) {
        std::vector<BlockRequest> wishes;
        for (TileNode* parent : parents) {
            for (TileNode& child : pager.tree().children(*parent))
                wishes.push_back({&child, static_cast<double>(wishes.size() % 7)});
        }
        load(pager, wishes, at);
        parents.clear();
        for (std::size_t i = 0; i < wishes.size(); i += 4) parents.push_back(wishes[i].node);
    }
}

TEST_F(PagerTest, EveryLoadIsToldOnceWithItsTimes) {
    std::mutex mutex;
    std::vector<BlockLoad> told;
    const auto pager = open({.threads = 2, .on_load = [&](const BlockLoad& load) {
                                 const std::scoped_lock lock(mutex);
                                 told.push_back(load);
                             }});
    load_down_to(*pager, 2);
    const std::scoped_lock lock(mutex);
    EXPECT_EQ(told.size(), pager->counters().loaded);
    std::set<TileId> tiles;
    for (const BlockLoad& load : told) {
        EXPECT_TRUE(tiles.insert(load.tile).second);
        EXPECT_LT(load.thread, 2U);
        EXPECT_LE(load.began, load.read);
        EXPECT_LE(load.read, load.done);
    }
}

TEST_F(PagerTest, RootsAreThereAtOnce) {
    const auto pager = open({});
    for (const TileNode& root : pager->tree().roots()) EXPECT_NE(root.block, nullptr);
    EXPECT_EQ(pager->counters().loaded, 2U);
    EXPECT_EQ(pager->counters().blocks, 2U);
    EXPECT_EQ(pager->pending(), 0U);
}

TEST_F(PagerTest, ADatabaseWithAnUnreadableRootIsRefusedInWords) {
    const ScratchFolder scratch;
    const auto folder = copy_to(scratch);
    damage(folder, {0, 1, 0});
    const auto database = std::make_shared<const Database>(Database::open(folder).value());
    const auto pager = Pager::create(database, {});
    ASSERT_FALSE(pager.has_value());
    EXPECT_NE(pager.error().find("1-0.shard"), std::string::npos) << pager.error();
}

TEST_F(PagerTest, TheBaseIsThereAtOnceAndStays) {
    const auto pager = open({.cache_bytes = 1, .base_depth = 3});
    EXPECT_EQ(pager->counters().blocks, 2U + 8U + 32U + 128U);
    EXPECT_GT(pager->counters().interpolated, 0U) << "the planet's tiles end at depth 2";
    TileNode* node = &pager->tree().roots()[1];
    while (node->tile.depth < 3) node = &pager->tree().children(*node)[2];
    load(*pager, std::vector<BlockRequest>{{&pager->tree().children(*node)[0], 1.0}}, 1);
    pager->publish(0, kLongAfter);
    EXPECT_EQ(pager->counters().evicted, 1U);
    EXPECT_NE(node->block, nullptr);
}

TEST_F(PagerTest, AnUnreadableTileOfTheBaseIsReportedAndItsParentStandsIn) {
    const ScratchFolder scratch;
    const auto folder = copy_to(scratch);
    damage(folder, {1, 2, 1});
    const auto database = std::make_shared<const Database>(Database::open(folder).value());
    const auto pager = std::move(Pager::create(database, {.base_depth = 2}).value());
    EXPECT_EQ(pager->counters().blocks, 2U + 7U + 28U);
    EXPECT_EQ(pager->take_faults().size(), 1U);
}

TEST_F(PagerTest, TheMostWantedBlockIsLoadedFirst) {
    const auto pager = open({.threads = 1, .cache_bytes = kPlenty});
    auto wishes = wishes_below_roots(pager->tree(), kMixedPriorities);
    pager->request(wishes);
    ASSERT_TRUE(pager->wait_for_loads());
    std::sort(wishes.begin(), wishes.end(),
              [](const BlockRequest& a, const BlockRequest& b) { return a.priority > b.priority; });
    for (std::size_t i = 0; i < wishes.size(); ++i) {
        ASSERT_EQ(wishes[i].node->block, nullptr) << "priority " << wishes[i].priority;
        ASSERT_EQ(pager->publish(1, 1), 1U);
        EXPECT_NE(wishes[i].node->block, nullptr) << "priority " << wishes[i].priority;
    }
}

TEST_F(PagerTest, WaitingEndsWhenEverythingWishedForIsThere) {
    const auto pager = open({.threads = 2, .cache_bytes = kPlenty});
    EXPECT_FALSE(pager->wait_for_loads()) << "nothing was wished for";
    pager->request(wishes_below_roots(pager->tree(), kMixedPriorities));
    EXPECT_TRUE(pager->wait_for_loads());
    EXPECT_EQ(pager->pending(), 8U) << "finished, not yet published";
    EXPECT_EQ(pager->publish(5, 1), 5U);
    EXPECT_TRUE(pager->wait_for_loads());
    EXPECT_EQ(pager->publish(100, 1), 3U);
    EXPECT_FALSE(pager->wait_for_loads());
    EXPECT_EQ(pager->pending(), 0U);
}

TEST_F(PagerTest, AWishForWhatIsLoadedOrHasNoParentLoadsNothing) {
    const auto pager = open({.threads = 1, .cache_bytes = kPlenty});
    TileTree& tree = pager->tree();
    TileNode& child = tree.children(tree.roots()[0])[0];
    TileNode& grandchild = tree.children(child)[0];
    pager->request(std::vector<BlockRequest>{{&tree.roots()[0], 2.0}, {&grandchild, 1.0}});
    EXPECT_EQ(pager->pending(), 0U);
    load(*pager, std::vector<BlockRequest>{{&child, 1.0}}, 1);
    load(*pager, std::vector<BlockRequest>{{&child, 2.0}, {&grandchild, 1.0}}, 2);
    EXPECT_EQ(pager->counters().loaded, 4U) << "two roots, the child, the grandchild";
}

TEST_F(PagerTest, OverTheBudgetTheLongestUnusedGoAndUsedOnesStay) {
    const auto roomy = open({.threads = 1, .cache_bytes = kPlenty});
    const std::uint64_t block_bytes = roomy->counters().bytes / 2;
    const auto pager = open({.threads = 1, .cache_bytes = 6 * block_bytes + block_bytes / 2});
    const auto wishes = wishes_below_roots(pager->tree(), kMixedPriorities);
    load(*pager, wishes, 1);
    EXPECT_EQ(pager->counters().blocks, 10U) << "fresh blocks are kept for a while";
    for (std::size_t i = 0; i < wishes.size(); ++i) wishes[i].node->used_frame = 8 - i;
    wishes[7].node->used_frame = kLongAfter;
    pager->publish(0, kLongAfter);
    EXPECT_EQ(pager->counters().blocks, 6U);
    EXPECT_EQ(pager->counters().evicted, 4U);
    EXPECT_LE(pager->counters().bytes, 6 * block_bytes + block_bytes / 2);
    for (const TileNode& root : pager->tree().roots()) EXPECT_NE(root.block, nullptr);
    for (const std::size_t i : {0U, 1U, 2U, 7U}) EXPECT_NE(wishes[i].node->block, nullptr) << i;
    for (const std::size_t i : {3U, 4U, 5U, 6U}) EXPECT_EQ(wishes[i].node->block, nullptr) << i;
}

TEST_F(PagerTest, BlocksInUseStayThoughTheyExceedTheBudget) {
    const auto pager = open({.threads = 1, .cache_bytes = 1});
    const auto wishes = wishes_below_roots(pager->tree(), kMixedPriorities);
    load(*pager, wishes, 1);
    for (const BlockRequest& wish : wishes) wish.node->used_frame = kLongAfter;
    pager->publish(0, kLongAfter);
    EXPECT_EQ(pager->counters().blocks, 10U);
    EXPECT_EQ(pager->counters().evicted, 0U);
}

TEST_F(PagerTest, ABlockStaysAsLongAsOneBelowItDoes) {
    const auto pager = open({.threads = 1, .cache_bytes = 1});
    TileTree& tree = pager->tree();
    TileNode& child = tree.children(tree.roots()[0])[0];
    TileNode& grandchild = tree.children(child)[0];
    load(*pager, std::vector<BlockRequest>{{&child, 1.0}}, 1);
    load(*pager, std::vector<BlockRequest>{{&grandchild, 1.0}}, 1);
    grandchild.used_frame = kLongAfter;
    pager->publish(0, kLongAfter);
    EXPECT_NE(child.block, nullptr);
    pager->publish(0, 2 * kLongAfter);
    EXPECT_EQ(grandchild.block, nullptr);
    pager->publish(0, 2 * kLongAfter);
    EXPECT_EQ(child.block, nullptr);
}

TEST_F(PagerTest, AnEvictedBlockComesBackTheSame) {
    const auto pager = open({.threads = 1, .cache_bytes = 1});
    const auto wishes = wishes_below_roots(pager->tree(), kMixedPriorities);
    load(*pager, wishes, 1);
    const auto before = content_of(*pager);
    pager->publish(0, kLongAfter);
    ASSERT_EQ(pager->counters().evicted, 8U);
    load(*pager, wishes, kLongAfter);
    EXPECT_EQ(content_of(*pager), before);
}

TEST_F(PagerTest, AnUnreadableBlockIsReportedOnceAndNotAskedForAgain) {
    const ScratchFolder scratch;
    const auto folder = copy_to(scratch);
    const TileId bad{1, 2, 1};
    damage(folder, bad);
    const auto database = std::make_shared<const Database>(Database::open(folder).value());
    const auto pager = std::move(Pager::create(database, {.threads = 1, .cache_bytes = kPlenty}).value());
    const auto wishes = wishes_below_roots(pager->tree(), kMixedPriorities);
    for (std::uint64_t frame = 1; frame <= 3; ++frame) load(*pager, wishes, frame);
    EXPECT_EQ(pager->counters().unreadable, 1U);
    EXPECT_EQ(pager->counters().loaded, 9U) << "two roots and seven of eight";
    const auto faults = pager->take_faults();
    ASSERT_EQ(faults.size(), 1U);
    EXPECT_NE(faults[0].find("1-0.shard"), std::string::npos) << faults[0];
    EXPECT_TRUE(pager->take_faults().empty());
    const TileNode* node = pager->tree().find(bad);
    ASSERT_NE(node, nullptr);
    EXPECT_TRUE(node->unreadable);
    EXPECT_EQ(node->block, nullptr);
}

TEST_F(PagerTest, AnUnreadableBlockIsDrawnFromItsAncestorWithoutCracks) {
    const ScratchFolder scratch;
    const auto folder = copy_to(scratch);
    const TileId bad = tile_at(46.5, 8.25, 3);
    damage(folder, bad);
    const auto database = std::make_shared<const Database>(Database::open(folder).value());
    const auto pager = std::move(Pager::create(database, {.threads = 1, .cache_bytes = kPlenty}).value());
    // From 3,000 km above the tile, looking down at 53 by 53 degrees.
    const Ecef eye = to_ecef({46.5, 8.25, EllipsoidalHeight{3.0e6}});
    const glm::dmat3 enu = east_north_up(46.5, 8.25);
    const glm::dvec3 east = enu[0], north = enu[1], down = -enu[2];
    const LodView view{.eye = eye,
                       .sides = {glm::normalize(2.0 * east + down), glm::normalize(-2.0 * east + down),
                                 glm::normalize(2.0 * north + down), glm::normalize(-2.0 * north + down)},
                       .kappa_px = 1000.0,
                       .tau_px = 0.01};
    TileLod lod;
    std::uint64_t frame = 0;
    const Selection* selection = nullptr;
    do {
        pager->publish(1000, ++frame);
        selection = &lod.select(view, pager->tree(), frame);
        pager->request(selection->wishes);
        ASSERT_LT(frame, 100U) << "still asking for blocks";
    } while (pager->wait_for_loads());

    const auto is_drawn = [&](TileId tile) {
        return std::any_of(selection->draws.begin(), selection->draws.end(),
                           [&](const BlockDraw& draw) { return draw.node->tile == tile; });
    };
    EXPECT_EQ(pager->counters().unreadable, 1U);
    EXPECT_TRUE(is_drawn(parent(bad)));
    EXPECT_FALSE(is_drawn(bad));
    EXPECT_TRUE(selection->wishes.empty()) << "the unreadable tile is not asked for again";
    const auto faults = testing::find_faults(selection->draws, lod.indices());
    EXPECT_GT(selection->draws.size(), 4U);
    EXPECT_EQ(faults.cracks + faults.overlaps + faults.unequal_bits + faults.folded, 0U);
}

TEST_F(PagerTest, OneThreadAndFourMakeTheSameTree) {
    const auto one = open({.threads = 1, .cache_bytes = kPlenty}),
               four = open({.threads = 4, .cache_bytes = kPlenty});
    constexpr std::uint32_t kBelowTheLeaves = 6;
    for (const auto& pager : {one.get(), four.get()}) load_down_to(*pager, kBelowTheLeaves);
    EXPECT_GT(one->counters().interpolated, 0U);
    EXPECT_EQ(one->counters().loaded, four->counters().loaded);
    EXPECT_EQ(one->counters().interpolated, four->counters().interpolated);
    EXPECT_EQ(one->counters().bytes, four->counters().bytes);
    EXPECT_EQ(content_of(*one), content_of(*four));
}

TEST_F(PagerTest, MayGoWhileLoadsAreUnderWay) {
    for (int round = 0; round < 50; ++round) {
        const auto pager = open({.threads = 4, .cache_bytes = kPlenty});
        pager->request(wishes_below_roots(pager->tree(), kMixedPriorities));
        if (round % 2 == 0) pager->publish(100, 1);
        if (round % 3 == 0) pager->request({});
    }
}

TEST_F(PagerTest, WishesReplacedEveryFrameLoadEachBlockOnce) {
    const auto pager = open({.threads = 4, .cache_bytes = kPlenty});
    const auto wishes = wishes_below_roots(pager->tree(), kMixedPriorities);
    for (std::uint64_t frame = 1; pager->counters().blocks < 10; ++frame) {
        pager->request(wishes);
        pager->publish(1, frame);
    }
    EXPECT_FALSE(pager->wait_for_loads());
    EXPECT_EQ(pager->counters().loaded, 10U);
}

}  // namespace
}  // namespace eyepoint::terrain
