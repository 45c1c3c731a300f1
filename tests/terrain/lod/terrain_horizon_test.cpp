/// Horizon culling against a depth buffer: what it leaves out of a picture of hills is not seen in the
/// picture, at any size of the hills, and it leaves out much of what is not seen.
#include "terrain/lod/terrain_horizon.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include "terrain/block/block.hpp"
#include "terrain/geodesy/earth.hpp"
#include "terrain/lod/error_level.hpp"
#include "terrain/lod/horizon_culling.hpp"
#include "terrain/lod/nested_motion.hpp"

namespace eyepoint::terrain {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr int kSize = 320;  ///< pixels a side of the pictures

/// Tiles of one depth about a place, with their parents; every own odd post goes at a level of its own, into
/// the parent's mesh, which is the grid of the even ones.
struct Field {
    struct Shape {
        std::uint32_t depth = 11;
        double latitude_deg = 46.5;
        double longitude_deg = 8.25;
        double height_m = 800.0;  ///< of the hills
        int parents = 3;          ///< a side
        std::uint8_t first_level = 20;
    };
    static constexpr int kLevels = 4;

    Field(const Shape& field_shape, unsigned seed) : shape(field_shape) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> unit(0.0, 1.0);
        for (Wave& wave : waves) {
            const double length = 3.0 * std::pow(2.0, -5.0 * unit(random)), turn = 6.28 * unit(random);
            wave = {std::cos(turn) / length, std::sin(turn) / length, 6.28 * unit(random),
                    std::pow(length, 0.9)};
        }
        const TileId middle = tile_at(shape.latitude_deg, shape.longitude_deg, shape.depth - 1);
        const auto before = static_cast<std::uint32_t>(shape.parents / 2);
        parents.resize(static_cast<std::size_t>(shape.parents * shape.parents));
        for (std::uint32_t i = 0; i < parents.size(); ++i) {
            const auto side = static_cast<std::uint32_t>(shape.parents);
            parents[i] = std::make_unique<TileNode>();
            make_parent(*parents[i], {middle.depth,
                                      (middle.x + tiles_across(middle.depth) - before + i % side) %
                                          tiles_across(middle.depth),
                                      middle.y - before + i / side});
        }
    }

    [[nodiscard]] double height_at(double latitude_deg, double longitude_deg) const {
        const double tiles = tile_side_deg(shape.depth);
        const double x = std::remainder(longitude_deg - shape.longitude_deg, 360.0) / tiles,
                     y = (latitude_deg - shape.latitude_deg) / tiles;
        double sum = 0.0;
        for (const Wave& wave : waves)
            sum += wave.weight * std::sin(6.28 * (x * wave.x + y * wave.y) + wave.phase);
        return shape.height_m * sum;
    }

    /// Level at which an odd post goes: a function of where it is, so that both sides of an edge agree.
    [[nodiscard]] std::uint8_t gone_level(TileId tile, int row, int column) const {
        const std::uint32_t x = tile.x * kBlockCells + static_cast<std::uint32_t>(column);
        const std::uint32_t y = tile.y * kBlockCells + static_cast<std::uint32_t>(row);
        return static_cast<std::uint8_t>(shape.first_level + 1 + (x * 73856093U ^ y * 19349663U) % kLevels);
    }

    [[nodiscard]] BlockData data(TileId tile) const {
        BlockData data;
        data.tile = tile;
        for (int row = -1; row <= kBlockPosts; ++row) {
            for (int column = -1; column <= kBlockPosts; ++column)
                data.heights_m[static_cast<std::size_t>((row + 1) * kApronPosts + column + 1)] =
                    static_cast<float>(
                        height_at(post_latitude_deg(tile, row), post_longitude_deg(tile, column)));
        }
        return data;
    }

    [[nodiscard]] std::shared_ptr<const Block> block(TileId tile, std::uint8_t first_level,
                                                     const Block* parent) const {
        NestedMesh mesh;
        mesh.whole_grid = true;
        for (int row = 0; row < kBlockPosts; ++row) {
            for (int column = 0; column < kBlockPosts; ++column) {
                const bool odd = row % 2 != 0 || column % 2 != 0;
                const int target = (row - row % 2) * kBlockPosts + column - column % 2;
                mesh.gone_level.push_back(odd && parent != nullptr ? gone_level(tile, row, column)
                                                                   : NestedMesh::kStays);
                mesh.target.push_back(static_cast<std::uint16_t>(odd ? target : 0));
            }
        }
        NodeInfo info;
        info.first_level = first_level;
        info.last_level = static_cast<std::uint8_t>(first_level + kLevels);
        return unfold(data(tile), info, mesh, parent, std::nullopt, true);
    }

