// The compiler on surfaces given by a formula. Each database is then put to verify(), which holds the checks
// of seams, poles, coarse posts and errors, written apart from the compiler.
#include "tools/terrain/compile.hpp"

#include <atomic>
#include <cmath>
#include <memory>

#include <gtest/gtest.h>
#include <unistd.h>

#include "terrain/database/virtual_tile.hpp"
#include "tools/terrain/verify.hpp"

namespace eyepoint::tools {
namespace {

namespace fs = std::filesystem;
using terrain::Edge;
using terrain::TileId;

class Folder {
  public:
    Folder() {
        std::string name = (fs::temp_directory_path() / "eyepoint-test-XXXXXX").string();
        path_ = ::mkdtemp(name.data());
    }
    ~Folder() { fs::remove_all(path_); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    [[nodiscard]] fs::path database() const { return path_ / "db"; }
    [[nodiscard]] bool is_empty() const { return fs::is_empty(path_); }

  private:
    fs::path path_;
};

/// Hills everywhere, in detail around one place down to a depth. At a pole its height depends on the
/// longitude, and it does not know that 180 W is 180 E: the compiler has to.
class Hills final : public ElevationSource {
  public:
    Hills(double latitude_deg, double longitude_deg, std::uint32_t depth)
        : latitude_deg_(latitude_deg), longitude_deg_(longitude_deg), depth_(depth) {}

    [[nodiscard]] bool has_detail(TileId tile) const override {
        return tile.depth <= depth_ && terrain::tile_at(latitude_deg_, longitude_deg_, tile.depth) == tile;
    }
    void sample(const Lattice& lattice, std::span<SurfaceSample> out) const override {
        for (int i = 0; i < lattice.rows * lattice.columns; ++i) {
            const double latitude = lattice.south_deg + i / lattice.columns * lattice.step_deg;
            const double longitude = lattice.west_deg + i % lattice.columns * lattice.step_deg;
            const double height =
                1'500.0 * std::sin(latitude * 37.0) * std::cos(longitude * 41.0) + 3.0 * longitude;
            out[static_cast<std::size_t>(i)] = {static_cast<float>(height), height < 0.0};
        }
    }

