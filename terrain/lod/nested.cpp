#include "terrain/lod/nested.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <glm/geometric.hpp>

#include "terrain/geodesy/earth.hpp"
#include "terrain/lod/eye_height.hpp"
#include "terrain/lod/nested_floors.hpp"
#include "terrain/lod/nested_motion.hpp"
#include "terrain/lod/painted_detail.hpp"
#include "terrain/lod/planet_horizon.hpp"

namespace eyepoint::terrain {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Nodes in use are told so once in so many frames: well before the pager takes them for unused.
constexpr std::uint64_t kUseFrames = 16;
static_assert(2 * kUseFrames < kKeepFrames);
constexpr std::uint8_t kAllSides = 0xf;

/// Rows: levels 0..63, then "always" and "never" (NestedLod::kAlways, kNever).
using RowDistances = std::array<double, kLevels + 2>;

RowDistances row_unit_distances_m(double margin_levels) {
    RowDistances result{};
    std::ranges::copy(unit_distances_m(margin_levels), result.begin());
    result[kLevels] = -kInfinity;
    result[kLevels + 1] = kInfinity;
    return result;
}

/// The margin is what the shader's rounding needs: for distances from which on a level is asked for,
/// positive.
template <int kSign>
RowDistances distances_m(double scale) {
    static const RowDistances unit_m = row_unit_distances_m(kSign * kLevelMargin);
    RowDistances result = unit_m;
    for (double& distance_m : result) distance_m /= scale;
    return result;
}

/// The sum of level_reach_m of a level and all finer ones, by that of the level.
const double kReachRow = 1.0 / (1.0 - std::sqrt(0.5));

/// How far a vertex may have slid, by its distance: at each level to a vertex beside it, so all in all by the
/// row that ends at the level asked for there. Half a level more for the slide that has begun.
double slide_share(double scale) { return kReachRow * kLevelReachM * scale * std::exp2(0.25); }

/// Of a level, in the tables of distances: level 0 is right anywhere.
std::uint8_t row_of(std::size_t level) { return static_cast<std::uint8_t>(level == 0 ? kLevels : level); }

/// No point of the Earth nearer than this is behind its curve.
double nearest_hidden_m(const Ecef& eye, double lowest_m) {
    const double radius_m = kPolarRadiusM + std::min(lowest_m, 0.0), eye_m = glm::length(eye);
    return std::sqrt(std::max(eye_m * eye_m - radius_m * radius_m, 0.0));
}

}  // namespace

struct NestedLod::Frame {
    const LodView& view;
    TileTree& tree;
    std::uint64_t number;
    double odometer_m;
    HorizonOccluder horizon;
    double nearest_hidden_m;
    double scale;                 ///< of levels, by tau
    RowDistances nearer_m;        ///< by tau + s: a list is right from there on
    RowDistances farther_m;       ///< by tau: the next one would be right, too
    RowDistances at_most_m;       ///< by tau + s: up to there no higher level is asked for
    double metres_a_texel;        ///< distance at which a texel of one metre is kMostPixelsATexel
    double metres_a_texel_slack;  ///< the same, of a choice once made

    double slide_share;  ///< how far a vertex may have slid, by its distance

    /// How far what is drawn of a tile may reach over its box. Up to its last level its triangles cover just
    /// the tile; then the vertices on its edges slide away, to vertices of its parent.
    [[nodiscard]] double slide_m(const Quad& quad, std::size_t lane, double middle_m2) const {
        const double farthest_m = std::sqrt(middle_m2) + quad.radius_m[lane];
        return std::max(slide_share * farthest_m - quad.slide_within_m[lane], 0.0);
    }

    /// The sides of the view that may cut what is drawn of a tile, or nothing when it is outside.
    [[nodiscard]] std::optional<std::uint8_t> sides_cutting(const Quad& quad, std::size_t lane,
                                                            const glm::dvec3& middle, double slide_m,
                                                            std::uint8_t planes) const {
        const double radius_m = quad.radius_m[lane];
        for (unsigned side = 0; side < 4; ++side) {
            if ((planes >> side & 1U) == 0) continue;
            const glm::dvec3& normal = view.sides[side];
            const double inward_m = glm::dot(normal, middle);
            if (std::abs(inward_m) < radius_m + slide_m) {
                double reach_m = slide_m;
                for (std::size_t axis = 0; axis < 9; axis += 3) {
                    reach_m +=
                        std::abs(normal.x * quad.half_m[axis][lane] + normal.y * quad.half_m[axis + 1][lane] +
                                 normal.z * quad.half_m[axis + 2][lane]);
                }
                if (inward_m < -reach_m) return std::nullopt;
                if (inward_m < reach_m) continue;
            } else if (inward_m < 0.0) {
                return std::nullopt;
            }
            planes &= static_cast<std::uint8_t>(~(1U << side));
        }
        return planes;
    }

