#include "terrain/database/mesh_place_codec.hpp"

#include <algorithm>
#include <bit>
#include <optional>
#include <tuple>
#include <utility>

#include "terrain/database/interpolate.hpp"
#include "terrain/database/mesh_places.hpp"
#include "terrain/database/zigzag.hpp"

namespace eyepoint::terrain {

namespace {

/// Depths below the tile whose posts a mesh can have.
constexpr int kDepthsBelow = std::countr_zero(static_cast<std::uint32_t>(kPostUnits));
constexpr std::uint64_t kCellCodes = (std::uint64_t{1} << 2 * kDepthsBelow) - 1;

/// A fine post by the cell of the own grid it lies in, and where in the cell.
struct InCell {
    std::uint32_t cell = 0;  ///< row * kBlockPosts + column
    std::uint64_t code = 0;
    auto operator<=>(const InCell&) const = default;
};

// The places in a cell are numbered depth by depth: first the three that the children's posts add to the own
// one, then the twelve of the grandchildren's, and so on; at depth j there are 4^(j-1) groups of three.
std::uint64_t code_in_cell(Place place) {
    auto x = static_cast<std::uint64_t>(place.x % kPostUnits);
    auto y = static_cast<std::uint64_t>(place.y % kPostUnits);
    const int shift = std::countr_zero(x | y);
    x >>= shift;
    y >>= shift;
    const std::uint64_t side = std::uint64_t{1} << (kDepthsBelow - shift - 1);
    return side * side - 1 + 3 * (y / 2 * side + x / 2) + (x % 2 + 2 * (y % 2) - 1);
}
Place place_in_cell(std::uint64_t code) {
    const auto depth = static_cast<int>((std::bit_width(code + 1) - 1) / 2 + 1);
    const std::uint64_t side = std::uint64_t{1} << (depth - 1);
    const std::uint64_t at = code - (side * side - 1), parity = at % 3 + 1;
    const int shift = kDepthsBelow - depth;
    return {static_cast<std::int32_t>((at / 3 % side * 2 + parity % 2) << shift),
            static_cast<std::int32_t>((at / 3 / side * 2 + parity / 2) << shift)};
}

InCell in_cell(Place place) {
    return {static_cast<std::uint32_t>(place.y / kPostUnits * kBlockPosts + place.x / kPostUnits),
            code_in_cell(place)};
}
Place place_of(InCell post) {
    const Place corner = place_of_post(static_cast<int>(post.cell)), inner = place_in_cell(post.code);
    return {corner.x + inner.x, corner.y + inner.y};
}

/// For each place the nearest of those before it, after which its height is foretold; itself for the first.
std::vector<std::size_t> models_of(std::span<const Place> places) {
    const PlaceIndex index{places};
    std::vector<std::size_t> models(places.size());
    for (std::size_t i = 1; i < places.size(); ++i) {
        index.visit_from(places[i], [&](std::size_t other) {
            if (other < i) models[i] = other;
            return other >= i;
        });
    }
    return models;
}

struct PlaceModels {
    NumberModel count;
    NumberModel post_gap;
    NumberModel cell_gap;
    NumberModel code;
    NumberModel height;
};

/// Nothing where it is not below the limit.
std::optional<std::uint64_t> read_below(RangeDecoder& bytes, NumberModel& model, std::uint64_t limit) {
    const std::uint64_t number = bytes.number(model);
    return number < limit ? std::optional{number} : std::nullopt;
}

void write_fine_places(RangeEncoder& bytes, PlaceModels& models, std::span<const Place> places) {
    std::vector<InCell> posts;
    for (const Place place : places) posts.push_back(in_cell(place));
    std::ranges::sort(posts);
    std::uint32_t cell = 0;
    for (const InCell post : posts) {
        bytes.number(models.cell_gap, post.cell - cell);
        bytes.number(models.code, post.code);
        cell = post.cell;
    }
}

void write_heights(RangeEncoder& bytes, PlaceModels& models, const NestedMesh& mesh,
                   std::span<const Place> places, double height_step_m) {
    std::vector<std::uint32_t> quanta;
    for (const auto& post : mesh.fine_posts)
        quanta.push_back(static_cast<std::uint32_t>(to_quanta(post.height_m, height_step_m)));
    const auto before = models_of(places);
    for (std::size_t i = 0; i < quanta.size(); ++i)
        bytes.number(models.height, zigzag(i == 0 ? quanta[0] : quanta[i] - quanta[before[i]]));
}

std::optional<std::vector<std::uint16_t>> read_posts(RangeDecoder& bytes, PlaceModels& models,
                                                     std::size_t count) {
    std::vector<std::uint16_t> posts;
    std::uint64_t next = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const auto gap = read_below(bytes, models.post_gap, kMaxVertices - next);
        if (!gap) return std::nullopt;
        posts.push_back(static_cast<std::uint16_t>(next + *gap));
        next += *gap + 1;
    }
    return posts;
}

std::optional<std::vector<Place>> read_fine_places(RangeDecoder& bytes, PlaceModels& models,
                                                   std::size_t count) {
    std::vector<Place> places;
    std::uint64_t cell = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const auto gap = read_below(bytes, models.cell_gap, kMaxVertices - cell);
        const auto code = read_below(bytes, models.code, kCellCodes);
        if (!gap || !code) return std::nullopt;
        cell += *gap;
        const Place place = place_of(InCell{static_cast<std::uint32_t>(cell), *code});
        if (std::max(place.x, place.y) > std::int32_t{kPlaceUnits}) return std::nullopt;
        places.push_back(place);
    }
    std::ranges::sort(places, {}, [](Place place) { return std::tuple{place.y, place.x}; });
    return places;
}