  private:
    double latitude_deg_, longitude_deg_;
    std::uint32_t depth_;
};

class Green final : public ImagerySource {
  public:
    [[nodiscard]] bool has_detail(TileId tile) const override { return tile.depth <= 1; }
    void sample(const Lattice&, std::span<std::uint8_t> out) const override {
        for (std::size_t i = 0; i < out.size(); ++i) out[i] = i % 3 == 1 ? 200 : 40;
    }
};

const terrain::Geoid& geoid() {
    static const auto grid = terrain::Geoid::load(EYEPOINT_BINARY_DIR "/share/eyepoint/egm96-15.pgm");
    return *grid;
}

CompileRequest request_for(const ElevationSource& source, const Folder& folder) {
    CompileRequest request;
    request.elevation = &source;
    request.geoid = &geoid();
    request.output = folder.database();
    return request;
}

terrain::Database compiled(const ElevationSource& source, const Folder& folder) {
    const auto manifest = compile_database(request_for(source, folder));
    EXPECT_TRUE(manifest.has_value()) << manifest.error();
    auto database = terrain::Database::open(folder.database());
    EXPECT_TRUE(database.has_value()) << database.error();
    return std::move(*database);
}

struct Case {
    const char* name;
    double latitude_deg, longitude_deg;
};
void PrintTo(const Case& place, std::ostream* out) { *out << place.name; }

class CompilePlace : public testing::TestWithParam<Case> {};

TEST_P(CompilePlace, IsSoundThere) {
    const Folder folder;
    const Hills hills{GetParam().latitude_deg, GetParam().longitude_deg, 8};
    const auto database = compiled(hills, folder);
    EXPECT_EQ(database.manifest().tiles, 2 + 8 + 4 * 7U);
    VerifyRequest request;
    request.delta_paths = 40;
    for (const std::string& fault : verify(database, request)) ADD_FAILURE() << fault;
}

INSTANTIATE_TEST_SUITE_P(Places, CompilePlace,
                         testing::Values(Case{"alps", 46.4, 8.1},
                                         Case{"east_of_antimeridian", -16.8, -179.99},
                                         Case{"west_of_antimeridian", 52.0, 179.99},
                                         Case{"north_pole", 89.99, 10.0}, Case{"south_pole", -89.99, -100.0},
                                         Case{"equator", 0.01, 0.01}),
                         [](const auto& place) { return place.param.name; });

// The deep tile's edge beside a leaf, against the leaf refined by the rule for virtual tiles: bit by bit.
TEST(Compile, EdgesBesideACoarserTileAreItsVirtualTiles) {
    const Folder folder;
    const auto database = compiled(Hills{46.4, 8.1, 9}, folder);
    int edges = 0;
    for (const TileId tile : database.tiles()) {
        for (const Edge edge : {Edge::West, Edge::East}) {
            const auto beyond = neighbour(tile, edge);
            if (database.find(*beyond) != nullptr) continue;
            std::uint32_t depth = tile.depth;
            while (database.find(ancestor(*beyond, depth)) == nullptr) --depth;
            auto other = *database.read_block(ancestor(*beyond, depth));
            while (other.tile.depth < tile.depth) {
                other = subdivide(other, quadrant(ancestor(*beyond, other.tile.depth + 1)),
                                  database.manifest().height_step_m);
            }
            const auto block = *database.read_block(tile);
            const int ours = edge == Edge::West ? 0 : 32;
            for (int row = 0; row < terrain::kBlockPosts; ++row) {
                ASSERT_EQ(block.height_m(row, ours), other.height_m(row, 32 - ours));
            }
            ++edges;
        }
    }
    EXPECT_GT(edges, 10);
}

// On a sphere-like planet without relief the error of level 5 of a tile of depth 6 is about the sagitta of
// its diagonal: side 180/64 degrees = 313 km, diagonal 443 km: 443^2 / (8 * 6371) = 3.85 km at the equator.
TEST(Compile, DeltaOfAPlanetWithoutReliefIsTheSagitta) {
    class Flat final : public ElevationSource {
      public:
        [[nodiscard]] bool has_detail(TileId tile) const override {
            return tile.depth <= 6 && terrain::tile_at(0.1, 0.1, tile.depth) == tile;
        }
        void sample(const Lattice&, std::span<SurfaceSample> out) const override {
            for (SurfaceSample& sample : out) sample = {};
        }
    };
    const Folder folder;
    const auto database = compiled(Flat{}, folder);
    const auto* node = database.find({6, 64, 32});
    ASSERT_NE(node, nullptr);
    EXPECT_NEAR(node->delta_m[5], 3'850.0, 80.0);
    EXPECT_EQ(node->height_min_m, 0.0F);
    EXPECT_EQ(node->height_max_m, 0.0F);
}

TEST(Compile, DrapesImageryWhereThereIsAny) {
    const Folder folder;
    const Hills hills{46.4, 8.1, 4};
    const Green green;
    auto request = request_for(hills, folder);
    request.imagery = &green;
    const auto manifest = compile_database(request);
    ASSERT_TRUE(manifest.has_value()) << manifest.error();
    EXPECT_EQ(manifest->image_tiles, 10U);
    const auto database = terrain::Database::open(folder.database());
    ASSERT_TRUE(database.has_value()) << database.error();
    const auto image = database->read_image({1, 2, 1});
    ASSERT_TRUE(image.has_value()) << image.error();
    EXPECT_NEAR(image->rgb[1], 200, 4);
    EXPECT_NEAR(image->rgb[0], 40, 4);
    EXPECT_FALSE(database->find({2, 0, 0}) != nullptr && database->find({2, 0, 0})->has_image);
}

TEST(Compile, AHeightThatIsNoNumberIsRefusedAndLeavesNothing) {
    class Holes final : public ElevationSource {
      public:
        [[nodiscard]] bool has_detail(TileId) const override { return false; }
        void sample(const Lattice&, std::span<SurfaceSample> out) const override {
            for (SurfaceSample& sample : out) sample = {std::nanf(""), false};
        }
    };
    const Folder folder;
    const Holes holes;
    const auto manifest = compile_database(request_for(holes, folder));
    ASSERT_FALSE(manifest.has_value());
    EXPECT_NE(manifest.error().find("no height"), std::string::npos) << manifest.error();
    EXPECT_TRUE(folder.is_empty());
}

TEST(Compile, AnInterruptedBuildLeavesNothing) {
    const Folder folder;
    const Hills hills{46.4, 8.1, 8};
    auto request = request_for(hills, folder);
    request.cancelled = [asked = std::make_shared<std::atomic<int>>(0)] { return ++*asked > 30; };
    const auto manifest = compile_database(request);
    ASSERT_FALSE(manifest.has_value());
    EXPECT_NE(manifest.error().find("interrupted"), std::string::npos);
    EXPECT_TRUE(folder.is_empty());
}

}  // namespace
}  // namespace eyepoint::tools
