#include "terrain/database/mesh_place_codec.hpp"

#include <algorithm>
#include <bit>
#include <tuple>

#include "terrain/database/interpolate.hpp"
#include "terrain/database/mesh_places.hpp"

namespace eyepoint::terrain {

namespace {

constexpr std::size_t kMaxVertices = std::size_t{kBlockPosts} * kBlockPosts;
constexpr std::size_t kMaxPlanes = 4;
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
Place place_of_code(InCell post) {
    const Place corner = place_of_post(static_cast<int>(post.cell)), inner = place_in_cell(post.code);
    return {corner.x + inner.x, corner.y + inner.y};
}

std::vector<Place> places_of(std::span<const NestedMesh::FinePost> posts) {
    std::vector<Place> places;
    for (const auto& post : posts) places.push_back(place_of(post));
    return places;
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

void append_fine_places(std::vector<std::uint8_t>& bytes, std::span<const Place> places) {
    std::vector<InCell> posts;
    for (const Place place : places) posts.push_back(in_cell(place));
    std::ranges::sort(posts);
    std::uint32_t cell = 0;
    for (const InCell post : posts) {
        append_sum(bytes, post.cell - cell);
        cell = post.cell;
    }
    std::vector<std::uint8_t> escaped;
    for (const InCell post : posts) {
        bytes.push_back(static_cast<std::uint8_t>(std::min<std::uint64_t>(post.code, kEscape)));
        if (post.code >= kEscape) append_varint(escaped, post.code - kEscape);
    }
    bytes.insert(bytes.end(), escaped.begin(), escaped.end());
}

void append_fine_heights(std::vector<std::uint8_t>& bytes, const NestedMesh& mesh,
                         std::span<const Place> places, double height_step_m) {
    std::vector<std::uint32_t> quanta, residuals;
    for (const auto& post : mesh.fine_posts)
        quanta.push_back(static_cast<std::uint32_t>(to_quanta(post.height_m, height_step_m)));
    const auto models = models_of(places);
    for (std::size_t i = 0; i < quanta.size(); ++i)
        residuals.push_back(zigzag(i == 0 ? quanta[0] : quanta[i] - quanta[models[i]]));
    const std::uint32_t largest = residuals.empty() ? 0 : std::ranges::max(residuals);
    const auto planes = static_cast<std::size_t>((std::bit_width(largest) + 7) / 8);
    bytes.push_back(static_cast<std::uint8_t>(planes));
    for (std::size_t plane = 0; plane < planes; ++plane) {
        for (const std::uint32_t residual : residuals)
            bytes.push_back(static_cast<std::uint8_t>(residual >> (8 * plane)));
    }
}

bool read_posts(ByteReader& bytes, std::vector<std::uint16_t>& posts) {
    std::size_t next = 0;
    for (std::uint16_t& post : posts) {
        next += bytes.sum();
        if (next >= kMaxVertices) return false;
        post = static_cast<std::uint16_t>(next++);
    }
    return true;
}

bool read_fine_places(ByteReader& bytes, std::vector<Place>& places) {
    std::vector<InCell> posts(places.size());
    std::size_t cell = 0;
    for (InCell& post : posts) {
        cell += bytes.sum();
        if (cell >= kMaxVertices) return false;
        post.cell = static_cast<std::uint32_t>(cell);
    }
    for (InCell& post : posts) post.code = bytes.number<std::uint8_t>();
    for (InCell& post : posts) {
        if (post.code == kEscape) post.code += bytes.varint();
        if (post.code >= kCellCodes) return false;
    }
    std::ranges::transform(posts, places.begin(), place_of_code);
    std::ranges::sort(places, {}, [](Place place) { return std::tuple{place.y, place.x}; });
    return std::ranges::all_of(
        places, [](Place place) { return std::max(place.x, place.y) <= std::int32_t{kPlaceUnits}; });
}

std::vector<float> read_fine_heights(ByteReader& bytes, std::span<const Place> places, double height_step_m) {
    const auto models = models_of(places);
    const std::size_t planes = std::min<std::size_t>(bytes.number<std::uint8_t>(), kMaxPlanes);
    std::vector<std::uint32_t> quanta(places.size(), 0);
    for (std::size_t plane = 0; plane < planes; ++plane) {
        for (std::uint32_t& residual : quanta)
            residual |= std::uint32_t{bytes.number<std::uint8_t>()} << (8 * plane);
    }
    std::vector<float> heights_m;
    for (std::size_t i = 0; i < quanta.size(); ++i) {
        quanta[i] = unzigzag(quanta[i]) + (i == 0 ? 0 : quanta[models[i]]);
        heights_m.push_back(to_metres(static_cast<std::int32_t>(quanta[i]), height_step_m));
    }
    return heights_m;
}

}  // namespace

std::vector<std::uint8_t> encode_places(const NestedMesh& mesh, double height_step_m) {
    std::vector<std::uint8_t> bytes;
    append_le(bytes, static_cast<std::uint16_t>(mesh.posts.size()));
    append_le(bytes, static_cast<std::uint16_t>(mesh.fine_posts.size()));
    std::size_t next = 0;
    for (const std::uint16_t post : mesh.posts) {
        append_sum(bytes, post - next);
        next = post + std::size_t{1};
    }
    const auto places = places_of(mesh.fine_posts);
    append_fine_places(bytes, places);
    append_fine_heights(bytes, mesh, places, height_step_m);
    return bytes;
}

tl::expected<DecodedPlaces, std::string> decode_places(ByteReader& bytes, double height_step_m) {
    const std::size_t posts = bytes.number<std::uint16_t>(), fine = bytes.number<std::uint16_t>();
    if (posts + fine > kMaxVertices) return tl::unexpected(std::string{"it has more vertices than posts"});
    DecodedPlaces decoded;
    decoded.posts.resize(posts);
    std::vector<Place> places(fine);
    if (!read_posts(bytes, decoded.posts) || !read_fine_places(bytes, places)) {
        return tl::unexpected(std::string{"a vertex lies outside the tile"});
    }
    const auto heights_m = read_fine_heights(bytes, places, height_step_m);
    for (std::size_t i = 0; i < fine; ++i) {
        decoded.fine_posts.push_back(
            {static_cast<std::uint32_t>(places[i].x), static_cast<std::uint32_t>(places[i].y), heights_m[i]});
    }
    if (bytes.failed()) return tl::unexpected(std::string{"its vertices are cut short"});
    return decoded;
}

}  // namespace eyepoint::terrain
