#include "terrain/lod/cell_cut.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "terrain/lod/cell_tests.hpp"
#include "terrain/lod/error_level.hpp"
#include "terrain/lod/nested_motion.hpp"

namespace eyepoint::terrain {

namespace {

/// Of coordinates and distances in float, by distance.
constexpr double kDistanceRounding = 1e-6;

/// Room made in the first frame: more than views of a thousand blocks have.
constexpr std::size_t kDrawsAtFirst = 4096;

using Distances = std::array<double, kLevels>;

/// This cell, 0..64, and all after it.
CellSet from_cell(int cell) { return cell < 64 ? ~CellSet{0} << cell : 0; }

/// Behind the last of the cells that follow one another from a cell of the set on.
int run_end(CellSet cells, int begin) { return begin + std::countr_one(cells >> begin); }

}  // namespace

struct CellCut::Frame {
    const LodView& view;
    Distances at_least_m;  ///< from there on at least the level is asked for
    Distances at_most_m;   ///< up to there at most

    explicit Frame(const LodView& of) : view(of) {
        static const Distances at_least = unit_distances_m(kLevelMargin),
                               at_most = unit_distances_m(-kLevelMargin);
        const double scale = level_scale(view.tau_px + view.slack_px, view.kappa_px);
        for (std::size_t level = 0; level < kLevels; ++level) {
            at_least_m[level] = at_least[level] / scale;
            at_most_m[level] = at_most[level] / scale;
        }
    }
    [[nodiscard]] double least(int level) const { return at_least_m[static_cast<std::size_t>(level)]; }
    /// How far off what it stands for a surface may be drawn, at a distance.
    [[nodiscard]] double tolerance_m(double distance_m) const {
        return (view.tau_px + view.slack_px) / view.kappa_px * distance_m;
    }
    [[nodiscard]] double most(int level) const { return at_most_m[static_cast<std::size_t>(level)]; }
};

/// The view in the steps of a block's boxes.
struct CellCut::LocalView {
    const CellBoxes& boxes;
    StepPoint eye;
    double distance_m = 0.0;  ///< of the boxes' centre
    double rounding_m = 0.0;

    LocalView(const CellBoxes& of, const LodView& view) : boxes(of) {
        const glm::dvec3 from_centre = view.eye - boxes.centre;
        const glm::dvec3 local = glm::transpose(boxes.axes) * from_centre;
        for (int axis = 0; axis < 3; ++axis) {
            const auto i = static_cast<std::size_t>(axis);
            const double step_m = double{boxes.step_m[axis]};
            eye.at[i] = static_cast<float>((local[axis] - double{boxes.origin[axis]}) / step_m);
            eye.square_metres[i] = static_cast<float>(step_m * step_m);
        }
        distance_m = glm::length(from_centre);
        rounding_m = kDistanceRounding * (distance_m + double{boxes.radius_m});
    }

    [[nodiscard]] double nearest_m() const { return distance_m - double{boxes.radius_m}; }
    [[nodiscard]] double farthest_m() const { return distance_m + double{boxes.radius_m}; }
    [[nodiscard]] float square(double distance) const { return static_cast<float>(distance * distance); }

