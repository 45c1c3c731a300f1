#include "terrain/lod/cell_cut.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "terrain/lod/error_level.hpp"
#include "terrain/lod/nested_motion.hpp"

namespace eyepoint::terrain {

namespace {

/// Of coordinates and distances in float, by distance.
constexpr double kDistanceRounding = 1e-6;

using Distances = std::array<double, kLevels>;
using Floats = std::array<float, CellBoxes::kCells>;
using Bytes = std::array<std::uint8_t, CellBoxes::kCells>;

/// Bit n is byte n, 0 or 1: a product brings the low bits of eight bytes, one after the other, into its top
/// byte.
std::uint64_t bits(const Bytes& bytes) {
    std::uint64_t result = 0;
    for (std::size_t i = 0; i < CellBoxes::kCells; i += 8) {
        std::uint64_t eight = 0;
        for (std::size_t j = 0; j < 8; ++j) eight |= std::uint64_t{bytes[i + j]} << (8 * j);
        result |= (eight * 0x0102040810204080) >> 56 << i;
    }
    return result;
}

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
    std::array<float, 3> eye{};      ///< steps
    std::array<float, 3> squares{};  ///< square metres a square step
    double distance_m = 0.0;         ///< of the boxes' centre
    double rounding_m = 0.0;

    LocalView(const CellBoxes& of, const LodView& view) : boxes(of) {
        const glm::dvec3 from_centre = view.eye - boxes.centre;
        const glm::dvec3 local = glm::transpose(boxes.axes) * from_centre;
        for (int axis = 0; axis < 3; ++axis) {
            const auto i = static_cast<std::size_t>(axis);
            const double step_m = double{boxes.step_m[axis]};
            eye[i] = static_cast<float>((local[axis] - double{boxes.origin[axis]}) / step_m);
            squares[i] = static_cast<float>(step_m * step_m);
        }
        distance_m = glm::length(from_centre);
        rounding_m = kDistanceRounding * (distance_m + double{boxes.radius_m});
    }

    [[nodiscard]] double nearest_m() const { return distance_m - double{boxes.radius_m}; }
    [[nodiscard]] double farthest_m() const { return distance_m + double{boxes.radius_m}; }
    [[nodiscard]] float square(double distance) const { return static_cast<float>(distance * distance); }

    void near_squares(const CellBoxes::Level& level, Floats& result) const {
        result.fill(0.0F);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const float at = eye[axis], scale = squares[axis];
            for (std::size_t i = 0; i < CellBoxes::kCells; ++i) {
                const float below = static_cast<float>(level.low[axis][i]) - at;
                const float above = at - static_cast<float>(level.high[axis][i]);
                const float beyond = below > above ? below : above;
                const float off = beyond > 0.0F ? beyond : 0.0F;
                result[i] += scale * off * off;
            }
        }
    }
    void far_squares(const CellBoxes::Level& level, Floats& result) const {
        result.fill(0.0F);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const float at = eye[axis], scale = squares[axis];
            for (std::size_t i = 0; i < CellBoxes::kCells; ++i) {
                const float to_low = at - static_cast<float>(level.low[axis][i]);
                const float to_high = static_cast<float>(level.high[axis][i]) - at;
                const float off = to_low > to_high ? to_low : to_high;
                result[i] += scale * off * off;
            }
        }
    }
    /// How far inside a side of the view the boxes reach, metres.
    void inward(const CellBoxes::Level& level, const LodView& view, unsigned side, Floats& result) const {
        const glm::dvec3 normal = glm::transpose(boxes.axes) * view.sides[side];
        result.fill(static_cast<float>(glm::dot(view.sides[side], boxes.centre - view.eye) +
                                       glm::dot(normal, glm::dvec3{boxes.origin})));
        for (int axis = 0; axis < 3; ++axis) {
            const auto row = static_cast<std::size_t>(axis);
            const auto slope = static_cast<float>(normal[axis] * double{boxes.step_m[axis]});
            const CellBoxes::Side& inner = slope > 0.0F ? level.high[row] : level.low[row];
            for (std::size_t i = 0; i < CellBoxes::kCells; ++i)
                result[i] += slope * static_cast<float>(inner[i]);
        }
    }
};

