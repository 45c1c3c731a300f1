/// Reading one imagery file into a grid of colours.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "tools/terrain/gdal_elevation.hpp"
#include "tools/terrain/mosaic_grid.hpp"

namespace eyepoint::tools {

/// Most pixels read from all imagery files of one build together: about 2 GB of memory while compiling.
inline constexpr std::uint64_t kMaxPixels = 400'000'000;

struct ImageryInput {
    std::string file;
    std::optional<terrain::GeographicExtent> extent;  ///< over what the file says, edge to edge
    /// Pixels whose red, green and blue all have this value are void: 0 for a black fill that the file does
    /// not name.
    std::optional<int> nodata;
};

/// Colours on the pixels of a raster, rows from the first line of the file.
struct ColourGrid {
    int columns = 0;
    int rows = 0;
    std::vector<std::uint8_t> rgba;  ///< alpha 0 where the file has no colour
    GridMapping mapping;
    double spacing_deg = 0.0;
    FileFacts facts;
};

/// Reads 8-bit RGB, RGBA, grey or palette pictures; alpha, mask and nodata of the file become alpha. A
/// picture without georeference that is twice as wide as high is taken as the whole planet, with a note. On
/// failure: one sentence with the file, the fault and what to do.
[[nodiscard]] tl::expected<ColourGrid, std::string> read_imagery(const ImageryInput& input,
                                                                 const ReadProgress& progress = {});

}  // namespace eyepoint::tools
