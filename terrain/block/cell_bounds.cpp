#include "terrain/block/cell_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
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
static_assert(kSide == kMeshCells);
constexpr int kPostsACell = kBlockCells / kSide;
constexpr std::uint32_t kLeastDepth = 4;
/// Levels above the block's last that the bounds allow for: a block is drawn farther out than its last level
/// asks for, as far as its parent's nearest point is too near for the parent.
constexpr int kLevelsBeyond = 2;
/// The outer lines along parallels run so far inside the tile, cells: a straight line between two nodes of a
/// parallel leaves the tile by less.
constexpr double kInset = 1.0 / 64.0;
/// Greatest angle between the vertical of the ellipsoid and the direction from the Earth's centre, radians.
constexpr double kDeflection = 0.0034;

/// Depth of a line where nothing is drawn, metres.
constexpr float kBottomless = 1e6F;

float least(float a, float b) { return a < b ? a : b; }
float most(float a, float b) { return a > b ? a : b; }

/// A place a vertex may be drawn at: local metres, and cells from the tile's south-west corner.
struct Place {
    glm::vec3 local{0.0F};
    glm::vec2 cell{0.0F};
};

struct Box {
    glm::vec2 low{std::numeric_limits<float>::max()};
    glm::vec2 high{std::numeric_limits<float>::lowest()};
};

class Frame {
  public:
    explicit Frame(const Ecef& centre) : centre_(centre), to_local_(glm::transpose(local_axes(centre))) {}

    [[nodiscard]] glm::vec3 local(const Ecef& point) const { return {to_local_ * (point - centre_)}; }

    /// `units`: cells of the tile whose vertex it is per cell of the block; `origin`: that tile's corner, in
    /// cells.
    [[nodiscard]] Place place(const BlockVertex& vertex, float units, glm::vec2 origin) const {
        const Ecef point{double{vertex.high[0]} + double{vertex.low[0]},
                         double{vertex.high[1]} + double{vertex.low[1]},
                         double{vertex.high[2]} + double{vertex.low[2]}};
        const float scale = units * static_cast<float>(kSide) / static_cast<float>(kVertexPlaceUnits);
        const glm::vec2 place{static_cast<float>(vertex.place & 0xffffU),
                              static_cast<float>(vertex.place >> 16)};
        return {local(point), origin + place * scale};
    }

  private:
    Ecef centre_;
    glm::dmat3 to_local_;
};

/// The places a vertex passes on its way, from its own on: vertices in runs of one list.
class Ways {
  public:
    Ways(const Block& block, const Block* parent, const Frame& frame, int level_limit)
        : block_(block), parent_(parent), level_limit_(level_limit) {
        places_.reserve(block.vertices.size());
        for (const BlockVertex& vertex : block.vertices)
            places_.push_back(frame.place(vertex, 1.0F, {0.0F, 0.0F}));
        first_.reserve(block.vertices.size() + 1);
        run_.reserve(block.vertices.size() * 3);
        for (std::uint32_t vertex = 0; vertex < block.vertices.size(); ++vertex) {
            first_.push_back(static_cast<std::uint32_t>(run_.size()));
            append_way(vertex, frame);
        }
        first_.push_back(static_cast<std::uint32_t>(run_.size()));
    }

    [[nodiscard]] std::span<const Place> of(std::uint32_t vertex) const {
        return std::span(run_).subspan(first_[vertex], first_[vertex + 1] - first_[vertex]);
    }
    [[nodiscard]] std::span<const Place> all() const { return run_; }

    /// Appends the places that a vertex of the parent passes.
    void append_way_in_parent(std::uint32_t vertex, const Frame& frame, std::vector<Place>& run) const {
        const TileId tile = block_.data.tile;
        const glm::vec2 origin{static_cast<float>(tile.x & 1U) * -kSide,
                               static_cast<float>(tile.y & 1U) * -kSide};
        const BlockVertex* at = &parent_->vertices[vertex];
        run.push_back(frame.place(*at, 2.0F, origin));
        while (gone_level(*at) != NestedMesh::kStays && gone_level(*at) - 1 < level_limit_) {
            at = &parent_->vertices[next(*at)];
            run.push_back(frame.place(*at, 2.0F, origin));
        }
    }

