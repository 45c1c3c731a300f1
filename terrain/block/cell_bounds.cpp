#include "terrain/block/cell_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>

#include "terrain/block/block.hpp"
#include "terrain/geodesy/earth.hpp"

namespace eyepoint::terrain {

glm::dmat3 local_axes(const Ecef& centre) {
    const glm::dvec3 up = glm::normalize(centre);
    const glm::dvec3 east = glm::normalize(glm::cross(glm::dvec3{0.0, 0.0, 1.0}, up));
    return {east, glm::cross(up, east), up};
}

namespace {

constexpr int kSide = CellBounds::kSide;
constexpr int kNodes = CellBounds::kNodes;
constexpr int kSteps = CellBounds::kSteps;
constexpr std::size_t kLineEdges = std::size_t{kNodes} * kSide;
static_assert(kSide == kMeshCells);
constexpr int kPostsACell = kBlockCells / kSide;
constexpr std::uint32_t kLeastDepth = 4;
/// The outer lines along parallels run so far inside the tile, cells: a straight line between two nodes of a
/// parallel leaves the tile by less.
constexpr double kInset = 1.0 / 64.0;
/// Greatest angle between the vertical of the ellipsoid and the direction from the Earth's centre, radians.
constexpr double kDeflection = 0.0034;
/// Depth of a line where nothing is drawn, metres.
constexpr float kBottomless = 1e6F;
constexpr float kLowest = std::numeric_limits<float>::lowest();

/// std::min and std::max take references, which costs here.
float least(float a, float b) { return a < b ? a : b; }
float most(float a, float b) { return a > b ? a : b; }

/// A box of places, in cells from the tile's south-west corner.
struct Box {
    glm::vec2 low{std::numeric_limits<float>::max()};
    glm::vec2 high{kLowest};

    void add(const glm::vec2& place) {
        low = {least(low.x, place.x), least(low.y, place.y)};
        high = {most(high.x, place.x), most(high.y, place.y)};
    }
    void add(const Box& box) {
        add(box.low);
        add(box.high);
    }
};

/// A place that a vertex may be drawn at, local metres, and the first step that allows for it.
struct Stop {
    glm::vec3 local{0.0F};
    std::uint32_t step = 0;
    glm::vec2 cell{0.0F};
};

/// The vertices of the block, and those of the parent that are wanted, as seen from the block.
class Places {
  public:
    Places(const Block& block, const Block* parent, const Ecef& centre, int last_limit)
        : block_(block),
          parent_(parent),
          centre_(centre),
          to_local_(glm::transpose(local_axes(centre))),
          first_limit_(last_limit - (kSteps - 1)),
          last_limit_(last_limit),
          locals_(block.vertices.size() + (parent != nullptr ? parent->vertices.size() : 0)),
          known_(locals_.size(), false) {}

    [[nodiscard]] glm::vec3 local(const Ecef& point) const { return {to_local_ * (point - centre_)}; }

    /// A vertex's number from here on: the parent's come after the block's own.
    [[nodiscard]] std::uint32_t of_parent(std::uint32_t vertex) const {
        return static_cast<std::uint32_t>(block_.vertices.size()) + vertex;
    }

    /// Calls for every stop on a vertex's way, with its number and step.
    template <typename Visit>
    void along(std::uint32_t number, Visit visit) const {
        std::uint32_t step = 0;
        visit(number, step);
        const auto own = static_cast<std::uint32_t>(block_.vertices.size());
        while (true) {
            const BlockVertex& vertex = at(number);
            const int gone = vertex.gone_level();
            if (gone == NestedMesh::kStays) {
                if (number >= own || parent_ == nullptr || vertex.next() == kNoVertex) return;
                number = own + vertex.next();
                continue;
            }
            // It sets off once the level asked for is above gone - 1.
            if (gone - 1 >= last_limit_) return;
            step = std::max(step, static_cast<std::uint32_t>(std::max(gone - first_limit_, 0)));
            number = (number >= own ? own : 0) + vertex.next();
            visit(number, step);
        }
    }

