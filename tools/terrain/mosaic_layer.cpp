#include "tools/terrain/mosaic_layer.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace eyepoint::tools {

namespace {

constexpr int kBlock = 32;

/// Steffen's cubic through b and c, with a and d beyond them; NaN neighbours are taken as a straight
/// continuation.
float steffen(double a, double b, double c, double d, double t) {
    const double slope = c - b;
    const double before = std::isnan(a) ? slope : b - a;
    const double after = std::isnan(d) ? slope : d - c;
    const auto tangent = [](double left, double right) {
        if (left * right <= 0.0) return 0.0;
        const double least = std::min({std::abs(left), std::abs(right), 0.25 * std::abs(left + right)});
        return std::copysign(2.0 * least, left);
    };
    const double start = tangent(before, slope);
    const double end = tangent(slope, after);
    const double cubic = start + end - 2.0 * slope;
    const double square = 3.0 * slope - 2.0 * start - end;
    return static_cast<float>(((cubic * t + square) * t + start) * t + b);
}

}  // namespace

MosaicLayer::MosaicLayer(HeightGrid grid, std::vector<std::uint8_t> water)
    : grid_(std::move(grid)),
      water_(std::move(water)),
      bounds_(bounds_of(grid_.mapping, grid_.columns, grid_.rows)) {
    around_ = grid_.columns_around();
    if (around_ > 0) {
        const double north = grid_.mapping.to_grid(LatLon{90.0, 0.0}).row;
        const double south = grid_.mapping.to_grid(LatLon{-90.0, 0.0}).row;
        folds_ = around_ % 2 == 0 && std::abs(north) < 1.1 && std::abs(south - (grid_.rows - 1)) < 1.1;
        north_fold_ = static_cast<int>(std::lround(2.0 * north));
        south_fold_ = static_cast<int>(std::lround(2.0 * south));
    }
    summarise();
}

void MosaicLayer::set_edges(EdgeWeights own, EdgeWeights of_class) {
    own_ = std::move(own);
    of_class_ = std::move(of_class);
}

void MosaicLayer::summarise() {
    block_columns_ = (grid_.columns + kBlock - 1) / kBlock;
    const int block_rows = (grid_.rows + kBlock - 1) / kBlock;
    blocks_.assign(static_cast<std::size_t>(block_columns_) * static_cast<std::size_t>(block_rows),
                   Content::None);
    for (int row = 0; row < grid_.rows; ++row) {
        for (int column = 0; column < grid_.columns; ++column) {
            const std::size_t at = grid_.index(column, row);
            if (is_void(grid_.heights_m[at])) continue;
            Content& block =
                blocks_[static_cast<std::size_t>(row / kBlock) * static_cast<std::size_t>(block_columns_) +
                        static_cast<std::size_t>(column / kBlock)];
            block = std::max(block, water_[at] != 0 ? Content::Water : Content::Land);
        }
    }
}

std::ptrdiff_t MosaicLayer::post(int column, int row) const {
    if (folds_ && (row < 0 || row >= grid_.rows)) {
        row = row < 0 ? north_fold_ - row : south_fold_ - row;
        column += around_ / 2;
    }
    if (around_ > 0) column = ((column % around_) + around_) % around_;
    return grid_.holds(column, row) ? static_cast<std::ptrdiff_t>(grid_.index(column, row)) : -1;
}

float MosaicLayer::height(int column, int row) const {
    const std::ptrdiff_t at = post(column, row);
    return at < 0 ? kVoid : grid_.heights_m[static_cast<std::size_t>(at)];
}

bool MosaicLayer::covers(int column, int row) const { return !is_void(height(column, row)); }

GridPosition MosaicLayer::onto_posts(GridPosition position) const {
    // A pixel's area reaches half a post beyond its centre.
    constexpr double kReach = 0.5 + 1e-6;
    const auto pulled = [](double at, int count) {
        if (at < 0.0 && at >= -kReach) return 0.0;
        if (at > count - 1 && at <= count - 1 + kReach) return static_cast<double>(count - 1);
        return at;
    };
    if (around_ == 0) position.column = pulled(position.column, grid_.columns);
    if (!folds_) position.row = pulled(position.row, grid_.rows);
    return position;
}

bool MosaicLayer::covers(LatLon place) const {
    const GridPosition position = onto_posts(grid_.mapping.to_grid(place));
    if (!(std::abs(position.column) < 1e9 && std::abs(position.row) < 1e9)) return false;
    return covers(static_cast<int>(std::lround(position.column)),
                  static_cast<int>(std::lround(position.row)));
}

float MosaicLayer::along_row(int column, int row, double dx) const {
    if (dx == 0.0) return height(column, row);
    return steffen(height(column - 1, row), height(column, row), height(column + 1, row),
                   height(column + 2, row), dx);
}