  private:
    static std::uint32_t next(const BlockVertex& vertex) { return vertex.motion & 0xffffU; }
    static int gone_level(const BlockVertex& vertex) { return static_cast<int>(vertex.motion >> 16 & 0xffU); }

    void append_way(std::uint32_t vertex, const Frame& frame) {
        run_.push_back(places_[vertex]);
        const BlockVertex* at = &block_.vertices[vertex];
        while (gone_level(*at) != NestedMesh::kStays) {
            if (gone_level(*at) - 1 >= level_limit_) return;
            run_.push_back(places_[next(*at)]);
            at = &block_.vertices[next(*at)];
        }
        if (parent_ != nullptr && next(*at) != kNoVertex) append_way_in_parent(next(*at), frame, run_);
    }

    const Block& block_;
    const Block* parent_;
    int level_limit_;
    std::vector<Place> places_;
    std::vector<Place> run_;
    std::vector<std::uint32_t> first_;
};

/// A plane over one edge of the grid of nodes, and how far below it the mesh may come.
struct EdgeLow {
    glm::vec2 origin{0.0F};
    glm::vec2 slope{0.0F};
    float height = 0.0F;
    float drop = std::numeric_limits<float>::lowest();  ///< lowest(): nothing is drawn over the edge

    [[nodiscard]] float below(const glm::vec3& point) const {
        return height + slope.x * (point.x - origin.x) + slope.y * (point.y - origin.y) - point.z;
    }
};

class BoundsMaker {
  public:
    BoundsMaker(const Block& block, const Block* parent, int level_limit)
        : block_(block),
          parent_(parent),
          frame_(middle(block.data)),
          ways_(block, parent, frame_, level_limit) {
        bounds_.centre = middle(block.data);
        bounds_.level_limit = static_cast<float>(level_limit);
    }

    CellBounds make() {
        set_extent();
        set_nodes();
        set_tops();
        set_lows();
        return bounds_;
    }

  private:
    static Ecef middle(const BlockData& data) {
        constexpr int kMiddle = kBlockCells / 2;
        return to_ecef({post_latitude_deg(data.tile, kMiddle), post_longitude_deg(data.tile, kMiddle),
                        EllipsoidalHeight{double{data.height_m(kMiddle, kMiddle)}}});
    }
    static std::size_t node(int row, int column) { return static_cast<std::size_t>(row * kNodes + column); }

    void set_extent() {
        float low = std::numeric_limits<float>::max(), high = std::numeric_limits<float>::lowest(),
              radius2 = 0.0F;
        for (const Place& place : ways_.all()) {
            low = least(low, place.local.z);
            high = most(high, place.local.z);
            radius2 = most(radius2, glm::dot(place.local, place.local));
        }
        bounds_.height_range_m = high - low;
        bounds_.radius_m = std::sqrt(radius2) * 1.00001F;
        rounding_m_ = 1e-6F * bounds_.radius_m;
    }