    /// How far inside a side of the view.
    [[nodiscard]] StepPlane inward(const LodView& view, unsigned side) const {
        const glm::dvec3 normal = glm::transpose(boxes.axes) * view.sides[side];
        StepPlane plane{static_cast<float>(glm::dot(view.sides[side], boxes.centre - view.eye) +
                                           glm::dot(normal, glm::dvec3{boxes.origin})),
                        {}};
        for (int axis = 0; axis < 3; ++axis)
            plane.slope_m[static_cast<std::size_t>(axis)] =
                static_cast<float>(normal[axis] * double{boxes.step_m[axis]});
        return plane;
    }
};

Selection CellCut::cut(const LodView& view, std::span<const std::uint8_t> sides, Selection selection) {
    const Frame frame(view);
    kept_.reserve(kDrawsAtFirst);
    kept_.clear();
    for (std::size_t i = 0; i < selection.draws.size(); ++i)
        cut_block(frame, selection.draws[i], sides[i], selection);
    // Both rows hold as much from here on: else the one that is swapped in would grow in a later, steady
    // frame.
    selection.draws.clear();
    selection.draws.reserve(kept_.capacity());
    kept_.swap(selection.draws);
    kept_.reserve(selection.draws.capacity());
    return selection;
}

void CellCut::cut_block(const Frame& frame, const BlockDraw& draw, unsigned sides, Selection& selection) {
    const Block& block = *draw.node->block;
    if (block.cell_boxes.levels.empty()) {
        kept_.push_back(draw);
        return;
    }
    const LocalView local(block.cell_boxes, frame.view);
    // Floors hold on the tile's own edges: what its vertices meet beyond them is another matter.
    const bool has_floors = std::ranges::any_of(draw.floors, [](std::uint8_t floor) { return floor != 0; });
    const int last = has_floors ? int{block.last_level} : block.last_list_level();
    const bool one_level = draw.level == last || local.farthest_m() < frame.least(draw.level + 1);
    const CellSet outside = sides != 0 ? find_outside(frame, local, draw, sides) : 0;
    if (one_level && outside == 0) {
        kept_.push_back(draw);
        return;
    }
    selection.triangles -= draw.indices.count / 3;
    CellSet here = ~CellSet{0};  // this level or a coarser one
    for (int level = draw.level; here != 0; ++level) {
        const CellSet coarser = level < last ? here & allowing(frame, local, level + 1) : 0;
        keep(draw, static_cast<std::uint8_t>(level), here & ~coarser, ~here | (coarser & ~outside), ~outside,
             selection);
        here = coarser;
    }
}

/// The cells that may be drawn with the list of a level.
CellSet CellCut::allowing(const Frame& frame, const LocalView& local, int level) {
    const double least_m = frame.least(level) + local.rounding_m;
    if (local.farthest_m() < least_m) return 0;
    return cells_beyond(local.boxes.at(level - 1), local.eye, local.square(least_m));
}

/// The cells beside the view: each by its box for the first level that is nowhere exceeded in it. A floor
/// counts as asked for. Boxes grow with the level: what is not outside at one is not at the next.
CellSet CellCut::find_outside(const Frame& frame, const LocalView& local, const BlockDraw& draw,
                              unsigned sides) {
    const int floor = *std::max_element(draw.floors.begin(), draw.floors.end());
    int level = std::max({int{draw.level}, int{local.boxes.first_level}, floor});
    const int last = local.boxes.last_level();
    while (level < last && frame.most(level) < local.nearest_m()) ++level;
    const auto least_m =
        static_cast<float>(-local.rounding_m - frame.tolerance_m(std::max(local.farthest_m(), 0.0)));
    std::array<StepPlane, 4> planes;
    for (unsigned side = 0; side < 4; ++side) {
        if ((sides >> side & 1U) != 0) planes[side] = local.inward(frame.view, side);
    }
    CellSet outside = 0, open = ~CellSet{0};
    for (; level <= last; ++level) {
        const CellBoxes::Level& boxes = local.boxes.at(level);
        CellSet beyond = 0;
        for (unsigned side = 0; side < 4; ++side) {
            if ((sides >> side & 1U) != 0) beyond |= cells_below(boxes, planes[side], least_m);
        }
        open &= beyond;
        if (open == 0) break;
        const double most_m = std::max(frame.most(level) - local.rounding_m, 0.0);
        const CellSet now = open & cells_within(boxes, local.eye, local.square(most_m));
        outside |= now;
        open &= ~now;
    }
    return outside;
}

/// A draw for every run of a level's cells that are in view. No gap is drawn with a cell that the level is
/// not right for, though it be beside the view (its triangles could come into it), nor with one of another
/// level that is in view, be it empty at this one.
void CellCut::keep(const BlockDraw& draw, std::uint8_t level, CellSet cells, CellSet barred, CellSet in_view,
                   Selection& selection) {
    const Block& block = *draw.node->block;
    const NestedLevel& list = block.levels[static_cast<std::size_t>(level - block.first_level)];
    const auto& first = list.cell_first;
    for (CellSet left = cells & in_view & list.filled; left != 0;) {
        const int begin = std::countr_zero(left);
        int end = run_end(left, begin);
        for (left &= from_cell(end); left != 0; left &= from_cell(end)) {
            const int next = std::countr_zero(left);
            const CellSet gap = from_cell(end) & ~from_cell(next);
            const auto from = static_cast<std::size_t>(end), to = static_cast<std::size_t>(next);
            if ((gap & barred) != 0 || first[to] - first[from] >= kGapIndices) break;
            end = run_end(left, next);
        }
        const std::uint32_t start = first[static_cast<std::size_t>(begin)];
        kept_.push_back(draw);
        kept_.back().level = level;
        kept_.back().indices = {start, first[static_cast<std::size_t>(end)] - start};
        selection.triangles += kept_.back().indices.count / 3;
    }
}

}  // namespace eyepoint::terrain