    [[nodiscard]] glm::vec2 cell(std::uint32_t number) const {
        const std::uint32_t place = at(number).place;
        constexpr float kCells = static_cast<float>(kSide) / static_cast<float>(kVertexPlaceUnits);
        const glm::vec2 cells =
            glm::vec2{static_cast<float>(place & 0xffffU), static_cast<float>(place >> 16)} * kCells;
        if (number < block_.vertices.size()) return cells;
        const TileId tile = block_.data.tile;
        return cells * 2.0F -
               glm::vec2{static_cast<float>(tile.x & 1U), static_cast<float>(tile.y & 1U)} * float{kSide};
    }

    [[nodiscard]] glm::vec3 local(std::uint32_t number) {
        if (!known_[number]) {
            locals_[number] = local(at(number).position());
            known_[number] = true;
        }
        return locals_[number];
    }

  private:
    [[nodiscard]] const BlockVertex& at(std::uint32_t number) const {
        return number < block_.vertices.size() ? block_.vertices[number]
                                               : parent_->vertices[number - block_.vertices.size()];
    }

    const Block& block_;
    const Block* parent_;
    Ecef centre_;
    glm::dmat3 to_local_;
    int first_limit_, last_limit_;
    std::vector<glm::vec3> locals_;
    std::vector<bool> known_;
};

/// A plane over one edge of the grid of nodes, and how far below it the mesh may come.
struct EdgeLow {
    glm::vec2 origin{0.0F};
    glm::vec2 slope{0.0F};
    float height = 0.0F;
    float drop = kLowest;  ///< kLowest: nothing is drawn over the edge

    /// Unit normal of the plane through the edge and the Earth's centre, and a point of the plane.
    glm::vec3 normal{0.0F};
    glm::vec3 on_plane{0.0F};

    /// Lowers the edge under what lies over it of the convex hull of some stops: its section with the plane
    /// is the hull of where the plane cuts the lines from stop to stop.
    void lower(std::span<const Stop> stops, std::vector<glm::vec2>& scratch) {
        scratch.clear();
        float most_below = kLowest;
        for (const Stop& stop : stops) {
            const float below = height + slope.x * (stop.local.x - origin.x) +
                                slope.y * (stop.local.y - origin.y) - stop.local.z;
            scratch.emplace_back(glm::dot(normal, stop.local - on_plane), below);
            most_below = most(most_below, below);
        }
        if (most_below <= drop) return;
        for (std::size_t i = 0; i < scratch.size(); ++i) {
            for (std::size_t j = i; j < scratch.size(); ++j) {
                const glm::vec2 &p = scratch[i], &q = scratch[j];
                if (most(p.y, q.y) <= drop) continue;
                if (std::abs(p.x) <= margin_m) drop = most(drop, p.y);
                if (std::abs(q.x) <= margin_m) drop = most(drop, q.y);
                if (p.x * q.x >= 0.0F) continue;
                // Within the margin on both sides of the plane.
                const float a = p.x / (p.x - q.x),
                            spread = std::abs(q.y - p.y) * margin_m / std::abs(p.x - q.x);
                drop = most(drop, std::min(p.y + a * (q.y - p.y) + spread, most(p.y, q.y)));
            }
        }
    }
    float margin_m = 0.0F;
};

class BoundsMaker {
  public:
    BoundsMaker(const Block& block, const Block* parent, int last_limit)
        : block_(block), parent_(parent), places_(block, parent, middle(block.data), last_limit) {
        bounds_.centre = middle(block.data);
        bounds_.last_limit = last_limit;
    }

    CellBounds make() {
        follow_vertices();
        set_nodes();
        set_edges();
        for (step_ = 0; step_ < kSteps; ++step_) {
            set_tops();
            set_lows();
        }
        return bounds_;
    }

