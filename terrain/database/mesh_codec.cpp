#include "terrain/database/mesh_codec.hpp"

#include <algorithm>
#include <memory>

#include <fmt/format.h>
#include <zstd.h>

#include "terrain/database/byte_stream.hpp"
#include "terrain/database/mesh_gates.hpp"
#include "terrain/database/mesh_place_codec.hpp"
#include "terrain/database/mesh_places.hpp"
#include "terrain/database/mesh_structure.hpp"

namespace eyepoint::terrain {

namespace {

enum class Kind : std::uint8_t { Listed = 0, WholeGrid = 1 };

constexpr std::size_t kMaxVertices = std::size_t{kBlockPosts} * kBlockPosts;
/// More than any mesh takes whose triangles are a triangulation.
constexpr std::size_t kMaxPayload = std::size_t{1} << 20;
constexpr int kZstdLevel = 19;

/// The vertices that one may go to, the nearest first: those that go later, on every side of the tile that it
/// is on.
class TargetRanks {
  public:
    TargetRanks(std::span<const Place> places, std::span<const std::uint8_t> gone_level)
        : places_(places), gone_level_(gone_level), index_(places) {}

    /// Calls visit(vertex) for them in order until it returns false.
    template <typename Visit>
    void visit(std::size_t vertex, Visit visit) const {
        const std::uint8_t sides = sides_of(places_[vertex]);
        index_.visit_from(places_[vertex], [&](std::size_t other) {
            const bool fits =
                gone_level_[other] > gone_level_[vertex] && (sides & ~sides_of(places_[other])) == 0;
            return !fits || visit(other);
        });
    }

    /// kEscape where it is no less or there is none such.
    [[nodiscard]] std::uint8_t rank_of(std::size_t vertex, std::size_t target) const {
        std::uint8_t rank = 0;
        bool found = false;
        visit(vertex, [&](std::size_t other) {
            found = other == target;
            return !found && ++rank < kEscape;
        });
        return found ? rank : kEscape;
    }
    /// The vertex itself where there are not so many.
    [[nodiscard]] std::size_t target_of(std::size_t vertex, std::uint8_t rank) const {
        std::size_t target = vertex;
        visit(vertex, [&](std::size_t other) {
            if (rank == 0) target = other;
            return rank-- != 0;
        });
        return target;
    }