    [[nodiscard]] bool behind_horizon(const Quad& quad, std::size_t lane, double middle_m2,
                                      double slide_m) const {
        const double surely_seen_m = nearest_hidden_m + quad.radius_m[lane] + slide_m;
        if (middle_m2 < surely_seen_m * surely_seen_m) return false;
        const TileNode& node = quad.nodes[lane];
        const TileNode& around = node.parent != nullptr ? *node.parent : node;
        return horizon.hides(node.bounds, slide_m, around.bounds.radius);
    }

    /// The same of a loaded block, by what is known of where its vertices slide to.
    [[nodiscard]] bool behind_horizon(const TileNode& node) const {
        const CellBoxes& boxes = node.block->cell_boxes;
        if (boxes.levels.empty()) return false;
        const double middle_m = glm::distance(view.eye, boxes.centre);
        if (middle_m < nearest_hidden_m) return false;
        const TileNode& around = node.parent != nullptr ? *node.parent : node;
        double ball_m = 0.0;
        for (std::size_t i = 0; i < boxes.level_radius_m.size(); ++i) {
            ball_m = double{boxes.level_radius_m[i]};
            if (middle_m + ball_m <= at_most_m[boxes.first_level + i])
                return horizon.hides(boxes.centre, ball_m, around.bounds.radius);
        }
        const double known_m = kReachRow * level_reach_m(boxes.last_level());
        ball_m += std::max(slide_share * (middle_m + ball_m) - known_m, 0.0);
        return horizon.hides(boxes.centre, ball_m, around.bounds.radius);
    }
};

const Selection& NestedLod::select(const LodView& view, TileTree& tree, std::uint64_t frame_number) {
    if (tree_ != &tree) {
        tree_ = &tree;
        quads_.clear();
        add(tree.roots().data(), 2);
        eye_ = view.eye;
    }
    odometer_m_ += glm::distance(view.eye, eye_);
    eye_ = view.eye;
    const double lowest_m = tree.lowest_height_m() - mesh_below_surface_m(view, tree.lowest_height_m());
    const double scale = level_scale(view.tau_px, view.kappa_px);
    const double slack_scale = level_scale(view.tau_px + view.slack_px, view.kappa_px);
    const double share = 1.0 + view.slack_px / view.tau_px;
    const Frame frame{.view = view,
                      .tree = tree,
                      .number = frame_number,
                      .odometer_m = odometer_m_,
                      .horizon = {view.eye, lowest_m},
                      .nearest_hidden_m = nearest_hidden_m(view.eye, lowest_m),
                      .scale = scale,
                      .nearer_m = distances_m<1>(slack_scale),
                      .farther_m = distances_m<1>(scale),
                      .at_most_m = distances_m<-1>(slack_scale),
                      .metres_a_texel = view.kappa_px / kMostPixelsATexel,
                      .metres_a_texel_slack = view.kappa_px / (kMostPixelsATexel * share),
                      .slide_share = slide_share(slack_scale)};
    selection_.draws.clear();
    selection_.wishes.clear();
    selection_.triangles = 0;
    selection_.blocks_tested = selection_.blocks_reused = selection_.blocks_chosen = 0;
    starved_.clear();
    sides_.clear();
    refresh(quads_[0], frame);
    pending_.push_back({0, kWhole, kAllSides});
    while (!pending_.empty()) {
        const Pending pending = pending_.back();
        pending_.pop_back();
        if (pending.lane == kWhole) {
            look_into(frame, pending);
        } else {
            draw(pending, frame);
        }
    }
    if (!starved_.empty()) spread_floors(selection_.draws, starved_, tree, frame_number);
    selection_.triangles_hidden = 0;
    if (cut_) selection_ = cutting_.cut(view, sides_, std::move(selection_));
    if (cull_)
        selection_ = culling_.cull(view, least_height_above_ground_m(tree, view.eye), std::move(selection_));
    return selection_;
}

