#include "terrain/database/database_writer.hpp"

#include <algorithm>
#include <csignal>

#include <sys/wait.h>

#include <gtest/gtest.h>

#include "tests/terrain/database/small_database.hpp"

namespace eyepoint::terrain {
namespace {

namespace fs = std::filesystem;

std::size_t entries_in(const fs::path& folder) {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator{folder}, fs::directory_iterator{}));
}

TEST(DatabaseWriter, LeavesNothingWithoutCommit) {
    const ScratchFolder scratch;
    {
        auto writer = DatabaseWriter::create(scratch.path() / "db", 1.0 / 16.0);
        ASSERT_TRUE(writer.has_value()) << writer.error();
        const BlockData block = rough_block({0, 0, 0});
        ASSERT_TRUE(writer->put({wide_node(), &block, nullptr, std::nullopt}).has_value());
        EXPECT_FALSE(fs::exists(scratch.path() / "db"));
    }
    EXPECT_EQ(entries_in(scratch.path()), 0U);
}

TEST(DatabaseWriter, RefusesAMeshThatIsNotSoundAndNamesTheTile) {
    const ScratchFolder scratch;
    auto writer = DatabaseWriter::create(scratch.path() / "db", 1.0 / 16.0);
    ASSERT_TRUE(writer.has_value()) << writer.error();
    const BlockData block = rough_block({0, 1, 0});
    NodeInfo info = wide_node();
    info.last_level = 63;
    NestedMesh mesh = virtual_mesh({0, 0, 0}, 63);
    mesh.gone_level.front() = 5;
    const auto put = writer->put({info, &block, &mesh, std::nullopt});
    ASSERT_FALSE(put.has_value());
    EXPECT_NE(put.error().find("mesh of tile 0/1-0: corner post 0 goes"), std::string::npos) << put.error();
}

TEST(DatabaseWriter, LeavesOnlyTheDatabaseAfterCommit) {
    const ScratchFolder scratch;
    write_two_roots(scratch.path() / "db");
    EXPECT_EQ(entries_in(scratch.path()), 1U);
}

TEST(DatabaseWriter, SameContentInAnotherOrderGivesTheSameBytes) {
    const ScratchFolder scratch;
    const auto write = [&](const char* name, bool reversed) {
        auto writer = DatabaseWriter::create(scratch.path() / name, 1.0 / 16.0);
        ASSERT_TRUE(writer.has_value());
        std::vector<BlockData> blocks;
        for (const std::uint32_t x : {0U, 1U}) blocks.push_back(rough_block({0, x, 0}));
        for (const std::uint32_t y : {0U, 1U}) blocks.push_back(rough_block({1, 0, y}));
        for (const std::uint32_t y : {0U, 1U}) blocks.push_back(rough_block({1, 1, y}));
        if (reversed) std::ranges::reverse(blocks);
        for (const BlockData& block : blocks) {
            NodeInfo info = wide_node();
            info.has_children = block.tile == TileId{0, 0, 0};
            ASSERT_TRUE(writer->put({info, &block, nullptr, std::nullopt}).has_value());
        }
        Manifest manifest = small_manifest();
        manifest.tiles = 6;
        manifest.image_tiles = 0;
        ASSERT_TRUE(writer->commit(manifest).has_value());
    };
    write("a", false);
    write("b", true);
    EXPECT_EQ(bytes_of(scratch.path() / "a/shards/0/0-0.shard"),
              bytes_of(scratch.path() / "b/shards/0/0-0.shard"));
    EXPECT_TRUE(Database::open(scratch.path() / "b").has_value());
}

TEST(DatabaseWriter, ReplacesADatabaseButNothingElse) {
    const ScratchFolder scratch;
    write_two_roots(scratch.path() / "db");
    write_two_roots(scratch.path() / "db");
    EXPECT_TRUE(Database::open(scratch.path() / "db").has_value());
    EXPECT_EQ(entries_in(scratch.path()), 1U);

    const fs::path precious = scratch.path() / "precious";
    fs::create_directory(precious);
    std::ofstream{precious / "thesis.txt"} << "all of it";
    const auto writer = DatabaseWriter::create(precious, 1.0 / 16.0);
    ASSERT_FALSE(writer.has_value());
    EXPECT_NE(writer.error().find("is no terrain database"), std::string::npos) << writer.error();
    EXPECT_EQ(bytes_of(precious / "thesis.txt"), "all of it");
}

TEST(DatabaseWriter, TheOldDatabaseStaysUntilTheNewOneIsWhole) {
    const ScratchFolder scratch;
    write_two_roots(scratch.path() / "db");
    const auto writer = DatabaseWriter::create(scratch.path() / "db", 1.0 / 16.0);
    ASSERT_TRUE(writer.has_value());
    EXPECT_TRUE(Database::open(scratch.path() / "db").has_value());
}

TEST(DatabaseWriter, ASecondWriterIsRefused) {
    const ScratchFolder scratch;
    const auto first = DatabaseWriter::create(scratch.path() / "db", 1.0 / 16.0);
    ASSERT_TRUE(first.has_value());
    const auto second = DatabaseWriter::create(scratch.path() / "db", 1.0 / 16.0);
    ASSERT_FALSE(second.has_value());
    EXPECT_NE(second.error().find("another eyepoint-terrain"), std::string::npos) << second.error();
}

TEST(DatabaseWriter, AKilledWriterLeavesNoDatabaseAndTheNextOneClearsUp) {
    const ScratchFolder scratch;
    const pid_t victim = ::fork();
    ASSERT_GE(victim, 0);
    if (victim == 0) {
        auto writer = DatabaseWriter::create(scratch.path() / "db", 1.0 / 16.0);
        const BlockData block = rough_block({0, 0, 0});
        if (writer) (void)writer->put({wide_node(), &block, nullptr, std::nullopt});
        ::raise(SIGKILL);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(victim, &status, 0), victim);
    ASSERT_TRUE(WIFSIGNALED(status));
    EXPECT_FALSE(fs::exists(scratch.path() / "db"));
    EXPECT_EQ(entries_in(scratch.path()), 1U);  // what it was writing

    write_two_roots(scratch.path() / "db");
    EXPECT_TRUE(Database::open(scratch.path() / "db").has_value());
    EXPECT_EQ(entries_in(scratch.path()), 1U);
}

}  // namespace
}  // namespace eyepoint::terrain
