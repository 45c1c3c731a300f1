#include "tools/terrain/nest/surface_samples.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "terrain/geodesy/earth.hpp"

namespace eyepoint::tools {

using namespace terrain;

namespace {

/// Every second sample; what the left out ones deviate from the middle of their neighbours goes to those, or,
/// where it is more than `most_between_m`, they become lone ones.
HeightSamples thinned(const HeightSamples& fine, float most_between_m) {
    HeightSamples coarse;
    coarse.side = (fine.side + 1) / 2;
    coarse.heights_m.resize(static_cast<std::size_t>(coarse.side) * static_cast<std::size_t>(coarse.side));
    coarse.between_m.assign(coarse.heights_m.size(), 0.0F);
    for (int row = 0; row < fine.side; ++row) {
        for (int column = 0; column < fine.side; ++column) {
            const int odd_row = row & 1, odd_column = column & 1;
            const std::size_t low = coarse.at(row / 2, column / 2);
            const std::size_t high = coarse.at((row + 1) / 2, (column + 1) / 2);
            const float height_m = fine.heights_m[fine.at(row, column)];
            float apart_m = fine.between_m[fine.at(row, column)];
            if (odd_row == 0 && odd_column == 0) {
                coarse.heights_m[low] = height_m;
            } else {
                const float middle_m = (fine.heights_m[fine.at(row - odd_row, column - odd_column)] +
                                        fine.heights_m[fine.at(row + odd_row, column + odd_column)]) /
                                       2.0F;
                apart_m += std::abs(height_m - middle_m);
                if (apart_m > most_between_m) {
                    coarse.lone.push_back({column / 2.0, row / 2.0, height_m});
                    continue;
                }
            }
            coarse.between_m[low] = std::max(coarse.between_m[low], apart_m);
            coarse.between_m[high] = std::max(coarse.between_m[high], apart_m);
        }
    }
    for (const LoneSample& sample : fine.lone) {
        const LoneSample place{sample.x / 2.0, sample.y / 2.0, sample.height_m};
        const auto row = static_cast<int>(std::min(place.y, coarse.side - 2.0));
        const auto column = static_cast<int>(std::min(place.x, coarse.side - 2.0));
        const auto height_m = [&](int r, int c) { return coarse.heights_m[coarse.at(r, c)]; };
        const auto [low, high] = std::minmax({height_m(row, column), height_m(row, column + 1),
                                              height_m(row + 1, column), height_m(row + 1, column + 1)});
        const float apart_m = std::max(high - sample.height_m, sample.height_m - low);
        if (apart_m > most_between_m) {
            coarse.lone.push_back(place);
            continue;
        }
        for (const std::size_t at : {coarse.at(row, column), coarse.at(row, column + 1),
                                     coarse.at(row + 1, column), coarse.at(row + 1, column + 1)})
            coarse.between_m[at] = std::max(coarse.between_m[at], apart_m);
    }
    return coarse;
}

/// Every sample and, between two, their middle.
HeightSamples doubled(const HeightSamples& coarse) {
    HeightSamples fine;
    fine.side = coarse.side * 2 - 1;
    for (int row = 0; row < fine.side; ++row) {
        for (int column = 0; column < fine.side; ++column) {
            const std::size_t low = coarse.at(row / 2, column / 2);
            const std::size_t high = coarse.at((row + 1) / 2, (column + 1) / 2);
            fine.heights_m.push_back((coarse.heights_m[low] + coarse.heights_m[high]) / 2.0F);
            fine.between_m.push_back(std::max(coarse.between_m[low], coarse.between_m[high]));
        }
    }
    for (const LoneSample& sample : coarse.lone)
        fine.lone.push_back({sample.x * 2.0, sample.y * 2.0, sample.height_m});
    return fine;
}

}  // namespace

HeightSamples HeightSamples::join(const std::array<HeightSamples, 4>& children, float most_between_m) {
    int part_side = 0;
    for (const HeightSamples& child : children) part_side = std::max(part_side, child.side);
    HeightSamples whole;
    whole.side = part_side * 2 - 1;
    whole.heights_m.resize(static_cast<std::size_t>(whole.side) * static_cast<std::size_t>(whole.side));
    whole.between_m.assign(whole.heights_m.size(), 0.0F);
    for (int quadrant = 0; quadrant < 4; ++quadrant) {
        HeightSamples part = children[static_cast<std::size_t>(quadrant)];
        while (part.side < part_side) part = doubled(part);
        const int south = quadrant / 2 * (part_side - 1), west = quadrant % 2 * (part_side - 1);
        for (int row = 0; row < part_side; ++row) {
            for (int column = 0; column < part_side; ++column) {
                const std::size_t to = whole.at(south + row, west + column), from = part.at(row, column);
                whole.heights_m[to] = part.heights_m[from];
                whole.between_m[to] = std::max(whole.between_m[to], part.between_m[from]);
            }
        }
        for (const LoneSample& sample : part.lone)
            whole.lone.push_back({sample.x + west, sample.y + south, sample.height_m});
    }
    return whole.side > kMostSamples ? thinned(whole, most_between_m) : whole;
}

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

}  // namespace

