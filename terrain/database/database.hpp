/// The terrain database as it is read: a folder of a manifest and shards (format: docs/database-format.md).
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "terrain/tiling/tile_id.hpp"

namespace eyepoint::terrain {

/// Levels of a block: level l draws every 2^l-th post, so level 5 is two triangles.
inline constexpr int kBlockLevels = 6;
/// Heights are stored with one further ring of posts around the block, so that normals agree on shared edges.
inline constexpr int kApronPosts = kBlockPosts + 2;
/// Texels a side of a tile's picture; the outer texels' centres lie on the tile's edges, so neighbours share
/// them.
inline constexpr int kImageTexels = 128;

/// What is known of every tile of the database without reading its block.
struct NodeInfo {
    /// Range of ellipsoidal heights, metres, over all full-resolution posts below the tile.
    float height_min_m = 0.0F;
    float height_max_m = 0.0F;
    /// delta_m[l]: an upper bound, metres, on the distance in space between any point of the full-resolution
    /// surface below the tile (heights linear between posts, on the curved ellipsoid) and the mesh of its
    /// level l (flat triangles). Grows with l.
    std::array<float, kBlockLevels> delta_m{};
    bool has_children = false;  ///< all four or none
    bool has_image = false;
    /// Levels (terrain/lod/error_level.hpp) that the tile's nested mesh has: its finest, bare_level(depth)
    /// where it has no children, and its coarsest, which is its parent's finest (kLastLevel for a root).
    /// Finer ones are its children's.
    std::uint8_t first_level = 0;
    std::uint8_t last_level = 0;
};

/// A tile's stored content.
struct BlockData {
    TileId tile;
    /// Ellipsoidal heights, metres: rows from south, posts from west; index (row + 1) * kApronPosts + column
    /// + 1 for row and column in -1..33.
    std::array<float, kApronPosts * kApronPosts> heights_m{};
    /// 1 where a post is on the surface of a sea or lake; index row * kBlockPosts + column.
    std::array<std::uint8_t, kBlockPosts * kBlockPosts> water{};
    /// Geoid height above the ellipsoid at the corners SW, SE, NW, NE, metres: MSL for colouring, by bilinear
    /// interpolation.
    std::array<float, 4> undulation_m{};

    [[nodiscard]] float height_m(int row, int column) const {
        return heights_m[static_cast<std::size_t>((row + 1) * kApronPosts + column + 1)];
    }
};

/// Places in a tile, from its south-west corner: so many units a side, enough for any post of any tile below
/// it to be whole. A post every kPlaceUnits / kBlockCells.
inline constexpr std::uint32_t kPlaceUnits = 1U << 30;

/// A tile's nested mesh (docs/lod.md): its finest triangulation, and how each of its vertices goes when the
/// mesh gets coarser. The triangulation of the first level is the union of the children's at their last
/// level.
///
/// Vertices are numbered: first the tile's own posts that are in the mesh, then posts of deeper tiles below
/// it. One vertex goes at a level d: it is in the meshes of levels below d, and while the level asked for
/// rises from d - 1 to d it slides, in a straight line, to its target, a vertex of this mesh that is still
/// there at level d. The mesh of a level is the first one with every vertex that has gone replaced by its
/// target, until none has gone, and the empty triangles left out.
struct NestedMesh {
    /// A vertex at a post of a deeper tile.
    struct FinePost {
        std::uint32_t x = 0;  ///< kPlaceUnits a side, from the west
        std::uint32_t y = 0;  ///< from the south
        float height_m = 0.0F;
        auto operator<=>(const FinePost&) const = default;
    };
    static constexpr std::uint8_t kStays = 255;  ///< level of a vertex that is in the parent's mesh too

    /// Every own post is a vertex, in the order of BlockData::water, and the triangles are the regular ones,
    /// every cell split from its south-west to its north-east post: `posts`, `fine_posts` and `triangles` are
    /// empty. So in a tile without children.
    bool whole_grid = false;
    std::vector<std::uint16_t> posts;  ///< row * kBlockPosts + column, rising
    std::vector<FinePost> fine_posts;  ///< rising in (y, x)
    std::vector<std::uint16_t>
        triangles;  ///< of the first level: three vertices each, counterclockwise from above
    /// By vertex: at most last_level, or kStays. At first_level or below it: in none of this tile's meshes,
    /// only passed by what slides to it and on (on the edge beside a coarser leaf). The tile's corners stay.
    std::vector<std::uint8_t> gone_level;
    std::vector<std::uint16_t> target;  ///< by vertex; 0 where it stays

    [[nodiscard]] std::size_t vertices() const { return gone_level.size(); }
    bool operator==(const NestedMesh&) const = default;
};

/// A tile's picture: kImageTexels^2 RGB triples, row 0 in the south, sRGB.
struct ImageData {
    TileId tile;
    std::vector<std::uint8_t> rgb;
};

/// Where the data came from, for people.
struct SourceRecord {
    std::string file;
    std::string kind;            ///< "elevation" or "imagery" or "procedural"
    std::string vertical_datum;  ///< "EGM96", "WGS84 ellipsoid"; empty for imagery
    double spacing_deg = 0.0;
    std::uint64_t voids = 0;  ///< posts that were void in the file
};

struct Manifest {
    static constexpr int kFormatVersion = 3;
    std::string name;
    std::string created_by;       ///< program and version
    double height_step_m = 0.0;   ///< heights are whole multiples of this
    std::uint32_t max_depth = 0;  ///< of the deepest tile
    std::uint64_t tiles = 0;
    std::uint64_t image_tiles = 0;
    std::uint64_t voids_filled = 0;
    GeographicExtent
        detail_extent;  ///< bounds of the tiles of the deepest sources; the planet is always whole
    std::vector<SourceRecord> sources;
};

/// What the tiles take on disk, compressed, without indexes.
struct StoredBytes {
    std::uint64_t blocks = 0;
    std::uint64_t meshes = 0;
    std::uint64_t images = 0;
};

/// A database opened for reading. Always holds both root tiles, and a tile's four children all or none.
/// Thread use: const use is safe from any thread (reads are pread).
class Database {
  public:
    /// Opens a database folder and reads its manifest and the index of every shard; verifies format version,
    /// index checksums and file sizes, not the blocks. On failure: one sentence with file, fault and remedy.
    [[nodiscard]] static tl::expected<Database, std::string> open(const std::filesystem::path& folder);

    ~Database();
    Database(Database&&) noexcept;
    Database& operator=(Database&&) noexcept;

    [[nodiscard]] const Manifest& manifest() const;
    [[nodiscard]] const std::filesystem::path& folder() const;

    /// nullptr for a tile the database does not hold. The pointer lives as long as the database.
    [[nodiscard]] const NodeInfo* find(TileId tile) const;

    /// Reads, checks (checksum) and decodes. On failure: one sentence with file, tile and fault.
    [[nodiscard]] tl::expected<BlockData, std::string> read_block(TileId tile) const;
    [[nodiscard]] tl::expected<NestedMesh, std::string> read_mesh(TileId tile) const;
    [[nodiscard]] tl::expected<ImageData, std::string> read_image(TileId tile) const;

    [[nodiscard]] StoredBytes stored_bytes() const;

    /// Every tile held, in no particular order.
    [[nodiscard]] std::vector<TileId> tiles() const;

  private:
    struct Content;
    explicit Database(std::unique_ptr<Content> content);
    std::unique_ptr<Content> content_;
};

}  // namespace eyepoint::terrain
