#include "tools/terrain/nest/edge_lines.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <mutex>
#include <optional>
#include <queue>
#include <set>
#include <tuple>
#include <unordered_set>
#include <utility>

#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include "terrain/geodesy/earth.hpp"
#include "terrain/lod/error_level.hpp"
#include "terrain/tiling/tile_edges.hpp"

namespace eyepoint::tools {

using namespace terrain;

namespace {

/// Of a level's error, what a line may use: the rest is left to the meshes beside it.
constexpr double kLineShare = 0.95;

/// A line while it is made: its vertices, where they are, and the level it has been simplified to.
struct Line {
    std::vector<LineVertex> vertices;
    std::vector<Ecef> places;
    std::vector<int> pinned;  ///< the level until which a vertex stays whatever the error
    int level = 0;
};

/// Takes vertices away from a line, level by level; both ends stay.
class LineCollapse {
  public:
    explicit LineCollapse(Line& line)
        : line_(line),
          before_(line.vertices.size()),
          after_(line.vertices.size()),
          version_(line.vertices.size()) {
        std::size_t last = 0;
        for (std::size_t i = 1; i < line.vertices.size(); ++i) {
            if (line.vertices[i].gone_level != NestedMesh::kStays) continue;
            after_[last] = i;
            before_[i] = last;
            last = i;
        }
        for (std::size_t i = after_[0]; i != 0 && i + 1 < line.vertices.size(); i = after_[i]) weigh(i);
    }

    void advance(int to_level) {
        while (line_.level < to_level) take_away(++line_.level);
    }

  private:
    struct Candidate {
        double error_m;
        std::size_t vertex;
        unsigned version;
        bool operator>(const Candidate& other) const {
            return std::tie(error_m, vertex) > std::tie(other.error_m, other.vertex);
        }
    };

    /// Queues a vertex by the error of the polyline without it, or by its length where that asks for more.
    void weigh(std::size_t vertex) {
        const std::size_t a = before_[vertex], b = after_[vertex];
        const Ecef& from = line_.places[a];
        const Ecef step = line_.places[b] - from;
        const double length = line_.vertices[b].at - line_.vertices[a].at;
        double greatest = glm::length(step) * (kFinestErrorM / kLevelReachM);
        for (std::size_t i = a + 1; i < b; ++i) {
            const double share = (line_.vertices[i].at - line_.vertices[a].at) / length;
            greatest = std::max(greatest, glm::distance(line_.places[i], from + step * share));
        }
        queue_.push({greatest, vertex, ++version_[vertex]});
    }

    void take_away(int level) {
        const double allowed_m = kLineShare * level_error_m(level);
        std::vector<Candidate> locked;
        while (!queue_.empty() && queue_.top().error_m <= allowed_m) {
            const Candidate next = queue_.top();
            queue_.pop();
            if (next.version != version_[next.vertex]) continue;
            if (targets_.contains(next.vertex) || line_.pinned[next.vertex] >= level ||
                entered_.contains(entry_of(next.vertex))) {
                locked.push_back(next);
                continue;
            }
            remove(next.vertex, level);
        }
        for (const Candidate& candidate : locked) queue_.push(candidate);
        targets_.clear();
        entered_.clear();
    }

    /// Where a vertex goes, into its nearer neighbour, and whether it comes from after it on the line.
    using Entry = std::pair<std::size_t, bool>;
    [[nodiscard]] Entry entry_of(std::size_t vertex) const {
        const std::size_t a = before_[vertex], b = after_[vertex];
        const std::uint32_t at = line_.vertices[vertex].at;
        return at - line_.vertices[a].at <= line_.vertices[b].at - at ? Entry{a, true} : Entry{b, false};
    }

    void remove(std::size_t vertex, int level) {
        const std::size_t a = before_[vertex], b = after_[vertex];
        LineVertex& gone = line_.vertices[vertex];
        const Entry entry = entry_of(vertex);
        gone.gone_level = static_cast<std::uint8_t>(level);
        gone.target_at = line_.vertices[entry.first].at;
        targets_.insert(entry.first);
        entered_.insert(entry);
        ++version_[vertex];
        after_[a] = b;
        before_[b] = a;
        if (a > 0) weigh(a);
        if (b + 1 < line_.vertices.size()) weigh(b);
    }

    Line& line_;
    std::vector<std::size_t> before_, after_;
    std::vector<unsigned> version_;
    std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> queue_;
    std::unordered_set<std::size_t> targets_;  ///< of this level: they stay for it
    /// Of this level: one vertex only goes to a target from each side, or one could overtake the other.
    std::set<Entry> entered_;
};

/// Of an edge along a parallel; of one along a meridian the tile's middle.
double edge_latitude_deg(TileId tile, Edge edge) {
    const GeographicExtent sides = extent(tile);
    if (edge == Edge::South) return sides.south_deg;
    if (edge == Edge::North) return sides.north_deg;
    return (sides.south_deg + sides.north_deg) / 2.0;
}

class LineMaker {
  public:
    LineMaker(const Database& heights, const FirstLevels& levels) : heights_(heights), levels_(levels) {}

