#include "tools/terrain/nest/sampled_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <glm/geometric.hpp>

#include "terrain/geodesy/earth.hpp"

namespace eyepoint::tools {

using namespace terrain;

namespace {

/// Metres between samples eastward and northward, not less than anywhere in the tile.
std::array<float, 2> widest_spacing_m(const GeographicExtent& sides, double spacing_deg) {
    constexpr double kMostADegreeM = 111.7e3;  // of latitude, at the poles; of longitude less
    const double widest_deg = sides.south_deg > 0.0 ? sides.south_deg : std::max(-sides.north_deg, 0.0);
    const double northward_m = spacing_deg * kMostADegreeM;
    return {static_cast<float>(northward_m * std::cos(widest_deg * std::numbers::pi / 180.0)),
            static_cast<float>(northward_m)};
}

}  // namespace

SampledSurface::SampledSurface(TileId tile, const HeightSamples& samples)
    : side_(samples.side), flat_(tile.depth >= kFlatDepth), between_m_(samples.between_m) {
    all_are_samples_ = std::all_of(between_m_.begin(), between_m_.end(), [](float m) { return m == 0.0F; });
    const GeographicExtent sides = extent(tile);
    const double latitude_deg = (sides.south_deg + sides.north_deg) / 2.0;
    const double longitude_deg = (sides.west_deg + sides.east_deg) / 2.0;
    const float middle_m = samples.heights_m[samples.at(side_ / 2, side_ / 2)];
    origin_ = to_ecef({latitude_deg, longitude_deg, EllipsoidalHeight{middle_m}});
    up_ = east_north_up(latitude_deg, longitude_deg)[2];
    const double spacing_deg = tile_side_deg(tile.depth) / (side_ - 1);
    spacing_m_ = widest_spacing_m(sides, spacing_deg);
    for (auto& part : positions_m_)
        part.resize(flat_ && &part != positions_m_.data() ? 0 : samples.heights_m.size());
    for (int row = 0; row < side_; ++row) {
        for (int column = 0; column < side_; ++column) {
            const std::size_t at = samples.at(row, column);
            const auto position = position_m(sides.south_deg + row * spacing_deg,
                                             sides.west_deg + column * spacing_deg, samples.heights_m[at]);
            for (std::size_t part = 0; part < (flat_ ? 1U : 3U); ++part)
                positions_m_[part][at] = position[part];
        }
    }
    lone_rows_ = keep_lone(tile, samples);
}

std::vector<std::size_t> SampledSurface::keep_lone(TileId tile, const HeightSamples& samples) {
    std::vector<LoneSample> lone = samples.lone;
    const auto row_of = [](const LoneSample& sample) { return static_cast<std::size_t>(sample.y); };
    std::sort(lone.begin(), lone.end(),
              [&](const LoneSample& a, const LoneSample& b) { return row_of(a) < row_of(b); });
    const GeographicExtent sides = extent(tile);
    const double spacing_deg = tile_side_deg(tile.depth) / (side_ - 1);
    std::vector<std::size_t> rows(static_cast<std::size_t>(side_) + 1, 0);
    for (const LoneSample& sample : lone) {
        lone_.push_back({sample.x, sample.y,
                         position_m(sides.south_deg + sample.y * spacing_deg,
                                    sides.west_deg + sample.x * spacing_deg, sample.height_m)});
        ++rows[row_of(sample) + 1];
    }
    for (std::size_t row = 1; row < rows.size(); ++row) rows[row] += rows[row - 1];
    return rows;
}

float SampledSurface::lone_error_m(const std::array<const Corner*, 3>& corners, double area) const {
    const auto& [a, b, c] = corners;
    const auto [low, high] = std::minmax({a->y, b->y, c->y});
    const auto row_of = [&](double y) {
        return static_cast<std::size_t>(std::clamp(std::floor(y), 0.0, side_ - 1.0));
    };
    float greatest_m = 0.0F;
    for (std::size_t i = lone_rows_[row_of(low)]; i < lone_rows_[row_of(high) + 1]; ++i) {
        const Lone& lone = lone_[i];
        const auto share = [&](const Corner& p, const Corner& q) {
            return ((q.x - p.x) * (lone.y - p.y) - (q.y - p.y) * (lone.x - p.x)) / area;
        };
        const double of_c = share(*a, *b), of_a = share(*b, *c), of_b = share(*c, *a);
        if (std::min({of_a, of_b, of_c}) < -1e-9) continue;
        float square = 0.0F;
        for (std::size_t part = 0; part < (flat_ ? 1U : 3U); ++part) {
            const double there =
                of_a * a->position_m[part] + of_b * b->position_m[part] + of_c * c->position_m[part];
            const float apart = static_cast<float>(there) - lone.position_m[part];
            square += apart * apart;
        }
        greatest_m = std::max(greatest_m, std::sqrt(square));
    }
    return greatest_m;
}

std::array<float, 3> SampledSurface::position_m(double latitude_deg, double longitude_deg,
                                                double height_m) const {
    const Ecef from_origin = to_ecef({latitude_deg, longitude_deg, EllipsoidalHeight{height_m}}) - origin_;
    if (flat_) return {static_cast<float>(glm::dot(from_origin, up_)), 0.0F, 0.0F};
    return {static_cast<float>(from_origin.x), static_cast<float>(from_origin.y),
            static_cast<float>(from_origin.z)};
}

float SampledSurface::side_m(const Corner& a, const Corner& b) const {
    std::array<float, 3> step{b.position_m[0] - a.position_m[0], b.position_m[1] - a.position_m[1],
                              b.position_m[2] - a.position_m[2]};
    if (flat_) {
        step[1] = static_cast<float>(b.x - a.x) * spacing_m_[0];
        step[2] = static_cast<float>(b.y - a.y) * spacing_m_[1];
    }
    return std::sqrt(step[0] * step[0] + step[1] * step[1] + step[2] * step[2]);
}

float SampledSurface::error_m(const Corner& a, const Corner& b, const Corner& c, float enough_m) const {
    const float of_grid_m = flat_ ? greatest<1>(a, b, c, enough_m) : greatest<3>(a, b, c, enough_m);
    if (lone_.empty() || of_grid_m > enough_m) return of_grid_m;
    const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    return std::max(of_grid_m, lone_error_m({&a, &b, &c}, area));
}

namespace {

constexpr double kRounding = 1e-7;  // in samples: those on a triangle's sides count

/// A side of a triangle as rows cross it.
struct Side {
    double south, north, west, east;
    double x, y;     ///< one end
    double x_a_row;  ///< 0 along a row
};

Side side_between(const Corner& from, const Corner& to) {
    const double up = to.y - from.y;
    return {std::min(from.y, to.y),
            std::max(from.y, to.y),
            std::min(from.x, to.x),
            std::max(from.x, to.x),
            from.x,
            from.y,
            std::abs(up) < 1e-9 ? 0.0 : (to.x - from.x) / up};
}

/// As std::floor and std::ceil of what an int can hold, without a call.
int floor_of(double value) {
    const auto whole = static_cast<int>(value);
    return whole > value ? whole - 1 : whole;
}
int ceiling_of(double value) {
    const auto whole = static_cast<int>(value);
    return whole < value ? whole + 1 : whole;
}

/// Rows or columns of samples; none where the last is before the first.
struct SampleRange {
    int first, last;
};

SampleRange samples_between(double low, double high, int side) {
    return {std::max(0, ceiling_of(low - kRounding)), std::min(side - 1, floor_of(high + kRounding))};
}

/// Samples of a row in a triangle.
SampleRange columns_in(const std::array<Side, 3>& sides, int row, int side_samples) {
    double west = 1e30, east = -1e30;
    for (const Side& side : sides) {
        if (row < side.south - kRounding || row > side.north + kRounding) continue;
        const double x = side.x + side.x_a_row * (row - side.y);
        west = std::min(west, std::max(x, side.west));
        east = std::max(east, std::min(x, side.east));
        if (side.x_a_row == 0.0) {  // along the row, or straight up
            west = std::min(west, side.west);
            east = std::max(east, side.east);
        }
    }
    return samples_between(west, east, side_samples);
}

}  // namespace

/// The plane through a triangle, in the parts of a position that count.
template <std::size_t kParts>
class TrianglePlane {
  public:
    TrianglePlane(const Corner& a, const Corner& b, const Corner& c) : x_(a.x), y_(a.y) {
        const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        for (std::size_t part = 0; part < kParts; ++part) {
            const double ab = static_cast<double>(b.position_m[part]) - a.position_m[part];
            const double ac = static_cast<double>(c.position_m[part]) - a.position_m[part];
            first_m_[part] = a.position_m[part];
            a_column_m_[part] = static_cast<float>((ab * (c.y - a.y) - ac * (b.y - a.y)) / area);
            a_row_m_[part] = static_cast<float>((ac * (b.x - a.x) - ab * (c.x - a.x)) / area);
        }
    }

