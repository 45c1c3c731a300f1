#include "terrain/database/database.hpp"

#include <thread>

#include <gtest/gtest.h>

#include "tests/terrain/database/small_database.hpp"

namespace eyepoint::terrain {
namespace {

class TwoRoots : public testing::Test {
  protected:
    void SetUp() override { write_two_roots(folder_); }
    ScratchFolder scratch_;
    std::filesystem::path folder_ = scratch_.path() / "db";
};

TEST_F(TwoRoots, ManifestComesBack) {
    const auto database = Database::open(folder_);
    ASSERT_TRUE(database.has_value()) << database.error();
    const Manifest& manifest = database->manifest();
    EXPECT_EQ(manifest.name, "two roots");
    EXPECT_EQ(manifest.created_by, "a test");
    EXPECT_EQ(manifest.height_step_m, 0.0625);
    EXPECT_EQ(manifest.tiles, 2U);
    EXPECT_EQ(manifest.image_tiles, 1U);
    EXPECT_EQ(manifest.voids_filled, 7U);
    EXPECT_EQ(manifest.detail_extent.east_deg, 180.0);
    ASSERT_EQ(manifest.sources.size(), 1U);
    EXPECT_EQ(manifest.sources[0].file, "N46E008.hgt");
    EXPECT_EQ(manifest.sources[0].vertical_datum, "EGM96");
    EXPECT_EQ(manifest.sources[0].spacing_deg, 1.0 / 3600.0);
    EXPECT_EQ(manifest.sources[0].voids, 7U);
}

TEST_F(TwoRoots, NodesAndBlocksComeBack) {
    const auto database = Database::open(folder_);
    ASSERT_TRUE(database.has_value());
    const NodeInfo* node = database->find({0, 1, 0});
    ASSERT_NE(node, nullptr);
    EXPECT_EQ(node->height_max_m, 5'000.0F);
    EXPECT_EQ(node->delta_m, wide_node().delta_m);
    EXPECT_FALSE(node->has_children);
    EXPECT_FALSE(node->has_image);
    EXPECT_EQ(database->find({1, 0, 0}), nullptr);
    const auto block = database->read_block({0, 1, 0});
    ASSERT_TRUE(block.has_value()) << block.error();
    EXPECT_EQ(block->heights_m, rough_block({0, 1, 0}).heights_m);
    EXPECT_FALSE(database->read_block({1, 0, 0}).has_value());
}

TEST_F(TwoRoots, LevelsAndMeshComeBack) {
    const auto database = Database::open(folder_);
    ASSERT_TRUE(database.has_value());
    const NodeInfo* node = database->find({0, 0, 0});
    ASSERT_NE(node, nullptr);
    EXPECT_EQ(node->first_level, 40);
    EXPECT_EQ(node->last_level, 63);
    const auto mesh = database->read_mesh({0, 0, 0});
    ASSERT_TRUE(mesh.has_value()) << mesh.error();
    EXPECT_EQ(*mesh, virtual_mesh({0, 0, 0}, 63));
    EXPECT_GT(database->stored_bytes().meshes, 0U);
}

TEST_F(TwoRoots, SaysWhereATileHasNoMesh) {
    const auto database = Database::open(folder_);
    ASSERT_TRUE(database.has_value());
    const auto none = database->read_mesh({0, 1, 0});
    ASSERT_FALSE(none.has_value());
    EXPECT_NE(none.error().find("no mesh of tile 0/1-0; rebuild"), std::string::npos) << none.error();
}

// JPEG of quality 90 keeps a smooth slope of grey within a few steps of 255.
TEST_F(TwoRoots, ImageComesBackNearlyAndTheRightWayUp) {
    const auto database = Database::open(folder_);
    ASSERT_TRUE(database.has_value());
    const auto image = database->read_image({0, 0, 0});
    ASSERT_TRUE(image.has_value()) << image.error();
    const auto expected = grey_slope();
    ASSERT_EQ(image->rgb.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) ASSERT_NEAR(image->rgb[i], expected[i], 4) << i;
    EXPECT_FALSE(database->read_image({0, 1, 0}).has_value());
}

TEST_F(TwoRoots, ManyThreadsReadAtOnce) {
    const auto database = Database::open(folder_);
    ASSERT_TRUE(database.has_value());
    const auto expected = rough_block({0, 0, 0});
    std::vector<std::jthread> readers;
    for (int i = 0; i < 4; ++i) {
        readers.emplace_back([&] {
            for (int time = 0; time < 50; ++time) {
                const auto block = database->read_block({0, 0, 0});
                ASSERT_TRUE(block.has_value());
                ASSERT_EQ(block->heights_m, expected.heights_m);
            }
        });
    }
}

}  // namespace
}  // namespace eyepoint::terrain