std::int32_t NestedLod::add(TileNode* nodes, std::uint32_t count) {
    Quad quad;
    quad.nodes = nodes;
    quad.count = count;
    for (std::size_t lane = 0; lane < count; ++lane) {
        const TileNode& node = nodes[lane];
        quad.x[lane] = node.bounds.centre.x;
        quad.y[lane] = node.bounds.centre.y;
        quad.z[lane] = node.bounds.centre.z;
        quad.radius_m[lane] = glm::length(node.bounds.half_m);
        quad.slide_within_m[lane] = kReachRow * level_reach_m(node.info.last_level);
        constexpr double kRoundingReserve = 1.0 + 1e-6;  // the vectors are kept in float
        for (int axis = 0; axis < 3; ++axis) {
            const glm::dvec3 half_m = node.bounds.axes[axis] * (node.bounds.half_m[axis] * kRoundingReserve);
            for (int i = 0; i < 3; ++i)
                quad.half_m[static_cast<std::size_t>(axis * 3 + i)][lane] = static_cast<float>(half_m[i]);
        }
        quad.texel_m[lane] = node.texel_to_refine_m > 0.0 ? node.texel_to_refine_m : -kInfinity;
        quad.split_until[lane] = node.info.has_children
                                     ? std::max(node.info.first_level, relief_level(node.tile))
                                     : node.info.first_level;
    }
    quads_.push_back(quad);
    return static_cast<std::int32_t>(quads_.size()) - 1;
}

/// Learns which blocks have come or gone, and tells the nodes that they are in use.
void NestedLod::refresh(Quad& quad, const Frame& frame) {
    if (quad.changes == frame.tree.changes() && frame.number - quad.used_frame < kUseFrames) return;
    quad.changes = frame.tree.changes();
    quad.used_frame = frame.number;
    quad.loaded = true;
    for (std::size_t lane = 0; lane < quad.count; ++lane) {
        quad.nodes[lane].used_frame = frame.number;
        quad.loaded = quad.loaded && quad.nodes[lane].block != nullptr;
    }
}

/// Puts what is in view of a quad on the pile, farthest first.
void NestedLod::look_into(const Frame& frame, const Pending& pending) {
    struct Seen {
        double distance2;
        Pending next;
    };
    std::array<Seen, 4> seen{};
    std::size_t count = 0;
    const std::uint32_t lanes = quads_[static_cast<std::size_t>(pending.quad)].count;
    selection_.blocks_tested += lanes;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        const Quad& quad = quads_[static_cast<std::size_t>(pending.quad)];
        const glm::dvec3 middle = glm::dvec3{quad.x[lane], quad.y[lane], quad.z[lane]} - frame.view.eye;
        const double distance2 = glm::dot(middle, middle);
        const double slide_m = frame.slide_m(quad, lane, distance2);
        const auto planes = frame.sides_cutting(quad, lane, middle, slide_m, pending.planes);
        if (!planes || frame.behind_horizon(quad, lane, distance2, slide_m)) continue;
        if (stands(quad, lane, frame)) {
            ++selection_.blocks_reused;
        } else {
            ++selection_.blocks_chosen;
            choose(pending.quad, lane, frame);
        }
        std::size_t at = count++;
        for (; at > 0 && seen[at - 1].distance2 < distance2; --at) seen[at] = seen[at - 1];
        seen[at] = {distance2, next_of(pending.quad, lane, *planes, frame)};
    }
    for (std::size_t i = 0; i < count; ++i) pending_.push_back(seen[i].next);
}

bool NestedLod::stands(const Quad& quad, std::size_t lane, const Frame& frame) const {
    if (!quad.chosen[lane] || !reuse_) return false;
    const double at_least_m = quad.near_m[lane] - frame.odometer_m,
                 at_most_m = quad.far_m[lane] + frame.odometer_m;
    const double farther_m = frame.farther_m[quad.farthest[lane]];
    if (quad.split[lane]) return at_most_m < std::max(farther_m, frame.metres_a_texel * quad.texel_m[lane]);
    return at_least_m >= std::max(frame.nearer_m[quad.nearest[lane]],
                                  frame.metres_a_texel_slack * quad.texel_m[lane]) &&
           at_most_m < farther_m;
}