    /// Square of the distance between the plane at a place and a position, whose parts `part_m(part)` gives.
    template <typename PartM>
    [[nodiscard]] float square_from(double x, double y, const PartM& part_m) const {
        const auto along = static_cast<float>(x - x_), up = static_cast<float>(y - y_);
        float square = 0.0F;
        for (std::size_t part = 0; part < kParts; ++part) {
            const float apart =
                first_m_[part] + along * a_column_m_[part] + up * a_row_m_[part] - part_m(part);
            square += apart * apart;
        }
        return square;
    }

  private:
    double x_, y_;  ///< of the first corner
    std::array<float, kParts> first_m_{}, a_column_m_{}, a_row_m_{};
};

template <std::size_t kParts>
float SampledSurface::greatest(const Corner& a, const Corner& b, const Corner& c, float enough_m) const {
    const TrianglePlane<kParts> plane{a, b, c};
    const SampleRange rows = samples_between(std::min({a.y, b.y, c.y}), std::max({a.y, b.y, c.y}), side_);
    const std::array<Side, 3> sides{side_between(a, b), side_between(b, c), side_between(c, a)};
    float greatest = 0.0F;
    for (int row = rows.first; row <= rows.last; ++row) {
        const SampleRange columns = columns_in(sides, row, side_);
        const std::size_t line = static_cast<std::size_t>(row) * static_cast<std::size_t>(side_);
        const auto square_at = [&](int column) {
            const std::size_t at = line + static_cast<std::size_t>(column);
            return plane.square_from(column, row, [&](std::size_t part) { return positions_m_[part][at]; });
        };
        if (all_are_samples_) {
            float square = 0.0F;
            for (int column = columns.first; column <= columns.last; ++column)
                square = std::max(square, square_at(column));
            greatest = std::max(greatest, std::sqrt(square));
        } else {
            for (int column = columns.first; column <= columns.last; ++column)
                greatest = std::max(greatest, std::sqrt(square_at(column)) +
                                                  between_m_[line + static_cast<std::size_t>(column)]);
        }
        if (greatest > enough_m) return greatest;
    }
    return greatest;
}

template <std::size_t kParts>
float SampledSurface::sweep_bound(const std::array<Corner, 3>& from, const std::array<Corner, 3>& to) const {
    const TrianglePlane<kParts> plane{from[0], from[1], from[2]};
    double south = from[0].y, north = south, west = from[0].x, east = west;
    float corners_square = 0.0F;
    for (std::size_t i = 0; i < 3; ++i) {
        south = std::min({south, from[i].y, to[i].y});
        north = std::max({north, from[i].y, to[i].y});
        west = std::min({west, from[i].x, to[i].x});
        east = std::max({east, from[i].x, to[i].x});
        const auto part_m = [&](std::size_t part) { return to[i].position_m[part]; };
        corners_square = std::max(corners_square, plane.square_from(to[i].x, to[i].y, part_m));
    }
    const SampleRange rows = samples_between(south, north, side_),
                      columns = samples_between(west, east, side_);
    if (!lone_.empty()) return std::numeric_limits<float>::infinity();
    float samples_m = 0.0F;
    for (int row = rows.first; row <= rows.last; ++row) {
        for (int column = columns.first; column <= columns.last; ++column) {
            const std::size_t at = static_cast<std::size_t>(row) * static_cast<std::size_t>(side_) +
                                   static_cast<std::size_t>(column);
            const auto part_m = [&](std::size_t part) { return positions_m_[part][at]; };
            samples_m =
                std::max(samples_m, std::sqrt(plane.square_from(column, row, part_m)) + between_m_[at]);
        }
    }
    return std::sqrt(corners_square) + samples_m;
}

float SampledSurface::sweep_bound_m(const std::array<Corner, 3>& from,
                                    const std::array<Corner, 3>& to) const {
    return flat_ ? sweep_bound<1>(from, to) : sweep_bound<3>(from, to);
}

}  // namespace eyepoint::tools