  private:
    static Ecef middle(const BlockData& data) {
        constexpr int kMiddle = kBlockCells / 2;
        return to_ecef({post_latitude_deg(data.tile, kMiddle), post_longitude_deg(data.tile, kMiddle),
                        EllipsoidalHeight{double{data.height_m(kMiddle, kMiddle)}}});
    }
    static std::size_t node(int row, int column) { return static_cast<std::size_t>(row * kNodes + column); }

    /// Lists the stops of the block's vertices, and takes the block's extent from them.
    void follow_vertices() {
        float low = std::numeric_limits<float>::max(), high = kLowest, radius2 = 0.0F;
        stops_.reserve(block_.vertices.size() * 4);
        first_stop_.reserve(block_.vertices.size() + 1);
        for (std::uint32_t vertex = 0; vertex < block_.vertices.size(); ++vertex) {
            first_stop_.push_back(static_cast<std::uint32_t>(stops_.size()));
            places_.along(vertex, [&](std::uint32_t number, std::uint32_t step) {
                const glm::vec3 local = places_.local(number);
                stops_.push_back({local, step, places_.cell(number)});
                low = least(low, local.z);
                high = most(high, local.z);
                radius2 = most(radius2, glm::dot(local, local));
            });
        }
        first_stop_.push_back(static_cast<std::uint32_t>(stops_.size()));
        bounds_.height_range_m = high - low;
        bounds_.radius_m = std::sqrt(radius2) * 1.00001F;
        rounding_m_ = 1e-6F * bounds_.radius_m;
    }

    [[nodiscard]] std::span<const Stop> stops_of(std::uint32_t vertex) const {
        return std::span(stops_).subspan(first_stop_[vertex], first_stop_[vertex + 1] - first_stop_[vertex]);
    }

    void add_way(Box& box, std::uint32_t vertex) const {
        for (const Stop& stop : stops_of(vertex)) {
            if (stop.step <= static_cast<std::uint32_t>(step_)) box.add(stop.cell);
        }
    }

    void set_nodes() {
        for (int row = 0; row < kNodes; ++row) {
            const double inset = row == 0 ? kInset : (row == kSide ? -kInset : 0.0);
            const double latitude_deg = post_latitude_deg(block_.data.tile, row * kPostsACell) +
                                        inset * kPostsACell * post_spacing_deg(block_.data.tile.depth);
            for (int column = 0; column < kNodes; ++column) {
                const double height_m = block_.data.height_m(row * kPostsACell, column * kPostsACell);
                const glm::vec3 place = places_.local(
                    to_ecef({latitude_deg, post_longitude_deg(block_.data.tile, column * kPostsACell),
                             EllipsoidalHeight{height_m}}));
                bounds_.node_x[node(row, column)] = place.x;
                bounds_.node_y[node(row, column)] = place.y;
                height_[node(row, column)] = place.z;
            }
        }
    }

    [[nodiscard]] glm::vec2 node_place(std::size_t i) const { return {bounds_.node_x[i], bounds_.node_y[i]}; }

    /// Rise a metre between two nodes, seen along x or y.
    [[nodiscard]] float rise(std::size_t from, std::size_t to, int axis) const {
        const float run = node_place(to)[axis] - node_place(from)[axis];
        return std::abs(run) > 1e-3F ? std::clamp((height_[to] - height_[from]) / run, -10.0F, 10.0F) : 0.0F;
    }

    /// Slope of the surface about a cell, from its four nodes.
    [[nodiscard]] glm::vec2 cell_slope(int row, int column) const {
        const std::size_t sw = node(row, column), se = node(row, column + 1), nw = node(row + 1, column),
                          ne = node(row + 1, column + 1);
        return {0.5F * (rise(sw, se, 0) + rise(nw, ne, 0)), 0.5F * (rise(sw, nw, 1) + rise(se, ne, 1))};
    }

    /// The first list that a step allows for.
    [[nodiscard]] const NestedLevel& list() const {
        const int level =
            std::clamp(bounds_.list_level(step_), int{block_.first_level}, int{block_.last_level});
        return block_.levels[static_cast<std::size_t>(level - block_.first_level)];
    }
    [[nodiscard]] CellBounds::Step& step() { return bounds_.steps[static_cast<std::size_t>(step_)]; }