    void make_parent(TileNode& node, TileId tile) {
        node.tile = tile;
        node.block = block(tile, static_cast<std::uint8_t>(shape.first_level + kLevels), nullptr);
        node.children = std::make_unique<std::array<TileNode, 4>>();
        for (int i = 0; i < 4; ++i) {
            TileNode& leaf = (*node.children)[static_cast<std::size_t>(i)];
            leaf.tile = child(tile, i);
            leaf.parent = &node;
            leaf.block = block(leaf.tile, shape.first_level, node.block.get());
            const auto& heights_m = leaf.block->data.heights_m;
            const auto [low, high] = std::minmax_element(heights_m.begin(), heights_m.end());
            leaf.bounds = tile_bounds(leaf.tile, *low, *high);
        }
    }

    struct Wave {
        double x = 0.0, y = 0.0, phase = 0.0, weight = 0.0;
    };
    Shape shape;
    std::array<Wave, 12> waves;
    std::vector<std::unique_ptr<TileNode>> parents;
};

struct Camera {
    LodView view;
    glm::dmat3 axes{1.0};  ///< columns: forward, right, down
    double scale_px = 1.0;
};

Camera camera(const Geodetic& place, const Attitude& attitude, double fov_deg, double tau_px) {
    Camera result;
    result.axes = body_axes(place.latitude_deg, place.longitude_deg, attitude);
    const double half = fov_deg / 2.0 * kDegree;
    const glm::dvec3 forward = result.axes[0], right = result.axes[1], down = result.axes[2];
    result.scale_px = kSize / (2.0 * std::tan(half));
    result.view.eye = to_ecef(place);
    result.view.sides = {
        std::sin(half) * forward + std::cos(half) * right, std::sin(half) * forward - std::cos(half) * right,
        std::sin(half) * forward - std::cos(half) * down, std::sin(half) * forward + std::cos(half) * down};
    result.view.kappa_px = result.scale_px;
    result.view.tau_px = tau_px;
    return result;
}

/// A depth buffer with, at every pixel, the number of what is nearest there; -1: nothing.
class Picture {
  public:
    Picture() : depth_(std::size_t{kSize} * kSize, 0.0), number_(depth_.size(), -1) {}

    /// Corners: right, down, forward of the eye, metres.
    void draw(const std::array<glm::dvec3, 3>& corners, const Camera& camera, int number) {
        std::array<glm::dvec3, 4> clipped{};
        std::size_t count = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::dvec3 &a = corners[i], &b = corners[(i + 1) % 3];
            const double near_m = camera.view.near_m;
            if (a.z >= near_m) clipped[count++] = a;
            if ((a.z >= near_m) != (b.z >= near_m))
                clipped[count++] = a + (b - a) * ((near_m - a.z) / (b.z - a.z));
        }
        for (std::size_t i = 2; i < count; ++i)
            fill({pixel(clipped[0], camera), pixel(clipped[i - 1], camera), pixel(clipped[i], camera)},
                 number);
    }
    [[nodiscard]] const std::vector<int>& numbers() const { return number_; }

  private:
    static glm::dvec3 pixel(const glm::dvec3& p, const Camera& camera) {
        return {kSize / 2.0 + camera.scale_px * p.x / p.z, kSize / 2.0 + camera.scale_px * p.y / p.z,
                1.0 / p.z};
    }
    void fill(const std::array<glm::dvec3, 3>& p, int number) {
        const double area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x);
        if (area == 0.0) return;
        const auto [x_low, x_high] = std::minmax({p[0].x, p[1].x, p[2].x});
        const auto [y_low, y_high] = std::minmax({p[0].y, p[1].y, p[2].y});
        const auto first = [](double at) {
            return static_cast<int>(std::clamp(std::ceil(at - 0.5), 0.0, double{kSize}));
        };
        for (int y = first(y_low); y < std::min(first(y_high) + 1, kSize); ++y) {
            for (int x = first(x_low); x < std::min(first(x_high) + 1, kSize); ++x) {
                const glm::dvec2 at{x + 0.5, y + 0.5};
                const auto side = [&](const glm::dvec3& a, const glm::dvec3& b) {
                    return ((b.x - a.x) * (at.y - a.y) - (b.y - a.y) * (at.x - a.x)) / area;
                };
                const double w0 = side(p[1], p[2]), w1 = side(p[2], p[0]), w2 = side(p[0], p[1]);
                if (w0 < 0.0 || w1 < 0.0 || w2 < 0.0) continue;
                const double depth = w0 * p[0].z + w1 * p[1].z + w2 * p[2].z;
                const auto i = static_cast<std::size_t>(y * kSize + x);
                if (depth <= depth_[i]) continue;
                depth_[i] = depth;
                number_[i] = number;
            }
        }
    }

    std::vector<double> depth_;
    std::vector<int> number_;
};

