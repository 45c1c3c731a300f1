#include "terrain/database/mesh_places.hpp"

#include <algorithm>
#include <tuple>

namespace eyepoint::terrain {

std::vector<Place> vertex_places(const NestedMesh& mesh) {
    std::vector<Place> places;
    places.reserve(mesh.vertices());
    if (mesh.whole_grid) {
        for (int post = 0; post < kBlockPosts * kBlockPosts; ++post) places.push_back(place_of_post(post));
        return places;
    }
    for (const std::uint16_t post : mesh.posts) places.push_back(place_of_post(post));
    for (const NestedMesh::FinePost& post : mesh.fine_posts) places.push_back(place_of(post));
    return places;
}

PlaceIndex::PlaceIndex(std::span<const Place> places, int cells)
    : cells_(cells), cell_units_(static_cast<std::int32_t>(kPlaceUnits) / cells), order_(places.size()) {
    for (const Place place : places) ++first_[cell_of(place) + 1];
    for (std::size_t cell = 1; cell < first_.size(); ++cell)
        first_[cell] = static_cast<std::uint16_t>(first_[cell] + first_[cell - 1]);
    auto next = first_;
    for (std::size_t i = 0; i < places.size(); ++i)
        order_[next[cell_of(places[i])]++] = static_cast<std::uint16_t>(i);
}

std::size_t PlaceIndex::cell_of(Place place) const {
    return static_cast<std::size_t>(place.y / cell_units_ * kBlockPosts + place.x / cell_units_);
}

std::span<const PlaceIndex::CellOffset> PlaceIndex::cells_by_distance() {
    static const std::vector<CellOffset> offsets = [] {
        std::vector<CellOffset> all;
        for (int y = -kBlockCells; y <= kBlockCells; ++y) {
            for (int x = -kBlockCells; x <= kBlockCells; ++x)
                all.push_back({static_cast<std::int8_t>(x), static_cast<std::int8_t>(y)});
        }
        std::ranges::stable_sort(all, {}, [](CellOffset cell) { return cell.x * cell.x + cell.y * cell.y; });
        return all;
    }();
    return offsets;
}

}  // namespace eyepoint::terrain