void NestedLod::choose(std::int32_t index, std::size_t lane, const Frame& frame) {
    TileNode& node = quads_[static_cast<std::size_t>(index)].nodes[lane];
    const double distance = distance_m(node.bounds, frame.view.eye);
    const double level = level_at(distance, frame.scale) - kLevelMargin;
    const int first = node.info.first_level, last = node.info.last_level;
    const std::uint8_t split_until = quads_[static_cast<std::size_t>(index)].split_until[lane];
    const bool fine = split_until == 0 || level >= split_until;
    const bool sharp =
        distance >= frame.metres_a_texel * quads_[static_cast<std::size_t>(index)].texel_m[lane];
    const bool split = !fine || !sharp;
    if (split && quads_[static_cast<std::size_t>(index)].children[lane] == kNone) {
        const auto children = frame.tree.children(node);
        if (!children.empty())
            quads_[static_cast<std::size_t>(index)].children[lane] = add(children.data(), 4);
    }
    Quad& quad = quads_[static_cast<std::size_t>(index)];
    // What stands in for missing children is always right in its own place at its first level.
    const int list = split ? first : std::clamp(static_cast<int>(std::floor(level)), first, last);
    const NestedLevel& triangles = node.block->levels[static_cast<std::size_t>(list - first)];
    quad.range[lane] = {triangles.first(), triangles.count()};
    quad.level[lane] = static_cast<std::uint8_t>(list);
    quad.chosen[lane] = true;
    quad.split[lane] = split;
    quad.near_m[lane] = distance + frame.odometer_m;
    quad.far_m[lane] = distance - frame.odometer_m;
    const std::size_t drawn_from = std::max(static_cast<std::size_t>(list), std::size_t{split_until});
    const std::size_t drawn_until = list == last ? kNever : static_cast<std::size_t>(list) + 1;
    quad.nearest[lane] = row_of(drawn_from);
    quad.farthest[lane] = split ? row_of(split_until) : static_cast<std::uint8_t>(drawn_until);
}

/// What a tile's choice asks for: its children, or itself.
NestedLod::Pending NestedLod::next_of(std::int32_t index, std::size_t lane, std::uint8_t planes,
                                      const Frame& frame) {
    const Quad& quad = quads_[static_cast<std::size_t>(index)];
    const std::int32_t children = quad.children[lane];
    const Pending itself{index, static_cast<std::uint8_t>(lane), planes};
    if (!quad.split[lane] || children == kNone) return itself;
    refresh(quads_[static_cast<std::size_t>(children)], frame);
    return quads_[static_cast<std::size_t>(children)].loaded ? Pending{children, kWhole, planes} : itself;
}

void NestedLod::draw(const Pending& pending, const Frame& frame) {
    const Quad& quad = quads_[static_cast<std::size_t>(pending.quad)];
    const std::size_t lane = pending.lane;
    if (frame.behind_horizon(quad.nodes[lane])) return;
    if (quad.split[lane]) {
        wish(quad, lane, frame);
        if (quad.nodes[lane].info.first_level > 0)
            starved_.push_back(static_cast<std::uint32_t>(selection_.draws.size()));
    }
    selection_.draws.push_back({&quad.nodes[lane], quad.range[lane], quad.level[lane], {}});
    sides_.push_back(pending.planes);
    selection_.triangles += quad.range[lane].count / 3;
}

/// For the children of a tile that had to be drawn in their place; sooner the more levels it lacks, in shape,
/// relief or picture.
void NestedLod::wish(const Quad& quad, std::size_t lane, const Frame& frame) {
    if (quad.children[lane] == kNone) return;
    const double nearest_m = std::max(distance_m(quad.nodes[lane].bounds, frame.view.eye), frame.view.near_m);
    const double levels = quad.split_until[lane] - level_at(nearest_m, frame.scale);
    const double picture_m = frame.metres_a_texel * std::max(quad.texel_m[lane], 0.0);
    const double priority = std::max(levels, 2.0 * std::log2(picture_m / nearest_m));
    Quad& children = quads_[static_cast<std::size_t>(quad.children[lane])];
    for (std::size_t i = 0; i < children.count; ++i) {
        TileNode& node = children.nodes[i];
        if (!node.block && !node.unreadable) selection_.wishes.push_back({&node, priority});
    }
}

}  // namespace eyepoint::terrain