    void set_nodes() {
        for (int row = 0; row < kNodes; ++row) {
            const double inset = row == 0 ? kInset : (row == kSide ? -kInset : 0.0);
            const double latitude_deg = post_latitude_deg(block_.data.tile, row * kPostsACell) +
                                        inset * kPostsACell * post_spacing_deg(block_.data.tile.depth);
            for (int column = 0; column < kNodes; ++column) {
                const double height_m = block_.data.height_m(row * kPostsACell, column * kPostsACell);
                const glm::vec3 place = frame_.local(
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

    void set_tops() {
        const NestedLevel& first = block_.levels.front();
        std::vector<std::uint8_t> counted(block_.vertices.size(), std::uint8_t{CellBounds::kCells});
        for (int cell = 0; cell < CellBounds::kCells; ++cell) {
            points_.clear();
            for (std::uint32_t i = first.cell_first[static_cast<std::size_t>(cell)];
                 i < first.cell_first[static_cast<std::size_t>(cell) + 1]; ++i) {
                const std::uint16_t vertex = block_.indices[i];
                if (counted[vertex] == cell) continue;
                counted[vertex] = static_cast<std::uint8_t>(cell);
                for (const Place& place : ways_.of(vertex)) points_.push_back(place.local);
            }
            set_top(static_cast<std::size_t>(cell), cell_slope(cell / kSide, cell % kSide));
        }
        points_.clear();
        for (const Place& place : ways_.all()) points_.push_back(place.local);
        const float columns = rise(node(kSide / 2, 0), node(kSide / 2, kSide), 0);
        set_top(CellBounds::kCells, {columns, rise(node(0, kSide / 2), node(kSide, kSide / 2), 1)});
    }

    /// The rectangle and the plane of this slope over points_.
    void set_top(std::size_t cell, glm::vec2 slope) {
        Box box;
        float above = std::numeric_limits<float>::lowest();
        for (const glm::vec3& point : points_) {
            box.low = glm::min(box.low, glm::vec2{point});
            box.high = glm::max(box.high, glm::vec2{point});
            above = most(above, point.z - slope.x * point.x - slope.y * point.y);
        }
        bounds_.west[cell] = points_.empty() ? 1.0F : box.low.x - rounding_m_;
        bounds_.east[cell] = points_.empty() ? 0.0F : box.high.x + rounding_m_;
        bounds_.south[cell] = box.low.y - rounding_m_;
        bounds_.north[cell] = box.high.y + rounding_m_;
        bounds_.slope_x[cell] = slope.x;
        bounds_.slope_y[cell] = slope.y;
        bounds_.top[cell] = above + slope.x * bounds_.west[cell] + slope.y * bounds_.south[cell] +
                            rounding_m_ * (2.0F + std::abs(slope.x) + std::abs(slope.y));
    }

    [[nodiscard]] EdgeLow edge(std::size_t from, glm::vec2 slope) const {
        return {node_place(from), slope, height_[from]};
    }

    /// Slope at an edge: along it its own, across it the mean of the cells beside it.
    [[nodiscard]] glm::vec2 row_slope(int row, int column) const {
        const float across = 0.5F * (cell_slope(std::max(row - 1, 0), column).y +
                                     cell_slope(std::min(row, kSide - 1), column).y);
        return {rise(node(row, column), node(row, column + 1), 0), across};
    }
    [[nodiscard]] glm::vec2 column_slope(int row, int column) const {
        const float across = 0.5F * (cell_slope(row, std::max(column - 1, 0)).x +
                                     cell_slope(row, std::min(column, kSide - 1)).x);
        return {across, rise(node(row, column), node(row + 1, column), 1)};
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

    void set_lows() {
        for (int row = 0; row < kNodes; ++row) {
            for (int column = 0; column < kSide; ++column) {
                rows_[static_cast<std::size_t>(row * kSide + column)] =
                    edge(node(row, column), row_slope(row, column));
                columns_[static_cast<std::size_t>(row * kSide + column)] =
                    edge(node(column, row), column_slope(column, row));
            }
        }
        const NestedLevel& first = block_.levels.front();
        const float reach_cells = reach();
        for (std::uint32_t i = first.first(); i < first.first() + first.count(); i += 3) {
            way_.clear();
            for (std::uint32_t corner = i; corner < i + 3; ++corner) {
                const auto way = ways_.of(block_.indices[corner]);
                way_.insert(way_.end(), way.begin(), way.end());
            }
            lower_under_way(reach_cells);
        }
        if (parent_ != nullptr) lower_under_siblings(reach_cells);
        join_lows();
    }

    /// Above the last level, triangles of the tile's siblings may slide over it: those of the parent's first
    /// level that are not the tile's own.
    void lower_under_siblings(float reach_cells) {
        const NestedLevel& first = parent_->levels.front();
        const int quadrant_column = static_cast<int>(block_.data.tile.x & 1U) * (kSide / 2);
        const int quadrant_row = static_cast<int>(block_.data.tile.y & 1U) * (kSide / 2);
        for (int cell = 0; cell < CellBounds::kCells; ++cell) {
            const int column = cell % kSide - quadrant_column, row = cell / kSide - quadrant_row;
            const bool own = column >= 0 && column < kSide / 2 && row >= 0 && row < kSide / 2;
            const auto index = static_cast<std::size_t>(cell);
            for (std::uint32_t i = first.cell_first[index]; !own && i < first.cell_first[index + 1]; i += 3) {
                way_.clear();
                for (std::uint32_t corner = i; corner < i + 3; ++corner)
                    ways_.append_way_in_parent(parent_->indices[corner], frame_, way_);
                lower_under_way(reach_cells);
            }
        }
    }

    /// Lowers the edges that a triangle may come to lie over; way_: the places its corners pass.
    void lower_under_way(float reach_cells) {
        Box box;
        for (const Place& place : way_) {
            box.low = glm::min(box.low, place.cell);
            box.high = glm::max(box.high, place.cell);
        }
        box.low -= reach_cells;
        box.high += reach_cells;
        constexpr auto kEnd = static_cast<float>(kSide);
        if (box.low.x > kEnd || box.low.y > kEnd || box.high.x < 0.0F || box.high.y < 0.0F) return;
        const auto lower = [&](EdgeLow& edge) {
            for (const Place& place : way_) edge.drop = most(edge.drop, edge.below(place.local));
        };
        const auto cell = [](float at) { return std::clamp(static_cast<int>(std::floor(at)), 0, kSide - 1); };
        const auto first_line = [](float at) { return std::max(static_cast<int>(std::ceil(at)), 0); };
        const auto last_line = [](float at) { return std::min(static_cast<int>(std::floor(at)), kSide); };
        for (int row = first_line(box.low.y); row <= last_line(box.high.y); ++row) {
            for (int column = cell(box.low.x); column <= cell(box.high.x); ++column)
                lower(rows_[static_cast<std::size_t>(row * kSide + column)]);
        }
        for (int column = first_line(box.low.x); column <= last_line(box.high.x); ++column) {
            for (int row = cell(box.low.y); row <= cell(box.high.y); ++row)
                lower(columns_[static_cast<std::size_t>(column * kSide + row)]);
        }
    }

    /// A node of a line is as low as the lower of the edges that meet there.
    void join_lows() {
        const auto low_at = [&](const EdgeLow& edge, glm::vec2 place) {
            if (edge.drop == std::numeric_limits<float>::lowest()) return -kBottomless;
            return edge.height + glm::dot(edge.slope, place - edge.origin) - edge.drop -
                   rounding_m_ * (2.0F + std::abs(edge.slope.x) + std::abs(edge.slope.y));
        };
        for (int line = 0; line < kNodes; ++line) {
            for (int at = 0; at < kNodes; ++at) {
                const auto before = static_cast<std::size_t>(line * kSide + std::max(at - 1, 0));
                const auto after = static_cast<std::size_t>(line * kSide + std::min(at, kSide - 1));
                const std::size_t row_node = node(line, at), column_node = node(at, line);
                bounds_.row_low[row_node] = least(low_at(rows_[before], node_place(row_node)),
                                                  low_at(rows_[after], node_place(row_node)));
                bounds_.column_low[column_node] = least(low_at(columns_[before], node_place(column_node)),
                                                        low_at(columns_[after], node_place(column_node)));
            }
        }
    }

    const Block& block_;
    const Block* parent_;
    Frame frame_;
    Ways ways_;
    CellBounds bounds_;
    float rounding_m_ = 0.0F;
    CellBounds::Floats<kNodes * kNodes> height_{};  ///< the own posts', at the nodes
    std::array<EdgeLow, static_cast<std::size_t>(kNodes*kSide)> rows_{},
        columns_{};                  ///< line * kSide + place
    std::vector<glm::vec3> points_;  ///< scratch
    std::vector<Place> way_;         ///< scratch
};

}  // namespace

CellBounds cell_bounds(const Block& block, const Block* parent) {
    if (block.data.tile.depth < kLeastDepth || block.levels.empty()) return {};
    int level_limit = int{block.last_level} + kLevelsBeyond;
    if (parent != nullptr) level_limit = std::min(level_limit, int{parent->last_level});
    return BoundsMaker(block, parent, level_limit).make();
}

}  // namespace eyepoint::terrain