    void set_tops() {
        const NestedLevel& first = list();
        std::vector<std::uint8_t> counted(block_.vertices.size(), std::uint8_t{CellBounds::kCells});
        for (std::size_t cell = 0; cell < CellBounds::kCells; ++cell) {
            vertices_.clear();
            for (std::uint32_t i = first.cell_first[cell]; i < first.cell_first[cell + 1]; ++i) {
                const std::uint16_t vertex = block_.indices[i];
                if (counted[vertex] == cell) continue;
                counted[vertex] = static_cast<std::uint8_t>(cell);
                vertices_.push_back(vertex);
            }
            set_top(cell, cell_slope(static_cast<int>(cell) / kSide, static_cast<int>(cell) % kSide));
        }
        std::fill(counted.begin(), counted.end(), std::uint8_t{0});
        vertices_.clear();
        for (std::uint32_t i = first.first(); i < first.first() + first.count(); ++i) {
            if (std::exchange(counted[block_.indices[i]], std::uint8_t{1}) == 0)
                vertices_.push_back(block_.indices[i]);
        }
        set_top(CellBounds::kCells, {rise(node(kSide / 2, 0), node(kSide / 2, kSide), 0),
                                     rise(node(0, kSide / 2), node(kSide, kSide / 2), 1)});
    }

    /// The rectangle and the plane of this slope over vertices_.
    void set_top(std::size_t cell, glm::vec2 slope) {
        Box box;
        float above = kLowest;
        for (const std::uint16_t vertex : vertices_) {
            for (const Stop& stop : stops_of(vertex)) {
                if (stop.step > static_cast<std::uint32_t>(step_)) break;
                box.add(glm::vec2{stop.local});
                above = most(above, stop.local.z - slope.x * stop.local.x - slope.y * stop.local.y);
            }
        }
        const bool empty = vertices_.empty();
        CellBounds::Step& bounds = step();
        bounds.west[cell] = empty ? 1.0F : box.low.x - rounding_m_;
        bounds.east[cell] = empty ? 0.0F : box.high.x + rounding_m_;
        bounds.south[cell] = empty ? 0.0F : box.low.y - rounding_m_;
        bounds.north[cell] = empty ? 0.0F : box.high.y + rounding_m_;
        bounds_.slope_x[cell] = slope.x;
        bounds_.slope_y[cell] = slope.y;
        bounds.top[cell] = empty ? 0.0F
                                 : above + slope.x * bounds.west[cell] + slope.y * bounds.south[cell] +
                                       rounding_m_ * (2.0F + std::abs(slope.x) + std::abs(slope.y));
    }

    /// Slope at an edge: along it its own, across it the mean of the cells beside it.
    [[nodiscard]] EdgeLow row_edge(int row, int column) const {
        const float across = 0.5F * (cell_slope(std::max(row - 1, 0), column).y +
                                     cell_slope(std::min(row, kSide - 1), column).y);
        const std::size_t from = node(row, column);
        return edge(from, node(row, column + 1), {rise(from, node(row, column + 1), 0), across});
    }
    [[nodiscard]] EdgeLow column_edge(int row, int column) const {
        const float across = 0.5F * (cell_slope(row, std::max(column - 1, 0)).x +
                                     cell_slope(row, std::min(column, kSide - 1)).x);
        const std::size_t from = node(row, column);
        return edge(from, node(row + 1, column), {across, rise(from, node(row + 1, column), 1)});
    }

    /// How far, in cells, a triangle's ground may reach beyond the box of its corners' places: great circles
    /// against parallels, verticals against directions from the Earth's centre.
    [[nodiscard]] float reach() const {
        const double cell_rad =
            tile_side_deg(block_.data.tile.depth) / kSide * 3.14159265358979323846 / 180.0;
        const double cell_m =
            glm::distance(node_place(node(kSide / 2, kSide / 2)), node_place(node(kSide / 2, kSide / 2 + 1)));
        return static_cast<float>(4.0 * cell_rad + kDeflection * double{bounds_.height_range_m} / cell_m +
                                  kInset);
    }

