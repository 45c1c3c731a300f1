#include "tools/terrain/nest/vertex_places.hpp"

#include <algorithm>

#include "terrain/database/database.hpp"

namespace eyepoint::tools {

using namespace terrain;

namespace {

bool is_tile_corner(const Placed& place) {
    const auto at_end = [](std::int64_t at) { return at == 0 || at == kPlaceUnits; };
    return at_end(place.x) && at_end(place.y);
}

Placed placed(const MeshVertex& vertex, TileId tile, const SampledSurface& surface) {
    const double side_deg = tile_side_deg(tile.depth);
    const GeographicExtent sides = extent(tile);
    const double x = static_cast<double>(vertex.x) / kPlaceUnits,
                 y = static_cast<double>(vertex.y) / kPlaceUnits;
    const double cells = surface.side() - 1;
    return {
        vertex.x,
        vertex.y,
        {x * cells, y * cells,
         surface.position_m(sides.south_deg + y * side_deg, sides.west_deg + x * side_deg, vertex.height_m)}};
}

}  // namespace

bool same_place(const Placed& a, const Placed& b) { return a.x == b.x && a.y == b.y; }

bool counterclockwise(const PlacedTriangle& corners) {
    const auto& [a, b, c] = corners;
    // Places slid beyond the tile may be far from it: the products need more than 64 bits.
    __extension__ using Wide = __int128;
    return Wide{b->x - a->x} * (c->y - a->y) > Wide{b->y - a->y} * (c->x - a->x);
}

bool is_empty(const PlacedTriangle& corners) {
    return same_place(*corners[0], *corners[1]) || same_place(*corners[1], *corners[2]) ||
           same_place(*corners[2], *corners[0]);
}

VertexPlaces::VertexPlaces(const CollapseRequest& request, const SampledSurface& surface) {
    for (const MeshVertex& vertex : request.mesh.vertices) {
        own_.push_back(placed(vertex, request.tile, surface));
        is_corner_.push_back(is_tile_corner(own_.back()));
    }
    for (const EdgeFate& fate : request.fates) {
        auto& steps = later_.emplace_back();
        for (const EdgeFate::Step& step : fate.steps)
            steps.push_back({step.level, placed(step.place, request.tile, surface)});
    }
}

const Placed& VertexPlaces::at_level(Vertex v, int level) const {
    const Placed* place = &own_[v];
    for (const Later& later : later_[v]) {
        if (later.level <= level) place = &later.place;
    }
    return *place;
}

int VertexPlaces::next_level(const std::array<Vertex, 3>& triangle, int level) const {
    int next = kNoLevel;
    for (const Vertex corner : triangle) {
        for (const Later& later : later_[corner]) {
            if (later.level > level) next = std::min(next, later.level);
        }
    }
    return next;
}

}  // namespace eyepoint::tools
