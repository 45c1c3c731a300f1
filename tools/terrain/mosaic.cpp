#include "tools/terrain/mosaic.hpp"

#include <algorithm>
#include <cmath>

#include "tools/terrain/void_fill.hpp"

namespace eyepoint::tools {

namespace {

/// Detail is lost when posts are further apart than the source's; one part in a hundred is rounding, not
/// loss.
constexpr double kSpacingTolerance = 1.01;
/// Keeps a place that only the outermost posts of a layer cover from having no weight at all within its
/// class.
constexpr float kLeastOwnWeight = 1e-4F;
constexpr double kMarginCoarserPosts = 20.0;
constexpr double kLeastMarginPosts = 4.0;

/// The layers of one class blended at one place, front to back.
struct ClassBlend {
    float height_sum = 0.0F;
    float class_sum = 0.0F;
    float weight_sum = 0.0F;
    float left = 1.0F;
    bool water = true;

    void add(const LayerSample& sample) {
        if (!sample.covered || left <= 0.0F) return;
        const float own = std::max(sample.own_weight, kLeastOwnWeight);
        const float weight = left * own;
        height_sum += weight * sample.msl_height_m;
        class_sum += weight * sample.class_weight;
        weight_sum += weight;
        water = water && sample.water;
        left *= 1.0F - own;
    }
};

terrain::GeographicExtent bounds_of_places(std::span<const LatLon> places) {
    terrain::GeographicExtent bounds{720.0, 90.0, -720.0, -90.0};
    for (const LatLon& place : places) {
        bounds.west_deg = std::min(bounds.west_deg, place.longitude_deg);
        bounds.east_deg = std::max(bounds.east_deg, place.longitude_deg);
        bounds.south_deg = std::min(bounds.south_deg, place.latitude_deg);
        bounds.north_deg = std::max(bounds.north_deg, place.latitude_deg);
    }
    return bounds;
}

terrain::GeographicExtent grown(const terrain::GeographicExtent& extent, double degrees) {
    return {extent.west_deg - degrees, extent.south_deg - degrees, extent.east_deg + degrees,
            extent.north_deg + degrees};
}

std::vector<std::vector<HeightGrid>> in_classes(std::vector<HeightGrid> grids) {
    std::stable_sort(grids.begin(), grids.end(),
                     [](const HeightGrid& a, const HeightGrid& b) { return a.spacing_deg < b.spacing_deg; });
    std::vector<std::vector<HeightGrid>> classes;
    for (HeightGrid& grid : grids) {
        if (classes.empty() || grid.spacing_deg > kLikeSpacing * classes.back().front().spacing_deg) {
            classes.emplace_back();
        }
        classes.back().push_back(std::move(grid));
    }
    for (auto& of_class : classes) {
        std::stable_sort(of_class.begin(), of_class.end(),
                         [](const HeightGrid& a, const HeightGrid& b) { return a.order < b.order; });
    }
    std::reverse(classes.begin(), classes.end());
    return classes;
}

}  // namespace

Mosaic::Mosaic(std::vector<HeightGrid> grids, const terrain::Geoid& geoid, const MosaicOptions& options,
               const std::function<void(std::size_t, std::size_t)>& progress)
    : geoid_(&geoid), max_depth_(options.max_depth) {
    const std::size_t total = grids.size();
    std::size_t done = 0;
    // Coarsest first: the voids of a finer class take the shape of what lies below it.
    for (auto& of_class : in_classes(std::move(grids))) {
        Class layers;
        std::vector<LayerFacts> facts;
        for (HeightGrid& grid : of_class) {
            facts.push_back(add_layer(layers, std::move(grid), options.sea));
            if (progress) progress(++done, total);
        }
        classes_.push_back(std::move(layers));
        fade_edges(classes_.size() - 1);
        for (std::size_t i = 0; i < facts.size(); ++i) {
            const MosaicLayer& layer = classes_.back()[i];
            facts[i].margin_posts = layer.has_edge() ? margin_posts(layer, classes_.size() - 1) : 0;
        }
        facts_.insert(facts_.begin(), facts.begin(), facts.end());
    }
}

LayerFacts Mosaic::add_layer(Class& of_class, HeightGrid grid, SeaRule rule) {
    LayerFacts facts;
    facts.files = grid.files;
    facts.spacing_deg = grid.spacing_deg;
    CoarserSurface coarser;
    if (!classes_.empty()) {
        coarser = [&, mapping = grid.mapping](std::span<const GridPosition> posts) {
            std::vector<LatLon> places;
            places.reserve(posts.size());
            for (const GridPosition& post : posts) places.push_back(mapping.to_place(post));
            std::vector<float> heights;
            heights.reserve(posts.size());
            for (const MslSample& sample : sample_msl(places)) heights.push_back(sample.msl_height_m);
            return heights;
        };
    }
    const VoidFill voids = fill_voids(grid, coarser);
    facts.voids_filled = voids.filled;
    facts.voids_outside = voids.outside;
    facts.filled_over_coarser = voids.filled > 0 && static_cast<bool>(coarser);
    std::vector<std::uint8_t> sea = find_sea(grid, rule);
    for (std::size_t post = 0; post < sea.size(); ++post) {
        if (sea[post] == 0) continue;
        grid.heights_m[post] = 0.0F;
        ++facts.sea_posts;
    }
    of_class.emplace_back(std::move(grid), std::move(sea));
    facts.bounds = of_class.back().bounds();
    return facts;
}

int Mosaic::margin_posts(const MosaicLayer& layer, std::size_t class_index) const {
    int shortest = std::min(layer.grid().columns, layer.grid().rows);
    for (const FileFacts& file : layer.grid().files) shortest = std::min({shortest, file.columns, file.rows});
    double margin = kMarginShare * shortest;
    if (class_index > 0) {
        const double coarser =
            classes_[class_index - 1].front().grid().spacing_deg / layer.grid().spacing_deg;
        margin = std::min(margin, kMarginCoarserPosts * coarser);
    }
    return static_cast<int>(std::lround(std::max(margin, kLeastMarginPosts)));
}

void Mosaic::fade_edges(std::size_t class_index) {
    Class& layers = classes_[class_index];
    for (MosaicLayer& layer : layers) {
        const int margin = margin_posts(layer, class_index);
        const HeightGrid& grid = layer.grid();
        const auto by_itself = [&](int column, int row) { return layer.covers(column, row); };
        std::vector<const MosaicLayer*> others;
        for (const MosaicLayer& other : layers) {
            if (&other != &layer &&
                meet(grown(layer.bounds(), (margin + 2) * grid.spacing_deg), other.bounds())) {
                others.push_back(&other);
            }
        }
        EdgeWeights own{grid.columns, grid.rows, margin, by_itself};
        const auto by_class = [&](int column, int row) {
            if (layer.covers(column, row)) return true;
            const LatLon place =
                grid.mapping.to_place({static_cast<double>(column), static_cast<double>(row)});
            return std::any_of(others.begin(), others.end(),
                               [&](const MosaicLayer* other) { return other->covers(place); });
        };
        EdgeWeights of_class = others.empty() ? own : EdgeWeights{grid.columns, grid.rows, margin, by_class};
        layer.set_edges(std::move(own), std::move(of_class));
    }
}

bool Mosaic::is_global() const {
    return !classes_.empty() &&
           std::any_of(classes_.front().begin(), classes_.front().end(), [](const auto& layer) {
               return !layer.has_edge() && layer.grid().columns_around() > 0;
           });
}

bool Mosaic::has_detail(terrain::TileId tile) const {
    if (tile.depth == 0) return true;
    if (tile.depth > max_depth_) return false;
    const double parent_spacing = terrain::post_spacing_deg(tile.depth - 1);
    const terrain::GeographicExtent extent = terrain::extent(tile);
    for (auto of_class = classes_.rbegin(); of_class != classes_.rend(); ++of_class) {
        for (const MosaicLayer& layer : *of_class) {
            if (parent_spacing <= kSpacingTolerance * layer.grid().spacing_deg) continue;
            const MosaicLayer::Content content = layer.content(extent);
            if (content == MosaicLayer::Content::Land) return true;
            if (content == MosaicLayer::Content::Water && tile.depth <= kDeepestSeaTile) return true;
        }
    }
    return false;
}

std::vector<Mosaic::MslSample> Mosaic::sample_msl(std::span<const LatLon> places) const {
    std::vector<MslSample> result(places.size());
    std::vector<float> left(places.size(), 1.0F);
    std::vector<LayerSample> samples(places.size());
    const terrain::GeographicExtent extent = bounds_of_places(places);
    for (auto of_class = classes_.rbegin(); of_class != classes_.rend(); ++of_class) {
        std::vector<ClassBlend> blends(places.size());
        for (const MosaicLayer& layer : *of_class) {
            if (!meet(layer.bounds(), extent)) continue;
            layer.sample(places, samples);
            for (std::size_t i = 0; i < places.size(); ++i) blends[i].add(samples[i]);
        }
        for (std::size_t i = 0; i < places.size(); ++i) {
            if (blends[i].weight_sum <= 0.0F) continue;
            const float weight = blends[i].class_sum / blends[i].weight_sum;
            if (weight <= 0.0F || left[i] <= 0.0F) continue;
            result[i].msl_height_m += left[i] * weight * (blends[i].height_sum / blends[i].weight_sum);
            result[i].water = result[i].water && blends[i].water;
            left[i] *= 1.0F - weight;
        }
    }
    // What is left over lies in the sea, at 0 m; it makes water of nothing that some source says is land.
    return result;
}

void Mosaic::sample(const Lattice& lattice, std::span<SurfaceSample> out) const {
    std::vector<LatLon> places;
    places.reserve(out.size());
    for (int row = 0; row < lattice.rows; ++row) {
        for (int column = 0; column < lattice.columns; ++column) {
            places.push_back(normalised(lattice.south_deg + row * lattice.step_deg,
                                        lattice.west_deg + column * lattice.step_deg));
        }
    }
    const std::vector<MslSample> samples = sample_msl(places);
    for (std::size_t i = 0; i < places.size(); ++i) {
        const auto height =
            geoid_->to_ellipsoidal(places[i].latitude_deg, places[i].longitude_deg,
                                   terrain::MslHeight{static_cast<double>(samples[i].msl_height_m)});
        out[i] = {static_cast<float>(height.metres()), samples[i].water};
    }
}

}  // namespace eyepoint::tools