    void set_edges() {
        for (int line = 0; line < kNodes; ++line) {
            for (int at = 0; at < kSide; ++at) {
                rows_[static_cast<std::size_t>(line * kSide + at)] = row_edge(line, at);
                columns_[static_cast<std::size_t>(line * kSide + at)] = column_edge(at, line);
            }
        }
    }

    [[nodiscard]] EdgeLow edge(std::size_t from, std::size_t to, glm::vec2 slope) const {
        EdgeLow result{node_place(from), slope, height_[from]};
        const glm::vec3 a{result.origin, result.height}, b{node_place(to), height_[to]};
        const glm::dvec3 earth_centre{0.0, 0.0, -glm::length(bounds_.centre)};
        result.normal =
            glm::vec3{glm::normalize(glm::cross(glm::dvec3{a} - earth_centre, glm::dvec3{b} - earth_centre))};
        result.on_plane = a;
        result.margin_m = rounding_m_;
        return result;
    }

    void set_lows() {
        for (EdgeLow& edge : rows_) edge.drop = kLowest;
        for (EdgeLow& edge : columns_) edge.drop = kLowest;
        const NestedLevel& first = list();
        const float reach_cells = reach();
        for (std::uint32_t i = first.first(); i < first.first() + first.count(); i += 3) {
            Box box;
            for (std::uint32_t corner = i; corner < i + 3; ++corner) add_way(box, block_.indices[corner]);
            lower_under(box, reach_cells, [&](EdgeLow& edge) {
                way_.clear();
                for (std::uint32_t corner = i; corner < i + 3; ++corner) {
                    for (const Stop& stop : stops_of(block_.indices[corner])) {
                        if (stop.step <= static_cast<std::uint32_t>(step_)) way_.push_back(stop);
                    }
                }
                edge.lower(way_, scratch_);
            });
        }
        if (parent_ != nullptr && bounds_.level_limit(step_) > int{block_.last_level})
            lower_under_siblings(reach_cells);
        join_lows();
    }

    /// Above the last level, triangles of the tile's siblings may slide over it: those of the parent's first
    /// level that are not the tile's own.
    void lower_under_siblings(float reach_cells) {
        std::vector<Box> boxes(parent_->vertices.size());
        for (std::uint32_t vertex = 0; vertex < boxes.size(); ++vertex) {
            places_.along(places_.of_parent(vertex), [&](std::uint32_t number, std::uint32_t step) {
                if (step <= static_cast<std::uint32_t>(step_)) boxes[vertex].add(places_.cell(number));
            });
        }
        const NestedLevel& first = parent_->levels.front();
        const int own_column = static_cast<int>(block_.data.tile.x & 1U) * (kSide / 2);
        const int own_row = static_cast<int>(block_.data.tile.y & 1U) * (kSide / 2);
        for (int cell = 0; cell < kSide * kSide; ++cell) {
            const int column = cell % kSide - own_column, row = cell / kSide - own_row;
            if (column >= 0 && column < kSide / 2 && row >= 0 && row < kSide / 2) continue;
            const auto index = static_cast<std::size_t>(cell);
            for (std::uint32_t i = first.cell_first[index]; i < first.cell_first[index + 1]; i += 3) {
                Box box;
                for (std::uint32_t corner = i; corner < i + 3; ++corner)
                    box.add(boxes[parent_->indices[corner]]);
                lower_under(box, reach_cells, [&](EdgeLow& edge) {
                    way_.clear();
                    for (std::uint32_t corner = i; corner < i + 3; ++corner) {
                        places_.along(places_.of_parent(parent_->indices[corner]),
                                      [&](std::uint32_t number, std::uint32_t step) {
                                          if (step > static_cast<std::uint32_t>(step_)) return;
                                          way_.push_back({places_.local(number), step, {}});
                                      });
                    }
                    edge.lower(way_, scratch_);
                });
            }
        }
    }

