#include "terrain/database/mesh_codec.hpp"

#include <utility>

#include "terrain/database/mesh_gates.hpp"
#include "terrain/database/mesh_place_codec.hpp"
#include "terrain/database/mesh_places.hpp"
#include "terrain/database/mesh_structure.hpp"
#include "terrain/database/range_coder.hpp"
#include "terrain/lod/error_level.hpp"

namespace eyepoint::terrain {

namespace {

/// A rank that stands for a target that is not among the first so many.
constexpr std::size_t kFarRank = 255;

struct TargetModels {
    NumberModel inside;
    NumberModel on_side;  ///< targets of vertices on the tile's sides lie on the same side
    NumberModel far;
    NumberModel& rank_at(Place place) { return sides_of(place) == 0 ? inside : on_side; }
};

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

    /// At most kFarRank.
    [[nodiscard]] std::size_t rank_of(std::size_t vertex, std::size_t target) const {
        std::size_t rank = 0;
        bool found = false;
        visit(vertex, [&](std::size_t other) {
            found = other == target;
            return !found && ++rank < kFarRank;
        });
        return found ? rank : kFarRank;
    }
    /// The vertex itself where there are not so many.
    [[nodiscard]] std::size_t target_of(std::size_t vertex, std::uint64_t rank) const {
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

/// Levels count from the mesh's first one, alternately up and (rare) down; 0: it stays.
std::uint64_t number_of_level(std::uint8_t level, std::uint8_t first_level) {
    if (level == NestedMesh::kStays) return 0;
    return level >= first_level ? 2U * static_cast<unsigned>(level - first_level) + 1U
                                : 2U * static_cast<unsigned>(first_level - level);
}
std::uint8_t level_of_number(std::uint64_t number, std::uint8_t first_level) {
    if (number == 0) return NestedMesh::kStays;
    const auto apart = static_cast<int>(number / 2);
    return static_cast<std::uint8_t>((number & 1U) != 0 ? first_level + apart : first_level - apart);
}

void write_levels(RangeEncoder& bytes, const NestedMesh& mesh, std::uint8_t first_level) {
    NumberModel model;
    for (const std::uint8_t level : mesh.gone_level) bytes.number(model, number_of_level(level, first_level));
}

void write_targets(RangeEncoder& bytes, const NestedMesh& mesh, std::span<const Place> places) {
    const TargetRanks ranks{places, mesh.gone_level};
    TargetModels models;
    for (std::size_t vertex = 0; vertex < mesh.vertices(); ++vertex) {
        if (mesh.gone_level[vertex] == NestedMesh::kStays) continue;
        const std::size_t rank = ranks.rank_of(vertex, mesh.target[vertex]);
        bytes.number(models.rank_at(places[vertex]), rank);
        if (rank == kFarRank) bytes.number(models.far, mesh.target[vertex]);
    }
}

bool read_levels(RangeDecoder& bytes, NestedMesh& mesh, std::size_t vertices, std::uint8_t first_level) {
    NumberModel model;
    mesh.gone_level.reserve(vertices);
    for (std::size_t vertex = 0; vertex < vertices; ++vertex) {
        const std::uint64_t number = bytes.number(model);
        if (number > 2U * kLastLevel + 1U) return false;
        mesh.gone_level.push_back(level_of_number(number, first_level));
    }
    return true;
}

bool read_targets(RangeDecoder& bytes, NestedMesh& mesh, std::span<const Place> places) {
    const TargetRanks ranks{places, mesh.gone_level};
    TargetModels models;
    mesh.target.assign(mesh.vertices(), 0);
    for (std::size_t vertex = 0; vertex < mesh.vertices() && !bytes.overrun(); ++vertex) {
        if (mesh.gone_level[vertex] == NestedMesh::kStays) continue;
        const std::uint64_t rank = bytes.number(models.rank_at(places[vertex]));
        const std::uint64_t target =
            rank < kFarRank ? ranks.target_of(vertex, rank) : bytes.number(models.far);
        if (rank > kFarRank || target >= mesh.vertices()) return false;
        mesh.target[vertex] = static_cast<std::uint16_t>(target);
    }
    return true;
}

tl::expected<NestedMesh, std::string> read_mesh(RangeDecoder& bytes, std::uint8_t first_level,
                                                double height_step_m) {
    NestedMesh mesh;
    BitModel kind;
    mesh.whole_grid = bytes.bit(kind);
    if (!mesh.whole_grid) {
        auto places = decode_places(bytes, height_step_m);
        if (!places) return tl::unexpected(places.error());
        mesh.posts = std::move(places->posts);
        mesh.fine_posts = std::move(places->fine_posts);
    }
    const auto places = vertex_places(mesh);
    if (!read_levels(bytes, mesh, places.size(), first_level))
        return tl::unexpected(std::string{"a vertex goes at a level that there is not"});
    if (!read_targets(bytes, mesh, places))
        return tl::unexpected(std::string{"a vertex goes to one that there is not"});
    if (!mesh.whole_grid) {
        auto triangles = decode_triangles(bytes, places);
        if (!triangles) return tl::unexpected(triangles.error());
        mesh.triangles = std::move(*triangles);
    }
    if (!bytes.at_end()) return tl::unexpected(std::string{"it is not as long as it says"});
    return mesh;
}

}  // namespace

tl::expected<std::vector<std::uint8_t>, std::string> encode_mesh(const NestedMesh& mesh,
                                                                 std::uint8_t first_level,
                                                                 std::uint8_t last_level,
                                                                 double height_step_m) {
    if (auto sound = check_structure(mesh, last_level); !sound) return tl::unexpected(sound.error());
    RangeEncoder bytes;
    BitModel kind;
    bytes.bit(kind, mesh.whole_grid);
    if (!mesh.whole_grid) encode_places(bytes, mesh, height_step_m);
    const auto places = vertex_places(mesh);
    write_levels(bytes, mesh, first_level);
    write_targets(bytes, mesh, places);
    if (!mesh.whole_grid) encode_triangles(bytes, places, canonical_triangles(mesh));
    return bytes.finish();
}

tl::expected<NestedMesh, std::string> decode_mesh(std::span<const std::uint8_t> bytes,
                                                  std::uint8_t first_level, std::uint8_t last_level,
                                                  double height_step_m) {
    RangeDecoder decoder{bytes};
    auto mesh = read_mesh(decoder, first_level, height_step_m);
    if (!mesh) return mesh;
    if (auto sound = check_structure(*mesh, last_level); !sound) return tl::unexpected(sound.error());
    return mesh;
}

}  // namespace eyepoint::terrain
