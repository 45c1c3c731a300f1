#include "tools/bench/measure/post_error.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include "tools/bench/measure/triangle_bins.hpp"

namespace eyepoint::tools {

namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
constexpr std::size_t kPosts = PostTile::kSide * PostTile::kSide;

struct MapPoint {
    std::int64_t u = 0, v = 0;
};

/// A triangle in a tile's map, counterclockwise.
struct TileTriangle {
    std::array<MapPoint, 3> corners;
    /// One over the distance of each corner from the map's centre along the tile's up: linear over the
    /// triangle as it is mapped, whatever its slope, and never beyond the corners' values inside it, however
    /// thin it is.
    std::array<double, 3> nearness{};
    double twice_area = 0.0;
    bool turned = false;  ///< it was clockwise
    bool folded = false;  ///< and by more than rounding
};

/// Keeps products of differences of coordinates within 64 bits.
constexpr double kMapLimit = 1 << 29;

MapPoint in_map(const PostTile& tile, const glm::dvec3& local) {
    const double scale = tile.centre_below_m / (local.z + tile.centre_below_m) / tile.unit_m;
    const auto whole = [](double value) {
        return static_cast<std::int64_t>(std::floor(std::clamp(value, -kMapLimit, kMapLimit) + 0.5));
    };
    return {whole(local.x * scale), whole(local.y * scale)};
}

std::int64_t twice_area(const MapPoint& a, const MapPoint& b, std::int64_t u, std::int64_t v) {
    return (b.u - a.u) * (v - a.v) - (b.v - a.v) * (u - a.u);
}

double longest_side(const std::array<MapPoint, 3>& corners) {
    const auto side = [](const MapPoint& a, const MapPoint& b) {
        return std::hypot(static_cast<double>(b.u - a.u), static_cast<double>(b.v - a.v));
    };
    return std::max(
        {side(corners[0], corners[1]), side(corners[1], corners[2]), side(corners[2], corners[0])});
}

/// Of the two triangles beside an edge, the one that has a point on the edge: the one on whose left side it
/// goes down, or west where it is level.
bool owns(const MapPoint& a, const MapPoint& b) { return b.v < a.v || (b.v == a.v && b.u < a.u); }

struct PostRange {
    int first = 0, end = 0;
};

/// Rows or columns whose span meets low..high.
PostRange meeting(const std::array<PostTile::Span, PostTile::kSide>& spans, PostRange counted,
                  std::int64_t low, std::int64_t high) {
    const auto at = [&](int i) -> const PostTile::Span& { return spans[static_cast<std::size_t>(i)]; };
    while (counted.first < counted.end && at(counted.first).high < low) ++counted.first;
    while (counted.first < counted.end && at(counted.end - 1).low > high) --counted.end;
    return counted;
}

/// The drawn mesh over one tile.
class TileCover {
  public:
    TileCover(std::shared_ptr<const PostTile> tile, const DrawnMesh& mesh) : mesh_(mesh) {
        measured_.tile = std::move(tile);
        measured_.above_m.assign(kPosts, kNone);
        measured_.px_per_m.assign(kPosts, kNone);
        measured_.layers.assign(kPosts, 0);
        measured_.folded.assign(kPosts, false);
    }

    void add(const MeshTriangle& triangle) {
        const PostTile& tile = *measured_.tile;
        TileTriangle mapped;
        float distance_m = 0.0F;
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::vec3& from_eye = mesh_.vertices[triangle.vertices[i]].from_eye;
            const glm::dvec3 local = tile.in_frame(glm::dvec3{from_eye}, mesh_.eye);
            mapped.corners[i] = in_map(tile, local);
            mapped.nearness[i] = 1.0 / (local.z + tile.centre_below_m);
            distance_m = std::max(distance_m, glm::length(from_eye));
        }
        const auto& [a, b, c] = mapped.corners;
        const std::int64_t area = twice_area(a, b, c.u, c.v);
        if (area == 0) return;
        mapped.twice_area = std::abs(static_cast<double>(area));
        mapped.turned = area < 0;
        if (mapped.turned) {
            // As wide as the rounding of floats from the eye, twice, it may be turned by that alone.
            const double rounding =
                2.0 + 2.0 * distance_m * std::numeric_limits<float>::epsilon() / tile.unit_m;
            mapped.folded = mapped.twice_area > rounding * longest_side(mapped.corners);
            std::swap(mapped.corners[1], mapped.corners[2]);
            std::swap(mapped.nearness[1], mapped.nearness[2]);
        }
        rasterise(mapped);
    }

