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

/// A block's local frame as the upright picture sees it.
struct BlockView {
    glm::vec3 centre{0.0F};   ///< right, forward, up of the eye
    glm::mat3 axes{1.0F};     ///< local to right, forward, up
    float per_radius = 0.0F;  ///< 1 / distance of the eye from the Earth's centre
};

}  // namespace

/// What cells reach in the picture at most, by number.
struct ProjectedTops {
    using Each = std::array<float, CellBounds::kCells>;
    Each least_u, greatest_u, v, ahead_m;
    Each steepest;  ///< the most of |u| and |v|; above kSteepest where a corner is not ahead of the eye
};

namespace {

constexpr float kBehind = 1e9F;
/// The farthest corner of what the near plane cuts off, in a view that has a picture, by its distance.
constexpr double kNears = 2.0;
constexpr std::uint8_t kNoList = 255;

/// The sides and tops of boxes, in steps of the block's CellBoxes. Boxes without bounds have none, `bounded`
/// 0.
struct FlatTops {
    using Each = std::array<float, CellBounds::kCells>;
    Each west, east, south, north, top;
    std::array<std::uint8_t, CellBounds::kCells> bounded;
};

/// Corner by corner over tops from first to last, in plain loops over arrays: the compiler makes vectors of
/// them. lean_m: how far, sideways, the low end of a thing may lie from beneath its top, since the block's
/// vertical is not everywhere its own.
void project_tops(const BlockView& view, const FlatTops& of, float lean_m, std::size_t count,
                  ProjectedTops& tops) {
    const glm::vec3 x_axis = view.axes[0], y_axis = view.axes[1], z_axis = view.axes[2], centre = view.centre;
    const float per_radius = view.per_radius;
    for (std::size_t i = 0; i < count; ++i) {
        const float top = of.top[i], run_x = of.east[i] - of.west[i], run_y = of.north[i] - of.south[i];
        // The south-west corner, and the way from it to the south-east and to the north-west one.
        const float right = centre.x + x_axis.x * of.west[i] + y_axis.x * of.south[i] + z_axis.x * top;
        const float forward = centre.y + x_axis.y * of.west[i] + y_axis.y * of.south[i] + z_axis.y * top;
        const float up = centre.z + x_axis.z * of.west[i] + y_axis.z * of.south[i] + z_axis.z * top;
        const float east_r = x_axis.x * run_x, north_r = y_axis.x * run_y;
        const float east_f = x_axis.y * run_x, north_f = y_axis.y * run_y;
        const float east_u = x_axis.z * run_x, north_u = y_axis.z * run_y;
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
        tops.steepest[i] = least_f > 0.0F && of.bounded[i] != 0 ? steepest : kBehind;
    }
}

/// One box around all: the first one.
FlatTops around(const FlatTops& tops) {
    FlatTops one;
    one.west[0] = *std::min_element(tops.west.begin(), tops.west.end());
    one.east[0] = *std::max_element(tops.east.begin(), tops.east.end());
    one.south[0] = *std::min_element(tops.south.begin(), tops.south.end());
    one.north[0] = *std::max_element(tops.north.begin(), tops.north.end());
    one.top[0] = *std::max_element(tops.top.begin(), tops.top.end());
    one.bounded[0] = *std::min_element(tops.bounded.begin(), tops.bounded.end());
    return one;
}

}  // namespace

/// The nodes of a block's low lines in the picture: nine along its rows, then nine along its columns.
struct ProjectedNodes {
    using Lines = std::array<UprightPoint, CellBounds::kLineNodes>;
    Lines rows, columns;  ///< line * CellBounds::kNodes + place on it
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
    for (std::size_t line = 0; line < CellBounds::kNodes; ++line) {
        for (std::size_t at = 0; at < CellBounds::kNodes; ++at) {
            const std::size_t i = at * CellBounds::kNodes + line;
            nodes.columns[line * CellBounds::kNodes + at] = {u[i], v[i], ahead_m[i]};
        }
    }
    return nodes;
}

const NestedLevel& list_of(const Block& block, std::uint8_t level) {
    return block.levels[static_cast<std::size_t>(level - block.first_level)];
}

