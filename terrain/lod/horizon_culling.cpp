#include "terrain/lod/horizon_culling.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "terrain/lod/error_level.hpp"
#include "terrain/lod/nested_motion.hpp"

namespace eyepoint::terrain {

namespace {

constexpr int kSide = CellBounds::kSide;
constexpr int kNodes = CellBounds::kNodes;
constexpr std::size_t kCells = CellBounds::kCells;
constexpr auto kWholeBlock = kCells;

/// Hidden must be what is drawn, not only what is meant: a corner of a triangle is drawn up to 1/512 pixel
/// off. In pixels, with room for the stretch of the upright picture.
constexpr double kMarginPx = 1.0 / 16.0;
/// Rounding of v itself.
constexpr double kMarginV = 2e-6;
/// Farther to a side, up or down than forward, by this: not used, for its rounding.
constexpr float kSteepest = 8.0F;
/// Where less than one in so many triangles is hidden, so many frames pass until the next attempt.
constexpr std::uint64_t kWorthwhile = 50;
constexpr int kIdleFrames = 15;
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

}  // namespace

/// What cells and the whole block reach in the picture at most.
struct ProjectedTops {
    using Each = std::array<float, kCells + 1>;
    Each least_u, greatest_u, v, ahead_m;
    Each steepest;  ///< the most of |u| and |v|; above kSteepest where a corner is not ahead of the eye
};

namespace {

constexpr float kBehind = 1e9F;

/// Corner by corner over all tops from first to last, in plain loops over arrays: the compiler makes vectors
/// of them.
void project_tops(const BlockView& view, const CellBounds& bounds, int step, std::size_t first,
                  std::size_t last, ProjectedTops& tops) {
    const CellBounds::Step& of = bounds.steps[static_cast<std::size_t>(step)];
    const glm::vec3 x_axis = view.axes[0], y_axis = view.axes[1], z_axis = view.axes[2], centre = view.centre;
    const float per_radius = view.per_radius, lean_m = view.lean_m;
    for (std::size_t i = first; i < last; ++i) {
        const float top = of.top[i];
        const float run_x = of.east[i] - of.west[i], run_y = of.north[i] - of.south[i];
        // The south-west corner, and the way from it to the south-east and to the north-west one.
        const float right = centre.x + x_axis.x * of.west[i] + y_axis.x * of.south[i] + z_axis.x * top;
        const float forward = centre.y + x_axis.y * of.west[i] + y_axis.y * of.south[i] + z_axis.y * top;
        const float up = centre.z + x_axis.z * of.west[i] + y_axis.z * of.south[i] + z_axis.z * top;
        const float rise_x = bounds.slope_x[i] * run_x, rise_y = bounds.slope_y[i] * run_y;
        const float east_r = x_axis.x * run_x + z_axis.x * rise_x,
                    north_r = y_axis.x * run_y + z_axis.x * rise_y;
        const float east_f = x_axis.y * run_x + z_axis.y * rise_x,
                    north_f = y_axis.y * run_y + z_axis.y * rise_y;
        const float east_u = x_axis.z * run_x + z_axis.z * rise_x,
                    north_u = y_axis.z * run_y + z_axis.z * rise_y;
        const auto pick = [](float a, float b, float c, float d, auto better) {
            return better(better(a, b), better(c, d));
        };
        const auto lesser = [](float a, float b) { return a < b ? a : b; };
        const auto greater = [](float a, float b) { return a > b ? a : b; };
        const float f0 = forward, f1 = forward + east_f, f2 = forward + north_f, f3 = f1 + north_f;
        const float z0 = up, z1 = up + east_u, z2 = up + north_u, z3 = z1 + north_u;
        const float p0 = 1.0F / f0, p1 = 1.0F / f1, p2 = 1.0F / f2, p3 = 1.0F / f3;
        const float u0 = right * p0, u1 = (right + east_r) * p1, u2 = (right + north_r) * p2,
                    u3 = (right + east_r + north_r) * p3;
        const float v0 = z0 * p0, v1 = z1 * p1, v2 = z2 * p2, v3 = z3 * p3;
        const float least_u = pick(u0, u1, u2, u3, lesser), greatest_u = pick(u0, u1, u2, u3, greater);
        const float greatest_v = pick(v0, v1, v2, v3, greater), least_v = pick(v0, v1, v2, v3, lesser);
        const float least_f = pick(f0, f1, f2, f3, lesser), greatest_z = pick(z0, z1, z2, z3, greater);
        const float steepest = pick(-least_u, greatest_u, -least_v, greatest_v, greater);
        const float lean_u = lean_m * (1.0F + kSteepest) / least_f;
        tops.least_u[i] = least_u - lean_u;
        tops.greatest_u[i] = greatest_u + lean_u;
        tops.v[i] = greatest_v;
        tops.ahead_m[i] = least_f / (1.0F + greatest_z * per_radius) - lean_m;
        tops.steepest[i] = least_f > 0.0F ? steepest : kBehind;
    }
}

}  // namespace

/// The nodes of a block's low lines in the picture: nine along its rows, then nine along its columns.
struct ProjectedNodes {
    using Lines = std::array<UprightPoint, CellBounds::kLineNodes>;
    Lines rows, columns;  ///< line * kNodes + place on it
};

namespace {

/// Points of lines in the block's order of nodes.
using NodeValues = std::array<float, CellBounds::kLineNodes>;
void project_lows(const BlockView& view, const CellBounds& bounds, const NodeValues& low, NodeValues& u,
                  NodeValues& v, NodeValues& ahead_m) {
    const glm::vec3 x_axis = view.axes[0], y_axis = view.axes[1], z_axis = view.axes[2], centre = view.centre;
    const float per_radius = view.per_radius;
    for (std::size_t i = 0; i < CellBounds::kLineNodes; ++i) {
        const float x = bounds.node_x[i], y = bounds.node_y[i], z = low[i];
        const float right = centre.x + x_axis.x * x + y_axis.x * y + z_axis.x * z;
        const float forward = centre.y + x_axis.y * x + y_axis.y * y + z_axis.y * z;
        const float up = centre.z + x_axis.z * x + y_axis.z * y + z_axis.z * z;
        const float per_forward = 1.0F / forward;
        u[i] = right * per_forward;
        v[i] = up * per_forward;
        const float steep_u = u[i] < 0.0F ? -u[i] : u[i], steep_v = v[i] < 0.0F ? -v[i] : v[i];
        const float steepest = steep_u > steep_v ? steep_u : steep_v;
        const float ahead = forward / (1.0F + up * per_radius);
        ahead_m[i] = steepest < kSteepest ? ahead : -1.0F;
    }
}

ProjectedNodes project_nodes(const BlockView& view, const CellBounds& bounds, int step_number) {
    const CellBounds::Step& step = bounds.steps[static_cast<std::size_t>(step_number)];
    ProjectedNodes nodes;
    NodeValues u, v, ahead_m;
    project_lows(view, bounds, step.row_low, u, v, ahead_m);
    for (std::size_t i = 0; i < CellBounds::kLineNodes; ++i) nodes.rows[i] = {u[i], v[i], ahead_m[i]};
    project_lows(view, bounds, step.column_low, u, v, ahead_m);
    for (std::size_t line = 0; line < kNodes; ++line) {
        for (std::size_t at = 0; at < kNodes; ++at) {
            const std::size_t i = at * kNodes + line;
            nodes.columns[line * kNodes + at] = {u[i], v[i], ahead_m[i]};
        }
    }
    return nodes;
}

const NestedLevel& list_of(const BlockDraw& draw) {
    const Block& block = *draw.node->block;
    return block.levels[static_cast<std::size_t>(draw.level - block.first_level)];
}

/// Bits of the cells with triangles in a draw.
std::uint64_t cells_of(const BlockDraw& draw) {
    const auto& first = list_of(draw).cell_first;
    const std::uint32_t end = draw.indices.first + draw.indices.count;
    std::uint64_t cells = 0;
    for (std::size_t i = 0; i < kCells; ++i) {
        const bool drawn = first[i] >= draw.indices.first && first[i + 1] <= end && first[i] < first[i + 1];
        cells |= std::uint64_t{drawn} << i;
    }
    return cells;
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

/// The order of a block's cells from near to far.
struct HorizonCulling::Bands {
    bool rows = true;    ///< else by columns
    bool rising = true;  ///< from the south, or from the west

    explicit Bands(const BlockView& view)
        : rows(std::abs(view.axes[1].y) >= std::abs(view.axes[0].y)),
          rising((rows ? view.axes[1].y : view.axes[0].y) > 0.0F) {}
};

/// Bits of cells.
struct HorizonCulling::CellSights {
    std::uint64_t visible = 0;
    std::uint64_t hidden = 0;
};

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

    /// The first step of the bounds that holds for all that is drawn of the block in this view.
    [[nodiscard]] std::optional<int> step_of(const BlockDraw& draw, const CellBounds* known) const {
        if (known == nullptr || known->last_limit < 0) return std::nullopt;
        const CellBounds& bounds = *known;
        const double farthest_m = glm::distance(bounds.centre, upright.eye) + double{bounds.radius_m};
        const double floor = *std::max_element(draw.floors.begin(), draw.floors.end());
        const double level = std::max(level_at(farthest_m, level_scale) + kLevelMargin, floor);
        if (level > bounds.last_limit) return std::nullopt;
        return std::clamp(static_cast<int>(std::ceil(level)) - bounds.level_limit(0), 0,
                          CellBounds::kSteps - 1);
    }

    /// Whether the near plane may cut a block, or the eye be below it.
    [[nodiscard]] bool touches(const BlockDraw& draw) const {
        const CellBounds* known = draw.node->block->bounds.get();
        constexpr double kNears =
            2.0;  // farthest corner of what the near plane cuts off, in a view that has a picture
        const double reach_m = kNears * near_m;
        const double drawn_off_m = level_error_m(draw.node->block->first_level);
        if (distance_m(draw.node->bounds, upright.eye) > reach_m + drawn_off_m) return false;
        const auto step = step_of(draw, known);
        if (!step) return true;
        const CellBounds& bounds = *known;
        const CellBounds::Step& of = bounds.steps[static_cast<std::size_t>(*step)];
        const glm::dvec3 eye = glm::transpose(local_axes(bounds.centre)) * (upright.eye - bounds.centre);
        for (std::size_t i = 0; i < kCells; ++i) {
            if (of.west[i] > of.east[i]) continue;
            const double x = std::clamp(eye.x, double{of.west[i]}, double{of.east[i]});
            const double y = std::clamp(eye.y, double{of.south[i]}, double{of.north[i]});
            if (std::hypot(eye.x - x, eye.y - y) > reach_m) continue;
            const double slope_x = double{bounds.slope_x[i]}, slope_y = double{bounds.slope_y[i]};
            const double top =
                double{of.top[i]} + slope_x * (x - double{of.west[i]}) + slope_y * (y - double{of.south[i]});
            if (eye.z - top < reach_m * (1.0 + std::abs(slope_x) + std::abs(slope_y))) return true;
        }
        return false;
    }
};

Selection HorizonCulling::cull(const LodView& view, double eye_above_ground_m, Selection selection) {
    if (idle_frames_ > 0) {
        --idle_frames_;
        return selection;
    }
    const auto upright = upright_view(view);
    if (!upright || !(eye_above_ground_m > 0.0)) return selection;
    const Frame frame{*upright, glm::transpose(upright->axes),
                      level_scale(view.tau_px + view.slack_px, view.kappa_px), view.near_m};
    for (const BlockDraw& draw : selection.draws) {
        if (frame.touches(draw)) return selection;
    }
    horizon_.reset(*upright, static_cast<float>(kMarginPx / view.kappa_px + kMarginV));
    kept_.clear();
    const std::span<const BlockDraw> draws = selection.draws;
    for (std::size_t begin = 0, end = 0; begin < draws.size(); begin = end) {
        while (end < draws.size() && draws[end].node == draws[begin].node) ++end;
        cull_block(frame, draws.subspan(begin, end - begin), selection);
    }
    kept_.swap(selection.draws);
    const std::uint64_t in_view = selection.triangles + selection.triangles_hidden;
    if (selection.triangles_hidden * kWorthwhile < in_view) idle_frames_ = kIdleFrames;
    return selection;
}

void HorizonCulling::cull_block(const Frame& frame, std::span<const BlockDraw> draws, Selection& selection) {
    const CellBounds* known = draws.front().node->block->bounds.get();
    const auto step = frame.step_of(draws.front(), known);
    if (!step) {
        kept_.insert(kept_.end(), draws.begin(), draws.end());
        return;
    }
    const CellBounds& bounds = *known;
    const BlockView view = frame.view_of(bounds);
    ProjectedTops tops;
    project_tops(view, bounds, *step, kWholeBlock, kWholeBlock + 1, tops);
    if (const auto whole = sight(tops, kWholeBlock); whole != TerrainHorizon::Sight::Visible) {
        std::uint64_t triangles = 0;
        for (const BlockDraw& draw : draws) triangles += draw.indices.count / 3;
        selection.triangles -= triangles;
        if (whole == TerrainHorizon::Sight::Hidden) selection.triangles_hidden += triangles;
        return;
    }
    project_tops(view, bounds, *step, 0, kCells, tops);
    std::uint64_t all = 0;
    for (const BlockDraw& draw : draws) all |= cells_of(draw);
    const CellSights sights = look_at_cells(all, tops, project_nodes(view, bounds, *step), Bands{view});
    for (const BlockDraw& draw : draws) {
        const NestedLevel& list = list_of(draw);
        const std::uint64_t cells = cells_of(draw);
        const std::uint64_t drawn = with_short_gaps(list, cells & sights.visible);
        keep_cells(draw, drawn);
        selection.triangles -= triangles_of(list, cells & ~drawn);
        selection.triangles_hidden += triangles_of(list, cells & sights.hidden & ~drawn);
    }
}

/// Band by band of cells, near to far, each raising the horizon for the next; then by the lines across the
/// bands. Lines between hidden cells are below the horizon.
HorizonCulling::CellSights HorizonCulling::look_at_cells(std::uint64_t cells, const ProjectedTops& tops,
                                                         const ProjectedNodes& nodes, const Bands& bands) {
    CellSights sights;
    std::uint64_t open = 0;  // visible, or without triangles at this level
    const auto raise = [&](const ProjectedNodes::Lines& lines, int line, bool along_bands) {
        const bool rows = along_bands == bands.rows;
        const std::uint64_t beside = rows ? rows_of_cells(line - 1, line) : columns_of_cells(line - 1, line);
        if ((open & beside) != 0)
            horizon_.raise(std::span(lines).subspan(static_cast<std::size_t>(line * kNodes), kNodes));
    };
    const auto& along = bands.rows ? nodes.rows : nodes.columns;
    const auto& across = bands.rows ? nodes.columns : nodes.rows;
    for (int n = 0; n < kSide; ++n) {
        const int band = bands.rising ? n : kSide - 1 - n;
        for (int at = 0; at < kSide; ++at) {
            const auto i = static_cast<std::size_t>(bands.rows ? band * kSide + at : at * kSide + band);
            const bool empty = (cells >> i & 1U) == 0;
            const auto seen = empty ? TerrainHorizon::Sight::Visible : sight(tops, i);
            open |= std::uint64_t{seen == TerrainHorizon::Sight::Visible} << i;
            sights.visible |= std::uint64_t{seen == TerrainHorizon::Sight::Visible && !empty} << i;
            sights.hidden |= std::uint64_t{seen == TerrainHorizon::Sight::Hidden} << i;
        }
        raise(along, bands.rising ? band : band + 1, true);
    }
    raise(along, bands.rising ? kSide : 0, true);
    for (int line = 0; line < kNodes; ++line) raise(across, line, false);
    return sights;
}

TerrainHorizon::Sight HorizonCulling::sight(const ProjectedTops& tops, std::size_t i) const {
    if (tops.steepest[i] > kSteepest) return TerrainHorizon::Sight::Visible;
    return horizon_.sight(tops.least_u[i], tops.greatest_u[i], tops.v[i], tops.ahead_m[i]);
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
