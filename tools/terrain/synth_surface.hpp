/// The synthetic planet: continents and oceans by noise, and the mountain region (synth_region.hpp) set into
/// them.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>

#include "terrain/geodesy/geoid.hpp"
#include "tools/terrain/surface_source.hpp"
#include "tools/terrain/synth_region.hpp"

namespace eyepoint::tools {

struct SynthRequest {
    std::uint64_t seed = 1;
    double centre_latitude_deg = 46.45;
    double centre_longitude_deg = 8.25;
    double size_deg = 1.2;    ///< side of the square in full detail, in latitude and in longitude
    double spacing_m = 40.0;  ///< of posts inside it, at most, north to south
    /// When set, full detail is a field of this many posts a side, 32 n + 1, on the tiles around the centre.
    std::optional<int> benchmark_field_posts;
};

/// Heights are ellipsoidal; the sea stands at the geoid.
/// Thread use: const use is safe from any thread. The same seed gives the same bits.
class SynthSurface final : public ElevationSource {
  public:
    /// The geoid is kept by reference. Takes some ten seconds; cancelled is asked about every second, and may
    /// be empty. Nothing is made once it says so.
    [[nodiscard]] static std::optional<SynthSurface> make(const SynthRequest& request,
                                                          const terrain::Geoid& geoid,
                                                          const std::function<bool()>& cancelled = {});

    [[nodiscard]] bool has_detail(terrain::TileId tile) const override;
    void sample(const Lattice& lattice, std::span<SurfaceSample> out) const override;

    /// The ground in full detail.
    [[nodiscard]] const terrain::GeographicExtent& detail_extent() const { return detail_; }

    /// Height of the surface (the water's where there is water), and whether it is water.
    struct Place {
        double msl_m = 0.0;
        bool water = false;
    };
    [[nodiscard]] Place at(double latitude_deg, double longitude_deg) const;

  private:
    SynthSurface(const SynthRequest& request, const terrain::Geoid& geoid,
                 const terrain::GeographicExtent& detail, SynthRegion region);

    const terrain::Geoid& geoid_;
    std::uint64_t seed_;
    double spacing_m_;
    terrain::GeographicExtent detail_;
    SynthRegion region_;
};

/// The depth whose posts are at most so far apart, north to south.
[[nodiscard]] std::uint32_t depth_for_spacing(double spacing_m);

}  // namespace eyepoint::tools
