// Damaged databases: each is refused with a sentence that names the file, when it is opened or when the
// damaged tile is read; none crashes (the sanitizers' build runs this too).
#include <random>

#include <gtest/gtest.h>

#include "terrain/database/shard.hpp"
#include "tests/terrain/database/small_database.hpp"

namespace eyepoint::terrain {
namespace {

/// The first fault met by somebody who opens the database and reads all of it; empty when there is none.
std::string first_fault(const std::filesystem::path& folder) {
    const auto database = Database::open(folder);
    if (!database) return database.error();
    for (const TileId tile : database->tiles()) {
        if (const auto block = database->read_block(tile); !block) return block.error();
        if (tile.x == 0) {
            if (const auto mesh = database->read_mesh(tile); !mesh) return mesh.error();
        }
        if (!database->find(tile)->has_image) continue;
        if (const auto image = database->read_image(tile); !image) return image.error();
    }
    return {};
}

class Corruption : public testing::Test {
  protected:
    void SetUp() override {
        write_two_roots(folder_);
        shard_ = folder_ / "shards/0/0-0.shard";
        whole_ = bytes_of(shard_);
        ASSERT_EQ(first_fault(folder_), "");
    }
    void expect_refused(const std::string& bytes, const std::string& what) {
        replace_bytes(shard_, bytes);
        const std::string fault = first_fault(folder_);
        EXPECT_NE(fault.find("0-0.shard"), std::string::npos) << what << ": " << fault;
    }

    ScratchFolder scratch_;
    std::filesystem::path folder_ = scratch_.path() / "db";
    std::filesystem::path shard_;
    std::string whole_;
};

TEST_F(Corruption, EveryTruncationOfAShardIsRefused) {
    for (std::size_t size = 0; size < whole_.size(); ++size) {
        expect_refused(whole_.substr(0, size), "cut to " + std::to_string(size));
    }
}

TEST_F(Corruption, AByteTooManyIsRefused) { expect_refused(whole_ + "x", "a byte more"); }

TEST_F(Corruption, EveryFlippedBitOfTheHeaderAndTheIndexIsRefused) {
    for (std::size_t bit = 0; bit < 8 * (kShardHeaderBytes + kShardEntryBytes); ++bit) {
        std::string bytes = whole_;
        bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ (1 << (bit % 8)));
        expect_refused(bytes, "bit " + std::to_string(bit));
    }
}

TEST_F(Corruption, FlippedBitsOfBlocksMeshesAndImagesAreRefused) {
    std::mt19937 random{11};
    for (int trial = 0; trial < 500; ++trial) {
        std::string bytes = whole_;
        const std::size_t bit = random() % (8 * bytes.size());
        bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ (1 << (bit % 8)));
        expect_refused(bytes, "bit " + std::to_string(bit));
    }
}

TEST_F(Corruption, AnotherFormatVersionNamesBothVersions) {
    std::string bytes = whole_;
    bytes[8] = 9;
    replace_bytes(shard_, bytes);
    EXPECT_NE(first_fault(folder_).find("version 9, this program reads version 3"), std::string::npos)
        << first_fault(folder_);
}

TEST_F(Corruption, ADatabaseOfVersion1IsToBeBuiltAgain) {
    std::string bytes = whole_;
    bytes[8] = 1;
    replace_bytes(shard_, bytes);
    EXPECT_EQ(first_fault(folder_), shard_.string() +
                                        ": its format is version 1, this program reads version 3; "
                                        "rebuild the database with eyepoint-terrain");
}

TEST_F(Corruption, AMissingShardIsRefused) {
    std::filesystem::remove(folder_ / "shards/0/1-0.shard");
    EXPECT_NE(first_fault(folder_).find("1-0.shard"), std::string::npos);
}

TEST_F(Corruption, EveryTruncationOfTheManifestIsRefused) {
    const auto manifest = folder_ / "manifest.json";
    const std::string text = bytes_of(manifest);
    for (std::size_t size = 0; size + 1 < text.size(); ++size) {  // the last byte is a line's end
        replace_bytes(manifest, text.substr(0, size));
        EXPECT_NE(first_fault(folder_).find("manifest.json"), std::string::npos) << size;
    }
}

TEST_F(Corruption, AManifestOfAnotherVersionNamesBothVersions) {
    const auto manifest = folder_ / "manifest.json";
    std::string text = bytes_of(manifest);
    text.replace(text.find("\"format_version\": 3"), 19, "\"format_version\": 4");
    replace_bytes(manifest, text);
    EXPECT_NE(first_fault(folder_).find("version 4, this program reads version 3"), std::string::npos);
}

TEST(Database, SaysWhatToDoWhereThereIsNone) {
    const ScratchFolder scratch;
    const auto nothing = Database::open(scratch.path() / "nothing");
    ASSERT_FALSE(nothing.has_value());
    EXPECT_NE(nothing.error().find("eyepoint-terrain synth"), std::string::npos) << nothing.error();
    const auto empty = Database::open(scratch.path());
    ASSERT_FALSE(empty.has_value());
    EXPECT_NE(empty.error().find("is no terrain database"), std::string::npos) << empty.error();
}

}  // namespace
}  // namespace eyepoint::terrain