    /// The line between a tile's edge and the tile beyond (none at a pole), simplified to a level. The vertex
    /// next to `pinned_end`, a place where the line ends at another one, stays.
    std::vector<LineVertex> make(TileId tile, Edge edge, std::optional<TileId> beyond, int to_level,
                                 std::optional<std::uint32_t> pinned_end) {
        Line line = build(tile, edge, beyond, pinned_end);
        LineCollapse{line}.advance(to_level);
        return std::move(line.vertices);
    }

    [[nodiscard]] std::string failure() const { return failure_; }

  private:
    [[nodiscard]] bool is_split(TileId tile) const { return heights_.find(tile)->has_children; }

    Line build(TileId tile, Edge edge, std::optional<TileId> beyond,
               std::optional<std::uint32_t> pinned_end) {
        if (!is_split(tile) || (beyond && !is_split(*beyond))) {
            Line line = posts(tile, edge);
            pin_corners(line, tile, edge);
            if (beyond) pin_corners(line, *beyond, opposite(edge));
            if (pinned_end && line.vertices.front().at == *pinned_end) line.pinned[1] = kLastLevel;
            if (pinned_end && line.vertices.back().at == *pinned_end)
                line.pinned[kBlockCells - 1] = kLastLevel;
            return line;
        }
        const auto here = children_at(edge), there = children_at(opposite(edge));
        const int pinned = std::max<int>(levels_.at(tile), beyond ? levels_.at(*beyond) : 0);
        Line whole;
        for (std::size_t half = 0; half < 2; ++half) {
            std::optional<TileId> child_beyond;
            if (beyond) child_beyond = child(*beyond, static_cast<int>(there[half]));
            Line part = build(child(tile, static_cast<int>(here[half])), edge, child_beyond, pinned_end);
            LineCollapse{part}.advance(pinned);
            const auto skip = static_cast<std::ptrdiff_t>(half);  // the middle is in both
            whole.vertices.insert(whole.vertices.end(), part.vertices.begin() + skip, part.vertices.end());
            whole.places.insert(whole.places.end(), part.places.begin() + skip, part.places.end());
            whole.pinned.insert(whole.pinned.end(), part.pinned.begin() + skip, part.pinned.end());
        }
        whole.level = pinned;
        return whole;
    }

    /// Where only one side has children, their corners among the other side's posts stay until those are not
    /// drawn.
    void pin_corners(Line& line, TileId tile, Edge edge) const {
        if (!is_split(tile)) return;
        const std::uint32_t side = kPlaceUnits >> tile.depth;
        const std::uint32_t middle = edge_start(tile, edge) + side / 2;
        for (std::size_t i = 0; i < line.vertices.size(); ++i) {
            if (line.vertices[i].at == middle)
                line.pinned[i] = std::max<int>(line.pinned[i], levels_.at(tile));
        }
        for (const std::size_t quadrant : children_at(edge))
            pin_corners(line, child(tile, static_cast<int>(quadrant)), edge);
    }

    Line posts(TileId tile, Edge edge) {
        Line line;
        line.level =
            std::min(bare_level(tile), virtual_post_level(tile.depth + 1, edge_latitude_deg(tile, edge)));
        const auto block = heights_.read_block(tile);
        if (!block) {
            const std::scoped_lock lock(mutex_);
            if (failure_.empty()) failure_ = block.error();
            return line;
        }
        const std::uint32_t spacing = (kPlaceUnits >> tile.depth) / kBlockCells;
        for (int post = 0; post < kBlockPosts; ++post) {
            const bool along_x = edge == Edge::South || edge == Edge::North;
            const int fixed = edge == Edge::South || edge == Edge::West ? 0 : kBlockCells;
            const int row = along_x ? fixed : post, column = along_x ? post : fixed;
            const float height_m = block->height_m(row, column);
            line.vertices.push_back({edge_start(tile, edge) + static_cast<std::uint32_t>(post) * spacing,
                                     height_m, NestedMesh::kStays, 0});
            // All posts at a pole are one place: they go as those of the row beside it do.
            const bool at_pole =
                along_x && (edge == Edge::South ? tile.y == 0 : tile.y + 1 == tiles_up(tile.depth));
            const int beside = !at_pole ? row : edge == Edge::South ? 1 : kBlockCells - 1;
            line.places.push_back(to_ecef({post_latitude_deg(tile, beside), post_longitude_deg(tile, column),
                                           EllipsoidalHeight{block->height_m(beside, column)}}));
            line.pinned.push_back(0);
        }
        return line;
    }