namespace {

/// As std::floor and std::ceil of what an int can hold, without a call.
int floor_of(double value) {
    const auto whole = static_cast<int>(value);
    return whole > value ? whole - 1 : whole;
}
int ceiling_of(double value) {
    const auto whole = static_cast<int>(value);
    return whole < value ? whole + 1 : whole;
}

}  // namespace

template <int kParts>
float SampledSurface::greatest(const Corner& a, const Corner& b, const Corner& c, float enough_m) const {
    constexpr double kRounding = 1e-7;  // samples on the sides count
    const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    // Position at (x, y) = p0 + x px + y py.
    std::array<float, kParts> p0{}, px{}, py{};
    for (std::size_t part = 0; part < kParts; ++part) {
        const double ab = static_cast<double>(b.position_m[part]) - a.position_m[part];
        const double ac = static_cast<double>(c.position_m[part]) - a.position_m[part];
        const double by_x = (ab * (c.y - a.y) - ac * (b.y - a.y)) / area;
        const double by_y = (ac * (b.x - a.x) - ab * (c.x - a.x)) / area;
        px[part] = static_cast<float>(by_x);
        py[part] = static_cast<float>(by_y);
        p0[part] = a.position_m[part];
    }
    const int south = std::max(0, ceiling_of((std::min({a.y, b.y, c.y}) - kRounding)));
    const int north = std::min(side_ - 1, floor_of((std::max({a.y, b.y, c.y}) + kRounding)));
    const std::array<Side, 3> sides{side_between(a, b), side_between(b, c), side_between(c, a)};
    float greatest = 0.0F;
    for (int row = south; row <= north; ++row) {
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
        const int first = std::max(0, ceiling_of((west - kRounding)));
        const int last = std::min(side_ - 1, floor_of((east + kRounding)));
        const std::size_t line = static_cast<std::size_t>(row) * static_cast<std::size_t>(side_);
        const auto up = static_cast<float>(row - a.y);
        const auto square_at = [&](int column) {
            const std::size_t at = line + static_cast<std::size_t>(column);
            const auto along = static_cast<float>(column - a.x);
            float square = 0.0F;
            for (std::size_t part = 0; part < kParts; ++part) {
                const float apart = p0[part] + along * px[part] + up * py[part] - positions_m_[part][at];
                square += apart * apart;
            }
            return square;
        };
        if (all_are_samples_) {
            float square = 0.0F;
            for (int column = first; column <= last; ++column) square = std::max(square, square_at(column));
            greatest = std::max(greatest, std::sqrt(square));
        } else {
            for (int column = first; column <= last; ++column)
                greatest = std::max(greatest, std::sqrt(square_at(column)) +
                                                  between_m_[line + static_cast<std::size_t>(column)]);
        }
        if (greatest > enough_m) return greatest;
    }
    return greatest;
}

}  // namespace eyepoint::tools