/// One draw a tile in view, at the list its nearest point allows, near to far.
Selection whole_selection(const Field& field, const LodView& view) {
    const double scale = level_scale(view.tau_px + view.slack_px, view.kappa_px);
    std::vector<std::pair<double, BlockDraw>> draws;
    for (const auto& parent : field.parents) {
        for (const TileNode& node : *parent->children) {
            const Block& block = *node.block;
            const auto beyond = [&](const glm::dvec3& side) {
                return glm::dot(side, block.bounds->centre - view.eye) < -double{block.bounds->radius_m};
            };
            if (std::any_of(view.sides.begin(), view.sides.end(), beyond)) continue;
            const double distance_m = std::max(
                glm::distance(block.bounds->centre, view.eye) - double{block.bounds->radius_m}, 0.01);
            const int level = std::clamp(static_cast<int>(level_at(distance_m, scale) - kLevelMargin),
                                         int{block.first_level}, int{block.last_level});
            const NestedLevel& list = block.levels[static_cast<std::size_t>(level - block.first_level)];
            draws.push_back(
                {distance_m, {&node, {list.first(), list.count()}, static_cast<std::uint8_t>(level), {}}});
        }
    }
    std::sort(draws.begin(), draws.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    Selection selection;
    for (const auto& [distance_m, draw] : draws) {
        selection.draws.push_back(draw);
        selection.triangles += draw.indices.count / 3;
    }
    return selection;
}

/// Numbers of a selection's triangles in the order of drawing: by tile and place in its index list.
struct DrawnTriangles {
    std::vector<bool> kept;        ///< by number
    std::vector<bool> in_picture;  ///< by number: seen at a pixel
};

/// Draws everything of `whole`, with the triangles of `culled` marked as kept.
DrawnTriangles draw_all(const Selection& whole, const Selection& culled, const Camera& camera) {
    const MotionView motion = motion_view(camera.view);
    const glm::dmat3 to_camera = glm::transpose(glm::dmat3{camera.axes[1], camera.axes[2], camera.axes[0]});
    DrawnTriangles result;
    Picture picture;
    for (const BlockDraw& draw : whole.draws) {
        const Block& block = *draw.node->block;
        std::vector<glm::dvec3> corners;
        for (std::uint32_t i = 0; i < block.vertices.size(); ++i)
            corners.emplace_back(
                to_camera *
                glm::dvec3{
                    drawn_vertex(*draw.node, static_cast<std::uint16_t>(i), draw.floors, motion).from_eye});
        for (std::uint32_t i = draw.indices.first; i < draw.indices.first + draw.indices.count; i += 3) {
            picture.draw(
                {corners[block.indices[i]], corners[block.indices[i + 1]], corners[block.indices[i + 2]]},
                camera, static_cast<int>(result.kept.size()));
            result.kept.push_back(
                std::any_of(culled.draws.begin(), culled.draws.end(), [&](const BlockDraw& kept) {
                    return kept.node == draw.node && i >= kept.indices.first &&
                           i < kept.indices.first + kept.indices.count;
                }));
        }
    }
    result.in_picture.resize(result.kept.size());
    for (const int number : picture.numbers()) {
        if (number >= 0) result.in_picture[static_cast<std::size_t>(number)] = true;
    }
    return result;
}

struct Outcome {
    std::size_t missing = 0;    ///< triangles left out that are seen
    std::uint64_t hidden = 0;   ///< triangles left out because they are hidden
    std::uint64_t in_view = 0;  ///< triangles drawn and hidden
};

Outcome look(const Field& field, const Camera& camera, double eye_above_ground_m) {
    const Selection whole = whole_selection(field, camera.view);
    HorizonCulling culling;
    const Selection culled = culling.cull(camera.view, eye_above_ground_m, whole);
    const DrawnTriangles drawn = draw_all(whole, culled, camera);
    Outcome outcome;
    for (std::size_t i = 0; i < drawn.kept.size(); ++i)
        outcome.missing += drawn.in_picture[i] && !drawn.kept[i] ? 1 : 0;
    EXPECT_EQ(static_cast<std::uint64_t>(std::count(drawn.kept.begin(), drawn.kept.end(), true)),
              culled.triangles);
    outcome.hidden = culled.triangles_hidden;
    outcome.in_view = culled.triangles + culled.triangles_hidden;
    return outcome;
}

struct Case {
    Field::Shape shape;
    const char* name = "";
};

void PrintTo(const Case& tested, std::ostream* out) { *out << tested.name; }

class HorizonCullingOfHills : public ::testing::TestWithParam<Case> {};

/// Given hills of a size and eyes anywhere above them, turned anyhow; expected: no triangle that the depth
/// buffer shows is left out.
TEST_P(HorizonCullingOfHills, LeavesOutNothingThatIsSeen) {
    const auto& shape = GetParam().shape;
    std::uint64_t hidden = 0, in_view = 0;
    for (unsigned seed = 1; seed <= 4; ++seed) {
        const Field field(shape, seed);
        std::mt19937 random(seed * 7919);
        std::uniform_real_distribution<double> unit(0.0, 1.0);
        for (int i = 0; i < 15; ++i) {
            const double tiles = tile_side_deg(shape.depth);
            const double latitude_deg = shape.latitude_deg + (unit(random) * 3.0 - 1.5) * tiles;
            const double longitude_deg = shape.longitude_deg + (unit(random) * 3.0 - 1.5) * tiles;
            const double above_m = shape.height_m * 10.0 * std::pow(10.0, -2.5 * unit(random));
            const Geodetic eye{latitude_deg, longitude_deg,
                               EllipsoidalHeight{field.height_at(latitude_deg, longitude_deg) + above_m}};
            const Attitude attitude{6.28 * unit(random), (0.3 - 0.8 * unit(random)),
                                    6.28 * (unit(random) - 0.5)};
            // The field's levels are asked for at distances of 1/2 to 8 tiles.
            const double tile_m = tiles * kDegree * kEquatorialRadiusM;
            const double fov_deg = 25.0 + 50.0 * unit(random);
            const double kappa_px = kSize / (2.0 * std::tan(fov_deg / 2.0 * kDegree));
            const double reach_m = tile_m * std::pow(2.0, 2.0 * unit(random));
            const double tau_px = kappa_px * level_error_m(shape.first_level) / reach_m;
            const Outcome outcome = look(field, camera(eye, attitude, fov_deg, tau_px), above_m);
            EXPECT_EQ(outcome.missing, 0U)
                << "seed " << seed << ", eye " << i << ", " << above_m << " m above ground";
            hidden += outcome.hidden;
            in_view += outcome.in_view;
        }
    }
    RecordProperty("hidden_percent", static_cast<int>(100 * hidden / std::max<std::uint64_t>(in_view, 1)));
    EXPECT_GT(static_cast<double>(hidden), 0.05 * static_cast<double>(in_view));
}

INSTANTIATE_TEST_SUITE_P(Sizes, HorizonCullingOfHills,
                         ::testing::Values(Case{{17, 46.5, 8.25, 2.5, 3, 4}, "Small"},
                                           Case{{11, 46.5, 8.25, 150.0, 3, 20}, "Mountains"},
                                           Case{{7, 60.0, 100.0, 1500.0, 3, 28}, "EarthsCurve"},
                                           Case{{10, -70.0, 179.95, 300.0, 3, 22}, "Antimeridian"}),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace eyepoint::terrain
