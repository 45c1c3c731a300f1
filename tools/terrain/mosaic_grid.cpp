#include "tools/terrain/mosaic_grid.hpp"

#include <algorithm>
#include <optional>

namespace eyepoint::tools {

namespace {

/// A rectangle of posts; the end is one past the last.
struct Box {
    int column = 0;
    int row = 0;
    int end_column = 0;
    int end_row = 0;
    [[nodiscard]] double area() const {
        return static_cast<double>(end_column - column) * static_cast<double>(end_row - row);
    }
};

Box bounding(const Box& a, const Box& b) {
    return {std::min(a.column, b.column), std::min(a.row, b.row), std::max(a.end_column, b.end_column),
            std::max(a.end_row, b.end_row)};
}

/// The other grid's box in this grid's posts if both are on one lattice and overlap or follow one another.
std::optional<Box> adjoining(const HeightGrid& grid, const HeightGrid& other) {
    const auto offset = grid.mapping.offset_of(other.mapping, other.columns, other.rows);
    if (!offset.congruent) return std::nullopt;
    const Box box{offset.columns, offset.rows, offset.columns + other.columns, offset.rows + other.rows};
    const bool touching =
        box.column <= grid.columns && box.end_column >= 0 && box.row <= grid.rows && box.end_row >= 0;
    return touching ? std::optional{box} : std::nullopt;
}

void copy_where_void(const HeightGrid& from, HeightGrid& to, int column_offset, int row_offset) {
    for (int row = 0; row < from.rows; ++row) {
        for (int column = 0; column < from.columns; ++column) {
            float& height = to.heights_m[to.index(column + column_offset, row + row_offset)];
            if (is_void(height)) height = from.heights_m[from.index(column, row)];
        }
    }
}

HeightGrid join(HeightGrid first, HeightGrid second, const Box& second_box) {
    const Box all = bounding({0, 0, first.columns, first.rows}, second_box);
    HeightGrid joined{.columns = all.end_column - all.column,
                      .rows = all.end_row - all.row,
                      .heights_m = {},
                      .mapping = first.mapping.shifted(all.column, all.row),
                      .spacing_deg = first.spacing_deg,
                      .files = std::move(first.files),
                      .order = std::min(first.order, second.order)};
    joined.heights_m.assign(joined.index(0, joined.rows), kVoid);
    const auto put_first = [&] { copy_where_void(first, joined, -all.column, -all.row); };
    const auto put_second = [&] {
        copy_where_void(second, joined, second_box.column - all.column, second_box.row - all.row);
    };
    if (first.order < second.order) {
        put_first();
        put_second();
    } else {
        put_second();
        put_first();
    }
    joined.files.insert(joined.files.end(), second.files.begin(), second.files.end());
    return joined;
}

/// Joins one pair that may be joined; false when there is none left.
bool join_one_pair(std::vector<HeightGrid>& grids) {
    for (std::size_t i = 0; i < grids.size(); ++i) {
        for (std::size_t j = i + 1; j < grids.size(); ++j) {
            const auto box = adjoining(grids[i], grids[j]);
            if (!box) continue;
            const Box own{0, 0, grids[i].columns, grids[i].rows};
            const bool contained = bounding(own, *box).area() == own.area();
            if (!contained && bounding(own, *box).area() > 2.0 * (own.area() + box->area())) continue;
            grids[i] = join(std::move(grids[i]), std::move(grids[j]), *box);
            grids.erase(grids.begin() + static_cast<std::ptrdiff_t>(j));
            return true;
        }
    }
    return false;
}

}  // namespace

double spacing_at_middle_deg(const GridMapping& mapping, int columns, int rows) {
    const GridPosition middle{0.5 * (columns - 1), 0.5 * (rows - 1)};
    const LatLon here = mapping.to_place(middle);
    const LatLon east = mapping.to_place({middle.column + 1.0, middle.row});
    const LatLon south = mapping.to_place({middle.column, middle.row + 1.0});
    const auto turn = [](double degrees) { return std::abs(std::remainder(degrees, 360.0)); };
    const double latitude_step = std::max(std::abs(east.latitude_deg - here.latitude_deg),
                                          std::abs(south.latitude_deg - here.latitude_deg));
    const double longitude_step = std::max(turn(east.longitude_deg - here.longitude_deg),
                                           turn(south.longitude_deg - here.longitude_deg));
    return std::min(latitude_step, longitude_step);
}

terrain::GeographicExtent bounds_of(const GridMapping& mapping, int columns, int rows) {
    constexpr int kStepsPerSide = 64;
    const LatLon middle = mapping.to_place({0.5 * (columns - 1), 0.5 * (rows - 1)});
    terrain::GeographicExtent bounds{middle.longitude_deg, middle.latitude_deg, middle.longitude_deg,
                                     middle.latitude_deg};
    const auto include = [&](double column, double row) {
        LatLon place = mapping.to_place({column, row});
        if (std::isnan(place.latitude_deg)) return;
        if (!mapping.is_geographic()) {
            place.longitude_deg =
                middle.longitude_deg + std::remainder(place.longitude_deg - middle.longitude_deg, 360.0);
        }
        bounds.west_deg = std::min(bounds.west_deg, place.longitude_deg);
        bounds.east_deg = std::max(bounds.east_deg, place.longitude_deg);
        bounds.south_deg = std::min(bounds.south_deg, place.latitude_deg);
        bounds.north_deg = std::max(bounds.north_deg, place.latitude_deg);
    };
    for (int step = 0; step <= kStepsPerSide; ++step) {
        const double column = -0.5 + static_cast<double>(columns) * step / kStepsPerSide;
        const double row = -0.5 + static_cast<double>(rows) * step / kStepsPerSide;
        include(column, -0.5);
        include(column, rows - 0.5);
        include(-0.5, row);
        include(columns - 0.5, row);
    }
    bounds.south_deg = std::max(bounds.south_deg, -90.0);
    bounds.north_deg = std::min(bounds.north_deg, 90.0);
    return bounds;
}

bool meet(const terrain::GeographicExtent& a, const terrain::GeographicExtent& b) {
    if (a.north_deg < b.south_deg || a.south_deg > b.north_deg) return false;
    // The least whole turn that brings a's east end to b's west end or past it.
    const double turn = std::ceil((b.west_deg - a.east_deg) / 360.0) * 360.0;
    return a.west_deg + turn <= b.east_deg;
}

LatLon normalised(double latitude_deg, double longitude_deg) {
    if (std::abs(latitude_deg) > 90.0) {
        latitude_deg = std::copysign(180.0, latitude_deg) - latitude_deg;
        longitude_deg += 180.0;
    }
    if (std::abs(latitude_deg) == 90.0) return {latitude_deg, 0.0};
    if (longitude_deg < -180.0 || longitude_deg >= 180.0) {
        longitude_deg -= 360.0 * std::floor((longitude_deg + 180.0) / 360.0);
    }
    return {latitude_deg, longitude_deg};
}

std::vector<HeightGrid> join_neighbours(std::vector<HeightGrid> grids) {
    while (join_one_pair(grids)) {
    }
    return grids;
}

}  // namespace eyepoint::tools