    const Database& heights_;
    const FirstLevels& levels_;
    std::mutex mutex_;
    std::string failure_;
};

/// The four arms of a tile's cross: south, north, west, east; each between two children, the first one's
/// edge.
struct Arm {
    int child;
    Edge edge;
    int beyond;
};
constexpr std::array<Arm, 4> kArms{
    {{0, Edge::East, 1}, {2, Edge::East, 3}, {0, Edge::North, 2}, {1, Edge::North, 3}}};

/// Where an arm of a tile's cross ends at the tile's edge.
std::uint32_t outer_end(TileId tile, std::size_t arm) {
    const std::uint32_t side = kPlaceUnits >> tile.depth;
    const std::uint32_t start = (kArms[arm].edge == Edge::East ? tile.y : tile.x) * side;
    return arm % 2 == 0 ? start : start + side;
}

}  // namespace

tl::expected<EdgeLines, std::string> EdgeLines::make(const Database& heights, const FirstLevels& levels) {
    EdgeLines lines;
    std::vector<std::pair<TileId, Cross*>> work;
    for (const auto& [tile, level] : levels) {
        if (heights.find(tile)->has_children) lines.crosses_[tile];
    }
    for (auto& [tile, cross] : lines.crosses_) work.emplace_back(tile, &cross);
    // The longest lines first, so that none is left over at the end.
    std::sort(work.begin(), work.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    LineMaker maker{heights, levels};
    tbb::parallel_for(std::size_t{0}, work.size(), [&](std::size_t i) {
        const auto [tile, cross] = work[i];
        for (std::size_t arm = 0; arm < kArms.size(); ++arm) {
            (*cross)[arm] = maker.make(child(tile, kArms[arm].child), kArms[arm].edge,
                                       child(tile, kArms[arm].beyond), levels.at(tile), outer_end(tile, arm));
        }
    });
    for (std::uint32_t x = 0; x < 2; ++x) {
        const TileId root{0, x, 0};
        lines.root_sides_[x] = {maker.make(root, Edge::West, TileId{0, 1 - x, 0}, kLastLevel, std::nullopt),
                                maker.make(root, Edge::South, std::nullopt, kLastLevel, std::nullopt),
                                maker.make(root, Edge::North, std::nullopt, kLastLevel, std::nullopt)};
    }
    if (!maker.failure().empty()) return tl::unexpected(maker.failure());
    return lines;
}

std::array<MeshGuard, 4> EdgeLines::guards(TileId tile) const {
    const Cross& cross = crosses_.at(tile);
    const std::uint32_t side = kPlaceUnits >> tile.depth;
    std::array<MeshGuard, 4> guards;
    for (std::size_t arm = 0; arm < kArms.size(); ++arm) {
        const bool along_y = kArms[arm].edge == Edge::East;
        const std::int64_t start = (along_y ? tile.y : tile.x) * std::int64_t{side};
        // Next to the outer end, what stays.
        const auto stays = [](const LineVertex& vertex) { return vertex.gone_level == NestedMesh::kStays; };
        const auto& line = cross[arm];
        const std::uint32_t next = arm % 2 == 0 ? std::find_if(line.begin() + 1, line.end(), stays)->at
                                                : std::find_if(line.rbegin() + 1, line.rend(), stays)->at;
        const std::int64_t along = (next - start) * (std::int64_t{1} << tile.depth);
        const std::int64_t end = arm % 2 == 0 ? 0 : kPlaceUnits, middle = kPlaceUnits / 2;
        guards[arm] = along_y ? MeshGuard{middle, along, middle, end} : MeshGuard{along, middle, end, middle};
    }
    return guards;
}

std::span<const LineVertex> EdgeLines::line(TileId tile, Edge edge) const {
    while (tile.depth > 0) {
        const TileId above = parent(tile);
        const auto in_parent = static_cast<std::size_t>(quadrant(tile));
        const bool west = (in_parent & 1U) == 0, south = (in_parent & 2U) == 0;
        const Cross* cross = nullptr;
        if (const auto found = crosses_.find(above); found != crosses_.end()) cross = &found->second;
        if ((edge == Edge::East && west) || (edge == Edge::West && !west)) return (*cross)[south ? 0 : 1];
        if ((edge == Edge::North && south) || (edge == Edge::South && !south)) return (*cross)[west ? 2 : 3];
        tile = above;
    }
    if (edge == Edge::South || edge == Edge::North) return root_sides_[tile.x][edge == Edge::South ? 1 : 2];
    return root_sides_[edge == Edge::West ? tile.x : 1 - tile.x][0];
}

LineVertex EdgeLines::vertex_at(std::span<const LineVertex> line, TileId tile, Edge edge, std::uint32_t at) {
    const auto found =
        std::lower_bound(line.begin(), line.end(), at,
                         [](const LineVertex& vertex, std::uint32_t place) { return vertex.at < place; });
    if (found != line.end() && found->at == at) return *found;
    const std::uint32_t spacing = at & (0U - at);  // the greatest power of two that divides it
    constexpr std::uint32_t kRootSpacing = kPlaceUnits / kBlockCells;
    const auto depth = static_cast<std::uint32_t>(std::countr_zero(kRootSpacing) - std::countr_zero(spacing));
    const bool along_meridian = edge == Edge::West || edge == Edge::East;
    const double latitude_deg =
        along_meridian ? 180.0 * at / kPlaceUnits - 90.0 : edge_latitude_deg(tile, edge);
    return {at, 0.0F, virtual_post_level(depth, latitude_deg), at - spacing};
}

}  // namespace eyepoint::tools