/// Bits of the cells in rows or columns of cells `from` to `to`, both counted, that there are.
std::uint64_t rows_of_cells(int from, int to) {
    std::uint64_t cells = 0;
    for (int row = std::max(from, 0); row <= std::min(to, CellBounds::kSide - 1); ++row)
        cells |= std::uint64_t{0xff} << (8 * row);
    return cells;
}
std::uint64_t columns_of_cells(int from, int to) {
    std::uint64_t cells = 0;
    for (int column = std::max(from, 0); column <= std::min(to, CellBounds::kSide - 1); ++column)
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

/// The cells of a block that are to be drawn: by which list each, kNoList for those that are not or have no
/// triangles.
struct HorizonCulling::CellLists {
    std::array<std::uint8_t, CellBounds::kCells> level;
    std::uint64_t triangles = 0;
    std::uint8_t highest_floor = 0;

    /// draws: all of one block.
    explicit CellLists(std::span<const BlockDraw> draws)
        : highest_floor(*std::max_element(draws.front().floors.begin(), draws.front().floors.end())) {
        level.fill(kNoList);
        for (const BlockDraw& draw : draws) {
            const auto& first = list_of(*draw.node->block, draw.level).cell_first;
            const std::uint32_t end = draw.indices.first + draw.indices.count;
            for (std::size_t i = 0; i < CellBounds::kCells; ++i) {
                if (first[i] >= draw.indices.first && first[i + 1] <= end && first[i] < first[i + 1])
                    level[i] = draw.level;
            }
            triangles += draw.indices.count / 3;
        }
    }
};

struct HorizonCulling::Frame {
    UprightView upright;
    glm::dmat3 to_upright{1.0};
    double level_scale = 0.0;
    double near_m = 0.0;

    [[nodiscard]] BlockView view_of(const CellBounds& bounds) const {
        return {glm::vec3{to_upright * (bounds.centre - upright.eye)},
                glm::mat3{to_upright * local_axes(bounds.centre)},
                static_cast<float>(1.0 / upright.radius_m)};
    }
    [[nodiscard]] BlockView view_of(const CellBoxes& boxes) const {
        const glm::dmat3 axes = to_upright * boxes.axes;
        const glm::dvec3 origin = to_upright * (boxes.centre - upright.eye) + axes * glm::dvec3{boxes.origin};
        return {glm::vec3{origin},
                glm::mat3{axes[0] * double{boxes.step_m.x}, axes[1] * double{boxes.step_m.y},
                          axes[2] * double{boxes.step_m.z}},
                static_cast<float>(1.0 / upright.radius_m)};
    }
    [[nodiscard]] float lean_m(const CellBoxes& boxes) const {
        constexpr double kSteps = 255.0;
        return static_cast<float>(kSteps * double{boxes.step_m.z} * double{boxes.radius_m} /
                                  upright.radius_m * 1.1);
    }

    /// The first step of the bounds that holds for all that is drawn of the block in this view.
    [[nodiscard]] std::optional<int> step_of(const TileNode& node, std::uint8_t highest_floor) const {
        const Block& block = *node.block;
        const CellBounds* bounds = block.bounds.get();
        if (bounds == nullptr || bounds->last_limit < 0) return std::nullopt;
        const double farthest_m = glm::distance(bounds->centre, upright.eye) + double{bounds->radius_m};
        const double level =
            std::max(level_at(farthest_m, level_scale) + kLevelMargin, static_cast<double>(highest_floor));
        if (level > bounds->last_limit) return std::nullopt;
        const int step = std::clamp(static_cast<int>(std::ceil(level)) - bounds->level_limit(0), 0,
                                    CellBounds::kSteps - 1);
        const int list = std::clamp(bounds->list_level(step), int{block.first_level}, int{block.last_level});
        const double nearest = level_at(distance_m(node.bounds, upright.eye), level_scale) - kLevelMargin;
        if (list > int{block.first_level} && nearest < list) return std::nullopt;
        return step;
    }

    /// The boxes of a block's cells, each for the first level that is asked for nowhere in it.
    [[nodiscard]] FlatTops tops_of(const CellBoxes& boxes, std::uint8_t highest_floor) const {
        FlatTops tops;
        tops.bounded.fill(0);
        if (boxes.levels.empty()) return tops;
        const glm::vec3 eye{
            (glm::transpose(boxes.axes) * (upright.eye - boxes.centre) - glm::dvec3{boxes.origin}) /
            glm::dvec3{boxes.step_m}};
        const glm::vec3 squares = boxes.step_m * boxes.step_m;
        const double middle_m = glm::distance(boxes.centre, upright.eye);
        const double nearest_m = middle_m - double{boxes.radius_m};
        const double rounding_m = 1e-6 * (middle_m + double{boxes.radius_m});
        int level = std::max({int{boxes.first_level}, int{highest_floor},
                              static_cast<int>(level_at(std::max(nearest_m, 0.0), level_scale))});
        for (std::size_t open = CellBounds::kCells; open > 0 && level <= boxes.last_level(); ++level) {
            const double most_m = std::exp2((level - kLevelMargin) / 2.0) / level_scale - rounding_m;
            open -= add_bounded(boxes.at(level), eye, squares, most_m, tops);
        }
        return tops;
    }

    /// Takes the boxes that are wholly within a distance, of those not taken yet; says how many.
    static std::size_t add_bounded(const CellBoxes::Level& level, const glm::vec3& eye,
                                   const glm::vec3& squares, double most_m, FlatTops& tops) {
        const auto most_square = static_cast<float>(std::max(most_m, 0.0) * std::max(most_m, 0.0));
        std::size_t added = 0;
        for (std::size_t i = 0; i < CellBounds::kCells; ++i) {
            const float west = level.low[0][i], east = level.high[0][i], south = level.low[1][i],
                        north = level.high[1][i], bottom = level.low[2][i], top = level.high[2][i];
            const auto farther = [](float at, float low, float high) {
                const float to_low = at - low, to_high = high - at;
                return to_low > to_high ? to_low : to_high;
            };
            const float x = farther(eye.x, west, east), y = farther(eye.y, south, north),
                        z = farther(eye.z, bottom, top);
            const bool takes = tops.bounded[i] == 0 &&
                               x * x * squares.x + y * y * squares.y + z * z * squares.z <= most_square;
            tops.west[i] = takes || tops.bounded[i] == 0 ? west : tops.west[i];
            tops.east[i] = takes || tops.bounded[i] == 0 ? east : tops.east[i];
            tops.south[i] = takes || tops.bounded[i] == 0 ? south : tops.south[i];
            tops.north[i] = takes || tops.bounded[i] == 0 ? north : tops.north[i];
            tops.top[i] = takes || tops.bounded[i] == 0 ? top : tops.top[i];
            tops.bounded[i] = static_cast<std::uint8_t>(tops.bounded[i] | (takes ? 1 : 0));
            added += takes ? 1 : 0;
        }
        return added;
    }

    /// Whether the near plane may cut a block, or the eye be below it.
    [[nodiscard]] bool touches(const BlockDraw& draw) const {
        const double reach_m = kNears * near_m;
        const Block& block = *draw.node->block;
        const double drawn_off_m = level_error_m(block.first_level);
        if (distance_m(draw.node->bounds, upright.eye) > reach_m + drawn_off_m) return false;
        const CellBoxes& boxes = block.cell_boxes;
        const FlatTops tops = tops_of(boxes, *std::max_element(draw.floors.begin(), draw.floors.end()));
        const glm::dvec3 eye =
            glm::transpose(boxes.axes) * (upright.eye - boxes.centre) - glm::dvec3{boxes.origin};
        const auto& first = block.levels.front().cell_first;
        for (std::size_t i = 0; i < CellBounds::kCells; ++i) {
            if (first[i] == first[i + 1]) continue;
            if (tops.bounded[i] == 0) return true;
            const glm::dvec3 low = glm::dvec3{tops.west[i], tops.south[i], 0.0} * glm::dvec3{boxes.step_m};
            const glm::dvec3 high =
                glm::dvec3{tops.east[i], tops.north[i], tops.top[i]} * glm::dvec3{boxes.step_m};
            const double x = std::clamp(eye.x, low.x, high.x), y = std::clamp(eye.y, low.y, high.y);
            if (std::hypot(eye.x - x, eye.y - y) <= reach_m && eye.z - high.z < reach_m) return true;
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
    // What is drawn beneath the eye is off by far less than a tenth of its distance.
    if (!upright || !(0.9 * eye_above_ground_m > kNears * view.near_m)) return selection;
    const Frame frame{*upright, glm::transpose(upright->axes),
                      level_scale(view.tau_px + view.slack_px, view.kappa_px), view.near_m};
    for (const BlockDraw& draw : selection.draws) {
        if (frame.touches(draw)) return selection;
    }
    horizon_.reset(*upright, static_cast<float>(kMarginPx / view.kappa_px + kMarginV));
    kept_.clear();
    const std::span<const BlockDraw> draws{selection.draws};
    for (std::size_t begin = 0, end = 0; begin < draws.size(); begin = end) {
        for (end = begin + 1; end < draws.size() && draws[end].node == draws[begin].node;) ++end;
        cull_block(frame, draws.subspan(begin, end - begin), selection);
    }
    kept_.swap(selection.draws);
    const std::uint64_t in_view = selection.triangles + selection.triangles_hidden;
    if (selection.triangles_hidden * kWorthwhile < in_view) idle_frames_ = kIdleFrames;
    return selection;
}

void HorizonCulling::cull_block(const Frame& frame, std::span<const BlockDraw> draws, Selection& selection) {
    const TileNode& node = *draws.front().node;
    const CellLists lists(draws);
    const CellBoxes& boxes = node.block->cell_boxes;
    const FlatTops flat = frame.tops_of(boxes, lists.highest_floor);
    const BlockView view = frame.view_of(boxes);
    const float lean_m = frame.lean_m(boxes);
    ProjectedTops tops;
    project_tops(view, around(flat), lean_m, 1, tops);
    selection.triangles -= lists.triangles;
    if (const auto whole = sight(tops, 0); whole != TerrainHorizon::Sight::Visible) {
        if (whole == TerrainHorizon::Sight::Hidden) selection.triangles_hidden += lists.triangles;
        return;
    }
    project_tops(view, flat, lean_m, CellBounds::kCells, tops);
    const auto step = frame.step_of(node, lists.highest_floor);
    std::optional<ProjectedNodes> nodes;
    if (step) nodes = project_nodes(frame.view_of(*node.block->bounds), *node.block->bounds, *step);
    const CellSights cells = look_at_cells(lists, tops, nodes ? &*nodes : nullptr, Bands{view});
    keep_cells(draws.front(), lists, cells, selection);
}

/// Band by band of cells, near to far, each raising the horizon for the next; then by the lines across the
/// bands. Lines between hidden cells are below the horizon.
HorizonCulling::CellSights HorizonCulling::look_at_cells(const CellLists& lists, const ProjectedTops& tops,
                                                         const ProjectedNodes* nodes, const Bands& bands) {
    CellSights sights;
    std::uint64_t open = 0;  // visible, or not to be drawn
    const auto raise = [&](bool rows, int line) {
        if (nodes == nullptr) return;
        const std::uint64_t beside = rows ? rows_of_cells(line - 1, line) : columns_of_cells(line - 1, line);
        const auto& lines = rows ? nodes->rows : nodes->columns;
        if ((open & beside) != 0)
            horizon_.raise(std::span(lines).subspan(static_cast<std::size_t>(line * CellBounds::kNodes),
                                                    CellBounds::kNodes));
    };
    for (int n = 0; n < CellBounds::kSide; ++n) {
        const int band = bands.rising ? n : CellBounds::kSide - 1 - n;
        for (int at = 0; at < CellBounds::kSide; ++at) {
            const auto i = static_cast<std::size_t>(bands.rows ? band * CellBounds::kSide + at
                                                               : at * CellBounds::kSide + band);
            const bool empty = lists.level[i] == kNoList;
            const auto seen = empty ? TerrainHorizon::Sight::Visible : sight(tops, i);
            open |= std::uint64_t{seen == TerrainHorizon::Sight::Visible} << i;
            sights.visible |= std::uint64_t{seen == TerrainHorizon::Sight::Visible && !empty} << i;
            sights.hidden |= std::uint64_t{seen == TerrainHorizon::Sight::Hidden} << i;
        }
        raise(bands.rows, bands.rising ? band : band + 1);
    }
    raise(bands.rows, bands.rising ? CellBounds::kSide : 0);
    for (int line = 0; line < CellBounds::kNodes; ++line) raise(!bands.rows, line);
    return sights;
}

TerrainHorizon::Sight HorizonCulling::sight(const ProjectedTops& tops, std::size_t i) const {
    if (tops.steepest[i] > kSteepest) return TerrainHorizon::Sight::Visible;
    return horizon_.sight(tops.least_u[i], tops.greatest_u[i], tops.v[i], tops.ahead_m[i]);
}

/// A draw for every run of visible cells of one level; short gaps between them are drawn.
void HorizonCulling::keep_cells(const BlockDraw& draw, const CellLists& lists, const CellSights& cells,
                                Selection& selection) {
    const Block& block = *draw.node->block;
    std::uint64_t hidden = cells.hidden;
    for (std::size_t begin = 0, end = 0; begin < CellBounds::kCells; begin = end) {
        end = begin + 1;
        if ((cells.visible >> begin & 1U) == 0) continue;
        const auto& first = list_of(block, lists.level[begin]).cell_first;
        for (std::size_t next = end; next < CellBounds::kCells && first[next] - first[end] < kGapIndices;
             ++next) {
            if ((cells.visible >> next & 1U) == 0) continue;
            if (lists.level[next] != lists.level[begin]) break;
            end = next + 1;
        }
        for (std::size_t i = begin; i < end; ++i) hidden &= ~(std::uint64_t{1} << i);
        kept_.push_back(draw);
        kept_.back().level = lists.level[begin];
        kept_.back().indices = {first[begin], first[end] - first[begin]};
        selection.triangles += kept_.back().indices.count / 3;
    }
    for (std::size_t i = 0; i < CellBounds::kCells; ++i) {
        if ((hidden >> i & 1U) == 0) continue;
        const auto& first = list_of(block, lists.level[i]).cell_first;
        selection.triangles_hidden += (first[i + 1] - first[i]) / 3;
    }
}

}  // namespace eyepoint::terrain
