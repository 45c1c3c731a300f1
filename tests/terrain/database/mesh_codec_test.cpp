#include "terrain/database/mesh_codec.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "terrain/database/mesh_structure.hpp"
#include "terrain/database/virtual_tile.hpp"
#include "tests/terrain/database/collapsed_mesh.hpp"

namespace eyepoint::terrain {
namespace {

constexpr double kStepM = 1.0 / 16.0;
constexpr std::uint8_t kStays = NestedMesh::kStays;

NestedMesh canonical(NestedMesh mesh) {
    mesh.triangles = canonical_triangles(mesh);
    return mesh;
}

/// The corner posts and two triangles: nothing goes.
NestedMesh bare_mesh() {
    NestedMesh mesh;
    mesh.posts = {0, 32, 1056, 1088};
    mesh.triangles = {0, 1, 3, 0, 3, 2};
    mesh.gone_level.assign(4, kStays);
    mesh.target.assign(4, 0);
    return mesh;
}

void expect_round_trip(const NestedMesh& mesh, std::uint8_t first_level, std::uint8_t last_level) {
    const auto bytes = encode_mesh(mesh, first_level, last_level, kStepM);
    ASSERT_TRUE(bytes.has_value()) << bytes.error();
    const auto decoded = decode_mesh(*bytes, first_level, last_level, kStepM);
    ASSERT_TRUE(decoded.has_value()) << decoded.error();
    EXPECT_EQ(*decoded, canonical(mesh));
}

TEST(MeshCodec, GivesBackTheMeshOfATileWithoutChildren) {
    const auto leaf = collapsed_mesh(33, 1'089, 80, 1);
    ASSERT_TRUE(leaf.mesh.whole_grid);
    expect_round_trip(leaf.mesh, leaf.first_level, leaf.last_level);
}

TEST(MeshCodec, GivesBackTheMeshOfATileWithChildren) {
    const auto inner = collapsed_mesh(129, 300, 80, 2);
    ASSERT_FALSE(inner.mesh.fine_posts.empty());
    ASSERT_TRUE(check_cover(inner.mesh).has_value());
    expect_round_trip(inner.mesh, inner.first_level, inner.last_level);
}

TEST(MeshCodec, GivesBackTheMeshOfAVirtualTile) { expect_round_trip(virtual_mesh({0, 0, 0}, 7), 3, 7); }

TEST(MeshCodec, GivesBackTheLeastMesh) { expect_round_trip(bare_mesh(), 63, 63); }

// The deepest post of all, and heights beyond any on Earth.
TEST(MeshCodec, GivesBackTheDeepestPosts) {
    NestedMesh mesh = bare_mesh();
    mesh.fine_posts = {{1, 1, -11'000.0F}, {kPlaceUnits - 1, kPlaceUnits - 1, 9'000.0F}};
    mesh.gone_level.insert(mesh.gone_level.end(), {1, 40});
    mesh.target.insert(mesh.target.end(), {5, 3});
    expect_round_trip(mesh, 1, 40);
}

// Sizes that keep a database's meshes within 8 bits a post (docs/database-format.md): the means over rough
// ground of 1089 posts at 20 or more levels, and of the 300 vertices that are left of 129 x 129 posts.
TEST(MeshCodec, TakesFewBits) {
    std::size_t leaf_bytes = 0, inner_bytes = 0;
    constexpr std::uint32_t kTiles = 4;
    for (std::uint32_t seed = 0; seed < kTiles; ++seed) {
        const auto leaf = collapsed_mesh(33, 1'089, 80, seed);
        leaf_bytes += encode_mesh(leaf.mesh, leaf.first_level, leaf.last_level, kStepM)->size();
        const auto inner = collapsed_mesh(129, 300, 80, seed);
        inner_bytes += encode_mesh(inner.mesh, inner.first_level, inner.last_level, kStepM)->size();
    }
    EXPECT_LE(leaf_bytes / kTiles, 1'020U);
    EXPECT_LE(inner_bytes / kTiles, 1'000U);
}

RC_GTEST_PROP(MeshCodec, GivesBackAnyCollapsedMesh, ()) {
    const auto posts = *rc::gen::element(33, 65);
    const auto last = *rc::gen::inRange<std::size_t>(4, 300);
    const auto first = *rc::gen::inRange<std::size_t>(last, 1'090);
    const auto made = collapsed_mesh(posts, first, last, *rc::gen::arbitrary<std::uint32_t>());
    const auto bytes = encode_mesh(made.mesh, made.first_level, made.last_level, kStepM);
    RC_ASSERT(bytes.has_value());
    const auto decoded = decode_mesh(*bytes, made.first_level, made.last_level, kStepM);
    RC_ASSERT(decoded.has_value());
    RC_ASSERT(*decoded == canonical(made.mesh));
}

// Triangles need be no triangulation: they cost more then, but all come back.
RC_GTEST_PROP(MeshCodec, GivesBackAnyTriangles, ()) {
    NestedMesh mesh = bare_mesh();
    mesh.posts = {0, 5, 32, 500, 501, 1'056, 1'088};
    mesh.gone_level.assign(7, kStays);
    mesh.target.assign(7, 0);
    mesh.triangles.clear();
    const auto triangles = *rc::gen::inRange(0, 60);
    for (int i = 0; i < triangles; ++i) {
        const auto a = *rc::gen::inRange<std::uint16_t>(0, 7), b = *rc::gen::inRange<std::uint16_t>(0, 7),
                   c = *rc::gen::inRange<std::uint16_t>(0, 7);
        if (a != b && b != c && c != a) mesh.triangles.insert(mesh.triangles.end(), {a, b, c});
    }
    const auto bytes = encode_mesh(mesh, 0, 63, kStepM);
    RC_ASSERT(bytes.has_value());
    RC_ASSERT(decode_mesh(*bytes, 0, 63, kStepM) == canonical(mesh));
}

TEST(MeshCodec, RefusesEveryTruncationAndAByteTooMany) {
    const auto inner = collapsed_mesh(65, 120, 30, 5);
    auto bytes = *encode_mesh(inner.mesh, inner.first_level, inner.last_level, kStepM);
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        const std::vector<std::uint8_t> cut{bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)};
        EXPECT_FALSE(decode_mesh(cut, inner.first_level, inner.last_level, kStepM).has_value()) << size;
    }
    bytes.push_back(0);
    EXPECT_FALSE(decode_mesh(bytes, inner.first_level, inner.last_level, kStepM).has_value());
}

// The checksum of the shard guards a mesh; without it, what is read must still be safe to use.
TEST(MeshCodec, ChangedBytesGiveASoundMeshOrNone) {
    for (const auto& made : {collapsed_mesh(65, 120, 30, 6), collapsed_mesh(33, 1'089, 200, 6)}) {
        const auto bytes = *encode_mesh(made.mesh, made.first_level, made.last_level, kStepM);
        std::mt19937 random{7};
        for (int trial = 0; trial < 1'000; ++trial) {
            auto changed = bytes;
            for (int i = 0; i < 3; ++i)
                changed[random() % changed.size()] = static_cast<std::uint8_t>(random());
            const auto decoded = decode_mesh(changed, made.first_level, made.last_level, kStepM);
            if (!decoded) continue;
            const auto sound = check_structure(*decoded, made.last_level);
            EXPECT_TRUE(sound.has_value()) << sound.error();
        }
    }
}

TEST(MeshCodec, SurvivesNoise) {
    std::mt19937 random{8};
    for (int trial = 0; trial < 3'000; ++trial) {
        std::vector<std::uint8_t> bytes(random() % 600);
        for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
        (void)decode_mesh(bytes, 0, 63, kStepM);
    }
}

TEST(MeshStructure, NamesWhatIsWrong) {
    const auto fault = [](auto change) {
        NestedMesh mesh = bare_mesh();
        change(mesh);
        const auto sound = check_structure(mesh, 20);
        return sound ? std::string{"sound"} : sound.error();
    };
    const auto has = [](const std::string& text, const char* part) {
        return text.find(part) != std::string::npos;
    };
    EXPECT_EQ(fault([](NestedMesh&) {}), "sound");
    EXPECT_TRUE(has(fault([](NestedMesh& mesh) { mesh.posts[1] = 31; }), "corner post 32"));
    EXPECT_TRUE(has(fault([](NestedMesh& mesh) { mesh.gone_level[3] = 15; }), "corner post 1088 goes"));
    EXPECT_TRUE(has(fault([](NestedMesh& mesh) { mesh.posts[1] = 0; }), "posts do not rise"));
    EXPECT_TRUE(has(fault([](NestedMesh& mesh) { mesh.triangles[0] = 4; }), "triangle 0"));
    EXPECT_TRUE(has(fault([](NestedMesh& mesh) { mesh.triangles[1] = 3; }), "triangle 0"));
    EXPECT_TRUE(has(fault([](NestedMesh& mesh) { mesh.target[2] = 1; }), "stays and has target"));
    EXPECT_TRUE(has(fault([](NestedMesh& mesh) { mesh.whole_grid = true; }), "whole grid"));
    const auto with_fine = [&](NestedMesh::FinePost post, std::uint8_t level, std::uint16_t target) {
        return fault([&](NestedMesh& mesh) {
            mesh.fine_posts.push_back(post);
            mesh.gone_level.push_back(level);
            mesh.target.push_back(target);
        });
    };
    EXPECT_EQ(with_fine({7, 9, 0.0F}, 20, 0), "sound");
    EXPECT_TRUE(has(with_fine({7, 9, 0.0F}, 21, 0), "goes at level 21"));
    EXPECT_EQ(with_fine({7, 9, 0.0F}, 9, 0), "sound");  // never drawn
    EXPECT_TRUE(has(with_fine({7, 9, 0.0F}, 20, 4), "not there any longer"));
    EXPECT_TRUE(has(with_fine({7, 9, 0.0F}, 20, 5), "not there any longer"));
    EXPECT_TRUE(has(with_fine({kPlaceUnits + 1, 9, 0.0F}, 20, 0), "outside the tile"));
    EXPECT_TRUE(has(with_fine({kPlaceUnits / 2, 0, 0.0F}, 20, 0), "own posts"));
}

TEST(MeshStructure, CoverFindsHolesFoldsAndOverlaps) {
    NestedMesh mesh = bare_mesh();
    EXPECT_TRUE(check_cover(mesh).has_value());
    EXPECT_TRUE(check_cover(virtual_mesh({0, 0, 0}, 3)).has_value());
    mesh.triangles = {0, 1, 3};
    EXPECT_FALSE(check_cover(mesh).has_value());
    mesh.triangles = {0, 1, 3, 0, 2, 3};
    EXPECT_FALSE(check_cover(mesh).has_value());
    mesh.triangles = {0, 1, 3, 0, 3, 2, 0, 1, 2};
    EXPECT_FALSE(check_cover(mesh).has_value());
}

}  // namespace
}  // namespace eyepoint::terrain