  private:
    std::span<const Place> places_;
    std::span<const std::uint8_t> gone_level_;
    PlaceIndex index_;
};

/// A byte by vertex: 0 where it stays, otherwise one more than the levels after the first at which it goes.
void append_levels(std::vector<std::uint8_t>& payload, const NestedMesh& mesh, std::uint8_t first_level) {
    for (const std::uint8_t level : mesh.gone_level) {
        payload.push_back(level == NestedMesh::kStays ? std::uint8_t{0}
                                                      : static_cast<std::uint8_t>(level - first_level + 1));
    }
}

void append_targets(std::vector<std::uint8_t>& payload, const NestedMesh& mesh,
                    std::span<const Place> places) {
    const TargetRanks ranks{places, mesh.gone_level};
    std::vector<std::uint8_t> escaped;
    for (std::size_t vertex = 0; vertex < mesh.vertices(); ++vertex) {
        if (mesh.gone_level[vertex] == NestedMesh::kStays) continue;
        payload.push_back(ranks.rank_of(vertex, mesh.target[vertex]));
        if (payload.back() == kEscape) append_le(escaped, mesh.target[vertex]);
    }
    payload.insert(payload.end(), escaped.begin(), escaped.end());
}

void append_triangles(std::vector<std::uint8_t>& payload, const NestedMesh& mesh,
                      std::span<const Place> places) {
    const TriangleStream stream = encode_triangles(places, canonical_triangles(mesh));
    append_le(payload, static_cast<std::uint16_t>(mesh.triangles.size() / 3));
    append_le(payload, static_cast<std::uint16_t>(stream.seeds.size() / 3));
    for (const std::uint16_t corner : stream.seeds) append_le(payload, corner);
    payload.insert(payload.end(), stream.gates.begin(), stream.gates.end());
}

std::vector<std::uint8_t> compress(std::span<const std::uint8_t> payload) {
    std::vector<std::uint8_t> bytes(ZSTD_compressBound(payload.size()));
    bytes.resize(ZSTD_compress(bytes.data(), bytes.size(), payload.data(), payload.size(), kZstdLevel));
    return bytes;
}

tl::expected<std::vector<std::uint8_t>, std::string> decompress(std::span<const std::uint8_t> bytes) {
    const unsigned long long declared = ZSTD_getFrameContentSize(bytes.data(), bytes.size());
    if (declared == ZSTD_CONTENTSIZE_ERROR || declared == ZSTD_CONTENTSIZE_UNKNOWN || declared > kMaxPayload)
        return tl::unexpected(std::string{"it is no zstd frame of a mesh's size"});
    std::vector<std::uint8_t> payload(declared);
    const std::size_t size = ZSTD_decompress(payload.data(), payload.size(), bytes.data(), bytes.size());
    if (ZSTD_isError(size) != 0U)
        return tl::unexpected(fmt::format("it does not decompress ({})", ZSTD_getErrorName(size)));
    if (size != payload.size()) return tl::unexpected(std::string{"it is shorter than it says"});
    return payload;
}

void read_levels(ByteReader& payload, NestedMesh& mesh, std::size_t vertices, std::uint8_t first_level) {
    mesh.gone_level.reserve(vertices);
    for (std::size_t vertex = 0; vertex < vertices; ++vertex) {
        const auto after = payload.number<std::uint8_t>();
        mesh.gone_level.push_back(after == 0 ? NestedMesh::kStays
                                             : static_cast<std::uint8_t>(first_level + after - 1));
    }
}

void read_targets(ByteReader& payload, NestedMesh& mesh, std::span<const Place> places) {
    const TargetRanks ranks{places, mesh.gone_level};
    mesh.target.assign(mesh.vertices(), 0);
    std::vector<std::size_t> escaped;
    for (std::size_t vertex = 0; vertex < mesh.vertices() && !payload.failed(); ++vertex) {
        if (mesh.gone_level[vertex] == NestedMesh::kStays) continue;
        const auto rank = payload.number<std::uint8_t>();
        if (rank == kEscape) {
            escaped.push_back(vertex);
        } else {
            mesh.target[vertex] = static_cast<std::uint16_t>(ranks.target_of(vertex, rank));
        }
    }
    for (const std::size_t vertex : escaped) mesh.target[vertex] = payload.number<std::uint16_t>();
}

tl::expected<std::vector<std::uint16_t>, std::string> read_triangles(ByteReader& payload,
                                                                     std::span<const Place> places) {
    const std::size_t triangles = payload.number<std::uint16_t>();
    std::vector<std::uint16_t> seeds(3 * std::size_t{payload.number<std::uint16_t>()});
    for (std::uint16_t& corner : seeds) corner = payload.number<std::uint16_t>();
    if (payload.failed()) return tl::unexpected(std::string{"it is cut short"});
    return decode_triangles(places, triangles, payload.rest(), seeds);
}

tl::expected<NestedMesh, std::string> decode_payload(ByteReader& payload, std::uint8_t first_level,
                                                     double height_step_m) {
    NestedMesh mesh;
    const auto kind = payload.number<std::uint8_t>();
    if (kind > static_cast<std::uint8_t>(Kind::WholeGrid))
        return tl::unexpected(fmt::format("it is of kind {}", kind));
    mesh.whole_grid = kind == static_cast<std::uint8_t>(Kind::WholeGrid);
    if (!mesh.whole_grid) {
        auto places = decode_places(payload, height_step_m);
        if (!places) return tl::unexpected(places.error());
        mesh.posts = std::move(places->posts);
        mesh.fine_posts = std::move(places->fine_posts);
    }
    const auto places = vertex_places(mesh);
    read_levels(payload, mesh, places.size(), first_level);
    read_targets(payload, mesh, places);
    if (!mesh.whole_grid) {
        auto triangles = read_triangles(payload, places);
        if (!triangles) return tl::unexpected(triangles.error());
        mesh.triangles = std::move(*triangles);
    }
    if (payload.failed()) return tl::unexpected(std::string{"it is cut short"});
    if (!payload.rest().empty()) return tl::unexpected(std::string{"it is longer than it says"});
    return mesh;
}

}  // namespace

tl::expected<std::vector<std::uint8_t>, std::string> encode_mesh(const NestedMesh& mesh,
                                                                 std::uint8_t first_level,
                                                                 std::uint8_t last_level,
                                                                 double height_step_m) {
    if (auto sound = check_structure(mesh, first_level, last_level); !sound)
        return tl::unexpected(sound.error());
    std::vector<std::uint8_t> payload;
    payload.push_back(static_cast<std::uint8_t>(mesh.whole_grid ? Kind::WholeGrid : Kind::Listed));
    if (!mesh.whole_grid) {
        const auto places = encode_places(mesh, height_step_m);
        payload.insert(payload.end(), places.begin(), places.end());
    }
    const auto places = vertex_places(mesh);
    append_levels(payload, mesh, first_level);
    append_targets(payload, mesh, places);
    if (!mesh.whole_grid) append_triangles(payload, mesh, places);
    return compress(payload);
}

tl::expected<NestedMesh, std::string> decode_mesh(std::span<const std::uint8_t> bytes,
                                                  std::uint8_t first_level, std::uint8_t last_level,
                                                  double height_step_m) {
    const auto payload = decompress(bytes);
    if (!payload) return tl::unexpected(payload.error());
    ByteReader reader{*payload};
    auto mesh = decode_payload(reader, first_level, height_step_m);
    if (!mesh) return mesh;
    if (auto sound = check_structure(*mesh, first_level, last_level); !sound)
        return tl::unexpected(sound.error());
    return mesh;
}

}  // namespace eyepoint::terrain