float MosaicLayer::interpolated(int column, int row, double dx, double dy) const {
    if (dy == 0.0) return along_row(column, row, dx);
    return steffen(along_row(column, row - 1, dx), along_row(column, row, dx), along_row(column, row + 1, dx),
                   along_row(column, row + 2, dx), dy);
}

LayerSample MosaicLayer::sample(GridPosition position) const {
    position = onto_posts(position);
    // NaN, and what lies far outside, fails here.
    if (!(position.column > -2.0 && position.row > -2.0 && position.column < grid_.columns + 1.0 &&
          position.row < grid_.rows + 1.0)) {
        return {};
    }
    const double whole_column = std::floor(position.column);
    const double whole_row = std::floor(position.row);
    const double dx = position.column - whole_column;
    const double dy = position.row - whole_row;
    const int column = static_cast<int>(whole_column);
    const int row = static_cast<int>(whole_row);
    LayerSample result{.water = true, .covered = true};
    for (int corner = 0; corner < 4; ++corner) {
        const double share = ((corner & 1) != 0 ? dx : 1.0 - dx) * ((corner & 2) != 0 ? dy : 1.0 - dy);
        if (share == 0.0) continue;
        const std::ptrdiff_t at = post(column + (corner & 1), row + (corner >> 1));
        if (at < 0 || is_void(grid_.heights_m[static_cast<std::size_t>(at)])) return {};
        const auto index = static_cast<std::size_t>(at);
        result.own_weight += static_cast<float>(share) * own_.at(index);
        result.class_weight += static_cast<float>(share) * of_class_.at(index);
        result.water = result.water && water_[index] != 0;
    }
    result.msl_height_m = result.water ? 0.0F : interpolated(column, row, dx, dy);
    return result;
}

void MosaicLayer::sample(std::span<const LatLon> places, std::span<LayerSample> out) const {
    std::vector<GridPosition> positions(places.size());
    grid_.mapping.to_grid(places, positions);
    std::transform(positions.begin(), positions.end(), out.begin(),
                   [&](GridPosition at) { return sample(at); });
}

MosaicLayer::Content MosaicLayer::content(const terrain::GeographicExtent& extent) const {
    if (!meet(bounds_, extent)) return Content::None;
    constexpr int kProbes = 5;
    std::array<LatLon, kProbes * kProbes> places;
    for (int i = 0; i < kProbes * kProbes; ++i) {
        const int column = i % kProbes, row = i / kProbes;
        const double across = static_cast<double>(column) / (kProbes - 1);
        const double up = static_cast<double>(row) / (kProbes - 1);
        places[static_cast<std::size_t>(i)] = {std::lerp(extent.south_deg, extent.north_deg, up),
                                               std::lerp(extent.west_deg, extent.east_deg, across)};
    }
    std::array<GridPosition, kProbes * kProbes> at;
    grid_.mapping.to_grid(places, at);
    const auto [west, east] = std::minmax_element(
        at.begin(), at.end(), [](const auto& a, const auto& b) { return a.column < b.column; });
    const auto [north, south] =
        std::minmax_element(at.begin(), at.end(), [](const auto& a, const auto& b) { return a.row < b.row; });
    const bool unclear =
        std::any_of(at.begin(), at.end(), [](const auto& p) { return std::isnan(p.column + p.row); });
    // Where a tile is large against the grid, or straddles where columns wrap, its outline says little:
    // assume most.
    const double span_deg = extent.east_deg - extent.west_deg;
    const bool large = span_deg > 0.5 * (bounds_.east_deg - bounds_.west_deg);
    const bool wrapped =
        (east->column - west->column) * grid_.spacing_deg > 3.0 * span_deg + 3.0 * grid_.spacing_deg;
    if (unclear || large || (grid_.mapping.is_geographic() && wrapped)) return Content::Land;
    // Projected outlines bulge between the probes by less than a cell of the probes.
    const double slack_columns =
        2.0 + (grid_.mapping.is_geographic() ? 0.0 : 0.05 * (east->column - west->column));
    const double slack_rows = 2.0 + (grid_.mapping.is_geographic() ? 0.0 : 0.05 * (south->row - north->row));
    const auto block = [](double position, int count) {
        return static_cast<int>(std::clamp(position, 0.0, static_cast<double>(count - 1))) / kBlock;
    };
    if (east->column < -slack_columns || west->column > grid_.columns + slack_columns) return Content::None;
    if (south->row < -slack_rows || north->row > grid_.rows + slack_rows) return Content::None;
    Content most = Content::None;
    for (int row = block(north->row - slack_rows, grid_.rows);
         row <= block(south->row + slack_rows, grid_.rows); ++row) {
        for (int column = block(west->column - slack_columns, grid_.columns);
             column <= block(east->column + slack_columns, grid_.columns); ++column) {
            most = std::max(most,
                            blocks_[static_cast<std::size_t>(row) * static_cast<std::size_t>(block_columns_) +
                                    static_cast<std::size_t>(column)]);
        }
    }
    return most;
}

}  // namespace eyepoint::tools
