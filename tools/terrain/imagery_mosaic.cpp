#include "tools/terrain/imagery_mosaic.hpp"

#include <algorithm>
#include <cmath>

#include "tools/terrain/mosaic_distance.hpp"

namespace eyepoint::tools {

namespace {

constexpr double kDetailFactor = 1.3;

bool has_colour(const ColourGrid& grid, int column, int row) {
    if (column < 0 || row < 0 || column >= grid.columns || row >= grid.rows) return false;
    const auto pixel = static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns) +
                       static_cast<std::size_t>(column);
    return grid.rgba[pixel * 4 + 3] != 0;
}

bool has_colour(const ColourGrid& grid, LatLon place) {
    const GridPosition at = grid.mapping.to_grid(place);
    if (!(std::abs(at.column) < 1e9 && std::abs(at.row) < 1e9)) return false;
    return has_colour(grid, static_cast<int>(std::lround(at.column)), static_cast<int>(std::lround(at.row)));
}

bool goes_round(const ColourGrid& grid) {
    const int around = grid.mapping.columns_around();
    return around > 0 && grid.columns >= around;
}

double texel_spacing_deg(std::uint32_t depth) {
    return terrain::tile_side_deg(depth) / (terrain::kImageTexels - 1);
}

/// Whether two extents share more than an edge.
bool overlap(const terrain::GeographicExtent& a, terrain::GeographicExtent b) {
    const double sliver = 1e-9;
    b.west_deg += sliver;
    b.east_deg -= sliver;
    b.south_deg += sliver;
    b.north_deg -= sliver;
    return meet(a, b);
}

}  // namespace

void ImageMosaic::fade_edges(std::vector<ColourGrid*>& of_class) {
    // All edges are judged before any alpha is changed.
    std::vector<EdgeWeights> weights;
    for (const ColourGrid* grid : of_class) {
        const int margin = std::max(2, static_cast<int>(kMarginShare * std::min(grid->columns, grid->rows)));
        const terrain::GeographicExtent own = bounds_of(grid->mapping, grid->columns, grid->rows);
        std::vector<const ColourGrid*> near;
        for (const ColourGrid* other : of_class) {
            if (other != grid && meet(own, bounds_of(other->mapping, other->columns, other->rows)))
                near.push_back(other);
        }
        const bool round = goes_round(*grid);
        weights.emplace_back(grid->columns, grid->rows, margin, [&](int column, int row) {
            if (round) column = (column + grid->columns) % grid->columns;
            // A picture that goes round the Earth ends at the poles or where no other follows.
            if (round && (row < 0 || row >= grid->rows)) return true;
            if (has_colour(*grid, column, row)) return true;
            const LatLon place =
                grid->mapping.to_place({static_cast<double>(column), static_cast<double>(row)});
            return std::any_of(near.begin(), near.end(),
                               [&](const auto* other) { return has_colour(*other, place); });
        });
    }
    for (std::size_t i = 0; i < of_class.size(); ++i) {
        if (weights[i].is_one()) continue;
        std::vector<std::uint8_t>& rgba = of_class[i]->rgba;
        for (std::size_t pixel = 0; pixel * 4 < rgba.size(); ++pixel) {
            rgba[pixel * 4 + 3] =
                static_cast<std::uint8_t>(std::lround(rgba[pixel * 4 + 3] * weights[i].at(pixel)));
        }
    }
}

ImageMosaic::ImageMosaic(std::vector<ColourGrid> grids, std::uint32_t max_depth) : max_depth_(max_depth) {
    std::stable_sort(grids.begin(), grids.end(),
                     [](const ColourGrid& a, const ColourGrid& b) { return a.spacing_deg < b.spacing_deg; });
    for (std::size_t first = 0; first < grids.size();) {
        std::vector<ColourGrid*> of_class;
        std::size_t next = first;
        while (next < grids.size() && grids[next].spacing_deg <= kLikeSpacing * grids[first].spacing_deg) {
            of_class.push_back(&grids[next++]);
        }
        fade_edges(of_class);
        first = next;
    }
    for (ColourGrid& grid : grids) {
        const auto bounds = bounds_of(grid.mapping, grid.columns, grid.rows);
        const bool round = goes_round(grid);
        facts_.push_back(std::move(grid.facts));
        pictures_.push_back({std::move(grid.mapping), grid.columns, grid.rows, grid.spacing_deg, bounds,
                             round, ImagePyramid{grid.columns, grid.rows, std::move(grid.rgba), round}});
    }
}

bool ImageMosaic::is_global() const {
    return std::any_of(pictures_.begin(), pictures_.end(), [](const Picture& picture) {
        return picture.goes_round && picture.bounds.south_deg <= -89.9 && picture.bounds.north_deg >= 89.9;
    });
}

bool ImageMosaic::has_detail(terrain::TileId tile) const {
    if (tile.depth == 0) return true;
    if (tile.depth > max_depth_) return false;
    const double parent_texel = texel_spacing_deg(tile.depth - 1);
    const terrain::GeographicExtent extent = terrain::extent(tile);
    return std::any_of(pictures_.begin(), pictures_.end(), [&](const Picture& picture) {
        return parent_texel > kDetailFactor * picture.spacing_deg && overlap(picture.bounds, extent);
    });
}

void ImageMosaic::sample(const Lattice& lattice, std::span<std::uint8_t> out) const {
    std::vector<LatLon> places;
    const std::size_t texels = out.size() / 3;
    places.reserve(texels);
    for (int row = 0; row < lattice.rows; ++row) {
        for (int column = 0; column < lattice.columns; ++column) {
            places.push_back(normalised(lattice.south_deg + row * lattice.step_deg,
                                        lattice.west_deg + column * lattice.step_deg));
        }
    }
    const terrain::GeographicExtent extent{lattice.west_deg, lattice.south_deg,
                                           lattice.west_deg + lattice.step_deg * (lattice.columns - 1),
                                           lattice.south_deg + lattice.step_deg * (lattice.rows - 1)};
    std::vector<Colour> blend(texels);
    std::vector<GridPosition> positions(texels);
    for (const Picture& picture : pictures_) {
        if (!meet(picture.bounds, extent)) continue;
        picture.mapping.to_grid(places, positions);
        const int level =
            static_cast<int>(std::lround(std::log2(std::max(1.0, lattice.step_deg / picture.spacing_deg))));
        for (std::size_t i = 0; i < texels; ++i) {
            const double u = (positions[i].column + 0.5) / picture.columns;
            const double v = (positions[i].row + 0.5) / picture.rows;
            const bool inside =
                v >= -1e-9 && v <= 1.0 + 1e-9 && (picture.goes_round || (u >= -1e-9 && u <= 1.0 + 1e-9));
            if (!inside || blend[i].alpha >= 1.0F) continue;
            const Colour colour = picture.pyramid.at(level, u, v);
            const float weight = (1.0F - blend[i].alpha) * colour.alpha;
            for (std::size_t c = 0; c < 3; ++c) blend[i].rgb[c] += weight * colour.rgb[c];
            blend[i].alpha += weight;
        }
    }
    for (std::size_t i = 0; i < texels; ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            const float value =
                blend[i].rgb[c] + (1.0F - blend[i].alpha) * static_cast<float>(kUnseenGround[c]);
            out[i * 3 + c] = static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0F, 255.0F)));
        }
    }
}

}  // namespace eyepoint::tools