Selection CellCut::cut(const LodView& view, std::span<const std::uint8_t> sides, Selection selection) {
    const Frame frame(view);
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
    const bool one_level = draw.level == block.last_level || local.farthest_m() < frame.least(draw.level + 1);
    const std::uint64_t outside = sides != 0 ? find_outside(frame, local, draw, sides) : 0;
    if (one_level && outside == 0) {
        kept_.push_back(draw);
        return;
    }
    selection.triangles -= draw.indices.count / 3;
    std::uint64_t here = ~std::uint64_t{0};  // this level or a coarser one
    for (int level = draw.level; here != 0; ++level) {
        const std::uint64_t coarser = level < block.last_level ? here & allowing(frame, local, level + 1) : 0;
        keep(draw, static_cast<std::uint8_t>(level), here & ~coarser, ~here | (coarser & ~outside), ~outside,
             selection);
        here = coarser;
    }
}

/// The cells that may be drawn with the list of a level.
std::uint64_t CellCut::allowing(const Frame& frame, const LocalView& local, int level) {
    const double least_m = frame.least(level) + local.rounding_m;
    if (local.farthest_m() < least_m) return 0;
    Floats squares;
    local.near_squares(local.boxes.at(level - 1), squares);
    const float least_square = local.square(least_m);
    Bytes far;
    for (std::size_t i = 0; i < CellBoxes::kCells; ++i)
        far[i] = static_cast<std::uint8_t>(squares[i] >= least_square ? 1 : 0);
    return bits(far);
}

/// The cells beside the view: each by its box for the first level that is nowhere exceeded in it. A floor
/// counts as asked for. Boxes grow with the level: what is not outside at one is not at the next.
std::uint64_t CellCut::find_outside(const Frame& frame, const LocalView& local, const BlockDraw& draw,
                                    unsigned sides) {
    const int floor = *std::max_element(draw.floors.begin(), draw.floors.end());
    int level = std::max({int{draw.level}, int{local.boxes.first_level}, floor});
    const int last = local.boxes.last_level();
    while (level < last && frame.most(level) < local.nearest_m()) ++level;
    const auto least_m =
        static_cast<float>(-local.rounding_m - frame.tolerance_m(std::max(local.farthest_m(), 0.0)));
    std::uint64_t outside = 0, open = ~std::uint64_t{0};
    for (; level <= last; ++level) {
        const CellBoxes::Level& boxes = local.boxes.at(level);
        Bytes beyond{};
        for (unsigned side = 0; side < 4; ++side) {
            if ((sides >> side & 1U) == 0) continue;
            Floats inward_m;
            local.inward(boxes, frame.view, side, inward_m);
            for (std::size_t i = 0; i < CellBoxes::kCells; ++i)
                beyond[i] = static_cast<std::uint8_t>(inward_m[i] < least_m ? 1 : beyond[i]);
        }
        open &= bits(beyond);
        if (open == 0) break;
        Floats squares;
        local.far_squares(boxes, squares);
        const float most_square = local.square(std::max(frame.most(level) - local.rounding_m, 0.0));
        Bytes bounded;
        for (std::size_t i = 0; i < CellBoxes::kCells; ++i)
            bounded[i] = static_cast<std::uint8_t>(squares[i] <= most_square ? 1 : 0);
        const std::uint64_t now = open & bits(bounded);
        outside |= now;
        open &= ~now;
    }
    return outside;
}

/// A draw for every run of a level's cells that are in view. No gap is drawn with a cell that the level is
/// not right for, though it be beside the view (its triangles could come into it), nor with one of another
/// level that is in view, be it empty at this one.
void CellCut::keep(const BlockDraw& draw, std::uint8_t level, std::uint64_t cells, std::uint64_t barred,
                   std::uint64_t in_view, Selection& selection) {
    const Block& block = *draw.node->block;
    const auto& first = block.levels[static_cast<std::size_t>(level - block.first_level)].cell_first;
    Bytes filled;
    for (std::size_t i = 0; i < CellBoxes::kCells; ++i)
        filled[i] = static_cast<std::uint8_t>(first[i] != first[i + 1] ? 1 : 0);
    for (std::uint64_t left = cells & in_view & bits(filled); left != 0;) {
        const int begin = std::countr_zero(left);
        int end = begin + 1;
        for (left &= left - 1; left != 0; left &= left - 1) {
            const int next = std::countr_zero(left);
            const std::uint64_t gap = (std::uint64_t{1} << next) - (std::uint64_t{1} << end);
            const auto from = static_cast<std::size_t>(end), to = static_cast<std::size_t>(next);
            if ((gap & barred) != 0 || first[to] - first[from] >= kGapIndices) break;
            end = next + 1;
        }
        const std::uint32_t start = first[static_cast<std::size_t>(begin)];
        kept_.push_back(draw);
        kept_.back().level = level;
        kept_.back().indices = {start, first[static_cast<std::size_t>(end)] - start};
        selection.triangles += kept_.back().indices.count / 3;
    }
}

}  // namespace eyepoint::terrain
