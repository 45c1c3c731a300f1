#include "terrain/lod/horizon_culling.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "terrain/lod/error_level.hpp"

namespace eyepoint::terrain {

namespace {

constexpr int kSide = CellBounds::kSide;
constexpr int kNodes = CellBounds::kNodes;
constexpr auto kCells = static_cast<std::size_t>(CellBounds::kCells);
constexpr auto kWholeBlock = kCells;

/// Hidden must be what is drawn, not only what is meant: a corner of a triangle is drawn up to 1/512 pixel
/// off. In pixels, with room for the stretch of the upright picture.
constexpr double kMarginPx = 1.0 / 16.0;
/// Rounding of v itself.
constexpr double kMarginV = 2e-6;
/// Farther to a side, up or down than forward, by this: not used, for its rounding.
constexpr float kSteepest = 8.0F;
/// A gap between runs of visible cells is drawn if it has fewer triangles: a draw more costs as much.
constexpr std::uint32_t kGapIndices = 3 * 12;

/// A block's local frame as the upright picture sees it.
struct BlockView {
    glm::vec3 centre{0.0F};   ///< right, forward, up of the eye
    glm::mat3 axes{1.0F};     ///< local to right, forward, up
    float per_radius = 0.0F;  ///< 1 / distance of the eye from the Earth's centre
    /// How far, sideways, the low end of a thing may lie from beneath its top, since the block's vertical is
    /// not everywhere its own.
    float lean_m = 0.0F;
};

/// What cells and the whole block reach in the picture at most.
struct ProjectedTops {
    template <typename T>
    using Each = std::array<T, kCells + 1>;
    Each<float> least_u, greatest_u, v, ahead_m;
    Each<float>
        steepest;  ///< the most of |u| and |v|; above kSteepest where a corner is not ahead of the eye
};

constexpr float kBehind = 1e9F;

void project_top(const BlockView& view, const CellBounds& bounds, std::size_t i, ProjectedTops& tops) {
    float least_u = kBehind, greatest_u = -kBehind, most_v = -kBehind, ahead_m = kBehind, steepest = 0.0F;
    float least_forward = kBehind;
    for (int corner = 0; corner < 4; ++corner) {
        const float run_x = (corner & 1) != 0 ? bounds.east[i] - bounds.west[i] : 0.0F;
        const float run_y = (corner & 2) != 0 ? bounds.north[i] - bounds.south[i] : 0.0F;
        const float x = bounds.west[i] + run_x, y = bounds.south[i] + run_y;
        const float z = bounds.top[i] + bounds.slope_x[i] * run_x + bounds.slope_y[i] * run_y;
        const float right = view.centre.x + view.axes[0].x * x + view.axes[1].x * y + view.axes[2].x * z;
        const float forward = view.centre.y + view.axes[0].y * x + view.axes[1].y * y + view.axes[2].y * z;
        const float up = view.centre.z + view.axes[0].z * x + view.axes[1].z * y + view.axes[2].z * z;
        const float per_forward = 1.0F / forward;
        const float u = right * per_forward, v = up * per_forward;
        const float ahead = forward / (1.0F + up * view.per_radius);
        least_u = u < least_u ? u : least_u;
        greatest_u = u > greatest_u ? u : greatest_u;
        most_v = v > most_v ? v : most_v;
        ahead_m = ahead < ahead_m ? ahead : ahead_m;
        least_forward = forward < least_forward ? forward : least_forward;
        const float steep_u = u < 0.0F ? -u : u, steep_v = v < 0.0F ? -v : v;
        steepest = steep_u > steepest ? steep_u : steepest;
        steepest = steep_v > steepest ? steep_v : steepest;
    }
    const float lean_u = view.lean_m / least_forward * (1.0F + steepest);
    tops.least_u[i] = least_u - lean_u;
    tops.greatest_u[i] = greatest_u + lean_u;
    tops.v[i] = most_v;
    tops.ahead_m[i] = ahead_m - view.lean_m;
    tops.steepest[i] = least_forward > 0.0F ? steepest : kBehind;
}

}  // namespace

/// The nodes of a block's low lines in the picture: nine along its rows, then nine along its columns.
struct ProjectedNodes {
    std::array<std::array<UprightPoint, kNodes>, kNodes> rows, columns;
};

namespace {

UprightPoint project_low(const BlockView& view, float x, float y, float z) {
    const glm::vec3 point = view.centre + view.axes * glm::vec3{x, y, z};
    const float u = point.x / point.y, v = point.z / point.y;
    const bool placed = point.y > 0.0F && std::abs(u) < kSteepest && std::abs(v) < kSteepest;
    return {u, v, placed ? point.y / (1.0F + point.z * view.per_radius) : -1.0F};
}

ProjectedNodes project_nodes(const BlockView& view, const CellBounds& bounds) {
    ProjectedNodes nodes;
    for (std::size_t row = 0; row < kNodes; ++row) {
        for (std::size_t column = 0; column < kNodes; ++column) {
            const std::size_t i = row * kNodes + column;
            nodes.rows[row][column] =
                project_low(view, bounds.node_x[i], bounds.node_y[i], bounds.row_low[i]);
            nodes.columns[column][row] =
                project_low(view, bounds.node_x[i], bounds.node_y[i], bounds.column_low[i]);
        }
    }
    return nodes;
}

const NestedLevel& list_of(const BlockDraw& draw) {
    const Block& block = *draw.node->block;
    return block.levels[static_cast<std::size_t>(draw.level - block.first_level)];
}

std::uint64_t triangles_of(const NestedLevel& list, std::uint64_t cells) {
    std::uint64_t triangles = 0;
    for (std::size_t i = 0; i < kCells; ++i)
        triangles += (cells >> i & 1U) != 0 ? (list.cell_first[i + 1] - list.cell_first[i]) / 3 : 0;
    return triangles;
}

/// These cells, and those between two of them that are not worth a draw more.
std::uint64_t with_short_gaps(const NestedLevel& list, std::uint64_t cells) {
    std::uint64_t drawn = cells;
    std::size_t gap = kCells;  // begin of the gap; kCells: none
    for (std::size_t i = 0; i < kCells; ++i) {
        if ((cells >> i & 1U) == 0) continue;
        if (gap < i && list.cell_first[i] - list.cell_first[gap] < kGapIndices) {
            for (std::size_t j = gap; j < i; ++j) drawn |= std::uint64_t{1} << j;
        }
        gap = i + 1;
    }
    return drawn;
}

/// Bits of the cells in rows or columns of cells `from` to `to`, both counted, that there are.
std::uint64_t rows_of_cells(int from, int to) {
    std::uint64_t cells = 0;
    for (int row = std::max(from, 0); row <= std::min(to, kSide - 1); ++row)
        cells |= std::uint64_t{0xff} << (8 * row);
    return cells;
}
std::uint64_t columns_of_cells(int from, int to) {
    std::uint64_t cells = 0;
    for (int column = std::max(from, 0); column <= std::min(to, kSide - 1); ++column)
        cells |= std::uint64_t{0x0101010101010101} << column;
    return cells;
}

}  // namespace

struct HorizonCulling::Frame {
    UprightView upright;
    glm::dmat3 to_upright{1.0};
    double level_scale = 0.0;
    double near_m = 0.0;