    [[nodiscard]] MeasuredTile take(const PostView& view) {
        project(view);
        return std::move(measured_);
    }

  private:
    void rasterise(const TileTriangle& triangle) {
        const PostTile& tile = *measured_.tile;
        const auto& [a, b, c] = triangle.corners;
        const PostRange rows = meeting(tile.rows_v, {tile.first_row, tile.end_row}, std::min({a.v, b.v, c.v}),
                                       std::max({a.v, b.v, c.v}));
        const PostRange columns = meeting(tile.columns_u, {0, tile.end_column}, std::min({a.u, b.u, c.u}),
                                          std::max({a.u, b.u, c.u}));
        // A point on an edge that is not the triangle's own counts as outside: 0 becomes -1.
        const std::int64_t less_ab = owns(a, b) ? 0 : 1, less_bc = owns(b, c) ? 0 : 1,
                           less_ca = owns(c, a) ? 0 : 1;
        for (int row = rows.first; row < rows.end; ++row) {
            for (int column = columns.first; column < columns.end; ++column) {
                const auto post = static_cast<std::size_t>(row * PostTile::kSide + column);
                const std::int64_t u = tile.posts[post].u, v = tile.posts[post].v;
                const std::int64_t ab = twice_area(a, b, u, v), bc = twice_area(b, c, u, v),
                                   ca = twice_area(c, a, u, v);
                if (((ab - less_ab) | (bc - less_bc) | (ca - less_ca)) < 0) continue;
                cover(post, triangle,
                      static_cast<double>(bc) * triangle.nearness[0] +
                          static_cast<double>(ca) * triangle.nearness[1] +
                          static_cast<double>(ab) * triangle.nearness[2]);
            }
        }
    }

    /// The post's vertical is the line from the map's centre through it.
    void cover(std::size_t post, const TileTriangle& triangle, double weighted_nearness) {
        const PostTile::Place& place = measured_.tile->posts[post];
        const double depth_m = place.z + measured_.tile->centre_below_m;
        const double tilt = std::hypot(place.x, place.y) / depth_m;
        const double above =
            (triangle.twice_area / weighted_nearness - depth_m) * std::sqrt(1.0 + tilt * tilt);
        if (!(std::abs(above) <= std::abs(measured_.above_m[post])))
            measured_.above_m[post] = static_cast<float>(above);
        measured_.layers[post] =
            static_cast<std::int8_t>(measured_.layers[post] + (triangle.turned ? -1 : 1));
        if (triangle.folded) measured_.folded[post] = true;
    }

    void project(const PostView& view) {
        const PostTile& tile = *measured_.tile;
        const glm::dvec3 eye = tile.in_frame(glm::dvec3{0.0}, view.lod.eye);
        std::array<glm::dvec3, 4> sides;
        for (std::size_t i = 0; i < sides.size(); ++i) sides[i] = view.lod.sides[i] * tile.axes;
        for (int row = tile.first_row; row < tile.end_row; ++row) {
            for (int column = 0; column < tile.end_column; ++column) {
                const auto post = static_cast<std::size_t>(row * PostTile::kSide + column);
                const PostTile::Place& place = tile.posts[post];
                const glm::dvec3 at{place.x, place.y, place.z}, from_eye = at - eye;
                const double distance2 = glm::dot(from_eye, from_eye);
                if (distance2 < view.lod.near_m * view.lod.near_m || distance2 > view.far_m * view.far_m)
                    continue;
                if (std::any_of(sides.begin(), sides.end(),
                                [&](const glm::dvec3& side) { return glm::dot(side, from_eye) < 0.0; }))
                    continue;
                const glm::dvec3 up{at.x, at.y, at.z + tile.centre_below_m};
                const double along = glm::dot(from_eye, up);
                const double horizontal2 = distance2 - along * along / glm::dot(up, up);
                measured_.px_per_m[post] =
                    static_cast<float>(view.lod.kappa_px * std::sqrt(std::max(horizontal2, 0.0)) / distance2);
            }
        }
    }