    /// Calls for the edges that a triangle may come to lie over, whose corners stay in a box.
    template <typename Lower>
    void lower_under(Box box, float reach_cells, Lower lower) {
        box.low -= reach_cells;
        box.high += reach_cells;
        constexpr auto kEnd = static_cast<float>(kSide);
        if (box.low.x > kEnd || box.low.y > kEnd || box.high.x < 0.0F || box.high.y < 0.0F) return;
        box.low = {most(box.low.x, 0.0F), most(box.low.y, 0.0F)};
        box.high = {least(box.high.x, kEnd), least(box.high.y, kEnd)};
        const auto last = [](float at) { return static_cast<int>(at); };
        const auto first = [](float at) {
            return static_cast<int>(at) + (at > static_cast<float>(static_cast<int>(at)));
        };
        const int west = last(box.low.x), east = std::min(last(box.high.x), kSide - 1);
        const int south = last(box.low.y), north = std::min(last(box.high.y), kSide - 1);
        for (int row = first(box.low.y); row <= last(box.high.y); ++row) {
            for (int column = std::min(west, kSide - 1); column <= east; ++column)
                lower(rows_[static_cast<std::size_t>(row * kSide + column)]);
        }
        for (int column = first(box.low.x); column <= last(box.high.x); ++column) {
            for (int row = std::min(south, kSide - 1); row <= north; ++row)
                lower(columns_[static_cast<std::size_t>(column * kSide + row)]);
        }
    }

    /// A node of a line is as low as the lower of the edges that meet there.
    void join_lows() {
        const auto low_at = [&](const EdgeLow& edge, glm::vec2 place) {
            if (edge.drop == kLowest) return -kBottomless;
            return edge.height + glm::dot(edge.slope, place - edge.origin) - edge.drop -
                   rounding_m_ * (2.0F + std::abs(edge.slope.x) + std::abs(edge.slope.y));
        };
        for (int line = 0; line < kNodes; ++line) {
            for (int at = 0; at < kNodes; ++at) {
                const auto before = static_cast<std::size_t>(line * kSide + std::max(at - 1, 0));
                const auto after = static_cast<std::size_t>(line * kSide + std::min(at, kSide - 1));
                const std::size_t of_row = node(line, at), of_column = node(at, line);
                step().row_low[of_row] = least(low_at(rows_[before], node_place(of_row)),
                                               low_at(rows_[after], node_place(of_row)));
                step().column_low[of_column] = least(low_at(columns_[before], node_place(of_column)),
                                                     low_at(columns_[after], node_place(of_column)));
            }
        }
    }

    const Block& block_;
    const Block* parent_;
    Places places_;
    CellBounds bounds_;
    float rounding_m_ = 0.0F;
    std::vector<Stop> stops_;                             ///< of the block's vertices, one after the other
    std::vector<std::uint32_t> first_stop_;               ///< of a vertex, and the end
    std::vector<Box> boxes_;                              ///< of a vertex's stops
    std::vector<std::uint16_t> vertices_;                 ///< scratch
    std::array<float, CellBounds::kLineNodes> height_{};  ///< the own posts', at the nodes
    std::array<EdgeLow, kLineEdges> rows_{}, columns_{};  ///< line * kSide + place
    std::vector<Stop> way_;                               ///< scratch
    std::vector<glm::vec2> scratch_;                      ///< scratch
    int step_ = 0;                                        ///< in the making
};

}  // namespace

CellBounds cell_bounds(const Block& block, const Block* parent) {
    if (block.data.tile.depth < kLeastDepth || block.levels.empty()) return {};
    int last_limit = int{block.last_level} + CellBounds::kLevelsBeyond;
    if (parent != nullptr) last_limit = std::min(last_limit, int{parent->last_level});
    return BoundsMaker(block, parent, last_limit).make();
}

}  // namespace eyepoint::terrain