    [[nodiscard]] BlockView view_of(const CellBounds& bounds) const {
        const glm::dvec3 centre = to_upright * (bounds.centre - upright.eye);
        const double lean_m =
            double{bounds.height_range_m} * double{bounds.radius_m} / upright.radius_m * 1.1;
        return {glm::vec3{centre}, glm::mat3{to_upright * local_axes(bounds.centre)},
                static_cast<float>(1.0 / upright.radius_m), static_cast<float>(lean_m)};
    }

    /// Whether the bounds hold for all that is drawn of the block in this view.
    [[nodiscard]] bool good(const BlockDraw& draw, const CellBounds& bounds) const {
        const double floor = *std::max_element(draw.floors.begin(), draw.floors.end());
        if (!(floor <= double{bounds.level_limit})) return false;
        const double farthest_m = glm::distance(bounds.centre, upright.eye) + double{bounds.radius_m};
        constexpr double kRounding = 1.0 + 1e-4;
        return farthest_m * level_scale * kRounding <= std::exp2(0.5 * double{bounds.level_limit});
    }

    /// Whether the near plane may cut a block, or the eye be below it.
    [[nodiscard]] bool touches(const CellBounds& bounds) const {
        constexpr double kNears =
            2.0;  // farthest corner of what the near plane cuts off, in a view that has a picture
        const double reach_m = kNears * near_m;
        const glm::dvec3 away = upright.eye - bounds.centre;
        if (glm::length(away) > double{bounds.radius_m} * 1.25 + reach_m) return false;
        if (!(bounds.level_limit >= 0.0F)) return true;
        const glm::dvec3 eye = glm::transpose(local_axes(bounds.centre)) * away;
        for (std::size_t i = 0; i < kCells; ++i) {
            const double x = std::clamp(eye.x, double{bounds.west[i]}, double{bounds.east[i]});
            const double y = std::clamp(eye.y, double{bounds.south[i]}, double{bounds.north[i]});
            if (bounds.west[i] > bounds.east[i] || std::hypot(eye.x - x, eye.y - y) > reach_m) continue;
            const double slope_x = double{bounds.slope_x[i]}, slope_y = double{bounds.slope_y[i]};
            const double top = double{bounds.top[i]} + slope_x * (x - double{bounds.west[i]}) +
                               slope_y * (y - double{bounds.south[i]});
            if (eye.z - top < reach_m * (1.0 + std::abs(slope_x) + std::abs(slope_y))) return true;
        }
        return false;
    }
};

Selection HorizonCulling::cull(const LodView& view, double eye_above_ground_m, Selection selection) {
    const auto upright = upright_view(view);
    if (!upright || !(eye_above_ground_m > 0.0)) return selection;
    const Frame frame{*upright, glm::transpose(upright->axes),
                      level_scale(view.tau_px + view.slack_px, view.kappa_px), view.near_m};
    for (const BlockDraw& draw : selection.draws) {
        if (frame.touches(draw.node->block->bounds)) return selection;
    }
    horizon_.reset(*upright, static_cast<float>(kMarginPx / view.kappa_px + kMarginV));
    kept_.clear();
    for (const BlockDraw& draw : selection.draws) cull_block(frame, draw, selection);
    kept_.swap(selection.draws);
    return selection;
}

void HorizonCulling::cull_block(const Frame& frame, const BlockDraw& draw, Selection& selection) {
    const CellBounds& bounds = draw.node->block->bounds;
    if (!frame.good(draw, bounds)) {
        kept_.push_back(draw);
        return;
    }
    const BlockView view = frame.view_of(bounds);
    ProjectedTops tops;
    const auto sight = [&](std::size_t i) {
        if (tops.steepest[i] > kSteepest) return TerrainHorizon::Sight::Visible;
        return horizon_.sight(tops.least_u[i], tops.greatest_u[i], tops.v[i], tops.ahead_m[i]);
    };
    project_top(view, bounds, kWholeBlock, tops);
    if (const auto whole = sight(kWholeBlock); whole != TerrainHorizon::Sight::Visible) {
        const std::uint64_t triangles = draw.indices.count / 3;
        selection.triangles -= triangles;
        if (whole == TerrainHorizon::Sight::Hidden) selection.triangles_hidden += triangles;
        return;
    }
    for (std::size_t i = 0; i < kCells; ++i) project_top(view, bounds, i, tops);
    const NestedLevel& cells = list_of(draw);
    std::uint64_t visible = 0, hidden = 0;
    for (std::size_t i = 0; i < kCells; ++i) {
        if (cells.cell_first[i] == cells.cell_first[i + 1]) continue;
        const auto seen = sight(i);
        visible |= std::uint64_t{seen == TerrainHorizon::Sight::Visible} << i;
        hidden |= std::uint64_t{seen == TerrainHorizon::Sight::Hidden} << i;
    }
    if (visible != 0) raise(project_nodes(view, bounds), visible);
    const std::uint64_t drawn = with_short_gaps(cells, visible);
    keep_cells(draw, drawn);
    selection.triangles -= triangles_of(cells, ~drawn);
    selection.triangles_hidden += triangles_of(cells, hidden & ~drawn);
}

/// Raises the horizon by the low lines beside visible cells: what is hidden cannot raise it.
void HorizonCulling::raise(const ProjectedNodes& nodes, std::uint64_t visible) {
    for (int line = 0; line < kNodes; ++line) {
        const auto i = static_cast<std::size_t>(line);
        if ((visible & rows_of_cells(line - 1, line)) != 0) horizon_.raise(nodes.rows[i]);
        if ((visible & columns_of_cells(line - 1, line)) != 0) horizon_.raise(nodes.columns[i]);
    }
}

/// A draw for every run of these cells.
void HorizonCulling::keep_cells(const BlockDraw& draw, std::uint64_t drawn) {
    const NestedLevel& cells = list_of(draw);
    for (std::size_t begin = 0, end = 0; begin < kCells; begin = end) {
        const bool kept = (drawn >> begin & 1U) != 0;
        for (end = begin + 1; end < kCells && (drawn >> end & 1U) == (kept ? 1U : 0U);) ++end;
        const IndexRange range{cells.cell_first[begin], cells.cell_first[end] - cells.cell_first[begin]};
        if (!kept || range.count == 0) continue;
        kept_.push_back(draw);
        kept_.back().indices = range;
    }
}

}  // namespace eyepoint::terrain