    const DrawnMesh& mesh_;
    MeasuredTile measured_;
};

void add(PostFigures& figures, const MeasuredTile& tile) {
    for (std::size_t post = 0; post < kPosts; ++post) {
        if (std::isnan(tile.px_per_m[post])) continue;
        if (tile.layers[post] > 1) ++figures.overlapped;
        if (tile.folded[post]) ++figures.folded;
        if (std::isnan(tile.above_m[post])) {
            ++figures.uncovered;
            const int hole = static_cast<int>(post);
            figures.hole = WorstPost{
                .tile = tile.tile->tile, .row = hole / PostTile::kSide, .column = hole % PostTile::kSide};
            continue;
        }
        const float error_px = std::abs(tile.above_m[post]) * tile.px_per_m[post];
        figures.error.add(error_px);
        if (!tile.folded[post])
            figures.most_off_folds_px = std::max<double>(figures.most_off_folds_px, error_px);
        if (error_px <= figures.worst.error_px) continue;
        const int number = static_cast<int>(post);
        figures.worst = {tile.tile->tile, number / PostTile::kSide, number % PostTile::kSide,
                         error_px,        tile.above_m[post],       tile.folded[post]};
    }
}

}  // namespace

void PostFigures::merge(const PostFigures& other) {
    if (other.worst.error_px > worst.error_px) worst = other.worst;
    error.merge(other.error);
    most_off_folds_px = std::max(most_off_folds_px, other.most_off_folds_px);
    uncovered += other.uncovered;
    if (other.hole) hole = other.hole;
    overlapped += other.overlapped;
    folded += other.folded;
}

tl::expected<MeasuredPosts, std::string> measure_posts(FullSurface& surface, const DrawnMesh& mesh,
                                                       const PostView& view) {
    const auto tiles = surface.look(view);
    if (!tiles) return tl::unexpected(tiles.error());
    const TriangleBins bins(surface, mesh, tiles->size());
    MeasuredPosts result;
    result.tiles.resize(tiles->size());
    tbb::parallel_for(std::size_t{0}, tiles->size(), [&](std::size_t i) {
        TileCover cover((*tiles)[i], mesh);
        for (const std::uint32_t triangle : bins.over(i)) cover.add(mesh.triangles[triangle]);
        result.tiles[i] = cover.take(view);
    });
    return result;
}

PostFigures post_figures(const MeasuredPosts& posts) {
    PostFigures figures;
    for (const MeasuredTile& tile : posts.tiles) add(figures, tile);
    return figures;
}

PixelDistribution pops(const MeasuredPosts& before, const MeasuredPosts& after) {
    std::map<terrain::TileId, const MeasuredTile*> earlier;
    for (const MeasuredTile& tile : before.tiles) earlier.emplace(tile.tile->tile, &tile);
    PixelDistribution jumps;
    for (const MeasuredTile& tile : after.tiles) {
        const auto found = earlier.find(tile.tile->tile);
        if (found == earlier.end()) continue;
        const MeasuredTile& was = *found->second;
        for (std::size_t post = 0; post < kPosts; ++post) {
            const float jump = std::abs(tile.above_m[post] - was.above_m[post]) * tile.px_per_m[post];
            if (!std::isnan(jump) && !std::isnan(was.px_per_m[post])) jumps.add(jump);
        }
    }
    return jumps;
}

}  // namespace eyepoint::tools