std::vector<float> read_heights(RangeDecoder& bytes, PlaceModels& models, std::span<const Place> places,
                                double height_step_m) {
    const auto before = models_of(places);
    std::vector<std::uint32_t> quanta(places.size(), 0);
    std::vector<float> heights_m;
    for (std::size_t i = 0; i < quanta.size(); ++i) {
        const auto residual = unzigzag(static_cast<std::uint32_t>(bytes.number(models.height)));
        quanta[i] = residual + (i == 0 ? 0 : quanta[before[i]]);
        heights_m.push_back(to_metres(static_cast<std::int32_t>(quanta[i]), height_step_m));
    }
    return heights_m;
}

}  // namespace

void encode_places(RangeEncoder& bytes, const NestedMesh& mesh, double height_step_m) {
    PlaceModels models;
    bytes.number(models.count, mesh.posts.size());
    bytes.number(models.count, mesh.fine_posts.size());
    std::size_t next = 0;
    for (const std::uint16_t post : mesh.posts) {
        bytes.number(models.post_gap, post - next);
        next = post + std::size_t{1};
    }
    std::vector<Place> places;
    for (const auto& post : mesh.fine_posts) places.push_back(place_of(post));
    write_fine_places(bytes, models, places);
    write_heights(bytes, models, mesh, places, height_step_m);
}

tl::expected<DecodedPlaces, std::string> decode_places(RangeDecoder& bytes, double height_step_m) {
    PlaceModels models;
    const auto own = read_below(bytes, models.count, kMaxVertices + 1);
    const auto fine = read_below(bytes, models.count, kMaxVertices + 1);
    if (!own || !fine) return tl::unexpected(std::string{"it has more vertices than posts"});
    auto posts = read_posts(bytes, models, *own);
    const auto places = posts ? read_fine_places(bytes, models, *fine) : std::nullopt;
    if (!places) return tl::unexpected(std::string{"a vertex lies outside the tile"});
    const auto heights_m = read_heights(bytes, models, *places, height_step_m);
    DecodedPlaces decoded{std::move(*posts), {}};
    for (std::size_t i = 0; i < places->size(); ++i) {
        decoded.fine_posts.push_back({static_cast<std::uint32_t>((*places)[i].x),
                                      static_cast<std::uint32_t>((*places)[i].y), heights_m[i]});
    }
    return decoded;
}

}  // namespace eyepoint::terrain
